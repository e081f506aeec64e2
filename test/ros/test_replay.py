# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log published again, over real DDS."""

import signal

import pytest
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from std_srvs.srv import SetBool, Trigger

from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight
from test.support.ros_processes import Forked, Peer, stamp_ns, wait_until

pytestmark = pytest.mark.ros


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'sphere', seconds=1.0, piloted=False)
    return path


def replay(log, *options):
    return Forked('fluid_sim_ros.cli', 'replay', str(log), *options)


def play_when_heard(peer, *lists):
    """Step a paused replay until every list has a message (discovery takes a while), then play."""

    def step_arrives():
        return peer.call(Trigger, 'fluid_sim_replay/step').success and all(lists)

    wait_until(step_arrives, 'the first messages')
    peer.call(SetBool, 'fluid_sim_replay/pause', data=False)


def test_the_recorded_messages_are_published_in_step_with_the_clock(log):
    with Peer() as peer:
        odometry = peer.collect(Odometry, '/sphere/odom')
        clocks = peer.collect(Clock, '/clock')
        options = ('--paused', '--from', '0.2', '--to', '0.6', '--rate', '0.5')
        with replay(log, *options) as process:
            play_when_heard(peer, odometry, clocks)
            assert process.wait() == 0
    stamps = [stamp_ns(m) for m in odometry]
    # discovery may cost the first few
    assert stamps[-1] == 600_000_000 and stamps[0] >= 200_000_000 and len(stamps) > 20
    assert stamps == list(range(stamps[0], 600_000_001, 10_000_000))
    assert {stamp_ns(m) for m in clocks} <= set(range(200_000_000, 600_000_001, 10_000_000))
    assert len(clocks) > 20


def test_without_a_recorded_clock_one_is_made(log):
    with Peer() as peer:
        clocks = peer.collect(Clock, '/clock')
        with replay(log, '--paused', '--topics', '/sphere/odom') as process:
            play_when_heard(peer, clocks)
            assert process.wait() == 0
    assert stamp_ns(clocks[-1]) == 1_000_000_000


def test_pause_step_and_loop(log):
    with Peer() as peer:
        odometry = peer.collect(Odometry, '/sphere/odom')
        with replay(log, '--paused', '--loop', '--rate', '20') as process:
            for count in (1, 2, 3):
                assert peer.call(Trigger, 'fluid_sim_replay/step').success
                wait_until(lambda n=count: len(odometry) >= n, 'a step')
                assert len(odometry) == count
            peer.call(SetBool, 'fluid_sim_replay/pause', data=False)
            assert not peer.call(Trigger, 'fluid_sim_replay/step').success
            wait_until(lambda: [stamp_ns(m) for m in odometry].count(0) >= 2, 'the second round')
            process.signal(signal.SIGINT)
            assert process.wait() == 0


def test_a_replay_is_recorded_bytes(log):
    recorded = {m.data for m in open_log(log).messages(['/sphere/odom'])}
    with Peer() as peer:
        received = []
        peer.node.create_subscription(Odometry, '/sphere/odom', received.append, 1000, raw=True)
        with replay(log, '--paused', '--rate', '2') as process:
            play_when_heard(peer, received)
            assert process.wait() == 0
    assert len(received) > 50 and set(received) <= recorded


def test_a_wrong_rate_is_one_line(log):
    with replay(log, '--rate', '0') as process:
        assert process.wait() == 2
    (line,) = process.output.splitlines()
    assert line.startswith('fluid_sim replay: error: argument --rate: must be above 0')
