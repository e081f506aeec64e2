# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Command to speed to thrust and torque: each curve against its numpy twin and its source."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics import propulsion
from fluid_sim_ros.physics.t200 import SUPPLIES, t200_speed_constants, t200_table
from test.support.plugin_models import load
from test.support.thruster_models import AEROSONDE, T200, X500, read, rotor_world, settle

POLYNOMIAL = {
    'curve': 'polynomial', 'polynomial_forward': [1e-3, 2e-6, 3e-8],
    'polynomial_reverse': [5e-4, 1e-6], 'rad_s_max': [900, 600], 'torque_ratio': 0.02,
}  # fmt: skip
QUADRATIC = {
    'curve': 'quadratic', 'thrust_coefficient': [4e-5, 3e-5], 'rad_s_max': [900, 600],
}  # fmt: skip
SPEEDS = np.linspace(-600, 900, 31)


def thrusts(values, commands, command='rad_s'):
    model, data = load(rotor_world({**values, 'command': command}))
    return np.array([settle(model, data, value)['thrust'] for value in commands])


def test_quadratic_thrust():
    wanted = propulsion.quadratic_thrust(SPEEDS, 4e-5, 3e-5)
    np.testing.assert_allclose(thrusts(QUADRATIC, SPEEDS), wanted, rtol=1e-14)


def test_polynomial_thrust_and_its_torque():
    wanted = propulsion.polynomial_thrust(
        SPEEDS, POLYNOMIAL['polynomial_forward'], POLYNOMIAL['polynomial_reverse']
    )
    np.testing.assert_allclose(thrusts(POLYNOMIAL, SPEEDS), wanted, rtol=1e-14)
    model, data = load(rotor_world({**POLYNOMIAL, 'command': 'rad_s'}))
    assert settle(model, data, 500)['torque'] == pytest.approx(
        0.02 * settle(model, data, 500)['thrust'], rel=1e-15
    )


@pytest.mark.parametrize(
    'values', [QUADRATIC, POLYNOMIAL, T200, {**AEROSONDE, 'reverse_scale': [0.6, 0.8]}]
)
def test_newtons_give_that_thrust_at_rest(values):
    model, data = load(rotor_world({**values, 'command': 'newton'}))
    full = [settle(model, data, side)['thrust'] for side in (-1e9, 1e9)]
    assert full[0] < -0.5
    assert full[1] > 5
    for wanted in np.linspace(*full, 41):
        found = settle(model, data, wanted)
        assert found['thrust'] == pytest.approx(wanted, rel=1e-12, abs=1e-12)
        assert data.actuator_force[0] == found['thrust']
    for beyond in (full[0] * 1.01, full[1] * 1.01):
        assert settle(model, data, beyond)['saturated'] == 1


@pytest.mark.parametrize('voltage', SUPPLIES)
def test_bollard_thrust_of_the_t200_is_the_sheets(voltage):
    supply = SUPPLIES[voltage]
    model, data = load(rotor_world({**T200, 'voltage': voltage}))
    assert settle(model, data, 1900)['thrust'] == pytest.approx(supply.forward, rel=1e-12)
    assert settle(model, data, 1100)['thrust'] == pytest.approx(-supply.reverse, rel=1e-12)
    for edge, outward in ((supply.dead_low, -1), (supply.dead_high, 1)):
        assert settle(model, data, edge)['thrust'] == 0
        assert settle(model, data, edge - 1e-9 * outward)['thrust'] == 0
        assert settle(model, data, edge + 1e-3 * outward)['thrust'] * outward > 0
    assert settle(model, data, 1500)['thrust'] == 0


def test_the_t200_between_its_sheets():
    pulses = np.linspace(1080, 1920, 85)
    for voltage in (10, 11.3, 16, 17, 20):
        wanted = propulsion.pulse_thrust(pulses, t200_table(voltage))
        found = thrusts({**T200, 'voltage': voltage}, pulses, 'pwm_us')
        np.testing.assert_allclose(found, wanted, atol=1e-12)
    model, data = load(rotor_world(T200))
    assert settle(model, data, 1900)['rad_s'] * 30 / np.pi == pytest.approx(3533, rel=1e-12)
    assert settle(model, data, 1100)['rad_s'] * 30 / np.pi == pytest.approx(-3465, rel=1e-12)
    np.testing.assert_allclose(t200_speed_constants(), [3.7551e-4, 3.0304e-4], rtol=1e-4)
    with pytest.raises(ConfigError, match=r'10\.\.20'):
        t200_table(22)


