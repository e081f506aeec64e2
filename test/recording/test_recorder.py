# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is handed over is what stands in the file, read by the reader of the mcap project."""

import json
import os
import resource
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.recorder_port import RecordedTopic, RecorderOptions, selected
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.recorder import Recorder
from fluid_sim_ros.recording.sink import RecordingSink
from fluid_sim_ros.recording.writing.rosbag2 import recorded_topic
from test.support.recorded_flights import events_of, record_flight

TOPIC = RecordedTopic('/a', 'std_msgs/msg/String')


def read(path):
    """Return (channel topic, sequence, log time, data) in file order, and the summary."""
    with path.open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True)
        found = [
            (channel.topic, message.sequence, message.log_time, message.data)
            for _, channel, message in reader.iter_messages(log_time_order=False)
        ]
        return found, reader.get_summary()


def test_the_states_are_those_of_the_simulation(tmp_path):
    path = tmp_path / 'a.mcap'
    record_flight(path, 'rov', seconds=0.2, piloted=False)
    messages, summary = read(path)
    simulation = Simulation('rov')
    states = StateTopics(simulation, DEFAULTS)
    fixed = [topic for topic in states.topics if topic.once]
    expected = [(f'/{t.name.lstrip("/")}', 0, 0, t.data()) for t in fixed]
    for step in range(0, 105, 5):  # every 10 ms; no topic is due in between
        simulation.step(step - simulation.step_count)
        states.take_state()
        expected += [
            (f'/{t.name.lstrip("/")}', step, simulation.time_ns, states.data(t))
            for t in states.topics
            if step % t.period == 0 and not (t.new_name or t.once)
        ]
    assert all(topic.period % 5 == 0 for topic in states.topics)
    assert messages == expected
    assert summary.statistics.message_count == len(expected)
    assert summary.statistics.attachment_count == len(summary.attachment_indexes) >= 3


def test_channels_carry_definition_hash_and_quality(tmp_path):
    path = tmp_path / 'a.mcap'
    record_flight(path, 'sphere', seconds=0.05, piloted=False)
    _, summary = read(path)
    for channel in summary.channels.values():
        schema = summary.schemas[channel.schema_id]
        known = definition(schema.name)
        assert (schema.encoding, schema.data.decode()) == ('ros2msg', known.text)
        assert channel.metadata['topic_type_hash'] == known.hash
        assert 'reliability: reliable' in channel.metadata['offered_qos_profiles']
    names = {channel.topic for channel in summary.channels.values()}
    assert {'/clock', '/sphere/odom', '/wind', '/fluid_sim/events'} <= names


def test_two_recordings_differ_in_wall_time_only(tmp_path):
    paths = [tmp_path / 'a.mcap', tmp_path / 'b.mcap']
    for path in paths:
        record_flight(path, seconds=0.3, seed=4)
    first, second = (read(path)[0] for path in paths)
    assert first == second


def test_an_existing_file_is_not_overwritten(tmp_path):
    path = tmp_path / 'a.mcap'
    path.write_bytes(b'precious')
    with pytest.raises(ConfigError, match='exists already'):
        RecordingSink(Simulation('sphere'), path)
    assert path.read_bytes() == b'precious'


def test_an_unknown_topic_is_named(tmp_path):
    with pytest.raises(ConfigError, match="'x/\\*' matches no topic; there are: sphere/odom"):
        RecordingSink(Simulation('sphere'), tmp_path / 'a.mcap', topics=['x/*'])


def test_a_reset_begins_a_new_file(tmp_path):
    path = tmp_path / 'a.mcap'
    simulation = Simulation('sphere')
    sink = RecordingSink(simulation, path)
    for _ in range(2):
        sink.write(simulation)
        simulation.step(sink.period)
        sink.write(simulation)
        simulation.reset()
        sink.next_segment()
    sink.close()
    assert [p.name for p in sink.recorder.paths] == ['a.mcap', 'a_1.mcap', 'a_2.mcap']
    first, second, third = (read(p)[0] for p in sink.recorder.paths)
    assert first == second and len(first) > 10
    assert third == []


def fill(recorder, simulation, count, size):
    for i in range(count):
        recorder.tick([(0, bytes([i % 256]) * size)])
        simulation.step(1)


