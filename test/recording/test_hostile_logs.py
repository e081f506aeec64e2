# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile logs with right checksums: read, or refused in one line, and nothing else touched."""

import os
import random

import pytest

from fluid_sim_ros.recording.reader import open_log
from test.support import log_files as mcap
from test.support.hostile.commands import command_of, judged_log
from test.support.hostile.judge import Outside
from test.support.hostile.logs import Mutator
from test.support.recorded_flights import record_flight

#: Commands that take a second each.
_LONG = ('resimulate', 'plot', 'replay --with', 'render')


@pytest.fixture(scope='module')
def mutator(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=0.3, seed=1)
    return Mutator(open_log(path))


@pytest.fixture
def outside(tmp_path, monkeypatch):
    watched = Outside(tmp_path)
    monkeypatch.chdir(watched.working)
    return watched


def check(mutator, seeds, outside, monkeypatch):
    outcomes = []
    for seed in seeds:
        verdict = judged_log(mutator.log(seed), command_of(seed), outside.working)
        assert verdict.right, (seed, command_of(seed), verdict)
        assert not outside.changed(), seed
        outcomes.append(verdict.outcome)
        monkeypatch.chdir('/')
        outside.clear()
        monkeypatch.chdir(outside.working)
    return outcomes


def test_hostile_logs_are_read_or_refused(mutator, outside, monkeypatch):
    quick = [seed for seed in range(10**6, 10**6 + 50) if command_of(seed) not in _LONG]
    outcomes = check(mutator, quick, outside, monkeypatch)
    assert {'read', 'refused'} == set(outcomes)


def test_hostile_logs_are_flown_again_or_refused(mutator, outside, monkeypatch):
    longer = [seed for seed in range(2 * 10**6, 2 * 10**6 + 100) if command_of(seed) in _LONG]
    check(mutator, longer[:6], outside, monkeypatch)


@pytest.mark.full
@pytest.mark.timeout(7200)
def test_two_thousand_hostile_logs(mutator, outside, monkeypatch):
    check(mutator, range(3 * 10**6, 3 * 10**6 + 2000), outside, monkeypatch)


# ---- crafted ones ------------------------------------------------------------------------------

HEAD = mcap.schema(1, 'std_msgs/msg/Float64', 'float64 data') + mcap.channel(1, 1, '/a')
LINE = '=' * 80
DATA = b'\x00\x01\x00\x00'


def typed(definition, data=DATA + bytes(64), count=1):
    """Return a log with messages of a definition."""
    head = mcap.schema(1, 'a_msgs/msg/A', definition) + mcap.channel(1, 1, '/a')
    return mcap.log_of([mcap.chunk(head + mcap.message(1, 0, 0, data) * count)])


def nested(levels):
    """Return a definition of messages within messages."""
    types = ''.join(f'\n{LINE}\nMSG: a/N{i}\nN{i + 1} n\n' for i in range(levels))
    return f'N0 n{types}\n{LINE}\nMSG: a/N{levels}\nfloat64 x'


def uneven(count):
    """Return a log with one long array, and many short ones."""
    head = mcap.schema(1, 'a_msgs/msg/A', 'float64[] x') + mcap.channel(1, 1, '/a')
    sizes = [9000] + [2] * count
    messages = b''.join(
        mcap.message(1, i, 0, DATA + size.to_bytes(4, 'little') + bytes(4 + 8 * size))
        for i, size in enumerate(sizes)
    )  # fmt: skip
    return mcap.log_of([mcap.chunk(head + messages)])


