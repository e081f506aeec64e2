# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The waves in pictures: triangles that lie on the surface."""

import mujoco
import numpy as np

from fluid_sim_ros import Simulation
from fluid_sim_ros.physics.environment.wave_spectrum import jonswap_waves
from fluid_sim_ros.physics.environment.waves import wave_surface
from fluid_sim_ros.plugins.drawn_waves import add_waves


def patch(name, **options):
    simulation = Simulation(name, **options)
    scene = mujoco.MjvScene(simulation.model, 10000)
    simulation.data.time = 12.0
    add_waves(scene, simulation.model, simulation.data, [3.2, -1.0, 0.4], 0.5)
    return scene


def test_every_corner_of_the_patch_is_on_the_surface():
    scene = patch('wave_buoy', seed=4)
    sea = jonswap_waves(1.5, 6.0, spreading=10, seed=4)
    geoms = scene.geoms[: scene.ngeom]
    assert scene.ngeom == 2 * 48**2
    start = np.array([geom.pos for geom in geoms], dtype=float)
    frames = np.array([geom.mat for geom in geoms], dtype=float).reshape(-1, 3, 3)
    for corner in (start, start + frames[..., 0], start + frames[..., 1]):
        expected = wave_surface(sea, corner[:, :2], 12.0).height
        np.testing.assert_allclose(corner[:, 2], expected, atol=1e-5)  # single precision
    area = 0.5 * np.cross(frames[..., 0], frames[..., 1])[:, 2]
    assert (area > 0.0).all()  # all face up
    low, high = start[:, :2].min(axis=0), (start + frames[..., 0])[:, :2].max(axis=0)
    np.testing.assert_allclose((low + high) / 2, [3.2, -1.0], atol=0.3)
    assert (high - low > 60.0).all()
    np.testing.assert_allclose(area.sum(), np.prod(high - low), rtol=1e-4)  # no gap, no overlap
    near = np.abs(start[:, :2] - [3.2, -1.0]).max(axis=1) < 0.5
    assert area[near].max() < 0.5 * 0.3**2  # fine where one looks


def test_level_water_and_dry_models_get_none():
    assert patch('rov').ngeom == 0
    assert patch('quadrotor').ngeom == 0