@pytest.mark.parametrize('policy', ['block', 'drop'])
def test_a_full_queue_blocks_or_drops_and_says_so(tmp_path, policy):
    simulation = Simulation('sphere')
    path = tmp_path / 'a.mcap'
    options = RecorderOptions(path, policy=policy, queue_mib=0.25)
    recorder = Recorder(simulation, [TOPIC], options)
    os.kill(recorder.writer.pid, signal.SIGSTOP)  # SIGSTOP: the writer stands still
    fill(recorder, simulation, 8, 1 << 18) if policy == 'drop' else None
    os.kill(recorder.writer.pid, signal.SIGCONT)
    fill(recorder, simulation, 40, 1 << 18)
    while recorder.dropped and recorder.writer.queued:  # the writer catches up
        recorder.flush(now=True)
    recorder.tick([(0, b'last')])
    recorder.close()
    messages, _ = read(path)
    states = [m for m in messages if m[0] == '/a']
    count = 41 if policy == 'block' else 49
    assert len(states) + recorder.dropped == count
    assert recorder.written == len(messages)
    reported = sum(e['dropped'] for e in events_of(m[3] for m in messages if m[0] != '/a'))
    assert reported == recorder.dropped
    assert (recorder.dropped > 0) == (policy == 'drop')


FULL_DISK = textwrap.dedent("""
    import resource, sys
    from pathlib import Path
    from fluid_sim_ros import Simulation
    from fluid_sim_ros.loop.recorder_port import RecordedTopic, RecorderOptions
    from fluid_sim_ros.recording.recorder import Recorder
    import random
    resource.setrlimit(resource.RLIMIT_FSIZE, (3 << 20, 3 << 20))
    simulation = Simulation('sphere')
    topic = RecordedTopic('/a', 'std_msgs/msg/String')
    recorder = Recorder(simulation, [topic], RecorderOptions(Path(sys.argv[1])))
    noise = random.Random(0)
    for _ in range(600):
        recorder.tick([(0, noise.randbytes(1 << 14))])
        simulation.step(1)
    recorder.close()
    print(recorder.fault)
    print(simulation.step_count)
""")


def test_a_command_whose_disk_is_full_shows_its_result_and_the_fault(tmp_path):
    path, most = tmp_path / 'a.mcap', 60_000
    done = subprocess.run(
        [Path(sys.executable).with_name('fluid_sim'), 'run', 'rov', '--duration', '5', '--record',
         path, '--json', '-'],
        capture_output=True, text=True, check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
    )  # fmt: skip
    assert done.returncode == 2
    result = json.loads(done.stdout)
    assert result['duration_s'] == 5.0
    assert result['record_fault'] == f'recording to {path} stopped: File too large'
    assert result['record_fault'] in done.stderr


def test_a_full_disk_ends_the_recording_and_not_the_run(tmp_path):
    path = tmp_path / 'a.mcap'
    done = subprocess.run(
        [sys.executable, '-c', FULL_DISK, str(path)], capture_output=True, text=True, check=True
    )
    fault, steps = done.stdout.splitlines()
    assert fault == f'recording to {path} stopped: File too large'
    assert steps == '600'
    assert (1 << 20) < path.stat().st_size <= (3 << 20)


def test_memory_and_files_are_given_back(tmp_path):
    def handles():
        return len(list(Path('/proc/self/fd').iterdir()))

    simulation = Simulation('sphere')
    before, peak = handles(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for i in range(3):
        recorder = Recorder(simulation, [TOPIC], RecorderOptions(tmp_path / f'{i}.mcap'))
        for _ in range(200):
            recorder.tick([(0, np.random.default_rng(i).bytes(1 << 16))])
        recorder.close()
    assert handles() == before
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak < 64 * 1024  # [KiB]


@pytest.mark.parametrize(
    ('patterns', 'chosen'),
    [
        (['*'], {'a/x', 'a/y', 'b/x'}),
        (['a/*', '!*/y'], {'a/x'}),
        (['!*/x'], {'a/y'}),
        (['!*', 'b/x'], {'b/x'}),
        ([], set()),
    ],
)
def test_patterns_add_and_take_away_in_their_order(patterns, chosen):
    assert selected(['a/x', 'a/y', 'b/x'], patterns) == chosen


def test_a_log_without_states_is_whole(tmp_path):
    run_scene('quadrotor', duration=0.1, record=tmp_path / 'a.mcap', record_topics=['!*'])
    log = open_log(tmp_path / 'a.mcap')
    assert log.complete and not log.faults and not list(log.messages())
    assert '/x500/cmd/thrust' in {topic.name for topic in log.topics.values()}


def test_a_replay_offers_the_recorded_quality_of_service(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'x500', seconds=0.1)
    offered = {
        t.name: recorded_topic(t.name, t.type, t.metadata)
        for t in open_log(tmp_path / 'a.mcap').topics.values()
    }
    assert offered['/x500/markers'].transient_local and offered['/x500/markers'].reliable
    assert not offered['/x500/imu/data_raw'].reliable
    assert offered['/x500/odom'].reliable and not offered['/x500/odom'].transient_local
    assert recorded_topic('a', 'b', {}).reliable
    old = {'offered_qos_profiles': '- {reliability: 2, durability: 1}'}
    assert not recorded_topic('a', 'b', old).reliable
    assert recorded_topic('a', 'b', {'offered_qos_profiles': '['}).reliable
