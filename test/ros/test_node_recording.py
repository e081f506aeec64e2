# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node records what it published and received, over real DDS."""

import re
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from mcap.reader import make_reader
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import MarkerArray

from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.recorded_flights import events_of
from test.support.ros_processes import NODE, Forked, Peer, node, stamp_ns, wait_until

pytestmark = pytest.mark.ros

VEHICLE = 'bluerov2_heavy'


def read(path):
    """Return the messages (sequence, data) of each topic."""
    found = {}
    with path.open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True)
        for _, channel, message in reader.iter_messages(log_time_order=False):
            found.setdefault(channel.topic, []).append((message.sequence, message.data))
    return found


def test_what_was_published_and_received_is_in_the_log(tmp_path):
    path = tmp_path / 'a.mcap'
    with Peer() as peer:
        odometry = peer.collect(Odometry, f'{VEHICLE}/odom')
        with node(scene='rov', record__path=path, command_timeout=0.3) as process:
            thrust = peer.publisher(Float64MultiArray, f'{VEHICLE}/cmd/thrust')
            command = Float64MultiArray(data=[1.0, -2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0])
            thrust.publish(command)
            peer.call(SetBool, 'fluid_sim_node/enable_wind', data=False)
            wait_until(lambda: odometry, 'the first state')
            end = odometry[-1].header.stamp.sec + 3
            wait_until(lambda: odometry[-1].header.stamp.sec >= end, 'the command to go stale')
            process.signal(signal.SIGINT)
            assert process.wait() == 0
    log = read(path)
    received = log[f'/{VEHICLE}/cmd/thrust']
    assert [deserialize_message(data, Float64MultiArray) for _, data in received] == [command]
    recorded = [deserialize_message(data, Odometry) for _, data in log[f'/{VEHICLE}/odom']]
    by_stamp = {stamp_ns(m): m for m in recorded}
    assert len(odometry) > 200
    for message in odometry:
        assert by_stamp[stamp_ns(message)] == message
    # nobody subscribed to these
    assert len(log[f'/{VEHICLE}/wrench/damping']) == len(log['/clock'])
    assert len(log['/diagnostics']) >= 1
    outcome = resimulate(open_log(path))
    assert outcome.difference is None and outcome.compared > 3000 and outcome.commands == 3
    events = events_of(data for _, data in log['/fluid_sim/events'])
    # in real time either may come first
    assert sorted(events, key=str) == [{'settings': {'enable_wind': False}}, {'stale': VEHICLE}]


def flown_after(states, resets):
    """Return how many states there are behind that many resets, where time goes back."""
    times = [(each.header.stamp.sec, each.header.stamp.nanosec) for each in list(states)]
    backs = [i for i in range(1, len(times)) if times[i] < times[i - 1]]
    return len(times) - backs[resets - 1] if len(backs) >= resets else 0


def test_topics_are_selected_and_a_reset_begins_a_new_log(tmp_path):
    path = tmp_path / 'a.mcap'
    topics = "['*/odom', '/clock']"
    with Peer() as peer, node(scene='sphere', record__path=path, record__topics=topics) as process:
        states = peer.collect(Odometry, 'sphere/odom')
        wait_until(lambda: len(states) > 2, 'states')
        for resets in (1, 2):
            peer.call(Trigger, 'fluid_sim_node/reset')
            # states of before the reset may still be under way behind its answer
            wait_until(lambda n=resets: flown_after(states, n) > 2, 'states after the reset')
        process.signal(signal.SIGINT)
        assert process.wait() == 0
    logs = [read(tmp_path / name) for name in ('a.mcap', 'a_1.mcap', 'a_2.mcap')]
    for log in logs:
        assert set(log) == {'/sphere/odom', '/clock'}
        assert log['/sphere/odom'][0][0] == 0
    assert logs[0]['/sphere/odom'][0] == logs[1]['/sphere/odom'][0]


def test_a_namespace_stands_before_the_recorded_topics(tmp_path):
    path = tmp_path / 'a.mcap'
    arguments = ['--ros-args', '-r', '__ns:=/tank']
    settings = {'scene': 'sphere', 'record.path': path, 'duration': 0.1}
    with Forked(NODE, *arguments, **settings) as process:
        assert process.wait() == 0
    assert {'/tank/sphere/odom', '/clock'} <= set(read(path))


@pytest.mark.parametrize(
    ('parameters', 'line'),
    [
        ({'record__path': '/proc/a.mcap'}, 'record: /proc/a.mcap: No such file or directory'),
        ({'record__topics': "['moon']"}, "'moon' matches no topic; there are: sphere/odom"),
    ],
)
def test_a_wrong_setting_is_one_line(tmp_path, parameters, line):
    given = {'scene': 'sphere', 'record__path': tmp_path / 'a.mcap', **parameters}
    with node(**given) as process:
        assert process.wait() == 2
    assert line in process.output


