# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Simulation: stepping under watch, commands, wrench terms, determinism."""

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.plugins.native import TERMS


def test_wrench_terms_add_up_to_what_the_engine_applies(boat):
    rng = np.random.default_rng(1)
    for _ in range(20):
        boat.data.qpos[3:7] = rng.normal(size=4)
        mujoco.mj_normalizeQuat(boat.model, boat.data.qpos)
        boat.data.qvel[:] = rng.normal(size=boat.model.nv)
        terms = boat.wrench('boat')
        force = sum(f for f, _ in terms.values())
        torque = sum(t for _, t in terms.values())
        mujoco.mj_forward(boat.model, boat.data)
        R = boat.data.body('boat').xmat.reshape(3, 3)
        expected_force = R.T @ boat.data.qfrc_fluid[:3]
        scale = np.linalg.norm(expected_force) + np.linalg.norm(boat.data.qfrc_fluid[3:6])
        np.testing.assert_allclose(force, expected_force, atol=1e-12 * scale)
        np.testing.assert_allclose(torque, boat.data.qfrc_fluid[3:6], atol=1e-12 * scale)
    assert list(terms) == list(TERMS)


def test_reading_never_changes_the_trajectory(boat):
    boat.data.qvel[:] = 0.5
    start = boat.save_state()
    boat.step(200)
    plain = boat.data.qpos.copy()
    boat.load_state(start)
    for _ in range(200):
        boat.step()
        boat.wrench('boat')
        boat.snapshot()
    np.testing.assert_array_equal(boat.data.qpos, plain)


def test_stepping_equals_a_bare_mujoco_loop(boat):
    data = mujoco.MjData(boat.model)
    data.qvel[:] = boat.data.qvel[:] = 0.3
    mujoco.mj_step(boat.model, data, 500)
    boat.step(500)
    np.testing.assert_array_equal(boat.data.qpos, data.qpos)
    np.testing.assert_array_equal(boat.data.qvel, data.qvel)


@settings(max_examples=20, deadline=None)
@given(cut=st.integers(1, 99), seed=st.integers(0, 2**31))
def test_a_saved_state_goes_on_bit_for_bit(cut, seed):
    simulation = Simulation('rov')
    rng = np.random.default_rng(seed)
    thrust = rng.uniform(-20, 20, 8)
    simulation.set_thrust('bluerov2_heavy', thrust)
    simulation.set_wrench('bluerov2_heavy', [1, 2, 3], [0.1, 0, 0])
    simulation.set_current([0.2, 0, 0])
    simulation.step(cut)
    state = simulation.save_state()
    simulation.step(100)
    expected = simulation.data.qpos.copy()
    simulation.reset()
    simulation.load_state(state)
    assert simulation.step_count == cut
    simulation.step(100)
    np.testing.assert_array_equal(simulation.data.qpos, expected)


def test_a_state_of_another_model_is_refused(boat):
    with pytest.raises(FluidSimError, match='another model'):
        boat.load_state(Simulation('sphere').save_state())


def test_snapshot_velocity_is_in_body_axes(boat):
    half = np.sqrt(0.5)
    boat.data.qpos[:7] = [1, 2, 3, half, 0, 0, half]  # yaw 90 degrees: body x is world y
    boat.data.qvel[:6] = [0, 2, 0, 0.1, 0.2, 0.3]
    state = boat.snapshot().vehicles['boat']
    np.testing.assert_allclose(state.velocity_b, [2, 0, 0], atol=1e-15)
    np.testing.assert_allclose(state.omega_b, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(state.position_w, [1, 2, 3])


def test_specific_force_of_a_body_at_rest_is_plus_g(tmp_path):
    path = tmp_path / 'rest.xml'
    path.write_text(
        '<mujoco><worldbody><geom type="plane" size="1 1 1"/><body name="b" pos="0 0 .1">'
        '<freejoint/><geom size=".1"/></body></worldbody></mujoco>'
    )
    simulation = Simulation(path)
    simulation.step(2000)
    row = simulation.observe(forces=True)[0]
    np.testing.assert_allclose(row[13:16], [0, 0, 9.81], atol=1e-6)
