# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The example controllers fly a new vehicle without any tuning."""

import numpy as np
import pytest

from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.new_vehicle.files import design_vehicle, write_vehicle
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import Loop


@pytest.mark.parametrize(
    ('mass', 'side', 'layout'), [(0.3, 0.12, 'quad'), (6.0, 0.7, 'hexa'), (20.0, 1.2, 'octo')]
)
def test_the_quadrotor_controller_holds_it_in_a_gust(tmp_path, mass, side, layout):
    design = design_vehicle('v', 'air', mass, (side, side, 0.3 * side), layout)
    scene = str(write_vehicle(design, tmp_path).scene)
    plant, _ = plant_of(scene, '')
    controller = MultirotorController(plant)
    loop = Loop(scene, 100.0, 'wind')
    target = tuple(loop.state()[1])
    for i in range(1500):
        state = loop.state()
        thrusts = controller.step(state, PoseTarget(target))
        loop.advance(thrusts, (4.0, 0.0, 0.0) if i >= 200 else (0.0, 0.0, 0.0))
    assert np.linalg.norm(np.subtract(loop.state()[1], target)) < 0.1


def test_the_rov_controller_holds_it_in_a_current(tmp_path):
    design = design_vehicle('v', 'water', 15.0, (0.5, 0.45, 0.3), 'vectored8')
    scene = str(write_vehicle(design, tmp_path).scene)
    plant, _ = plant_of(scene, '')
    controller = UnderwaterController(plant)
    loop = Loop(scene, 50.0, 'current')
    for i in range(2000):
        state = loop.state()
        thrusts = controller.step(state, DepthTarget(2.5, 0.5, place_w=(0.0, 0.0)))
        loop.advance(thrusts, (0.2, 0.0, 0.0) if i >= 500 else (0.0, 0.0, 0.0))
    assert loop.state()[1] == pytest.approx([0, 0, -2.5], abs=0.05)
