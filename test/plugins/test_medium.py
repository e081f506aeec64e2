# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""fluid_sim.medium: profiles, run-time targets, accelerating flow, two fluids."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.added_mass import accelerating_flow_wrench
from fluid_sim_ros.physics.environment.medium import (
    flow_acceleration,
    logarithmic_profile,
    power_law_profile,
    slew_limited,
    table_profile,
)
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    set_medium,
    world,
)

AXES = [0.3, 0.2, 0.1]
VOLUME = 4 / 3 * np.pi * 0.006
#: A body whose damping reads the flow: force = -(v - u) for unit coefficients.
PROBE = free_body(ellipsoid(AXES, 500) + body_plugin(linear_damping=[1, 1, 1, 0, 0, 0]))


def felt_flow(model, data, position):
    data.qpos[:3] = position
    return explicit_force(model, data)[:3]


@pytest.mark.parametrize('height', [0.2, 0.9, 3.0, 12.0, 40.0])
@pytest.mark.parametrize(
    ('words', 'twin'),
    [
        ('power 0.143 10', lambda z: power_law_profile(z, 10, 0.143)),
        ('log 0.03 10', lambda z: logarithmic_profile(z, 10, 0.03)),
        (
            'table 0 0.2 1 0.5 10 1 30 1.3',
            lambda z: table_profile(z, [0, 1, 10, 30], [0.2, 0.5, 1, 1.3]),
        ),
        ('uniform', lambda z: (1.0, 0.0)),
    ],
)
def test_wind_profiles(words, twin, height):
    wind = [6.0, 2.0, 0.0]
    medium = {'density': 1.2, 'wind': wind, 'wind_profile': words, 'wind_datum': -1.5}
    model, data = load(world(PROBE, medium=medium))
    felt = felt_flow(model, data, [3, -7, height - 1.5])
    np.testing.assert_allclose(felt, float(twin(height)[0]) * np.array(wind), rtol=1e-12)


def test_current_below_and_wind_above_the_surface():
    medium = {
        'density': 1025, 'viscosity': 1e-3, 'density_above': 1.2, 'viscosity_above': 1e-3,
        'surface': 2.0, 'current': [1, 0, 0], 'wind': [0, 5, 0],
        'current_profile': 'table -10 0.2 0 1',
    }  # fmt: skip
    model, data = load(world(PROBE, medium=medium))
    np.testing.assert_allclose(felt_flow(model, data, [0, 0, -3.0]), [0.6, 0, 0])
    np.testing.assert_allclose(felt_flow(model, data, [0, 0, -30.0]), [0.2, 0, 0])
    np.testing.assert_allclose(felt_flow(model, data, [0, 0, 9.0]), [0, 5, 0])
    np.testing.assert_allclose(felt_flow(model, data, [0, 0, 2.0]), [0.5, 2.5, 0])  # half wet


def test_targets_move_at_the_stated_rate_and_can_change_on_the_way():
    medium = {'density': 1000, 'current_slew': 0.5}
    model, data = load(world(PROBE, medium=medium, timestep=0.1))
    model.body_mass[1] = 1e9  # stays where it is
    target = np.array([1.2, -1.6, 0])
    assert set_medium(model, data, current=target)
    for _ in range(15):
        expected, _ = slew_limited(np.zeros(3), target, 0.5, data.time)
        np.testing.assert_allclose(explicit_force(model, data)[:3], expected, atol=1e-6)
        mujoco.mj_step(model, data)
    turned_at, start = data.time, slew_limited(np.zeros(3), target, 0.5, data.time)[0]
    set_medium(model, data, current=[0, 0, 0])
    for _ in range(30):
        expected, _ = slew_limited(start, np.zeros(3), 0.5, data.time - turned_at)
        np.testing.assert_allclose(explicit_force(model, data)[:3], expected, atol=1e-6)
        set_medium(model, data, current=[0, 0, 0])  # said again: nothing new
        mujoco.mj_step(model, data)


def test_zero_slew_is_a_step_without_a_force_spike():
    plugin = body_plugin(added_mass='auto', volume='auto')
    model, data = load(
        world(
            free_body(ellipsoid(AXES, 500) + plugin),
            medium={'density': 1000, 'current_slew': 0},
        )
    )
    set_medium(model, data, current=[5, 0, 0])
    np.testing.assert_allclose(explicit_force(model, data), 0, atol=1e-9)


