# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The Aerosonde against SciPy on the book's equations: trim, modes, a manoeuvre, its motor."""

import pytest

from benchmarks.vehicles.aircraft import manoeuvre, modes, trims
from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.electric_motor import AEROSONDE_MOTOR, ElectricMotor
from test.support import aircraft_equations as equations
from test.support.aircraft_runs import Aircraft


@pytest.fixture(scope='module')
def aircraft():
    return Aircraft()


@pytest.mark.parametrize('airspeed', [20.0, 25.0, 30.0, 32.0])
def test_level_trim(aircraft, airspeed):
    """Promised to 0.5 %; the share of attached flow leaves 1e-5."""
    (row,) = trims(aircraft, [airspeed])
    assert row['error'] < 1e-4
    assert 0.6 < row['measured']['throttle'] < 1.0
    by_torque = row['measured']['throttle_by_torque']
    assert by_torque == pytest.approx(row['solved']['throttle'], rel=1e-4)


def test_free_modes(aircraft):
    found = modes(aircraft, 25.0)
    assert max(mode['error'] for mode in found.values()) < 1e-4
    assert found['short period']['imaginary'] > found['phugoid']['imaginary'] > 0
    assert found['spiral']['real'] > 0  # slowly unstable, as the book's


def test_manoeuvre_of_every_input(aircraft):
    assert manoeuvre(aircraft, 25.0)['error'] < 1e-4


def test_the_keyframe_flies_level_hands_off():
    simulation = Simulation('aerosonde')
    simulation.enable_wind(False)
    simulation.step(2000)
    assert simulation.data.qpos[:3] == pytest.approx([250, 0, 100], abs=1e-3)


@pytest.mark.parametrize(
    ('surface', 'direction', 'axis'),
    [('aileron', 1, 3), ('elevator', 1, 4), ('rudder', 1, 5)],
)
def test_a_surface_turns_the_way_it_is_drawn(surface, direction, axis):
    """Aileron > 0 rolls right, elevator > 0 pitches down, rudder > 0 yaws left, in FLU."""
    simulation = Simulation('aerosonde')
    simulation.enable_wind(False)
    trim = simulation.data.ctrl[simulation.vehicles['aerosonde'].joint_ids].copy()
    names = simulation.vehicles['aerosonde'].joints
    before = simulation.data.qpos[7:].copy()
    simulation.set_joints('aerosonde', {surface: trim[names.index(surface)] + 0.1})
    simulation.step(60)
    assert direction * simulation.data.qvel[axis] > 0.01
    left_aileron, right_aileron, left_tail, right_tail = simulation.data.qpos[7:] - before
    drawn = {
        'aileron': (left_aileron, -right_aileron), 'elevator': (left_tail, right_tail),
        'rudder': (-left_tail, right_tail),
    }  # fmt: skip
    assert drawn[surface] == pytest.approx((0.1, 0.1), abs=2e-3)


PROPELLER = {'torque_coefficients': equations.CQ, 'diameter': 0.508, 'density': equations.RHO}


@pytest.mark.parametrize(('throttle', 'airspeed'), [(0.5, 0.0), (0.8, 25.0), (1.0, 32.0)])
def test_motor_and_propeller_are_in_equilibrium(throttle, airspeed):
    speed = AEROSONDE_MOTOR.speed(throttle, airspeed, **PROPELLER)
    assert speed == pytest.approx(equations.motor_speed(throttle, airspeed), rel=1e-12)
    _, torque = equations.propeller(speed, airspeed)
    assert AEROSONDE_MOTOR.throttle(speed, torque) == pytest.approx(throttle, rel=1e-12)


def test_a_motor_that_cannot_be_is_refused():
    assert AEROSONDE_MOTOR.speed(0.0, 0.0, **PROPELLER) == 0.0
    with pytest.raises(ConfigError, match="motor 'resistance': 0"):
        ElectricMotor(0.06, 0.0, 1.5, 44.4)
    with pytest.raises(ConfigError, match='no steady speed at throttle 1 and 25 m/s'):
        AEROSONDE_MOTOR.speed(1.0, 25.0, torque_coefficients=(-1, 0, 0), diameter=0.5, density=1.2)
