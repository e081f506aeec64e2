# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The lag: exact at any timestep with any integrator, order 4 with RK4, the same bits always."""

import copy

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mujoco import rollout
from mujoco.batch import Batch
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.propulsion import lagged_speed, propeller_load
from test.support.plugin_models import load
from test.support.thruster_models import AEROSONDE, X500, read, rotor_world

INTEGRATORS = ('Euler', 'RK4', 'implicit', 'implicitfast', 'discrete')
UP, DOWN = 0.0125, 0.025
BOTH_WAYS = {**X500, 'rad_s_max': [1000, 1000]}


def option(integrator='implicitfast', step=0.01):
    return f'timestep="{step!r}" integrator="{integrator}" gravity="0 0 0"'


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('step', [1e-4, 1e-3, 0.01, 0.1, 1.0])
@pytest.mark.parametrize(
    ('start', 'command'), [(0, 500), (800, 300), (300, 0), (700, -400), (-200, 900)]
)
def test_step_response_is_the_exact_exponential(integrator, step, start, command):
    model, data = load(rotor_world(BOTH_WAYS, option=option(integrator, step)))
    data.act[0], data.ctrl[0] = start, command
    for i in range(1, 9):
        mujoco.mj_step(model, data)
        exact = lagged_speed(start, command, i * step, UP, DOWN)
        assert abs(read(model, data)['rad_s'] - exact) < 1e-9
        assert data.act[1] == 0


def test_up_and_down_follow_the_closed_form():
    assert lagged_speed(0, 100, UP, UP, DOWN) == pytest.approx(100 * (1 - np.exp(-1)), rel=1e-14)
    assert lagged_speed(100, 0, DOWN, UP, DOWN) == pytest.approx(100 * np.exp(-1), rel=1e-14)
    crossing = DOWN * np.log(2)  # from 100 towards -100
    assert lagged_speed(100, -100, crossing, UP, DOWN) == pytest.approx(0, abs=1e-12)
    after = lagged_speed(100, -100, crossing + UP, UP, DOWN)
    assert after == pytest.approx(-100 * (1 - np.exp(-1)), rel=1e-12)


@given(
    start=st.floats(-900, 900), command=st.floats(-900, 900),
    first=st.floats(0, 0.2), second=st.floats(0, 0.2),
)  # fmt: skip
def test_lag_composes_and_never_overshoots(start, command, first, second):
    middle = lagged_speed(start, command, first, UP, DOWN)
    end = lagged_speed(middle, command, second, UP, DOWN)
    assert end == pytest.approx(lagged_speed(start, command, first + second, UP, DOWN), abs=1e-9)
    low, high = min(start, command), max(start, command)
    assert low - 1e-9 <= middle <= high + 1e-9
    assert low - 1e-9 <= end <= high + 1e-9


def test_a_command_that_changes_each_step():
    model, data = load(rotor_world(BOTH_WAYS, option=option(step=0.007)))
    rng = np.random.default_rng(1)
    speed = 0.0
    for command in rng.uniform(-900, 900, 50):
        data.ctrl[0] = command
        mujoco.mj_step(model, data)
        speed = lagged_speed(speed, command, 0.007, UP, DOWN)
        assert abs(read(model, data)['rad_s'] - speed) < 1e-9


def slider(integrator, step):
    """Return a propeller on a slide: inflow and lag act on each other's scale."""
    values = {**AEROSONDE, 'time_constant': [0.3, 0.5]}
    body = (
        '<joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass=".5" diaginertia="1 1 1"/>'
    )
    return load(rotor_world(values, body=body, option=option(integrator, step), torque=True))


def flight(time):
    """Return height and speed of the slider by SciPy."""
    constants = {
        'density': AEROSONDE['density'], 'diameter': AEROSONDE['diameter'],
        'thrust': AEROSONDE['thrust_coefficients'],
    }  # fmt: skip

    def rates(now, y):
        omega = lagged_speed(200, 600, now, 0.3, 0.5)
        return [y[1], propeller_load(omega, y[1], **constants)[0] / 0.5]

    return solve_ivp(rates, (0, time), [0, 2.0], rtol=1e-12, atol=1e-12).y[:, -1]


def test_rk4_keeps_order_four():
    exact = flight(0.96)
    steps, errors = np.array([0.12, 0.08, 0.06, 0.04]), []
    for step in steps:
        model, data = slider('RK4', float(step))
        data.act[0], data.ctrl[0], data.qvel[0] = 200, 600, 2
        mujoco.mj_step(model, data, round(0.96 / step))
        errors.append(abs(data.qpos[0] - exact[0]) + abs(data.qvel[0] - exact[1]))
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order >= 3.9


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_every_way_to_run_gives_the_same_bits(integrator):
    model, data = slider(integrator, 0.01)
    data.act[0], data.ctrl[0] = 100, 600
    first = copy.copy(data)
    start = np.zeros(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, start, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    mujoco.mj_step(model, data, 40)
    wanted = np.r_[data.qpos, data.qvel, data.act]

    def agrees(values):
        np.testing.assert_array_equal(np.r_[values.qpos, values.qvel, values.act], wanted)

    for _ in range(40):
        mujoco.mj_forward(model, first)  # reading must not change the run
        mujoco.mj_step(model, first)
    agrees(first)
    control = np.tile([600.0, 0.0], (1, 40, 1))
    states, _ = rollout.rollout(model, mujoco.MjData(model), start, control)
    np.testing.assert_array_equal(states[0, -1, 1 : 1 + wanted.size], wanted)
    batch = Batch(model, nsim=3, nthread=2)
    for field, value in (('qpos', 0), ('qvel', 0), ('ctrl', [600, 0]), ('act', [100, 0])):
        batch.bind(field)[:] = value
    for _ in range(40):
        batch.step()
    for simulation in range(batch.nsim):
        agrees(batch.get_data(simulation))


def test_reset_and_activation_of_a_keyframe():
    model, data = load(rotor_world(X500))
    data.ctrl[0] = 500
    mujoco.mj_step(model, data, 5)
    mujoco.mj_resetData(model, data)
    assert read(model, data)['rad_s'] == 0
    data.act[0] = 321
    assert read(model, data)['rad_s'] == 321


def test_actuation_off_stops_the_clock():
    model, data = load(rotor_world(X500))
    data.ctrl[0] = 500
    mujoco.mj_step(model, data, 5)
    speed = data.act[0]
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    mujoco.mj_step(model, data, 5)
    assert data.act[0] == speed
    np.testing.assert_array_equal(data.qfrc_actuator, 0)


def test_a_disabled_group_gives_nothing():
    model, data = load(rotor_world(X500, actuator='group="3"'))
    data.act[0] = data.ctrl[0] = 500
    mujoco.mj_forward(model, data)
    assert data.actuator_force[0] > 1
    model.opt.disableactuator = 1 << 3
    mujoco.mj_step(model, data)
    np.testing.assert_array_equal(data.actuator_force, 0)
    assert data.act[0] == 500
