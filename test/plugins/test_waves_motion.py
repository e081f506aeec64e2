# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How bodies move in waves of fluid_sim.medium."""

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.environment.waves import regular_waves, wave_flow, wave_surface
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
)
from test.support.wave_models import CASES, LEVEL, MEAN, VOLUME, G, sea_model, sphere


def test_the_force_on_a_small_held_sphere_is_one_and_a_half_froude_krylov():
    """(rho V + m_a) Du/Dt with m_a = rho V/2: amplitude 3/2 rho V a omega^2 e^kz."""
    model, data = sea_model(
        sphere(volume='auto', added_mass='auto'), CASES['deep'][0], weight=False
    )
    omega, k, z = 2 * np.pi / 5, (2 * np.pi / 5) ** 2 / G, -3.0
    data.qpos[:3] = [0, 0, z + LEVEL]
    push = 1.5 * 1000 * VOLUME * 0.6 * omega**2 * np.exp(k * z)
    steady = 1.5 * 1000 * VOLUME * k * (0.6 * omega * np.exp(k * z)) ** 2  # of (u.grad)u, upward
    for time in np.arange(16) / 16 * 5:
        data.time = time
        sine, cosine = np.sin(-omega * time), np.cos(-omega * time)
        # a held body's added mass also has its convective part: none for a sphere without spin
        expected = [0.6 * push * sine, 0.8 * push * sine, steady - push * cosine]
        np.testing.assert_allclose(explicit_force(model, data)[:3], expected, atol=1e-6 * push)


@pytest.mark.parametrize('name', ['deep', 'shallow', 'short-crested'])
def test_a_neutral_body_moves_with_the_water(name):
    """No drag: (rho V + A) Du/Dt = (m + A) a along the path of the water particle."""
    waves, sea = CASES[name]
    model, data = sea_model(
        sphere(volume='auto', added_mass='auto'), waves, timestep=0.02, weight=False
    )
    start = np.array([1.0, 2.0, -1.4])
    data.qpos[:3] = start + MEAN
    data.qvel[:3] = wave_flow(sea, start, 0.0).velocity
    path = solve_ivp(
        lambda t, x: wave_flow(sea, x, t).velocity, (0, 10), start,
        method='DOP853', rtol=1e-11, atol=1e-12,
    )  # fmt: skip
    mujoco.mj_step(model, data, 500)
    assert np.ptp(path.y[2]) > 0.1
    np.testing.assert_allclose(data.qpos[:3] - MEAN, path.y[:, -1], atol=1e-6)


def test_orbits_are_circles_of_the_textbook_radius():
    """Radius a e^kz, to first order in the steepness (here k a = 0.0016)."""
    waves = {'waves': 'regular .02 5'}
    k = (2 * np.pi / 5) ** 2 / G
    for z in (-1.0, -4.0):
        model, data = sea_model(
            sphere(volume='auto', added_mass='auto'), waves, timestep=0.05, weight=False
        )
        data.qpos[2] = z + LEVEL
        data.qvel[:3] = wave_flow(regular_waves(0.02, 5.0), [0, 0, z], 0.0).velocity
        path = []
        for _ in range(100):
            mujoco.mj_step(model, data)
            path.append(data.qpos[[0, 2]].copy())
        across = np.ptp(path, axis=0) / 2
        np.testing.assert_allclose(across, 0.01 * np.exp(k * z), rtol=4 * k * 0.01)


def test_a_floating_box_follows_long_waves():
    """Wave 156 m long, box 1 m: heave is the surface, pitch its slope, to first order."""
    box = '<geom type="box" size=".5 .5 .1" density="500"/>'
    plugin = body_plugin(
        volume='auto', added_mass=[10, 10, 80, 3, 3, 1],
        linear_damping=[0, 0, 300, 60, 60, 5],
    )  # fmt: skip
    sea = regular_waves(2.0, 10.0, [0.6, 0.8], gravity=G)
    model, data = sea_model(
        free_body(box + plugin), {'waves': 'regular 2 10', 'wave_direction': [0.6, 0.8]}
    )
    data.qpos[2] = LEVEL + 1.0
    data.qvel[:3] = wave_flow(sea, [0, 0, 1.0], 0.0).velocity
    heave, tilt, slopes = [], [], []
    for step in range(3000):
        mujoco.mj_step(model, data)
        if step < 1000:
            continue
        surface = wave_surface(sea, data.qpos[:2], data.time)
        rotation = data.xmat[1].reshape(3, 3)
        heave.append(data.qpos[2] - LEVEL - surface.height)
        tilt.append(-rotation[:2, 2] / rotation[2, 2])
        slopes.append(surface.slope)
    assert np.max(np.abs(heave)) < 0.012  # of 1 m
    assert np.max(np.abs(np.array(tilt) - slopes)) < 0.05 * np.max(np.abs(slopes))
    # it goes around with the water, 1 m to either side, and drifts as slowly (Stokes: 2.5 cm/s)
    assert np.hypot(*data.qpos[:2]) < 3


def test_order_of_convergence_in_a_sea():
    """RK4 keeps order 4 in waves: error against a fine step."""
    waves = {
        'waves': 'jonswap .5 3', 'wave_seed': 1, 'wave_components': 20, 'wave_spreading': 8,
    }  # fmt: skip
    hull = free_body(
        ellipsoid([0.3, 0.2, 0.1], 990) + body_plugin(volume='auto', added_mass='auto')
    )

    def end(timestep):
        model, data = sea_model(hull, waves, timestep=timestep)
        data.qpos[2], data.qvel[:] = LEVEL - 3, [0.3, 0, 0, 0.2, 0.5, -0.4]
        mujoco.mj_step(model, data, round(2 / timestep))
        return data.qpos.copy()

    reference = end(0.0025)
    errors = [np.linalg.norm(end(h) - reference) for h in (0.04, 0.02)]
    assert np.log2(errors[0] / errors[1]) >= 3.9


def test_the_motion_in_still_water_is_that_of_waves_of_no_height():
    box = '<geom type="box" size=".5 .5 .1" density="500"/>'
    bodies = free_body(box + body_plugin(volume='auto', linear_damping=[1] * 6))
    ends = []
    for waves in ({}, {'waves': 'none'}, {'waves': 'regular 0 5'}):
        model, data = sea_model(bodies, waves, weight=True)
        data.qpos[:], data.qvel[3:] = [0, 0, LEVEL + 0.05, 0.98, 0.1, 0.15, 0], [0.5, 0.2, 0.1]
        mujoco.mj_step(model, data, 200)
        ends.append(data.qpos.copy())
    np.testing.assert_array_equal(ends[1], ends[0])
    np.testing.assert_allclose(ends[2], ends[0], rtol=0, atol=1e-12)
