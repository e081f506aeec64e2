# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Our reader agrees with independent ones, and no damage makes it crash or read a wrong value."""

import json
import os
import random
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from fluid_sim_ros.cli.main import WRONG_INPUT, main
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.recording.decode import columns, fields
from fluid_sim_ros.recording.inspect import info, repair
from fluid_sim_ros.recording.reader import MAGIC, open_log
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def flight(tmp_path_factory):
    """Return the path of a short piloted flight."""
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=1.0, seed=1)
    return path


@pytest.fixture(scope='module')
def chunked(flight, tmp_path_factory):
    """Return the content of a flight in many small chunks, and its messages."""
    path = tmp_path_factory.mktemp('log') / 'chunked.mcap'
    repair(flight, path, chunk_size=1 << 14)
    log = open_log(path)
    assert len(log.chunks) > 10 and log.complete and not log.faults
    return path.read_bytes(), list(log.messages())


def test_equal_to_the_reader_of_the_mcap_project(flight):
    ours = [(m.topic, m.step, m.log_ns, m.publish_ns, m.data) for m in open_log(flight).messages()]
    with flight.open('rb') as stream:
        theirs = [
            (channel.topic, m.sequence, m.log_time, m.publish_time, m.data)
            for _, channel, m in make_reader(stream, validate_crcs=True).iter_messages(
                log_time_order=False
            )
        ]
    assert len(ours) > 1500
    assert ours == theirs


