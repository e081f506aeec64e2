# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The approach speed: continuous, within its limits, and never too fast to brake."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluid_sim_ros.control.approach import Approach

GAIN, SPEED, ACCELERATION = 1.5, 4.0, 3.0


def approach() -> Approach:
    return Approach(GAIN, SPEED, ACCELERATION)


def test_speed_is_smooth_where_its_two_branches_meet() -> None:
    at, step = ACCELERATION / GAIN**2, 1e-6
    below, above = approach().speed(at - step), approach().speed(at + step)
    assert above - below == pytest.approx(2 * step * GAIN, rel=1e-3)


@given(st.floats(0.0, 50.0))
def test_braking_from_the_speed_at_a_distance_takes_no_longer_than_the_distance(d: float) -> None:
    speed = approach().speed(d)
    assert 0.0 <= speed <= SPEED
    # v dv/dd <= a: the change of speed along the way needs no more than the largest braking
    slope = (approach().speed(d + 1e-6) - speed) / 1e-6
    assert speed * slope <= ACCELERATION * (1 + 1e-3)


@settings(max_examples=20)
@given(st.floats(-20, 20), st.floats(-20, 20), st.floats(-3, 3), st.floats(-3, 3))
def test_following_the_reference_arrives_and_keeps_the_acceleration(
    dx: float, dy: float, vx: float, vy: float
) -> None:
    plan, dt = approach(), 0.01
    plan.restart(vx, vy)
    left = np.array([dx, dy])
    for _ in range(2000):
        before = np.array(plan.velocity)
        plan.step(*left, dt)
        change = np.linalg.norm(np.array(plan.velocity) - before)
        assert change <= ACCELERATION * dt * (1 + 1e-9)
        assert np.array(plan.acceleration) * dt == pytest.approx(plan.velocity - before)
        left = left - np.array(plan.velocity) * dt
    assert np.linalg.norm(left) < 1e-3


def test_straight_line_from_rest_has_no_overshoot() -> None:
    plan, left, dt = approach(), 5.0, 0.01
    for _ in range(1000):
        plan.step(left, 0.0, dt)
        left -= plan.velocity[0] * dt
        assert left > -0.005
        assert math.hypot(*plan.velocity) <= SPEED + 1e-9


def test_a_repeated_state_changes_nothing() -> None:
    plan = approach()
    plan.step(3.0, 1.0, 0.01)
    before = plan.velocity, plan.acceleration
    plan.step(3.0, 1.0, 0.0)
    assert (plan.velocity, plan.acceleration) == before
