# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Damping and local drag in C++ against the numpy twins, term by term."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.drag import angular_drag, viscous_resistance
from fluid_sim_ros.physics.ellipsoid import FluidCoef, ellipsoid_wrench
from fluid_sim_ros.physics.fossen import (
    CrossTerm,
    cross_damping_wrench,
    damping_wrench,
    faded_moments,
    secant_damping,
)
from fluid_sim_ros.physics.reynolds import reynolds_drag
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    world,
)

AXES = np.array([0.3, 0.2, 0.1])
SEA = {'density': 1025, 'viscosity': 1e-3, 'current': [0.3, -0.1, 0.2]}


def random_state(model, data, seed):
    """Give the hull a random state; return velocity relative to the current and spin, body."""
    rng = np.random.default_rng(seed)
    data.qpos[3:] = rng.normal(size=4)
    data.qpos[3:] /= np.linalg.norm(data.qpos[3:])
    data.qvel[:] = rng.normal(size=6)
    mujoco.mj_kinematics(model, data)
    rotation = data.xmat[1].reshape(3, 3)
    return rotation, rotation.T @ (data.qvel[:3] - SEA['current']), data.qvel[3:].copy()


def generalized(rotation, force_b, torque_b):
    return np.r_[rotation @ force_b, torque_b]


@pytest.mark.parametrize('area', ['lemma', 'true'])
@pytest.mark.parametrize('seed', range(5))
def test_ellipsoid_forces(area, seed):
    coef = FluidCoef(0.5, 0.25, 1.5, 0.8, 1.2)
    plugin = body_plugin(added_mass='auto', drag='ellipsoid', drag_area=area)
    model, data = load(world(free_body(ellipsoid(AXES, 800, coef) + plugin), medium=SEA))
    rotation, v, omega = random_state(model, data, seed)
    terms = ellipsoid_wrench(AXES, v, omega, density=1025, viscosity=1e-3, coef=coef, area=area)
    force = sum(term[0] for term in terms.values())
    torque = sum(term[1] for term in terms.values())
    # with qacc = 0 the relative velocity turns in body axes: A (w x v) belongs to the inertia
    added = ellipsoid_wrench(
        AXES, v, omega, density=1025, viscosity=1e-3, v_dot_b=-np.cross(omega, v)
    )['added_mass']
    force += added[0] - terms['added_mass'][0]
    np.testing.assert_allclose(
        explicit_force(model, data), generalized(rotation, force, torque), rtol=1e-11, atol=1e-9
    )


@pytest.mark.parametrize('speed', [0.0, 1e-6, 1e-3, 0.1, 3.0])
def test_drag_by_reynolds_number(speed):
    plugin = body_plugin(drag='ellipsoid', drag_area='true', drag_reynolds='brown_lawler')
    model, data = load(
        world(free_body(ellipsoid(AXES, 800, (0.5, 0.2, 1, 0, 0)) + plugin), medium=SEA)
    )
    rotation, _, _ = random_state(model, data, 1)
    v = speed * np.array([0.36, 0.48, 0.8])
    data.qvel[:3] = rotation @ v + SEA['current']
    omega = data.qvel[3:]
    force = reynolds_drag(AXES, v, density=1025, viscosity=1e-3, c_slender=0.2, area='true')
    torque = angular_drag(AXES, omega, density=1025, c_angular=1, c_slender=0.2)
    stokes = viscous_resistance(AXES, v, omega, 1e-3)
    np.testing.assert_allclose(
        explicit_force(model, data),
        generalized(rotation, force + stokes[0], torque + stokes[1]), rtol=1e-10, atol=1e-13,
    )  # fmt: skip


def test_rotational_damping_follows_the_density():
    plugin = body_plugin(drag='ellipsoid', rotational_damping=[0.1, 0.2, 0.3])
    model, data = load(world(free_body(ellipsoid(AXES, 800) + plugin), medium={'density': 1025}))
    data.qvel[3:] = [1, -2, 3]
    np.testing.assert_allclose(
        explicit_force(model, data), np.r_[0, 0, 0, -1025 * np.array([0.1, -0.4, 0.9])]
    )


def test_damping_with_cross_terms():
    rng = np.random.default_rng(8)
    linear = rng.normal(size=(6, 6))
    linear = linear @ linear.T + np.triu(rng.normal(size=(6, 6)), 1) * 0.1
    quadratic = np.diag(rng.uniform(5, 9, size=6)) + 0.5 * rng.normal(size=(6, 6))
    cross = [CrossTerm(1, 1, 5, 0.7), CrossTerm(5, 1, 5, 0.9)]
    values = {
        'linear_damping': linear,
        'quadratic_damping': quadratic,
        # indices count from 1 in MJCF
        'cross_damping': '2 2 6 0.7  6 2 6 0.9',
    }
    inside = '<inertial pos="0 0 0" mass="5" diaginertia=".3 .2 .1"/>'
    model, data = load(world(free_body(inside + body_plugin(**values)), medium=SEA))
    rotation, v, omega = random_state(model, data, 4)
    nu = np.r_[v, omega]
    wrench = damping_wrench(linear, quadratic, nu) + cross_damping_wrench(cross, nu)
    np.testing.assert_allclose(
        explicit_force(model, data), generalized(rotation, wrench[:3], wrench[3:]), rtol=1e-12
    )