def test_columns_are_the_fields_of_each_message(flight):
    log = open_log(flight)
    for topic in log.topics.values():
        data = [m.data for m in log.messages([topic.name])]
        if not data:
            continue
        table = columns(topic.definition, data)
        for i in (0, len(data) // 2, len(data) - 1):
            single = fields(topic.definition, data[i])
            assert {name: values[i] for name, values in table.items()} == single


def test_columns_of_messages_of_changing_length():
    text = 'float64[] values\nstring name\n'

    def message(values, name):
        head = b'\x00\x01\x00\x00' + len(values).to_bytes(4, 'little')
        body = b'\x00' * 4 * bool(values) + np.array(values, '<f8').tobytes()
        return head + body + (len(name) + 1).to_bytes(4, 'little') + name.encode() + b'\x00'

    table = columns(text, [message([1.0, 2.0], 'a'), message([3.0], 'bc'), message([], 'a')])
    np.testing.assert_array_equal(table['values[0]'], [1.0, 3.0, np.nan])
    np.testing.assert_array_equal(table['values[1]'], [2.0, np.nan, np.nan])
    assert table['name'].tolist() == ['a', 'bc', 'a']


# ---- damage ----------------------------------------------------------------------------------


def check_cut(path, content, messages, size):
    """Check what is read of a log's first bytes: the first messages, and a fault."""
    path.write_bytes(content[:size])
    if size < len(MAGIC):
        with pytest.raises(LogError, match=r'the file is empty|not an MCAP file'):
            open_log(path)
        return 0
    log = open_log(path)
    assert log.faults and not log.complete
    found = list(log.messages())
    assert found == messages[: len(found)]
    return len(found)


def check_cuts(path, chunked, sizes):
    content, messages = chunked
    found = [check_cut(path, content, messages, size) for size in sizes]
    assert found == sorted(found)
    return found


def test_a_truncated_log_is_read_up_to_its_last_whole_chunk(tmp_path, chunked):
    content, messages = chunked
    sizes = sorted(random.Random(0).sample(range(len(content)), 200))
    found = check_cuts(tmp_path / 'cut.mcap', chunked, [*range(40), *sizes, len(content) - 1])
    assert found[-1] == len(messages) and len(set(found)) > 10


@pytest.mark.full
def test_ten_thousand_truncations(tmp_path, chunked):
    size = len(chunked[0])
    check_cuts(tmp_path / 'cut.mcap', chunked, sorted(random.Random(1).sample(range(size), 10000)))


def check_corruption(path, chunked, random_):
    """Damage a few bytes; what is still read must be right, what is missing must be said."""
    content, messages = bytearray(chunked[0]), chunked[1]
    for _ in range(random_.choice((1, 1, 4))):
        at, length = random_.randrange(len(content)), random_.choice((1, 1, 8, 512))
        for i in range(at, min(at + length, len(content))):
            content[i] ^= random_.randrange(1, 256)
    path.write_bytes(content)
    try:
        log = open_log(path)
    except LogError:
        assert content[: len(MAGIC)] != MAGIC
        return
    found = list(log.messages())
    remaining = iter(messages)
    assert all(message in remaining for message in found)  # in order, none changed
    assert log.faults
    for name, data in log.attachments.items():
        assert data in chunked[0], name


def test_damage_is_found_and_never_read_as_a_value(tmp_path, chunked):
    random_ = random.Random(0)
    for _ in range(100):
        check_corruption(tmp_path / 'bad.mcap', chunked, random_)


@pytest.mark.full
def test_a_thousand_corruptions(tmp_path, chunked):
    random_ = random.Random(2)
    for _ in range(1000):
        check_corruption(tmp_path / 'bad.mcap', chunked, random_)


def test_one_damaged_chunk_costs_that_chunk_only(tmp_path, chunked):
    content, messages = chunked
    path = tmp_path / 'bad.mcap'
    path.write_bytes(content)
    chunk = open_log(path).chunks[4]

    def damaged(at):
        bad = bytearray(content)
        bad[at] ^= 0x55
        path.write_bytes(bad)
        log = open_log(path)
        assert log.faults
        return len(list(log.messages()))

    inside = damaged(chunk.offset + chunk.size // 2)
    assert 0.8 * len(messages) < inside < len(messages)
    # the length of its record: the index at the end of the file says where to go on
    assert damaged(chunk.offset - 50) == len(messages)


def test_a_repaired_log_is_sound(tmp_path, chunked):
    content, messages = chunked
    cut, whole = tmp_path / 'cut.mcap', tmp_path / 'whole.mcap'
    cut.write_bytes(content[: len(content) // 2])
    result = repair(cut, whole)
    log = open_log(whole)
    assert log.complete and not log.faults and result['lost']
    assert list(log.messages()) == messages[: result['messages']]
    assert log.description() == open_log(cut).description()
    with pytest.raises(LogError, match='File exists'):
        repair(cut, whole)


@pytest.mark.parametrize(('content', 'line'), [(b'', 'is empty'), (b'x' * 99, 'not an MCAP')])
def test_what_is_no_log_is_one_line(tmp_path, capsys, content, line):
    path = tmp_path / 'a.mcap'
    path.write_bytes(content)
    assert main(['info', str(path)]) == WRONG_INPUT
    assert line in capsys.readouterr().err


def test_info_counts_and_says_what_is_missing(flight, tmp_path, capsys):
    assert main(['info', str(flight), '--json', '-']) == 0
    result = json.loads(capsys.readouterr().out)
    assert result['run']['scene'] == 'quadrotor' and result['complete']
    assert result['topics']['/x500/odom'] == {
        'type': 'nav_msgs/msg/Odometry', 'messages': 101, 'rate_hz': 100.0
    }  # fmt: skip
    cut = tmp_path / 'cut.mcap'
    cut.write_bytes(flight.read_bytes()[:-100])
    assert main(['info', str(cut)]) == 1
    assert 'missing' in ' '.join(capsys.readouterr().out.split())
    assert info(cut)['messages'] == result['messages']


# ---- kill -9 ---------------------------------------------------------------------------------

FLIGHT = textwrap.dedent("""
    import sys, time
    from pathlib import Path
    from fluid_sim_ros import Simulation
    from fluid_sim_ros.loop.pacing import RealTime
    from fluid_sim_ros.recording.sink import RecordingSink
    from fluid_sim_ros.loop.runner import NoSource, Runner
    simulation = Simulation('sphere')
    sink = RecordingSink(simulation, Path(sys.argv[1]))
    print(sink.recorder.writer.pid, flush=True)
    class Clock:
        period = sink.period
        def write(self, simulation):
            print(simulation.step_count, flush=True)
    Runner(simulation, NoSource(), [sink, Clock()], RealTime(tick=sink.period)).run()
""")


@pytest.mark.parametrize('victim', ['simulation', 'both'])
def test_kill_9_costs_the_last_second_at_most(tmp_path, victim):
    path = tmp_path / 'a.mcap'
    with (tmp_path / 'stderr').open('w') as stderr:
        process = subprocess.Popen(
            [sys.executable, '-c', FLIGHT, str(path)],
            stdout=subprocess.PIPE, stderr=stderr, text=True,
        )  # fmt: skip
    writer = int(process.stdout.readline())
    for line in process.stdout:
        if int(line) > 2.2 / 0.002:  # some seconds of flight at the clock's pace
            break
    if victim == 'both':
        os.kill(writer, signal.SIGKILL)
    process.kill()
    last = max([int(line), *map(int, process.stdout.read().split())])
    process.wait()
    while Path(f'/proc/{writer}').exists():  # it ends the file, or was killed
        os.sched_yield()
    log = open_log(path)
    steps = [m.step for m in log.messages(['/sphere/odom'])]
    assert steps == list(range(0, steps[-1] + 1, 5))
    assert (last - steps[-1]) * 0.002 < (1.1 if victim == 'both' else 0.1)
    assert log.complete == (victim == 'simulation')
    assert not (tmp_path / 'stderr').read_text()  # the writer has nothing to complain of
