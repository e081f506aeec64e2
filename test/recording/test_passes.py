# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Passes over a log: as few as memory allows, and whoever waits for one sees how far it is."""

import sys
from pathlib import Path

import pytest

from fluid_sim_ros.cli import logs, replay
from fluid_sim_ros.cli.main import main
from fluid_sim_ros.recording import export
from fluid_sim_ros.recording.reader import open_log
from test.support import log_files as mcap
from test.support.recorded_flights import record_flight
from test.support.terminal import shown_in_a_terminal


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'sphere', seconds=0.3, piloted=False)
    return path


class Told(list):
    """Takes what is told of passes."""

    def __call__(self, what, done, total):
        self.append((what, done, total))

    def passes(self, what):
        return sum(done == total for name, done, total in self if name == what)


def test_each_pass_is_told_from_its_begin_to_its_end(log, tmp_path):
    told = Told()
    files = export.export(open_log(log, told), tmp_path, 'csv')
    assert told.passes('checking [kB]') == told.passes('tables') == 1
    assert told.passes('reading [chunks]') == 2  # the sizes of topics, and all of them together
    assert ('tables', len(files), len(files)) in told
    assert ('checking [kB]', log.stat().st_size // 1000, log.stat().st_size // 1000) in told
    for what in ('checking [kB]', 'reading [chunks]', 'tables'):
        shares = [done / total for name, done, total in told if name == what]
        assert all(0 <= share <= 1 for share in shares)


@pytest.mark.parametrize('kind', ['csv', 'parquet'])
def test_topics_that_are_read_one_by_one_make_the_same_tables(log, tmp_path, monkeypatch, kind):
    for name in 'ab':
        (tmp_path / name).mkdir()
    together = export.export(open_log(log), tmp_path / 'a', kind)
    monkeypatch.setattr(export, '_TOGETHER', 1)
    told = Told()
    alone = export.export(open_log(log, told), tmp_path / 'b', kind)
    assert told.passes('reading [chunks]') == 1 + len(alone) > 4
    for first, second in zip(together, alone, strict=True):
        assert Path(first).read_bytes() == Path(second).read_bytes()


COMMANDS = [
    ['info', 'LOG'],
    ['repair', 'LOG', 'OUT/r.mcap'],
    ['export', 'LOG', '--csv', 'OUT/csv'],
    ['plot', 'LOG', '--out', 'OUT/plots'],
    ['replay', 'LOG', '--resimulate'],
    ['replay', 'LOG', '--with', 'timestep=0.002', '--out', 'OUT/w.png'],
]


@pytest.mark.parametrize('command', COMMANDS, ids=' '.join)
def test_long_work_on_a_log_shows_how_far_it_is(command, log, tmp_path, capsys, monkeypatch):
    words = [w.replace('LOG', str(log)).replace('OUT', str(tmp_path)) for w in command]
    assert main(words) == 0
    assert capsys.readouterr().err == ''  # it was short
    for module in (logs, replay):
        monkeypatch.setattr(module, 'LOG_PATIENCE', 0.0)
    words = [w.replace(str(tmp_path), f'{tmp_path}/again') for w in words]
    (tmp_path / 'again').mkdir()
    assert main(words) == 0
    told = capsys.readouterr().err
    assert 'checking [kB]: 0 of ' in told and 'reading [chunks]: 0 of ' in told


def test_in_a_terminal_it_is_a_bar(log, tmp_path):
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'repair', str(log), str(tmp_path / 'r')]
    seen = shown_in_a_terminal(command)
    assert b' of ' not in seen and b'\x1b[' in seen


def test_a_topic_with_two_types_is_read_by_its_first_and_told(tmp_path, capsys):
    text = b'\x00\x01\x00\x00' + (2).to_bytes(4, 'little') + b'x\x00'
    number = b'\x00\x01\x00\x00' + (7).to_bytes(4, 'little')
    path = tmp_path / 'l.mcap'
    path.write_bytes(mcap.log_of([mcap.chunk(b''.join([
        mcap.schema(1, 'std_msgs/msg/String', 'string data'),
        mcap.schema(2, 'std_msgs/msg/UInt32', 'uint32 data'),
        mcap.channel(1, 1, '/a'), mcap.channel(2, 2, '/a'), mcap.channel(3, 1, '/a'),
        mcap.message(1, 0, 0, text), mcap.message(2, 1, 1, number), mcap.message(3, 2, 2, text),
    ]))]))  # fmt: skip
    assert main(['export', str(path), '--csv', str(tmp_path / 'o')]) == 1
    (file,) = (tmp_path / 'o').iterdir()
    rows = file.read_text().splitlines()[1:]
    assert [row.split(',')[0] for row in rows] == ['0', '2']
    said = ' '.join(capsys.readouterr().out.split())
    assert "channel 2 is left out: topic '/a' has another type" in said