CRAFTED = {
    'a bomb of zeros': (mcap.log_of([mcap.chunk(bytes(1 << 28))]), 'log_chunk_bytes'),
    'a bomb of chunks': (mcap.log_of([mcap.chunk(HEAD + bytes(1 << 25))] * 90), 'expansion'),
    'a bomb of messages': (
        mcap.log_of([mcap.chunk(HEAD + mcap.message(1, 0, 0, b'') * 10**6)] * 2), 'expansion'
    ),
    'a long fixed array': (typed('float64[2000000000] x'), 'shorter than its definition'),
    'a long array of nothing': (typed(f'E[2000000000] e\n{LINE}\nMSG: a/E\n'), 'log_columns'),
    'arrays of arrays of nothing': (
        typed(f'A[30000] a\n{LINE}\nMSG: a/A\nE[30000] e\n{LINE}\nMSG: a/E\n'), 'log_columns'
    ),
    'a sequence that says it is long': (typed('uint8[] x', DATA + b'\xff' * 40), 'shorter than'),
    'a text that says it is long': (typed('string x', DATA + b'\xff' * 40), 'shorter than'),
    'many columns': (typed('uint8[50000] x', DATA + bytes(50000)), 'log_columns'),
    'a table much larger than its messages': (uneven(3000), 'log_table_bytes'),
    'a hundred levels': (typed(nested(100)), 'log_depth'),
    'a type within itself': (typed(f'A a\n{LINE}\nMSG: a/A\nA a'), 'log_depth'),
    'a type that is not there': (typed('Nothing n'), "lacks the type 'Nothing'"),
    'a length of many digits': (typed(f'float64[{"9" * 5000}] x'), 'cannot be read'),
    'a long name': (typed('float64 ' + 'n' * 100_000), 'log_columns'),
    'a long definition': (typed('# ' + 'c' * 1_100_000), 'log_definition_bytes'),
    'fields of one name': (typed('string a\nfloat64 a', DATA + bytes(40)), ''),
    'big-endian': (typed('float64 x', b'\x00\x00\x00\x00' + bytes(8)), 'not plain little-endian'),
    'no data': (typed('float64 x', b''), 'not plain little-endian'),
    'a message without a head': (
        mcap.log_of([mcap.chunk(HEAD + mcap.record(mcap.MESSAGE, b'12'))]), 'too short'
    ),
    'a record beyond its chunk': (
        mcap.log_of([mcap.chunk(HEAD + mcap.MESSAGE.to_bytes(1, 'little') + b'\xff' * 8)]),
        'too long',
    ),
    'half a record': (mcap.log_of([mcap.chunk(HEAD + mcap.message(1, 0, 0, b'')[:5])]), 'is cut'),
    'a schema that is cut': (mcap.log_of([mcap.chunk(mcap.record(3, b'\x01'))]), 'longer than'),
    'a channel of two minds': (
        mcap.log_of([mcap.chunk(HEAD), mcap.chunk(HEAD + mcap.channel(1, 1, '/b'))]),
        'channel 1 is another than before',
    ),
    'lz4': (mcap.log_of([mcap.chunk(HEAD, 'lz4')]), "compression 'lz4' is not known"),
    'an unprintable compression': (mcap.log_of([mcap.chunk(HEAD, '\x1b[2J')]), r"'\x1b[2J'"),
    'two attachments of one name': (
        mcap.log_of([mcap.attachment('a', b'1'), mcap.attachment('a', b'2')]), 'another attachment'
    ),
    'unknown records': (mcap.log_of([mcap.record(77, b'')] * 100_000), 'and 99900 more faults'),
    'an index that names all chunks': (
        mcap.log_of([mcap.chunk(HEAD)], mcap.record(8, bytes(16) + b'\x08' + bytes(23)) * 1000), ''
    ),
    'steps that take a day': (
        mcap.log_of([mcap.chunk(HEAD + mcap.message(1, 4_000_000_000, 0, DATA + bytes(8)))]), ''
    ),
}  # fmt: skip


@pytest.mark.parametrize('name', CRAFTED)
def test_crafted_logs(name, outside):
    content, words = CRAFTED[name]
    lines = []
    for command in ('info', 'export --csv', 'repair', 'scene'):
        verdict = judged_log(content, command, outside.working)
        assert verdict.right, (command, verdict)
        lines.append(verdict.line)
        if command == 'info' and verdict.outcome == 'read':
            lines += open_log(outside.working / 'a.mcap').faults
        (outside.working / 'a.mcap').unlink()
    assert not words or any(words in line for line in lines), lines


def test_a_pipe_is_no_log(tmp_path):
    os.mkfifo(tmp_path / 'a.mcap')
    for path in (tmp_path / 'a.mcap', tmp_path):
        with pytest.raises(Exception, match='not a regular file'):
            open_log(path)


def test_a_log_that_becomes_shorter_while_it_is_read(mutator, tmp_path):
    path = tmp_path / 'a.mcap'
    path.write_bytes(mutator.log(1))
    log = open_log(path)
    path.write_bytes(path.read_bytes()[: random.Random(0).randrange(2000)])
    with pytest.raises(Exception, match='chunk at byte'):
        list(log.messages())
