# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A flood of faults is one line per second, with a count."""

import time
from pathlib import Path

import pytest
from geometry_msgs.msg import PoseStamped

import fluid_sim_ros
from fluid_sim_ros.output import throttled_log
from fluid_sim_ros.output.throttled_log import ThrottledLog
from test.support.ros_processes import Peer, controller, wait_until


def test_a_flood_is_one_line_a_second_with_a_count(monkeypatch):
    now, lines = [100.0], []
    monkeypatch.setattr(throttled_log.time, 'monotonic', lambda: now[0])
    log = ThrottledLog(lines.append)
    for _ in range(1000):
        log('a', 'a: rejected')
    log('b', 'b: rejected')
    now[0] += 1.0
    log('a', 'a: rejected')
    now[0] += 1.0
    log('a', 'a: rejected')
    assert lines == [
        'a: rejected', 'b: rejected', 'a: rejected (999 more like it before)', 'a: rejected'
    ]  # fmt: skip


def test_the_end_of_a_flood_is_counted_too(monkeypatch):
    now, lines = [100.0], []
    monkeypatch.setattr(throttled_log.time, 'monotonic', lambda: now[0])
    log = ThrottledLog(lines.append)
    for i in range(1000):
        log('a', f'a {i}: rejected')
    log.flush()
    assert lines == ['a 0: rejected']
    now[0] += 1.0
    log.flush()
    log.flush()
    assert lines == ['a 0: rejected', 'a 999: rejected (998 more like it before)']


def test_there_is_one_throttle():
    """That of rclpy counts nothing."""
    package = Path(fluid_sim_ros.__file__).parent
    assert not [
        path for path in package.rglob('*.py') if 'throttle_duration' in path.read_text('utf-8')
    ]  # fmt: skip


@pytest.mark.ros
@pytest.mark.full
def test_a_flood_of_wrong_waypoints_is_a_line_a_second_with_a_count():
    with Peer() as peer, controller('quad') as process:
        waypoints = peer.publisher(PoseStamped, 'x500/cmd/waypoint')
        wrong = PoseStamped()
        wrong.header.frame_id = 'moon'
        begin = time.monotonic()
        while (spent := time.monotonic() - begin) < 2.0:
            waypoints.publish(wrong)
            time.sleep(0.005)
        wait_until(lambda: 'more like it before' in process.output, 'a count')
        said = [line for line in process.lines if 'waypoint rejected' in line]
        assert 2 <= len(said) <= spent + 3