# Rows of the 14 V sheet (Blue Robotics, September 2019): pulse width [us], thrust [kgf].
SHEET_14_V = [
    (1100, -3.52), (1148, -2.94), (1200, -2.35), (1248, -1.76), (1300, -1.24), (1348, -0.81),
    (1400, -0.4), (1448, -0.08), (1548, 0.1), (1600, 0.5), (1648, 0.97), (1700, 1.55),
    (1748, 2.16), (1800, 2.99), (1848, 3.77), (1896, 4.53),
]  # fmt: skip


def test_the_shape_of_the_t200_curve_follows_the_sheet():
    pulses, wanted = np.array(SHEET_14_V).T
    found = thrusts({**T200, 'voltage': 14}, pulses, 'pwm_us')
    assert np.max(np.abs(found - 9.80665 * wanted)) < 0.02 * 44.4


def test_own_table_with_a_dead_zone():
    table = [1100, -20, 1450, 0, 1550, 0, 1700, 12, 1900, 30]
    values = {'curve': 'table', 'table': table, 'thrust_coefficient': [2e-4, 1e-4]}
    pulses = np.linspace(1050, 1950, 46)
    wanted = propulsion.pulse_thrust(pulses, np.reshape(table, (-1, 2)))
    np.testing.assert_allclose(thrusts(values, pulses, 'pwm_us'), wanted, atol=1e-13)
    shares = np.linspace(-1, 1, 21)
    wanted = propulsion.pulse_thrust(1500 + 400 * shares, np.reshape(table, (-1, 2)))
    np.testing.assert_allclose(thrusts(values, shares, 'normalized'), wanted, atol=1e-13)


def test_pulse_width_and_normalized_without_a_table():
    values = {**QUADRATIC, 'dead_zone': [1470, 1540]}
    model, data = load(rotor_world({**values, 'command': 'pwm_us'}))
    for pulse, speed in (
        (1900, 900), (1720, 450), (1540, 0), (1500, 0), (1470, 0), (1285, -300), (1100, -600),
    ):  # fmt: skip
        assert settle(model, data, pulse)['rad_s'] == pytest.approx(speed, abs=1e-9)
    model, data = load(rotor_world({**values, 'command': 'normalized'}))
    for share, pulse in ((1, 1900), (0.55, 1720), (0, 1500), (-0.5375, 1285), (-1, 1100)):
        speed = 900 * (pulse - 1540) / 360 if pulse > 1540 else -600 * (1470 - pulse) / 370
        wanted = 0 if 1470 <= pulse <= 1540 else speed
        assert settle(model, data, share)['rad_s'] == pytest.approx(wanted, abs=1e-9)
    rotor = {**X500, 'time_constant': 0, 'command': 'pwm_us'}  # 1000..2000 us, no reverse
    model, data = load(rotor_world(rotor))
    assert settle(model, data, 1500)['rad_s'] == 500
    assert settle(model, data, 900)['rad_s'] == 0


@pytest.mark.parametrize('reverse', [(1, 1), (0.7, 0.8)])
def test_propeller_in_four_quadrants(reverse):
    body = '<joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    model, data = load(rotor_world({**AEROSONDE, 'reverse_scale': reverse}, body=body))
    constants = {
        'density': 1.2682, 'diameter': 0.508, 'thrust': AEROSONDE['thrust_coefficients'],
        'torque': AEROSONDE['torque_coefficients'], 'reverse': reverse,
    }  # fmt: skip
    for omega in (-600, -50, 0, 1e-300, 200, 700):
        for inflow in (-30, -1, 0, 1e-200, 5, 40):
            data.ctrl[0], data.qvel[0] = omega, inflow
            mujoco.mj_forward(model, data)
            thrust, torque = propulsion.propeller_load(omega, inflow, **constants)
            found = read(model, data)
            assert found['inflow'] == inflow
            assert found['thrust'] == pytest.approx(thrust, rel=1e-12, abs=1e-12)
            assert found['torque'] == pytest.approx(torque, rel=1e-12, abs=1e-12)
            assert data.actuator_force[1] == -found['torque']


