# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Fins of any number, place and sign turn a torpedo as a rudder and stern planes do."""

import numpy as np
import pytest

from fluid_sim_ros.control.fins import PITCH, ROLL, YAW, FinMixer
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.propulsion import Propulsion
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.fin_effect import fin_effect
from fluid_sim_ros.simulation.plant import plant_of

A = 0.7  # [1/m^2]
LIMIT = 0.25  # [rad]


def limits(count):
    return np.tile([-LIMIT, LIMIT], (count, 1))


def x_tail():
    """Four fins at 45 degrees, each turning the vehicle in pitch, yaw and roll."""
    angles = np.radians([45, 135, 225, 315])
    return np.array([np.full(4, 3.0), A * np.sin(angles), A * np.cos(angles)])


@pytest.mark.parametrize(
    'effect',
    [
        np.array([[0.0, 0.0], [0.0, A], [A, 0.0]]),  # rudder, planes
        np.array([[0.3, 0.0], [0.0, -A], [-A, 0.0]]),  # both the other way round
        np.array([[0.2, 0.2, -0.2, -0.2], [0, A / 2, 0, A / 2], [A / 2, 0, A / 2, 0]]),
        x_tail(),
    ],
    ids=['plus', 'reversed', 'four single', 'x'],
)
@pytest.mark.parametrize(('rudder', 'planes'), [(0.1, 0.0), (0.0, -0.2), (0.05, 0.08)])
def test_the_fins_turn_it_as_a_rudder_and_planes_of_the_same_authority_do(effect, rudder, planes):
    names = [f'fin{i}' for i in range(effect.shape[1])]
    mixer = FinMixer(names, effect, limits(len(names)))
    assert mixer.names == tuple(names) and mixer.lacks == ()
    turned = effect @ mixer.mix(rudder, planes)
    assert turned[YAW] == pytest.approx(mixer.authority * rudder, abs=1e-12)
    assert turned[PITCH] == pytest.approx(mixer.authority * planes, abs=1e-12)
    if len(names) == 4:
        assert turned[ROLL] == pytest.approx(0.0, abs=1e-12)
    # at the largest deflection of one axis the most loaded fin is at its limit
    most = max(np.abs(mixer.mix(mixer.max_deflection, 0.0)))
    other = max(np.abs(mixer.mix(0.0, mixer.max_deflection)))
    assert max(most, other) == pytest.approx(LIMIT)


def test_no_fin_leaves_its_limits():
    mixer = FinMixer(['a', 'b', 'c', 'd'], x_tail(), limits(4))
    assert np.abs(mixer.mix(9.0, -9.0)).max() <= LIMIT


def test_joints_that_do_not_turn_it_are_left_alone_and_missing_axes_are_said():
    effect = np.array([[0.0, 0.0, 0.0], [0.0, 0.001, 0.0], [0.0, 0.0, -A]])
    mixer = FinMixer(['arm', 'mast', 'tail'], effect, limits(3))
    assert mixer.names == ('tail',)
    assert mixer.lacks == ('pitch',)
    assert mixer.authority == pytest.approx(A)
    assert mixer.mix(0.1, 0.2) == pytest.approx([-0.1])


def test_no_fins_and_fins_without_limits_are_refused():
    with pytest.raises(ConfigError, match=r'that turn the vehicle.*has the joint actuators: arm'):
        FinMixer(['arm'], np.zeros((3, 1)), limits(1))
    with pytest.raises(ConfigError, match='fins tail: need limits'):
        FinMixer(['tail'], np.array([[0.0], [0.0], [A]]), np.array([[-np.inf, np.inf]]))


def test_the_measured_fins_of_the_remus_are_those_that_its_gains_state():
    """Muuds and Nuudr of Prestero (2001) over moment of inertia and added moment of inertia."""
    _, vehicle = plant_of('remus100', '')
    rudder, planes = fin_effect('remus100', vehicle).T
    assert rudder[YAW] == pytest.approx(0.74, rel=0.05)
    assert planes[PITCH] == pytest.approx(0.74, rel=0.05)
    assert abs(rudder[PITCH]) < 1e-6 and abs(planes[YAW]) < 1e-6


def plant(matrix, limits_n):
    columns = np.zeros((6, len(matrix)))
    columns[0] = matrix
    return Plant(30.0, (0.2, 3.0, 3.0), 0.0, columns, np.array(limits_n, dtype=float))


def test_twin_propellers_share_the_thrust_by_their_limits():
    both = Propulsion(plant([1.0, 1.0, 0.0], [[-2, 10], [-2, 5], [-9, 9]]))
    assert both.plant.thrust_limits.tolist() == [[-4.0, 15.0]]
    assert both.thrusts(15.0) == pytest.approx([10.0, 5.0, 0.0])
    assert both.thrusts(3.0) == pytest.approx([2.0, 1.0, 0.0])


def test_one_propeller_is_left_as_it_is():
    single = plant([1.0], [[0, 10]])
    alone = Propulsion(single)
    assert alone.plant is single and alone.thrusts(7.0) == [7.0]
    with pytest.raises(ConfigError, match='no thruster pushes forward'):
        Propulsion(plant([0.0], [[0, 10]]))
