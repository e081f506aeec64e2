# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Steady speeds and free decay of the vehicles against SciPy on the same equations, 0.5 %."""

import numpy as np
import pytest

from test.support import vehicle_runs as runs
from test.support.vehicle_equations import EQUATIONS, G

ROVS = ('bluerov2_heavy', 'bluerov2')
COPTERS = ('x500', 'crazyflie')
SHARE = 0.005  # of the value, as promised


@pytest.mark.parametrize('direction', runs.TOP_SPEEDS)
@pytest.mark.parametrize('name', ROVS)
def test_top_speed_of_an_rov(name, direction):
    equations, axis = EQUATIONS[name], runs.TOP_SPEEDS[direction]
    command = runs.top_command(direction, len(equations.rotors.axis))
    expected = equations.top_velocity(command)
    assert abs(expected[axis]) > 0.5
    assert runs.top_speed(name, direction) == pytest.approx(expected[axis], rel=SHARE)


@pytest.mark.parametrize(('axis', 'initial', 'seconds'), [(2, 1.0, 6.0), (5, 1.5, 6.0)])
@pytest.mark.parametrize('name', ROVS)
def test_free_decay_of_an_rov(name, axis, initial, seconds):
    times, measured = runs.decay(name, axis, initial, seconds)
    equations = EQUATIONS[name]
    start = initial * np.eye(6)[axis]
    expected = equations.flight(
        times, np.zeros(len(equations.rotors.axis)), v=start[:3], w=start[3:]
    )[:, axis]
    # of what it began with
    assert abs(expected[-1]) < 0.2 * initial
    np.testing.assert_allclose(measured, expected, atol=SHARE * initial)


@pytest.mark.parametrize('name', COPTERS)
def test_hover_command_of_a_multirotor(name):
    equations = EQUATIONS[name]
    thrust, speed = equations.level_flight(0.0)
    assert thrust == pytest.approx(equations.mass * G / 4, rel=1e-9)
    assert speed == pytest.approx(0, abs=1e-6)
    velocity = runs.tilted(name, 0.0, thrust, 3.0, 0.0)
    settled = velocity[500:, 2]  # after 1 s the lag is over
    assert abs(settled[-1] - settled[0]) / 2.0 < SHARE * 0.02 * G


@pytest.mark.parametrize('tilt_deg', [5, 10, 20])
@pytest.mark.parametrize('name', COPTERS)
def test_speed_of_a_multirotor_against_its_tilt(name, tilt_deg):
    thrust, speed = EQUATIONS[name].level_flight(np.deg2rad(tilt_deg))
    velocity = runs.tilted(name, np.deg2rad(tilt_deg), thrust, 90.0, 0.8 * speed)[-1]
    assert velocity[0] == pytest.approx(speed, rel=SHARE)
    assert abs(velocity[1]) < 1e-9
    assert abs(velocity[2]) < SHARE * speed


@pytest.mark.parametrize('name', COPTERS)
def test_manoeuvre_of_a_multirotor_in_all_six_directions(name):
    """Lag, thrust, reaction torque, drag and the turning body together, from the hover."""
    equations = EQUATIONS[name]
    hover = equations.mass * G / 4
    command = hover * np.array([1.05, 0.99, 1.01, 0.98])
    simulation = runs.start(name, 500)
    simulation.set_thrust(name, command)
    times, measured = runs.free(simulation, name, 0.4, 5)
    expected = equations.flight(times, command, thrust=hover)
    # a first-order integrator at 2 ms: a share of the largest of each kind
    for part in (slice(0, 3), slice(3, 6)):
        largest = np.abs(expected[:, part]).max()
        np.testing.assert_allclose(measured[:, part], expected[:, part], atol=0.02 * largest)


def test_manoeuvre_of_an_rov_in_all_six_directions():
    equations = EQUATIONS['bluerov2']
    command = np.array([-5.0, -3, 4, 6, 10, 8])
    simulation = runs.start('bluerov2', -50)
    simulation.set_thrust('bluerov2', command)
    times, measured = runs.free(simulation, 'bluerov2', 5.0, 50)
    expected = equations.flight(times, command)
    for part in (slice(0, 3), slice(3, 6)):
        largest = np.abs(expected[:, part]).max()
        np.testing.assert_allclose(measured[:, part], expected[:, part], atol=0.02 * largest)
