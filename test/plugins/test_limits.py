# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The limits that doc/limits.md states, each measured; where MuJoCo changes, these tests tell."""

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluid_sim_ros.physics.kappa import ellipsoid_added_mass
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    free_body,
    kinetic_energy,
    load,
    world,
)

AXES, WATER = np.array([0.3, 0.2, 0.1]), {'density': 1000, 'viscosity': 1e-3}
MASS_A, INERTIA_A = ellipsoid_added_mass(AXES, 1000.0)
START = (1.0, 0.5, 0.3, 1.0, 2.0, 1.5)


def moving(integrator='implicitfast', medium=WATER, **values):
    values = values or {'added_mass': 'auto', 'quadratic_damping': [50, 50, 50, 3, 3, 3]}
    model, data = load(
        world(
            free_body(ellipsoid(AXES, 800) + body_plugin(**values)),
            integrator=integrator,
            medium=medium,
        )
    )
    data.qvel[:] = START
    return model, data


def dense_inertia(model, data):
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    return full


@pytest.mark.parametrize('integrator', ['Euler', 'discrete'])
def test_qacc_is_the_velocity_step_under_the_effective_mass(integrator):
    model, data = moving(integrator)
    before = data.qvel.copy()
    mujoco.mj_step(model, data)
    np.testing.assert_allclose(data.qacc, (data.qvel - before) / 0.01, rtol=1e-9, atol=1e-12)


def test_qacc_is_the_true_acceleration_under_rk4():
    model, data = moving('RK4')
    mujoco.mj_forward(model, data)
    true = data.qacc.copy()
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
    for timestep, bound in ((0.01, 0.5), (0.0001, 0.005)):
        model.opt.timestep = timestep
        mujoco.mj_forward(model, data)
        difference = np.linalg.norm(data.qacc - true) / np.linalg.norm(true)
        assert 0.01 * bound < difference < bound  # there, and of first order in the timestep


def test_mass_matrix_between_steps_is_not_the_inertia_but_the_accessor_is():
    model, data = moving()
    mujoco.mj_forward(model, data)
    rigid_and_added = np.array(
        [*(model.body_mass[1] + MASS_A), *(model.body_inertia[1][[2, 1, 0]])]
    )
    assert dense_inertia(model, data)[0, 0] > rigid_and_added[0] * 1.001  # h D_s is in it
    expected = 0.5 * np.sum((model.body_mass[1] + MASS_A) * data.qvel[:3] ** 2)
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, model.body_iquat[1])
    axes = turned.reshape(3, 3)
    own = axes @ np.diag(model.body_inertia[1]) @ axes.T
    spin = data.qvel[3:]
    expected += 0.5 * spin @ (own + np.diag(INERTIA_A)) @ spin
    assert kinetic_energy(model, data).sum() == pytest.approx(expected, rel=1e-12)


def test_inverse_dynamics_hold_the_added_mass():
    """MuJoCo 4 takes M qacc from d.M, so mj_inverse finds that no outer force was there."""
    model, data = moving('RK4', added_mass='auto')
    mujoco.mj_forward(model, data)
    assert np.linalg.norm(MASS_A * data.qacc[:3]) > 1
    mujoco.mj_inverse(model, data)
    np.testing.assert_allclose(data.qfrc_inverse, 0, atol=1e-12)


def test_force_sensors_lack_the_fluid():
    """mj_rnePostConstraint knows rigid bodies only: neither A a nor any other passive force."""
    keel = (
        '<body name="keel"><site name="joint"/>'
        f'{ellipsoid(AXES, 800)}{body_plugin(added_mass="auto")}</body>'
    )
    inside = '<inertial pos="0 0 0" mass="5" diaginertia=".1 .1 .1"/>'
    sensor = '<sensor><force site="joint"/></sensor>'
    model, data = load(world(free_body(inside + keel), medium=WATER, extra=sensor))
    data.xfrc_applied[1, 0] = 10.0
    mujoco.mj_forward(model, data)
    keel_mass = model.body('keel').mass[0]
    total = model.body('hull').mass[0] + keel_mass + MASS_A[0]
    assert data.qacc[0] == pytest.approx(10.0 / total, rel=1e-9)
    assert abs(data.sensordata[0]) == pytest.approx(keel_mass * data.qacc[0], rel=1e-9)


def test_contact_softness_is_scaled_by_the_rigid_inertia_alone():
    with_plugin, _ = moving('RK4', added_mass='auto')
    without, _ = load(world(free_body(ellipsoid(AXES, 800))))
    np.testing.assert_array_equal(with_plugin.body_invweight0, without.body_invweight0)


def test_sleep_leaves_the_awake_bodies_right():
    """Sleep is warned about; a body that is awake must still move as without it."""
    finals = []
    for flag in ('', 'sleep="enable"'):
        xml = world(
            free_body(ellipsoid(AXES, 800) + body_plugin(added_mass='auto')),
            medium=WATER,
            flag=flag,
            integrator='implicitfast',
        )
        model, data = load(xml)
        data.qvel[:] = START
        mujoco.mj_step(model, data, 100)
        finals.append(data.qpos.copy())
    np.testing.assert_array_equal(finals[0], finals[1])


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    velocity=st.lists(st.floats(-3, 3), min_size=6, max_size=6),
    height=st.floats(-0.25, 0.25),
    turn=st.lists(st.floats(-1, 1), min_size=3, max_size=3),
)
def test_energy_never_rises_through_the_surface(velocity, height, turn):
    """Entry takes energy (slamming), exit too (the flow keeps its own); nothing gives any."""
    medium = WATER | {'density_above': 1.2, 'surface': 0}
    model, data = moving('RK4', medium, added_mass='auto', drag='none')
    model.opt.timestep = 5e-4
    data.qpos[2] = height
    data.qpos[3:] = np.r_[1.5, turn] / np.linalg.norm(np.r_[1.5, turn])
    data.qvel[:] = velocity
    before = kinetic_energy(model, data).sum()
    for _ in range(10):
        mujoco.mj_step(model, data, 20)
        after = kinetic_energy(model, data).sum()
        assert after <= before * (1 + 1e-6) + 1e-12
        before = after


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    velocity=st.lists(st.floats(-10, 10), min_size=6, max_size=6),
    height=st.floats(-0.4, 0.4),
    area=st.sampled_from(['lemma', 'true']),
    reynolds=st.sampled_from(['constant', 'brown_lawler']),
)
def test_drag_and_damping_only_take_power(velocity, height, area, reynolds):
    medium = WATER | {'density_above': 1.2, 'viscosity_above': 1.8e-5, 'surface': 0}
    coefficients = (0.5, 0.25, 1.5, 0, 0)
    plugin = body_plugin(
        drag='ellipsoid',
        drag_area=area,
        drag_reynolds=reynolds,
        rotational_damping=0.01,
        linear_damping=[1, 2, 3, 0.1, 0.2, 0.3],
        quadratic_damping=[4, 5, 6, 0.4, 0.5, 0.6],
    )
    model, data = load(
        world(free_body(ellipsoid(AXES, 800, coefficients) + plugin), medium=medium)
    )
    data.qpos[2], data.qvel[:] = height, velocity
    mujoco.mj_forward(model, data)
    assert np.all(np.isfinite(data.qfrc_passive))
    assert data.qfrc_passive @ data.qvel <= 0
