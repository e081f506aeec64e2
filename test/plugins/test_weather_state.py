# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The state of the weather: copies, rollouts, seeds; and the forces on bodies in it."""

import mujoco
import numpy as np
import pytest
from mujoco import rollout

from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    world,
)
from test.support.weather_models import DRYDEN, flow, rows_of, weather


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_copies_saved_states_and_restarts_agree_to_the_bit(integrator):
    medium = DRYDEN | {'turbulence': 'von_karman', 'wind_gauss_markov': [1, 1, 1, 5]}
    model, data = weather(medium, integrator=integrator, timestep=0.003)
    start = data.plugin_state.copy()
    mujoco.mj_step(model, data, 100)
    copy = mujoco.MjData(model)
    mujoco.mj_copyState(model, data, copy, mujoco.mjtState.mjSTATE_INTEGRATION)
    for d in (data, copy):
        mujoco.mj_step(model, d, 100)
    np.testing.assert_array_equal(data.qpos, copy.qpos)
    np.testing.assert_array_equal(data.plugin_state, copy.plugin_state)
    end = data.qpos.copy()
    mujoco.mj_resetData(model, data)
    np.testing.assert_array_equal(data.plugin_state, start)
    mujoco.mj_step(model, data, 200)
    np.testing.assert_array_equal(data.qpos, end)


def test_a_rollout_is_the_same_flight():
    model, data = weather(DRYDEN, integrator='implicitfast', timestep=0.004)
    spec = mujoco.mjtState.mjSTATE_FULLPHYSICS
    start = np.empty(mujoco.mj_stateSize(model, spec))
    mujoco.mj_getState(model, data, start, spec)
    states, _ = rollout.rollout(model, data, start, nstep=150)
    mujoco.mj_resetData(model, data)
    mujoco.mj_step(model, data, 150)
    end = np.empty_like(start)
    mujoco.mj_getState(model, data, end, spec)
    np.testing.assert_array_equal(states[0, -1], end)


def test_time_set_back_gives_the_same_gusts_again():
    model, data = weather(DRYDEN)
    model.body_mass[1] = 1e9
    before = rows_of(model, data, 120)[:100]
    data.time = 0
    mujoco.mj_forward(model, data)
    mujoco.mj_step(model, data)  # the noise is drawn at the end of a step
    data.time = 0
    np.testing.assert_allclose(rows_of(model, data, 100)[2:, :3], before[2:, :3], atol=1e-12)


def test_a_seed_is_another_flight_and_can_be_set_again():
    model, data = weather(DRYDEN)
    other = weather(DRYDEN | {'seed': [6]})
    assert np.abs(flow(model, data)[0] - flow(*other)[0]).min() > 1e-3
    assert native().seed_medium(model._address, data._address, 6.0)
    np.testing.assert_array_equal(flow(model, data)[0], flow(*other)[0])


def test_switched_off_only_the_mean_is_left():
    model, data = weather(DRYDEN | {'wind_signal': 'ramp 0 5 0 0 1'})
    mujoco.mj_step(model, data, 50)
    assert native().enable_medium(model._address, data._address, 0)
    np.testing.assert_array_equal(flow(model, data)[0], [6, 0, 0])
    assert native().enable_medium(model._address, data._address, 1)
    assert flow(model, data)[0][1] > 1  # 2.5 and a gust


def test_turbulence_that_follows_goes_with_height_and_airspeed():
    """At the stated height and airspeed it is the same; faster, the gusts pass faster."""
    medium = {k: v for k, v in DRYDEN.items() if k != 'turbulence_length'}
    medium |= {'turbulence_height': [20], 'wind': [0, 0, 0]}
    fixed = weather(medium, timestep=0.01)
    steady = weather(medium | {'turbulence_follow': 'vehicle'}, timestep=0.01)
    fast = weather(medium | {'turbulence_follow': 'vehicle'}, timestep=0.01)
    for (model, data), speed in ((fixed, 12), (steady, 12), (fast, 48)):
        model.body_mass[1] = model.body_inertia[1] = 1e9
        data.qpos[2], data.qvel[0] = 20, speed
    u = [rows_of(*run, 1500)[:, 0] for run in (fixed, steady, fast)]
    np.testing.assert_allclose(u[1], u[0], atol=1e-6)  # damping takes 1e-8 of the speed
    assert np.diff(u[2][10:]).std() == pytest.approx(2 * np.diff(u[0][10:]).std(), rel=0.1)


