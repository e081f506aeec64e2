# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is written into the pictures of a film."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.plugins.renderer import new_renderer
from fluid_sim_ros.recording.pictures.caption import captioned, pixels_per_metre, round_length


@pytest.mark.parametrize(
    ('most', 'length'), [(1.0, 1.0), (1.99, 1.0), (4.9, 2.0), (5.0, 5.0), (0.03, 0.02), (730, 500)]
)
def test_a_bar_has_a_round_length(most, length):
    assert round_length(most) == pytest.approx(length)


def test_the_bar_is_as_long_as_it_says():
    black = np.zeros((300, 400, 3), dtype=np.uint8)
    picture = captioned(black, 't = 1.0 s', 80.0)
    # 0.25 x 400 pixels are 1.25 m: a bar of 1 m
    row = picture[300 - 2 * 6]
    assert (row > 200).all(axis=1).sum() == pytest.approx(80, abs=3)
    assert (picture[:40] > 200).any()  # the words
    assert not black.any()


def test_the_scale_is_that_of_the_picture():
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><visual><headlight ambient=".9 .9 .9"/></visual><worldbody>'
        '<geom type="box" size=".5 .5 .5" rgba="1 1 1 1"/></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    camera = mujoco.MjvCamera()
    camera.lookat[:], camera.distance, camera.azimuth, camera.elevation = 0.0, 5.0, 90.0, 0.0
    renderer = new_renderer(model, 400, 400)
    try:
        renderer.update_scene(data, camera)
        front = np.array([0.0, -0.5, 0.0])
        scale = pixels_per_metre(model, renderer.scene, front, 400)
        picture = renderer.render()
    finally:
        renderer.close()
    seen = np.flatnonzero((picture[200] > 60).any(axis=1))
    assert seen[-1] - seen[0] + 1 == pytest.approx(scale, abs=3.0)  # the box is 1 m wide