@pytest.mark.parametrize('fade', [(0.0, 1.4), (2.5, 0.7)])
def test_moments_by_surge_and_sway_fade_with_speed(fade):
    linear = np.diag([5.0, 6.0, 7.0, 1.0, 1.2, 0.8])
    linear[3, 1], linear[4, 0] = -0.4, 0.6
    values = {'linear_damping': linear, 'moment_fade': fade}
    inside = '<inertial pos="0 0 0" mass="5" diaginertia=".3 .2 .1"/>'
    model, data = load(world(free_body(inside + body_plugin(**values)), medium=SEA))
    rotation, v, omega = random_state(model, data, 4)
    nu = np.r_[v, omega]
    wrench = damping_wrench(faded_moments(linear, fade, nu), np.zeros((6, 6)), nu)
    np.testing.assert_allclose(
        explicit_force(model, data), generalized(rotation, wrench[:3], wrench[3:]), rtol=1e-12
    )
    at_the_speed = faded_moments(linear, fade, [fade[1], 0, 0, 0, 0, 0])
    assert at_the_speed[4, 0] == pytest.approx(0.5 * linear[4, 0])


@pytest.mark.parametrize('added_mass', [[5, 40, 50, 1, 6, 7], 'auto', None])
def test_a_total_is_the_same_with_any_added_mass(added_mass):
    values = {} if added_mass is None else {'added_mass': added_mass}
    plugin = body_plugin(cross_damping='5 1 3 -24', cross_damping_total='true', **values)
    model, data = load(world(free_body(ellipsoid(AXES, 800) + plugin), medium={'density': 1025}))
    data.qvel[:] = (1.5, 0, 0.2, 0, 0, 0)
    mujoco.mj_kinematics(model, data)
    # M_uw u w, the Munk moment of the added mass in it
    assert explicit_force(model, data)[4] == pytest.approx(24 * 1.5 * 0.2, rel=1e-12)


@pytest.mark.parametrize('index', range(6))
@pytest.mark.parametrize('kind', ['linear_damping', 'quadratic_damping'])
def test_every_coefficient_on_its_own(kind, index):
    values = np.zeros(6)
    values[index] = 3.0
    inside = '<inertial pos="0 0 0" mass="5" diaginertia=".3 .2 .1"/>'
    model, data = load(world(free_body(inside + body_plugin(**{kind: values}))))
    data.qvel[:] = [-0.5, 0.6, -0.7, 0.8, -0.9, 1.1]
    expected = np.zeros(6)
    speed = data.qvel[index]
    expected[index] = -3.0 * speed * (1 if kind == 'linear_damping' else abs(speed))
    np.testing.assert_allclose(explicit_force(model, data), expected, atol=1e-15)


def test_secant_matrix_is_the_semidefinite_part():
    rng = np.random.default_rng(11)
    quadratic = np.diag(rng.uniform(0.1, 1, size=6)) + rng.normal(size=(6, 6)) * 2
    quadratic[np.diag_indices(6)] = np.abs(np.diag(quadratic))
    inside = '<inertial pos="0 0 0" mass="5" diaginertia=".3 .2 .1"/>'
    model, data = load(
        world(
            free_body(inside + body_plugin(quadratic_damping=quadratic)),
            integrator='implicitfast',
        )
    )
    nu = data.qvel[:] = rng.normal(size=6)
    matrix = quadratic * np.abs(nu)
    assert np.linalg.eigvalsh(matrix + matrix.T)[0] < 0  # or the test would show nothing
    mujoco.mj_forward(model, data)
    dense = np.zeros((6, 6))
    mujoco.mj_fullM(model, data, dense)
    dense -= np.diag([5, 5, 5, 0.3, 0.2, 0.1])
    expected = 0.01 * secant_damping(np.zeros((6, 6)), quadratic, nu)
    np.testing.assert_allclose(dense, expected, atol=1e-14)


@pytest.mark.parametrize('integrator', ['Euler', 'implicit', 'implicitfast', 'discrete'])
@pytest.mark.parametrize('timestep', [0.01, 1.0])
def test_quadratic_drag_is_the_secant_step_at_any_timestep(integrator, timestep):
    """v+ = v / (1 + h D |v| / m): never changes sign, to rounding (spin likewise)."""
    inside = '<inertial pos="0 0 0" mass="5" diaginertia=".3 .2 .1"/>'
    plugin = body_plugin(quadratic_damping=[100, 100, 100, 1, 1, 1])
    model, data = load(world(free_body(inside + plugin), integrator=integrator, timestep=timestep))
    speed = data.qvel[0] = 20.0
    for _ in range(10):
        mujoco.mj_step(model, data)
        speed /= 1 + timestep * 100 * speed / 5
        assert data.qvel[0] == pytest.approx(speed, rel=1e-13)