def neutral(medium, **options):
    body = ellipsoid([0.3, 0.2, 0.1], 1000) + body_plugin(
        added_mass='auto', volume='auto', linear_damping=[3, 4, 5, 0.1, 0.1, 0.1]
    )
    return load(world(free_body(body), medium={'density': 1000} | medium, **options))


def test_a_neutral_body_reaches_the_velocity_of_the_current():
    model, data = neutral({'current': [0.4, -0.2, 0.1]}, timestep=0.05)
    mujoco.mj_step(model, data, 6000)
    np.testing.assert_allclose(data.qvel[:3], [0.4, -0.2, 0.1], atol=1e-9)


def test_a_neutral_body_at_the_velocity_of_a_gust_stays_with_it():
    """A uniform flow that changes in time accelerates body and fluid alike."""
    signal = 'gust .5 .2 0 .2 .6 .1 sine 0 0 .3 2 1.5707963267948966'
    model, data = neutral({'current_signal': signal}, timestep=0.005)
    data.qvel[:3] = flow(model, data)[0]
    for _ in range(300):
        mujoco.mj_step(model, data)
        np.testing.assert_allclose(data.qvel[:3], flow(model, data)[0], atol=1e-7)


def test_a_body_moving_with_the_current_feels_nothing():
    model, data = neutral({'current': [1.5, -0.7, 0.2]})
    data.qvel[:3] = [1.5, -0.7, 0.2]
    np.testing.assert_allclose(explicit_force(model, data), 0, atol=1e-9)


def test_motion_and_opposite_wind_give_the_same_wrench():
    moving, windy = neutral({'wind': [0, 0, 0]}), neutral({'wind': [-3, 1, -0.5]})
    moving[1].qvel[:3] = [3, -1, 0.5]
    np.testing.assert_allclose(explicit_force(*moving), explicit_force(*windy), rtol=1e-12)


def test_start_reset_and_seed_give_no_force_of_acceleration():
    """The pressure force rho V Du/Dt at the start is that of the gust's own slope."""
    body = free_body(ellipsoid([0.2] * 3, 500) + body_plugin(volume='auto'))
    model, data = load(world(body, medium=DRYDEN | {'density': 1000}))
    volume = 4 / 3 * np.pi * 0.008
    for action in (lambda: None, lambda: mujoco.mj_resetData(model, data),
                   lambda: native().seed_medium(model._address, data._address, 77.0)):  # fmt: skip
        action()
        expected = 1000 * volume * flow(model, data)[1]
        np.testing.assert_allclose(explicit_force(model, data)[:3], expected, rtol=1e-9)
        assert np.abs(expected).max() < 1000 * volume * 40


def test_rk4_keeps_its_order_in_turbulence_with_aligned_ticks():
    """Steps that divide the tick: each sees a smooth flow."""

    def final(timestep):
        medium = DRYDEN | {'turbulence_tick': [0.04]}
        body = free_body(
            ellipsoid([0.3, 0.2, 0.1], 1.2)
            + body_plugin(
                added_mass='auto', volume='auto', linear_damping=[0.05] * 3 + [0.001] * 3
            )
        )
        model, data = load(world(body, medium=medium, timestep=timestep))
        mujoco.mj_step(model, data, round(0.8 / timestep))
        return data.qpos[:3].copy()

    exact = final(0.04 / 128)
    errors = [np.linalg.norm(final(0.04 / n) - exact) for n in (8, 16, 32)]
    assert np.log2(errors[0] / errors[1]) > 3.9
    assert np.log2(errors[1] / errors[2]) > 3.9
