# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Arrows in MuJoCo's pictures are as long as they say."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.plugins.drawn_arrow import add_arrow
from fluid_sim_ros.plugins.renderer import new_renderer


def test_an_arrow_reaches_as_far_as_it_says():
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><light pos="0 -3 3"/><geom size=".001"/></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    camera = mujoco.MjvCamera()
    camera.lookat[:], camera.distance, camera.azimuth, camera.elevation = (0, 0, 0.5), 3, 90, 0
    renderer = new_renderer(model, 400, 400)
    try:
        renderer.update_scene(data, camera)
        scene = renderer.scene
        assert add_arrow(scene, np.zeros(3), np.array([0, 0, 1.0]), 0.02, np.array([1, 0, 0, 1]))
        ball = scene.geoms[scene.ngeom]
        mujoco.mjv_initGeom(
            ball, mujoco.mjtGeom.mjGEOM_SPHERE, np.full(3, 0.03), np.array([0.3, 0, 1.0]),
            np.eye(3).ravel(), np.array([0, 1, 0, 1], dtype=np.float32),
        )  # fmt: skip
        scene.ngeom += 1
        picture = renderer.render().astype(int)
    finally:
        renderer.close()
    red = np.argwhere((picture[..., 0] > 90) & (picture[..., 1] < 60))[:, 0]
    green = np.argwhere((picture[..., 1] > 90) & (picture[..., 0] < 60))[:, 0]
    # of 162 pixels; the last of the point are thinner than one
    assert red.min() == pytest.approx(green.mean(), abs=12.0)
    assert red.max() - red.min() > 140