def test_accelerating_flow_pushes_displaced_and_added_mass():
    """(rho V + A) Du/Dt on a body that moves along with the fluid at this instant."""
    plugin = body_plugin(added_mass='auto', volume='auto')
    model, data = load(
        world(
            free_body(ellipsoid(AXES, 500) + plugin),
            medium={'density': 1000, 'current_slew': 0.8},
        )
    )
    quat = np.array([0.8, 0.3, -0.4, 0.33])
    data.qpos[3:] = quat / np.linalg.norm(quat)
    set_medium(model, data, current=[3, 4, 0])
    mujoco.mj_kinematics(model, data)
    rotation = data.xmat[1].reshape(3, 3)
    mass, inertia = ellipsoid_added_mass(AXES, 1000.0)
    accel = rotation.T @ (0.8 * np.array([0.6, 0.8, 0]))
    force, torque = accelerating_flow_wrench(
        np.diag(np.r_[mass, inertia]), 1000 * VOLUME, np.zeros(3), accel
    )
    np.testing.assert_allclose(
        explicit_force(model, data), np.r_[rotation @ force, torque], rtol=1e-12, atol=1e-9
    )


def test_a_neutral_body_is_carried_along_by_an_accelerating_current():
    """Same density as the fluid, no drag: it must follow the flow exactly."""
    plugin = body_plugin(added_mass='auto', volume='auto')
    model, data = load(
        world(
            free_body(ellipsoid(AXES, 1000) + plugin),
            medium={'density': 1000, 'current_slew': 0.4},
        )
    )
    set_medium(model, data, current=[0.3, -0.2, 0.6])
    mujoco.mj_step(model, data, 100)
    direction = np.array([0.3, -0.2, 0.6]) / 0.7
    np.testing.assert_allclose(data.qvel[:3], 0.4 * direction, rtol=1e-9)
    np.testing.assert_allclose(data.qvel[3:], 0, atol=1e-12)


def test_a_body_towed_through_a_steady_shear_feels_no_flow_acceleration():
    plugin = body_plugin(added_mass='auto', volume='auto')
    medium = {
        'density': 1000, 'current': [2, 0, 0], 'current_profile': 'table -10 0 0 1',
        'current_datum': 0,
    }  # fmt: skip
    model, data = load(world(free_body(ellipsoid([0.2] * 3, 500) + plugin), medium=medium))
    data.qpos[2], data.qvel[2] = -5, 3
    np.testing.assert_allclose(explicit_force(model, data), 0, atol=1e-9)


def test_an_upward_flow_through_a_shear_accelerates():
    medium = {
        'density': 1000, 'current': [2, 0, 0.5], 'current_profile': 'table -10 0 0 1',
        'current_datum': 0,
    }  # fmt: skip
    plugin = body_plugin(volume='auto')
    model, data = load(world(free_body(ellipsoid([0.2] * 3, 500) + plugin), medium=medium))
    data.qpos[2] = -4
    accel = flow_acceleration(0.6, 0.1, [2, 0, 0.5], np.zeros(3))
    volume = 4 / 3 * np.pi * 0.008
    np.testing.assert_allclose(explicit_force(model, data)[:3], 1000 * volume * accel, rtol=1e-9)


def test_without_a_medium_in_charge_the_call_says_so():
    model, data = load(world(free_body(ellipsoid(AXES, 500) + body_plugin(added_mass=[1] * 6))))
    assert not set_medium(model, data, wind=[1, 0, 0])
    stock = load(
        world(
            free_body(ellipsoid(AXES, 500) + body_plugin(added_mass='auto')),
            option='density="1000"',
            medium={'density': 1000},
        )
    )
    assert not set_medium(*stock, wind=[1, 0, 0])


@pytest.mark.parametrize('shape', ['', 'fluidshape="ellipsoid" fluidcoef=".5 .3 1.2 1 1"'])
def test_stock_forces_meet_the_local_wind(shape):
    """MuJoCo's own drag in a profile is what it would be with opt.wind of that height."""
    body = free_body(f'<geom type="ellipsoid" size=".3 .2 .1" density="500" {shape}/>')
    option = 'density="1.2" viscosity="1.8e-5"'
    medium = {'wind': [8, 2, 0], 'wind_profile': 'power 0.143 10', 'wind_datum': 0}
    model, data = load(world(body, option=option, medium=medium))
    plain, reference = load(world(body, option=option))
    plain.opt.wind = float(power_law_profile(4.0, 10, 0.143)[0]) * np.array([8, 2, 0])
    for copy in (data, reference):
        copy.qpos[:] = [1, 2, 4, 0.8, 0.6, 0, 0]
        copy.qvel[:] = [1, -2, 0.5, 0.3, -0.4, 0.2]
    mujoco.mj_forward(model, data)
    mujoco.mj_forward(plain, reference)
    np.testing.assert_allclose(data.qfrc_fluid, reference.qfrc_fluid, rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(data.qfrc_passive, reference.qfrc_passive, rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(explicit_force(model, data), data.qfrc_fluid, rtol=1e-10)


def test_reset_restores_the_configured_flow():
    model, data = load(world(PROBE, medium={'density': 1000, 'current': [0.1, 0.2, 0.3]}))
    start = data.plugin_state.copy()
    set_medium(model, data, current=[1, 1, 1], wind=[2, 2, 2])
    assert not np.array_equal(data.plugin_state, start)
    mujoco.mj_resetData(model, data)
    np.testing.assert_array_equal(data.plugin_state, start)
