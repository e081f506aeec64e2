# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The example controllers fly the simulator over real topics, in every pacing."""

import math
import signal

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from test.support.ros_processes import (
    Peer,
    controller,
    error_lines,
    node,
    place_of,
    reach,
    stamp_ns,
    wait_until,
)

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


@pytest.mark.parametrize('first', ['node', 'controller'])
def test_lockstep_pair_flies_to_a_waypoint_whoever_starts_first(first):
    start = {
        'node': lambda: node(scene='quadrotor', pacing='lockstep', enable_wind=False),
        'controller': lambda: controller('quad', waypoints='[1.0, 0.5, 2.0, 0.5, 0.0]'),
    }
    second = ({*start} - {first}).pop()
    with Peer() as peer:
        states = peer.collect(Odometry, 'x500/odom', depth=5000)
        with start[first]() as one, start[second]() as two:
            there = reach(states, 8.0)
            for process in (one, two):
                process.signal(signal.SIGTERM)
                assert process.wait() == 0
    assert there == pytest.approx([1.0, 0.5, 2.0, 0.5], abs=0.03)


def test_free_pacing_is_answered_in_order():
    with Peer() as peer:
        answers = peer.collect(JointState, 'x500/cmd/thrust_stamped', depth=5000)
        with controller('quad') as pilot:
            with node(scene='quadrotor', pacing='free') as simulator:
                wait_until(lambda: len(answers) > 200, 'two hundred answers')
            assert error_lines(simulator.output + pilot.output) == []
    stamps = np.array([stamp_ns(a) for a in answers])
    assert (np.diff(stamps) > 0).all()
    assert np.isfinite([list(a.effort) for a in answers]).all()


@pytest.mark.full  # slow
def test_realtime_pair_holds_its_place_through_a_reset():
    plan = '[0.0, 0.0, 1.5, 0.0, 0.0]'
    with Peer() as peer:
        states = peer.collect(Odometry, 'x500/odom')
        with node(scene='quadrotor', realtime__factor=2.0, enable_wind=False) as simulator:
            with controller('quad', waypoints=plan) as pilot:
                before = reach(states, 8.0)
                assert peer.call(Trigger, '/fluid_sim_node/reset').success
                wait_until(lambda: 'time went back' in pilot.output, 'the reset')
                wait_until(lambda: stamp_ns(states[-1]) < 5e9, 'the time after it')
                after = reach(states, 6.0)
            assert error_lines(simulator.output) == []
    assert before == pytest.approx([0.0, 0.0, 1.5, 0.0], abs=0.05)
    assert after == pytest.approx([0.0, 0.0, 1.5, 0.0], abs=0.05)


def test_lockstep_rov_dives_and_turns():
    with Peer() as peer:
        states = peer.collect(Odometry, 'bluerov2_heavy/odom', depth=5000)
        pilot = controller('rov', depth=6.0, heading=1.0)
        with pilot, node(scene='rov', pacing='lockstep', enable_wind=False):
            there = reach(states, 12.0)
    assert there[2:] == pytest.approx([-6.0, 1.0], abs=0.01)


@pytest.mark.full  # slow
def test_lockstep_auv_dives_and_heads_for_its_waypoints_by_thrust_and_fins():
    plan = '[8.0, 0.0, -5.0, 3.0, 0.0, 150.0, -75.0, -6.0, 0.0, 0.0]'  # passes the first at once
    with Peer() as peer:
        states = peer.collect(Odometry, 'remus100/odom', depth=5000)
        pilot = controller('auv', waypoints=plan, depth=2.0, heading=2.0)  # a plan comes first
        with pilot, node(scene='remus100', pacing='lockstep') as simulator:
            x, y, z, yaw = reach(states, 18.0)
        assert error_lines(simulator.output + pilot.output) == []
    assert math.hypot(x, y) > 20
    assert yaw == pytest.approx(math.atan2(-75 - y, 150 - x), abs=0.03)
    assert z == pytest.approx(-6.0, abs=0.3)  # still settling


def fly_in_wind(seconds, **parameters):
    """Return rows of position and heading in lockstep, 100 Hz, and what both processes printed."""
    with Peer() as peer:
        states = peer.collect(Odometry, 'aerosonde/odom', depth=10000)
        with node(scene='aerosonde', pacing='lockstep', duration=seconds) as simulator:
            wait_until(lambda: states, 'the first state, which waits for its answer')
            with controller('plane', **parameters) as pilot:
                assert simulator.wait() == 0
        output = simulator.output + pilot.output
    by_stamp = {stamp_ns(m): m for m in states}
    rows = [place_of(by_stamp[stamp]) for stamp in sorted(by_stamp)]
    assert len(rows) >= 100 * seconds
    return np.array(rows[: round(100 * seconds)]), output


@pytest.mark.full  # slow
def test_lockstep_plane_holds_altitude_and_heading_in_wind_and_a_gust():
    rows, output = fly_in_wind(20.0, altitude=102.0, heading=0.2)  # wind at 5 s, gust at 10 s
    assert error_lines(output) == []
    windy, gust, after = rows[900:1000], rows[1000:1300], rows[1950:]
    for calm, turned in ((windy, 0.06), (after, 0.01)):  # 4 s after the wind, 7 s after the gust
        assert calm[:, 2] == pytest.approx(102.0, abs=0.5)
        assert calm[:, 3] == pytest.approx(0.2, abs=turned)
    assert np.abs(rows[500:, 2] - 102.0).max() < 5.0
    assert gust[:, 2].max() > 102.5  # it did lift


@pytest.mark.full  # slow; test_lockstep.py compares two runs in `make test`
def test_lockstep_plane_flies_waypoints_the_same_way_twice():
    plan = '[60.0, 2.0, 100.5, 0.0, 0.0, 120.0, 10.0, 101.0, 0.3, 0.0]'
    first, _ = fly_in_wind(10.0, waypoints=plan)
    second, _ = fly_in_wind(10.0, waypoints=plan)
    np.testing.assert_array_equal(first, second)
    along, left = np.cos(0.3), np.sin(0.3)
    distance = along * (first[:, 1] - 10) - left * (first[:, 0] - 120)
    assert np.abs(distance[-50:]).max() < 5.0
    assert first[-1, 2] == pytest.approx(101.0, abs=0.5)
