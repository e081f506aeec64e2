# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Gaits drive joints until a command comes."""

import numpy as np

from fluid_sim_ros import Simulation


def test_a_gait_swims_is_the_same_in_any_batch_and_ends_with_a_command():
    ends = []
    for batch in (1, 7, 500):
        simulation = Simulation('swimmer')
        while simulation.step_count < 1000:
            simulation.step(min(batch, 1000 - simulation.step_count))
        ends.append(simulation.data.qpos.copy())
    np.testing.assert_array_equal(ends[0], ends[1])
    np.testing.assert_array_equal(ends[0], ends[2])
    assert ends[0][0] > 0.1
    state = simulation.save_state()
    simulation.step(123)
    expected = simulation.data.qpos.copy()
    simulation.load_state(state)
    simulation.step(123)
    np.testing.assert_array_equal(simulation.data.qpos, expected)
    simulation.set_joints('swimmer', [0.1] * 5)
    simulation.step(200)
    np.testing.assert_array_equal(simulation.data.ctrl, [0.1] * 5)
    simulation.reset()
    simulation.step(200)
    assert np.ptp(simulation.data.ctrl) > 0.1


def test_the_fly_flies_by_its_gait():
    simulation = Simulation('fly_wing')
    start = simulation.snapshot().vehicles['fly'].position_w[2]
    simulation.step(round(0.5 / simulation.timestep))
    rise = simulation.snapshot().vehicles['fly'].position_w[2] - start
    assert abs(rise) < 0.15  # without wings it would have fallen 1.2 m
