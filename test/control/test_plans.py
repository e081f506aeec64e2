# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Waypoints, time from stamps, and joint waves."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.control.gait import JointWave, travelling_wave, wing_beat
from fluid_sim_ros.control.timing import LONGEST_PERIOD, StampClock
from fluid_sim_ros.control.waypoints import Waypoint, WaypointPlan, from_flat
from fluid_sim_ros.errors import ConfigError


def test_flat_list_is_read_five_by_five() -> None:
    plan = from_flat([1, 2, 3, 0.5, 4, 5, 6, 7, -1, 0])
    assert plan == [Waypoint((1.0, 2.0, 3.0), 0.5, 4.0), Waypoint((5.0, 6.0, 7.0), -1.0, 0.0)]
    assert from_flat([]) == []


@pytest.mark.parametrize(
    ('numbers', 'message'),
    [
        ([1, 2, 3], '3 numbers; must be a multiple of 5'),
        ([1, 2, math.nan, 0, 0], 'must be finite'),
        ([1, 2, 3, 0, -1], 'hold at least 0'),
    ],
)
def test_bad_waypoints_are_one_line(numbers: list[float], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        from_flat(numbers)


def test_plan_waits_at_each_waypoint_and_holds_the_last() -> None:
    first, last = Waypoint((0, 0, 1), 0, hold=3.0), Waypoint((2, 0, 1))
    plan = WaypointPlan([first, last])
    assert plan.target(0.0, (0.0, 0.0, 0.0), 0.0) is first  # 1 m away: not there yet
    assert plan.target(5.0, (0.0, 0.0, 0.9), 0.0) is first  # arrived, the hold begins
    assert plan.target(7.9, (0.0, 0.0, 2.0), 0.0) is first  # a gust does not restart it
    assert plan.target(8.0, (0.0, 0.0, 1.0), 0.0) is last
    assert plan.target(99.0, (2.0, 0.0, 1.0), 0.0) is last
    plan.restart()
    assert plan.target(0.0, (0.0, 0.0, 0.0), 0.0) is first


def test_arrival_needs_the_heading_too() -> None:
    plan = WaypointPlan([Waypoint((0, 0, 0), yaw=math.pi), Waypoint((1, 0, 0))])
    assert plan.target(0.0, (0, 0, 0), 0.0).yaw == math.pi
    assert plan.target(1.0, (0, 0, 0), -math.pi + 0.1).position_w == (1, 0, 0)


def test_go_to_leaves_the_plan() -> None:
    plan, other = WaypointPlan([Waypoint((0, 0, 0))]), Waypoint((9, 9, 9))
    plan.go_to(other)
    assert plan.target(0.0, (0, 0, 0), 0.0) is other
    assert WaypointPlan().target(0.0, (0, 0, 0), 0.0) is None


def test_clock_gives_periods_and_sees_a_reset() -> None:
    clock = StampClock()
    assert clock.advance(5.0) == 0.0 and clock.restarted
    assert clock.advance(5.01) == pytest.approx(0.01) and not clock.restarted
    assert clock.advance(5.01) == 0.0 and not clock.restarted
    assert clock.advance(50.0) == LONGEST_PERIOD
    assert clock.advance(0.0) == 0.0 and clock.restarted


@given(st.floats(0, 100), st.floats(0, 2))
def test_wave_stays_within_its_amplitude(time: float, amplitude: float) -> None:
    wave = travelling_wave(5, amplitude=amplitude, frequency=1.3, lag=1.0)
    assert np.abs(wave.angles(time)).max() <= amplitude + 1e-12


def test_wave_starts_at_rest_and_travels_from_head_to_tail() -> None:
    wave = travelling_wave(3, amplitude=0.5, frequency=2.0, lag=0.7, ramp=1.0)
    assert np.abs(wave.angles(0.0)).max() == 0.0
    later = 0.7 / (2 * math.pi * 2.0)  # the next joint does the same this much later
    assert wave.angles(3.0)[0] == pytest.approx(wave.angles(3.0 + later)[1], abs=1e-12)
    assert wave.angles(3.0)[1] == pytest.approx(wave.angles(3.0 + later)[2], abs=1e-12)


def test_wing_meets_the_air_at_its_pitch_in_mid_stroke() -> None:
    beat = wing_beat(stroke=1.0, pitch=0.8, frequency=26.0, ramp=0.0)
    assert beat.angles(0.0) == pytest.approx([0, 0, 0.8, 0.8], abs=1e-12)
    assert beat.angles(0.25 / 26.0) == pytest.approx([1, 1, 0, 0], abs=1e-12)
    assert beat.angles(0.5 / 26.0) == pytest.approx([0, 0, -0.8, -0.8], abs=1e-12)


def test_offsets_move_the_middle_of_the_wave() -> None:
    wave = JointWave(1.0, (0.0,), (0.0,), offsets=(0.3,))
    assert wave.angles(1.7) == [0.3]


@pytest.mark.parametrize(
    'arguments',
    [
        (1.0, (0.1,), ()), (1.0, (0.1,), (0.0,), (0.0, 0.0)), (-1.0, (0.1,), (0.0,)),
        (1.0, (math.nan,), (0.0,)),
    ],
)  # fmt: skip
def test_bad_waves_are_refused(arguments: tuple[object, ...]) -> None:
    with pytest.raises(ConfigError, match='joint wave'):
        JointWave(*arguments)
