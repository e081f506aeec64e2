# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Wrench per term: the sum, the acceleration part, and that reading changes nothing."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.plugins import native as nat
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    set_medium,
    world,
)

SEA = {
    'density': 1025, 'viscosity': 1e-3, 'density_above': 1.2, 'viscosity_above': 1.8e-5,
    'surface': 0.05, 'current': [0.3, -0.1, 0.2], 'wind': [3, 1, 0],
}  # fmt: skip
COEF = (0.5, 0.25, 1.5, 1.0, 1.0)


def vehicle(**values):
    """Return a hull with a hinged fin; both in the fluid."""
    fin = (
        '<body name="fin" pos="-.4 0 0"><joint axis="0 1 0"/>'
        f'{ellipsoid([0.1, 0.08, 0.01], 900, COEF)}{body_plugin(**values)}</body>'
    )
    return free_body(ellipsoid([0.3, 0.2, 0.1], 800, COEF) + body_plugin(**values) + fin)


def everything(integrator='RK4'):
    values = {
        'added_mass': 'auto', 'volume': 'auto', 'drag': 'ellipsoid', 'drag_area': 'true',
        'linear_damping': [1, 2, 3, 0.1, 0.2, 0.3], 'quadratic_damping': [9, 8, 7, 1, 1, 1],
    }  # fmt: skip
    model, data = load(
        world(vehicle(**values), gravity=[0, 0, -9.81], medium=SEA, integrator=integrator)
    )
    rng = np.random.default_rng(0)
    data.qvel[:] = rng.normal(size=model.nv)
    return model, data


def observe(model, data, body='hull'):
    rows = np.zeros((1, nat.ROW_WIDTH))
    bases = np.array([model.body(body).id], dtype=np.int32)
    scratch = mujoco.MjData(model)
    nat.native().observe(
        model._address,
        data._address,
        scratch._address,
        bases.ctypes.data,
        1,
        2,
        rows.ctypes.data,
    )
    return rows[0], scratch


@pytest.mark.parametrize('medium', ['plugin', 'stock'])
def test_explicit_terms_add_up_to_the_fluid_share_of_the_passive_force(medium):
    if medium == 'plugin':
        model, data = everything()
    else:
        model, data = load(
            world(
                vehicle(added_mass='auto', volume='auto'),
                gravity=[0, 0, -9.81],
                option='density="1000" viscosity="1e-3" wind=".3 .2 -.1"',
            )
        )
        data.qvel[:] = np.random.default_rng(0).normal(size=model.nv)
    for _ in range(20):
        mujoco.mj_step(model, data, 5)
        force = explicit_force(model, data)
        mujoco.mj_forward(model, data)
        scale = np.abs(data.qfrc_fluid).max()
        np.testing.assert_allclose(force, data.qfrc_fluid, atol=1e-10 * scale)
        np.testing.assert_allclose(force, data.qfrc_passive, atol=1e-10 * scale)


def test_total_is_the_sum_and_every_term_is_there():
    model, data = everything()
    row, _ = observe(model, data)
    terms = {name: row[nat.term_columns(name)] for name in nat.TERMS}
    np.testing.assert_allclose(sum(terms.values()), row[nat.TOTAL], rtol=1e-13)
    for name in ('drag', 'viscous', 'added_mass', 'magnus', 'kutta', 'buoyancy', 'damping'):
        assert np.linalg.norm(terms[name]) > 0, name


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_published_added_mass_holds_the_acceleration(integrator):
    """Newton's second law for the rigid body alone must hold with the published wrench."""
    values = {'added_mass': 'auto', 'volume': 'auto', 'drag': 'ellipsoid'}
    inside = ellipsoid([0.3, 0.2, 0.1], 800, COEF) + body_plugin(**values)
    model, data = load(
        world(free_body(inside), gravity=[0, 0, -9.81], medium=SEA, integrator=integrator)
    )
    data.qpos[3:] = np.array([0.8, 0.3, -0.4, 0.33]) / np.linalg.norm([0.8, 0.3, -0.4, 0.33])
    data.qvel[:] = [1, -0.5, 0.3, 0.2, 0.4, -0.6]
    row, scratch = observe(model, data)
    rotation = scratch.xmat[1].reshape(3, 3)
    force, torque = rotation @ row[nat.TOTAL][:3], row[nat.TOTAL][3:]
    mass, inertia = model.body_mass[1], model.body_inertia[1]
    accel, omega_dot = scratch.qacc[:3].copy(), scratch.qacc[3:].copy()
    omega = data.qvel[3:]
    if integrator == 'implicitfast':  # the secant holds h D_s qacc of the drag back
        mujoco.mj_forward(model, scratch)
        dense = np.zeros((6, 6))
        mujoco.mj_fullM(model, scratch, dense)
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
        mujoco.mj_forward(model, scratch)
        without = np.zeros((6, 6))
        mujoco.mj_fullM(model, scratch, without)
        late = (dense - without) @ np.r_[accel, omega_dot]
        force, torque = force - late[:3], torque - late[3:]
    turning = np.cross(omega, inertia * omega)
    np.testing.assert_allclose(force + mass * model.opt.gravity, mass * accel, rtol=1e-9)
    np.testing.assert_allclose(torque, inertia * omega_dot + turning, rtol=1e-9, atol=1e-12)


def test_reading_never_changes_the_trajectory():
    finals = []
    for read in (False, True):
        model, data = everything('implicitfast')
        set_medium(model, data, current=[1, 0, 0])
        for _ in range(50):
            mujoco.mj_step(model, data)
            if read:
                observe(model, data)
                explicit_force(model, data)
        finals.append(np.r_[data.qpos, data.qvel, data.plugin_state, data.qacc_warmstart])
    np.testing.assert_array_equal(finals[0], finals[1])


def test_medium_velocity_at_the_vehicle():
    model, data = everything()
    assert list(observe(model, data)[0][nat.MEDIUM_VELOCITY]) == SEA['current']
    data.qpos[2] = 1
    assert list(observe(model, data)[0][nat.MEDIUM_VELOCITY]) == SEA['wind']


def test_accelerations_alone_are_those_beside_the_wrenches():
    simulation = Simulation('rov')
    simulation.set_thrust('bluerov2_heavy', [5.0, -3.0] * 4)
    simulation.step(20)
    whole = simulation.observe(forces=True)[0].copy()
    simulation.step(1)
    alone = simulation.observe(forces=True, wrenches=False)[0].copy()
    fresh = simulation.observe(forces=True)[0]
    moved = slice(0, nat.MEDIUM_VELOCITY.stop)
    np.testing.assert_array_equal(alone[moved], fresh[moved])
    np.testing.assert_array_equal(alone[nat.TOTAL], whole[nat.TOTAL])  # left as they were
    assert (fresh[nat.TOTAL] != whole[nat.TOTAL]).all()
