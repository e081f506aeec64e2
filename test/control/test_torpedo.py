# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The torpedo's controller, closed around the REMUS 100."""

import dataclasses

import numpy as np
import pytest

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.torpedo import CruiseTarget, TorpedoController, TorpedoGains
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import Loop

PLANT, VEHICLE = plant_of('remus100', '')
MOST = 0.2374  # rad
TIME, DEPTH, YAW, SPEED, TILT, THRUST, RUDDER, PLANES = range(8)
RATE = 50.0


def controller(**gains):
    return TorpedoController(PLANT, MOST, TorpedoGains(**gains))


def cruise(law, seconds, *, depth=5.0, heading=0.0, speed=1.5, current=(0.0, 0.0, 0.0)):
    """Return rows of time, depth, heading, forward speed, tilt, thrust, rudder, planes."""
    loop, rows = Loop('remus100', RATE, 'current'), []
    for _ in range(round(seconds * RATE)):
        state = loop.state()
        thrust, rudder, planes = law.step(state, CruiseTarget(depth, heading, speed))
        r_wb = rot.from_quaternion(state[2])
        rows.append([
            state[0], -state[1][2], rot.yaw_of(r_wb), state[3][0], np.arccos(r_wb[8]), thrust,
            rudder, planes,
        ])  # fmt: skip
        loop.simulation.set_joints('remus100', [rudder, planes])
        loop.advance([thrust], current)
    return np.array(rows)


def test_cruise_holds_depth_heading_and_speed_against_buoyancy_and_propeller_torque():
    rows = cruise(controller(), 45.0)
    assert np.abs(rows[:, DEPTH] - 5).max() < 0.2
    assert np.abs(rows[:, YAW]).max() < np.radians(2)
    last = rows[-1]
    assert last[[DEPTH, YAW, SPEED]] == pytest.approx([5, 0, 1.5], abs=0.01)
    assert np.degrees(last[TILT]) < 8  # 5 deg of roll carry the torque, 3 of pitch the buoyancy
    assert last[RUDDER] < 0 < last[THRUST]


@pytest.mark.parametrize(
    ('current', 'speed'), [((0.0, 0.3, 0.0), 1.5), ((-0.3, 0.0, 0.0), 1.5), ((0.3, 0.0, 0.0), 1.8)]
)
def test_it_holds_them_in_a_current_from_any_side(current, speed):
    # 1.5 m/s through the water at least: below 1.3 the planes cannot hold 7 N of buoyancy down
    rows = cruise(controller(), 45.0, current=current, speed=speed)
    assert np.abs(rows[:, DEPTH] - 5).max() < 0.25
    settled = rows[-250:]
    assert np.abs(settled[:, DEPTH] - 5).max() < 0.03
    assert np.abs(settled[:, YAW]).max() < np.radians(0.2)
    assert np.abs(settled[:, SPEED] - speed).max() < 0.01


@pytest.mark.parametrize(('depth', 'heading'), [(8.0, 2.0), (6.0, -1.0), (2.0, -3.0)])
def test_steps_of_depth_and_heading_settle(depth, heading):
    rows = cruise(controller(), 60.0, depth=depth, heading=heading)
    way = (rows[:, DEPTH] - 5) * np.sign(depth - 5)
    assert way.max() < abs(depth - 5) + 0.3 and way.min() > -0.2
    assert np.abs(rows[:, YAW]).max() < abs(heading) + 0.1
    assert rows[-1, [DEPTH, YAW, SPEED]] == pytest.approx([depth, heading, 1.5], abs=0.02)


def test_it_turns_the_shorter_way():
    rows = cruise(controller(), 15.0, heading=-3.0)
    assert rows[100:300, YAW].max() < 0


def test_limits_hold():
    rows = cruise(controller(max_rate=0.5), 10.0, depth=9.0, heading=3.0, speed=2.5)
    assert np.abs(rows[:, [RUDDER, PLANES]]).max() == pytest.approx(MOST)
    assert rows[:, THRUST].min() >= 0 and rows[:, THRUST].max() == pytest.approx(10.72)


def test_a_repeated_state_gets_the_same_answer_and_time_going_back_forgets():
    law = controller()
    state = ((0.3, 0.1, -4.9), (0.99, 0.1, 0.0, 0.0), (1.4, 0.0, 0.1), (0.1, 0.02, 0.03))
    begun = law.step(State(0.0, *state), CruiseTarget(5.0, 0.0, 1.5))
    first = law.step(State(0.02, *state), CruiseTarget(5.0, 0.0, 1.5))
    assert first != begun
    assert law.step(State(0.02, *state), CruiseTarget(5.0, 0.0, 1.5)) == first
    assert law.step(State(0.0, *state), CruiseTarget(5.0, 0.0, 1.5)) == begun


def test_bad_plants_and_gains_are_one_line():
    two = dataclasses.replace(
        PLANT, thruster_matrix=np.repeat(PLANT.thruster_matrix, 2, axis=1),
        thrust_limits=np.repeat(PLANT.thrust_limits, 2, axis=0),
    )  # fmt: skip
    with pytest.raises(ConfigError, match='2 thrusters; this controller needs one'):
        TorpedoController(two, MOST)
    with pytest.raises(ConfigError, match=r'deflection of the fins 0 rad: must be above 0'):
        TorpedoController(PLANT, 0)
    with pytest.raises(ConfigError, match=r"gain 'fin_authority': 0\.0; must be above 0"):
        controller(fin_authority=0.0)
    with pytest.raises(ConfigError, match=r"gain 'max_pitch': 2\.0; must be below pi/2"):
        controller(max_pitch=2.0)
