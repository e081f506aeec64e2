# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An underwater vehicle that lacks axes: those that it has are held, the others are named."""

import dataclasses

import numpy as np
import pytest

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.allocation import AXES
from fluid_sim_ros.control.axes import reached_axes
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import STILL, Loop

BLUEROV2, _ = plant_of('bluerov2', '')  # six thrusters, two of them vertical
HEAVY, _ = plant_of('rov', '')
ORDER = ('fz', 'tz', 'fx', 'fy', 'tx', 'ty')


def only(plant, thrusters):
    return dataclasses.replace(
        plant, thruster_matrix=plant.thruster_matrix[:, thrusters],
        thrust_limits=plant.thrust_limits[thrusters],
    )  # fmt: skip


def fly(law, seconds, target):
    """Return rows of position, heading and tilt at 50 Hz."""
    loop, rows = Loop('bluerov2', 50.0, 'current'), []
    for _ in range(round(seconds * 50)):
        state = loop.state()
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        rows.append([*state.position_w, rot.yaw_of(r_wb), np.arccos(min(1.0, r_wb[8]))])
        loop.advance(law.step(state, target), STILL)
    return np.array(rows)


def test_what_reaches_every_direction_lacks_nothing():
    assert reached_axes(HEAVY.thruster_matrix, ORDER) == ORDER
    assert UnderwaterController(HEAVY).lacks == ()


def test_the_bluerov2_lacks_pitch_alone():
    assert np.linalg.matrix_rank(BLUEROV2.thruster_matrix) == 5
    assert UnderwaterController(BLUEROV2).lacks == ('ty',)


def test_reached_axes_can_be_commanded_one_by_one():
    rng = np.random.default_rng(5)
    for count in range(1, 7):
        matrix = rng.normal(size=(6, count))
        axes = reached_axes(matrix, ORDER)
        rows = [AXES.index(axis) for axis in axes]
        assert len(axes) == count
        inverse = np.linalg.pinv(matrix[rows])
        np.testing.assert_allclose(matrix[rows] @ inverse, np.eye(count), atol=1e-6)


def test_the_axes_of_the_bluerov2_are_held():
    rows = fly(UnderwaterController(BLUEROV2), 15.0, DepthTarget(6.0, 1.0))
    assert abs(rows[-1, 2] + 6.0) < 0.01
    assert abs(rows[-1, 3] - 1.0) < 0.01
    assert rows[:, 4].max() < np.radians(15)


def test_the_bluerov2_reaches_a_place():
    rows = fly(UnderwaterController(BLUEROV2), 20.0, DepthTarget(5.0, 0.0, place_w=(2.0, 1.0)))
    assert np.hypot(rows[-1, 0] - 2.0, rows[-1, 1] - 1.0) < 0.1
    assert abs(rows[-1, 2] + 5.0) < 0.02


def test_without_sway_it_turns_towards_its_place_and_drives_there():
    """Two vertical thrusters, and two that push along the body: no sway and no pitch."""
    matrix = np.zeros((6, 4))
    matrix[0, :2], matrix[5, :2] = 1.0, (-0.1, 0.1)
    matrix[2, 2:], matrix[3, 2:] = 1.0, (0.1, -0.1)
    plant = dataclasses.replace(
        BLUEROV2, thruster_matrix=matrix, thrust_limits=np.tile([-40.0, 40.0], (4, 1))
    )
    law = UnderwaterController(plant)
    assert law.lacks == ('fy', 'ty')
    loop = Loop('bluerov2', 50.0, 'current')
    vehicle = loop.simulation.vehicles['bluerov2']
    place = np.array([-3.0, 4.0])
    body = vehicle.body_id
    for _ in range(50 * 40):
        state = loop.state()
        wrench_b = matrix @ law.step(state, DepthTarget(5.0, 0.0, place_w=place))
        r_wb = np.array(rot.from_quaternion(state.quat_wb_wxyz)).reshape(3, 3)
        loop.data.xfrc_applied[body, :3] = r_wb @ wrench_b[:3]
        loop.data.xfrc_applied[body, 3:] = r_wb @ wrench_b[3:]
        loop.advance([0.0] * 6, STILL)
    assert np.linalg.norm(np.array(loop.state().position_w[:2]) - place) < 0.6
    assert abs(loop.state().position_w[2] + 5.0) < 0.05


@pytest.mark.parametrize(
    ('thrusters', 'lacks'),
    [
        ([4, 5], ('fx', 'fy', 'ty', 'tz')),  # the verticals: heave and roll
        ([0], ('fx', 'fy', 'fz', 'tx', 'ty')),  # one at an angle: yaw comes before surge
    ],
)
def test_what_is_left_of_the_bluerov2_is_used(thrusters, lacks):
    law = UnderwaterController(only(BLUEROV2, thrusters))
    assert law.lacks == lacks


def test_thrusters_that_reach_nothing_are_refused():
    dead = dataclasses.replace(BLUEROV2, thruster_matrix=np.zeros((6, 6)))
    with pytest.raises(ConfigError, match='reach no axis'):
        UnderwaterController(dead)
