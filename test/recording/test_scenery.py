# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Ground, sky and water of films."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.recording.pictures.scenery import Scenery

FOG = mujoco.mjtRndFlag.mjRND_FOG


def dressed(name, height):
    """Return the model, and what stands in a picture whose eye is at a height [m]."""
    simulation = Simulation(name)
    model, data = simulation.model, simulation.data
    mujoco.mj_forward(model, data)
    scenery = Scenery(model, data, 0.4)
    scene = mujoco.MjvScene(model, 20000)
    for camera in scene.camera:
        camera.pos[:] = (0, -3, height)
    scenery.dress(scene, np.array([0.0, 0.0, height]))
    return model, scene


@pytest.mark.parametrize(('height', 'under'), [(2.0, 0), (-2.0, 1)])
def test_one_sees_less_far_under_water_and_a_level_surface_is_one_sheet(height, under):
    model, scene = dressed('rov', height)
    assert scene.flags[FOG] == under
    assert scene.ngeom == 1
    assert scene.geoms[0].pos[2] == 0.0
    bed = model.geom('bed')
    assert (bed.size[:2] == 0.0).all()  # to the horizon


def test_waves_are_drawn_and_dry_scenes_have_no_water():
    assert dressed('wave_buoy', 3.0)[1].ngeom > 1000
    model, scene = dressed('quadrotor', 1.0)
    assert scene.ngeom == 0 and scene.flags[FOG] == 0
    # the ground fades into the colour of the sky over the horizon
    assert model.vis.rgba.haze[:3] == pytest.approx([0.535, 0.66, 0.81], abs=0.02)


def test_still_bodies_of_water_give_way_to_the_surface():
    model, _ = dressed('amphibious', 1.0)
    assert model.geom('water').group[0] == 5


def test_the_sky_ends_at_the_water():
    model, _ = dressed('rov', 1.0)
    sky = next(i for i in range(model.ntex) if model.tex_type[i] == 2)
    width = int(model.tex_width[sky])
    begin, size = int(model.tex_adr[sky]), 6 * width * width * 3
    faces = model.tex_data[begin : begin + size].reshape(6, width, width, 3).astype(int)
    for side in (0, 1, 4, 5):
        rows = faces[side].mean(axis=(1, 2))
        assert rows[: width // 2 - 3].min() > rows[width // 2 + 3 :].max() + 50
    assert faces[2].mean() > faces[3].mean() + 50