def test_propeller_in_forward_flight_is_the_published_polynomial():
    d, n, rho = 0.508, 90.0, 1.2682
    for v in (0.0, 10.0, 25.0):
        j = propulsion.advance_ratio(v, 2 * np.pi * n, d)
        thrust, torque = propulsion.propeller_load(
            2 * np.pi * n, v, density=rho, diameter=d,
            thrust=AEROSONDE['thrust_coefficients'], torque=AEROSONDE['torque_coefficients'],
        )  # fmt: skip
        ct = -0.1079 * j**2 - 0.06044 * j + 0.09357
        cq = -0.01664 * j**2 + 0.00497 * j + 0.00523
        assert thrust == pytest.approx(rho * n**2 * d**4 * ct, rel=1e-12)
        assert torque == pytest.approx(rho * n**2 * d**5 * cq, rel=1e-12)


LOADS = {
    'density': 1000, 'diameter': 0.14,
    'thrust': [0.45, -0.3, -0.2], 'torque': [0.07, -0.03, -0.02],
}  # fmt: skip


@given(omega=st.floats(-300, 300), inflow=st.floats(-10, 10))
def test_propeller_is_odd_and_its_inflow_part_brakes(omega, inflow):
    thrust, torque = propulsion.propeller_load(omega, inflow, **LOADS)
    assert np.isfinite([thrust, torque]).all()
    mirrored = propulsion.propeller_load(-omega, -inflow, **LOADS)
    np.testing.assert_allclose([thrust, torque], -np.array(mirrored), atol=1e-12)
    at_rest = propulsion.propeller_load(omega, 0.0, **LOADS)[0]
    assert (thrust - at_rest) * inflow <= 1e-12


@given(inflow=st.floats(-10, 10))
def test_propeller_is_continuous_through_rest(inflow):
    left, right = (propulsion.propeller_load(w, inflow, **LOADS)[0] for w in (-1e-9, 1e-9))
    assert left == pytest.approx(right, abs=1e-6)
    assert propulsion.propeller_load(0, inflow, **LOADS)[0] * inflow <= 0


def test_advance_ratio_has_no_nan():
    ratio = propulsion.advance_ratio([0, 1, 2], [0, 0, 2 * np.pi], 0.5)
    np.testing.assert_array_equal(ratio, [0, np.inf, 4])


def test_saturation_by_ctrlrange_and_by_the_curve():
    values = {**QUADRATIC, 'command': 'newton'}
    model, data = load(rotor_world(values, actuator='ctrllimited="true" ctrlrange="-3 5"'))
    for command, thrust, saturated in ((4, 4, 0), (5, 5, 0), (6, 5, 1), (-4, -3, 1)):
        found = settle(model, data, command)
        assert found['thrust'] == pytest.approx(thrust, rel=1e-12)
        assert found['saturated'] == saturated
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL
    assert settle(model, data, 6)['thrust'] == pytest.approx(6, rel=1e-12)


def test_forcerange_still_holds():
    model, data = load(
        rotor_world(
            {**QUADRATIC, 'command': 'newton'}, actuator='forcelimited="true" forcerange="-1 2"'
        )
    )
    settle(model, data, 10)
    assert data.actuator_force[0] == 2


def test_a_command_that_is_no_number_gives_no_thrust():
    model, data = load(rotor_world({**QUADRATIC, 'command': 'newton'}))
    data.ctrl[0] = np.nan
    mujoco.mj_forward(model, data)
    assert data.actuator_force[0] == 0
    assert data.warning[mujoco.mjtWarning.mjWARN_BADCTRL].number > 0