def test_a_full_disk_is_reported_and_the_node_flies_on(tmp_path):
    path = tmp_path / 'a.mcap'
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene='rov', record__path=path, pacing='free') as process:
            wait_until(lambda: path.exists(), 'the log')
            limit_files(writer_of(process), 1 << 16)
            wait_until(lambda: peer.diagnostics.get('recording', (0,))[0] == 2, 'the report')
            step = int(peer.diagnostics['loop'][2]['step'])
            wait_until(lambda: int(peer.diagnostics['loop'][2]['step']) > step, 'more steps')
            assert 'File too large' in peer.diagnostics['recording'][1]
            process.signal(signal.SIGINT)
            assert process.wait() == 1  # the signal is how it ends; the log is lost all the same
    assert process.output.count('going on without') == 1


@pytest.mark.full
def test_a_folder_that_is_deleted_is_reported_and_told_by_the_exit_code(tmp_path):
    folder = tmp_path / 'logs'
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene='rov', record__path=folder / 'a.mcap', duration=4.0) as process:
            log = folder / 'a.mcap'
            wait_until(lambda: log.exists() and log.stat().st_size > 1000, 'a recording')
            shutil.rmtree(folder)
            wait_until(lambda: peer.diagnostics['recording'][0] == 2, 'the report')
            step = int(peer.diagnostics['loop'][2]['step'])
            wait_until(lambda: int(peer.diagnostics['loop'][2]['step']) > step, 'more steps')
            assert 'its file was deleted' in peer.diagnostics['recording'][1]
            assert process.wait() == 1  # it has ended by itself, at the end of its duration
    assert process.output.count('its file was deleted; going on without') == 1


def test_too_few_file_handles_for_a_node_are_one_line():
    code = (
        'import resource; resource.setrlimit(resource.RLIMIT_NOFILE, (30, 30)); '
        'from fluid_sim_ros.ros.executables import fluid_sim_node; fluid_sim_node()'
    )
    done = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2 and not done.stdout
    assert re.fullmatch(
        r'fluid_sim_node: error: this process may open \d+ more files, and needs 40; '
        r'raise the limit, such as: ulimit -n 1024\n', done.stderr,
    )  # fmt: skip


def writer_of(process):
    """Return the process id of a node's writer."""
    children = f'/proc/{process.pid}/task/{process.pid}/children'
    found = []

    def look():
        for pid in Path(children).read_text().split():
            if b'recording.writing.writer' in Path(f'/proc/{pid}/cmdline').read_bytes():
                found.append(int(pid))
        return bool(found)

    wait_until(look, 'the writer process')
    return found[0]


def limit_files(pid, size):
    """Let a process write files up to a size only, as on a disk that is full."""
    resource.prlimit(pid, resource.RLIMIT_FSIZE, (size, size))


@pytest.mark.parametrize('scene', ['sphere', 'x500'])
def test_equal_messages_have_equal_bytes_with_and_without_ros(tmp_path, scene):
    run_scene(scene, duration=0.5, record=tmp_path / 'a.mcap')
    with node(
        scene=scene, record__path=tmp_path / 'b.mcap', duration=0.5, pacing='free'
    ) as process:
        assert process.wait() == 0
    first, second = read(tmp_path / 'a.mcap'), read(tmp_path / 'b.mcap')
    assert second.pop('/diagnostics')
    assert first == second
    message = deserialize_message(first[f'/{scene}/odom'][-1][1], Odometry)
    assert len(serialize_message(message)) == len(first[f'/{scene}/odom'][-1][1])


def test_markers_are_recorded_as_published_and_a_pattern_takes_them_away(tmp_path):
    with Peer() as peer:
        markers = peer.collect(MarkerArray, f'{VEHICLE}/markers', latched=True)
        with node(scene='rov', record__path=tmp_path / 'a.mcap') as process:
            wait_until(lambda: len(markers) > 4, 'markers')
            process.signal(signal.SIGINT)
            assert process.wait() == 0
    recorded = [
        deserialize_message(data, MarkerArray)
        for _, data in read(tmp_path / 'a.mcap')[f'/{VEHICLE}/markers']
    ]
    by_stamp = {stamp_ns(m.markers[0]): m for m in recorded}
    assert list(by_stamp) == list(range(0, 50_000_000 * len(by_stamp), 50_000_000))
    for message in markers:
        assert by_stamp[stamp_ns(message.markers[0])] == message
    topics = "['!*/markers', '!/diagnostics']"
    path = tmp_path / 'b.mcap'
    with node(scene='rov', record__path=path, record__topics=topics, duration=0.1) as process:
        assert process.wait() == 0
    assert f'/{VEHICLE}/odom' in read(path)
    assert not {f'/{VEHICLE}/markers', '/diagnostics'} & set(read(path))
