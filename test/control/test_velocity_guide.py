# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A pilot's velocity, followed by the laws on the simulated vehicles."""

import math

import numpy as np
import pytest

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.approach import Approach
from fluid_sim_ros.control.guidance.velocity import Velocity, VelocityGuide
from fluid_sim_ros.control.multirotor import MultirotorController, MultirotorGains, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import STILL, Loop

GAINS = MultirotorGains()
LEAD = Approach(GAINS.position, GAINS.max_speed, GAINS.max_acceleration).distance
REST = ((1.0, 0.0, 0.0, 0.0), STILL, STILL)


def fly(scene, medium, law, target_of, velocity_at, seconds, rate=100.0):
    """Return rows of time, velocity (heading axes), turn rate, position and heading."""
    loop, guide, rows = Loop(scene, rate, medium), VelocityGuide(LEAD, 3.0), []
    for _ in range(round(seconds * rate)):
        state = loop.state()
        velocity = velocity_at(state.time)
        target = target_of(velocity, guide.step(state, velocity))
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        yaw, (vx, vy, vz) = rot.yaw_of(r_wb), rot.to_world(r_wb, state.velocity_b)
        c, s = math.cos(yaw), math.sin(yaw)
        ahead, left = c * vx + s * vy, c * vy - s * vx
        rows.append([state.time, ahead, left, vz, state.omega_b[2], *state.position_w, yaw])
        loop.advance(law.step(state, target), STILL)
    return np.array(rows)


def quad(velocity_at, seconds):
    law = MultirotorController(plant_of('quadrotor', 'x500')[0])
    return fly(
        'quadrotor', 'wind', law, lambda _, m: PoseTarget(m.position_w, m.heading), velocity_at,
        seconds,
    )  # fmt: skip


def rov(velocity_at, seconds):
    law = UnderwaterController(plant_of('rov', 'bluerov2_heavy')[0])

    def target(velocity, moving):
        return DepthTarget(-moving.position_w[2], moving.heading, velocity[:2])

    return fly('rov', 'current', law, target, velocity_at, seconds)


@pytest.mark.parametrize(
    ('fly_it', 'velocity'),
    [
        (quad, Velocity(ahead=2.0)),
        (quad, Velocity(ahead=-3.5)),
        (quad, Velocity(left=-1.0, up=0.5)),
        (quad, Velocity(ahead=1.0, turn=0.5)),
        (rov, Velocity(ahead=0.5)),
        (rov, Velocity(left=0.3, up=-0.2)),
        (rov, Velocity(ahead=0.3, turn=0.3)),
    ],
)
def test_each_axis_reaches_the_velocity_that_is_asked_for(fly_it, velocity):
    rows = fly_it(lambda _: velocity, 12.0)
    settled = rows[rows[:, 0] > 8.0]
    assert settled[:, 1:5].mean(axis=0) == pytest.approx([*velocity], abs=0.05)


@pytest.mark.parametrize('fly_it', [quad, rov])
def test_a_velocity_of_zero_holds_depth_and_heading(fly_it):
    moving = Velocity(ahead=0.5, up=0.2, turn=0.4)
    rows = fly_it(lambda t: moving if t < 4.0 else Velocity(), 12.0)
    at_rest = rows[rows[:, 0] > 10.0]
    assert np.abs(at_rest[:, 1:5]).max() < 0.05
    assert np.ptp(at_rest[:, 7]) < 0.02 and np.ptp(at_rest[:, 8]) < 0.02


def test_what_holds_the_vehicle_back_does_not_wind_the_target_up():
    guide = VelocityGuide(lambda speed: 0.5 * speed, upward=1.0, turned=0.5)
    for step in range(1000):
        moving = guide.step(State(0.1 * step, (1.0, 2.0, 3.0), *REST), Velocity(3, 4, 5, 6))
    x, y, z = np.subtract(moving.position_w, (1.0, 2.0, 3.0))
    assert (x, y) == pytest.approx((1.5, 2.0))
    assert z == pytest.approx(1.0) and moving.heading == pytest.approx(0.5)


def test_a_pause_is_no_motion_and_restart_begins_where_the_vehicle_is():
    guide = VelocityGuide(float, 10.0)
    guide.step(State(0.0, STILL, *REST), Velocity(up=1.0))
    moving = guide.step(State(100.0, STILL, *REST), Velocity(up=1.0))
    assert moving.position_w[2] == pytest.approx(0.5)
    guide.restart()
    assert guide.step(State(1.0, (5.0, 0, 2.0), *REST), Velocity()).position_w == (5.0, 0, 2.0)


def test_velocities_are_along_the_heading_whatever_the_tilt():
    q = rot_of(yaw=math.pi / 2, roll=0.6)
    guide = VelocityGuide(float, 10.0)
    for step in range(2):
        moving = guide.step(State(0.1 * step, STILL, q, STILL, STILL), Velocity(ahead=1.0, up=1.0))
    assert moving.position_w == pytest.approx((0.0, 1.0, 0.1), abs=1e-9)


def test_the_place_where_it_comes_to_rest_is_kept():
    guide = VelocityGuide(float, 10.0)
    fast = State(0.0, STILL, REST[0], (1.0, 0, 0), STILL)
    assert guide.step(fast, Velocity()).position_w == STILL  # still moves: none yet
    guide.step(State(1.0, (2.0, 0, 0), *REST), Velocity())
    assert guide.step(State(2.0, (2.5, 0, 0), *REST), Velocity()).position_w == (2.0, 0, 0)


@pytest.mark.parametrize('speed', [0.0, 0.5, 2.0, 3.9])
def test_the_lead_is_that_for_which_the_law_asks_for_the_speed(speed):
    approach = Approach(GAINS.position, GAINS.max_speed, GAINS.max_acceleration)
    assert approach.speed(approach.distance(speed)) == pytest.approx(speed)


def rot_of(yaw, roll):
    """Return a quaternion, scalar first: the roll first, then the yaw."""
    a, b = yaw / 2, roll / 2
    return (
        math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), math.sin(a) * math.sin(b),
        math.sin(a) * math.cos(b),
    )  # fmt: skip
