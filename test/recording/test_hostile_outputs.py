# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is made of a hostile log: files in their folder, cells that stay text, plain terminals."""

import csv
import json
from itertools import pairwise, product

import pytest

from fluid_sim_ros.cli.main import WRONG_INPUT, main
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.reader import open_log
from test.support import log_files as mcap
from test.support.log_files import rewritten
from test.support.recorded_flights import record_flight
from test.support.volumes import quick

STRING = 'std_msgs/msg/String'
ODOMETRY = 'nav_msgs/msg/Odometry'


@pytest.fixture(scope='module')
def flight(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'sphere', seconds=0.2, piloted=False)
    return path


def names_in(folder):
    return {path.name for path in folder.iterdir()}


def string_data(text):
    data = text.encode() + b'\x00'
    return b'\x00\x01\x00\x00' + len(data).to_bytes(4, 'little') + data


def strings_log(path, texts, topics=('/a',), definition='string data'):
    """Write a log with texts on some topics."""
    head = [mcap.schema(1, STRING, definition)]
    head += [mcap.channel(i, 1, topic) for i, topic in enumerate(topics, 1)]
    messages = [
        mcap.message(i, step, step, string_data(text))
        for i in range(1, len(topics) + 1) for step, text in enumerate(texts)
    ]  # fmt: skip
    path.write_bytes(mcap.log_of([mcap.chunk(b''.join([*head, *messages]))]))
    return path


# ---- files -------------------------------------------------------------------------------------

TARGETS = {
    'export --csv': (['export', 'LOG', '--csv', 'OUT'], 'clock.csv'),
    'export --parquet': (['export', 'LOG', '--parquet', 'OUT'], 'clock.parquet'),
    'plot': (['plot', 'LOG', '--out', 'OUT'], 'a_sphere.png'),
    'report': (['plot', 'LOG', '--out', 'OUT'], 'a.html'),
    'render': (['render', 'LOG', '--out', 'OUT/a.png', '--size', '32', '32'], 'a.png'),
    'film': (['render', 'LOG', '--out', 'OUT/a.mp4', '--size', '32', '32'], 'a.mp4'),
    'what if': (['replay', 'LOG', '--with', 'timestep=0.001', '--out', 'OUT/w.png'], 'w.png'),
    'repair': (['repair', 'LOG', 'OUT/b.mcap'], 'b.mcap'),
    'metadata': (['repair', 'LOG', 'OUT'], 'metadata.yaml'),
    'repaired bag': (['repair', 'LOG', 'OUT'], 'out_0.mcap'),
}


@pytest.mark.parametrize('target', quick(TARGETS, 'export --csv', 'plot', 'render', 'repair'))
def test_a_link_that_was_there_is_not_written_through(target, flight, tmp_path, capsys):
    words, name = TARGETS[target]
    out, precious = tmp_path / 'out', tmp_path / 'precious'
    out.mkdir()
    precious.write_text('mine')
    (out / name).symlink_to(precious)
    command = [word.replace('LOG', str(flight)).replace('OUT', str(out)) for word in words]
    assert main(command) == WRONG_INPUT
    assert precious.read_text() == 'mine' and (out / name).is_symlink()
    assert str(out / name) in capsys.readouterr().err
    (out / name).unlink()
    if name == 'metadata.yaml':
        (out / 'out_0.mcap').unlink()
    assert main(command) == 0
    assert (out / name).stat().st_size > 100


def test_two_topics_never_share_a_file(tmp_path, capsys):
    topics = ('/a/b', '/a_b', '/A_b', '/a/b_2')
    log = strings_log(tmp_path / 'l.mcap', ['x', 'y'], topics)
    assert main(['export', str(log), '--csv', str(tmp_path / 'o'), '--json', '-']) == 0
    files = json.loads(capsys.readouterr().out)['files']
    assert len({file.lower() for file in files}) == len(topics) == len(names_in(tmp_path / 'o'))


@pytest.mark.parametrize(
    'name',
    ['../../x', '/../x', 'a/../../x', '/x/', '//x', '', ' ', 'a b', '/a\x00', '/\x1b[2J', 'é',
     '/' + 'x' * 300, '/a\n', '~/x', '-x', '{x}', '/[red]x'],
)  # fmt: skip
def test_a_topic_that_is_no_name_is_left_out(name, tmp_path, capsys):
    log = strings_log(tmp_path / 'l.mcap', ['x'], (name, '/good'))
    assert [topic.name for topic in open_log(log).topics.values()] == ['/good']
    out = tmp_path / 'deep' / 'o'
    assert main(['export', str(log), '--csv', str(out)]) == 1
    assert names_in(out) == {'good.csv'} and names_in(tmp_path) == {'deep', 'l.mcap'}
    said = ' '.join(capsys.readouterr().out.split())
    assert 'channel 1 is left out: topic' in said and said.isprintable()


@pytest.mark.parametrize(
    'kind',
    ['this.x/msg/Y', 'os/msg/system', '../x/msg/Y', 'std_msgs/msg/../os', 'std_msgs/String', '',
     'std_msgs/msg/String\n', 'a' * 300 + '/msg/B', 'Std/msg/String', 'std_msgs/msg/\x1b[2J'],
)  # fmt: skip
def test_a_type_that_is_no_name_is_left_out(kind, tmp_path):
    head = mcap.schema(1, kind, 'string data') + mcap.channel(1, 1, '/a')
    path = tmp_path / 'l.mcap'
    path.write_bytes(mcap.log_of([mcap.chunk(head + mcap.message(1, 0, 0, string_data('x')))]))
    log = open_log(path)
    if kind == 'os/msg/system':  # not in capitals
        assert not log.topics
    assert log.topics == {} and log.faults[0].isprintable()
    assert list(log.messages()) == []


# ---- cells and terminals -----------------------------------------------------------------------


def test_text_cells_are_no_formulas(tmp_path):
    texts = ['=1+1', '+1', '-1', '@SUM(A1)', '\t=1', '\r=1', 'a=1', '', '1', '=cmd|" /C calc"!A0']
    log = strings_log(tmp_path / 'l.mcap', texts)
    assert main(['export', str(log), '--csv', str(tmp_path)]) == 0
    with (tmp_path / 'a.csv').open(newline='') as stream:
        cells = [row['data'] for row in csv.DictReader(stream)]
    assert cells == [f"'{text}" if text[:1] in tuple('=+-@\t\r') else text for text in texts]


def test_numbers_below_zero_stay_numbers(flight, tmp_path):
    assert main(['export', str(flight), '--csv', str(tmp_path)]) == 0
    with (tmp_path / 'sphere_odom.csv').open(newline='') as stream:
        heights = [float(row['pose.pose.position.z']) for row in csv.DictReader(stream)]
    assert any(b < a for a, b in pairwise(heights))


def test_a_field_may_have_the_name_of_our_columns(tmp_path):
    log = strings_log(tmp_path / 'l.mcap', ['x'], definition='string step')
    assert main(['export', str(log), '--csv', str(tmp_path)]) == 0
    with (tmp_path / 'a.csv').open(newline='') as stream:
        (row,) = csv.DictReader(stream)
    assert (row['step'], row['message.step']) == ('0', 'x')


ODD = ('\x1b[2J\x1b[31mred', '[bold]b[/bold] [/]', 'n' * 1_000_000, '\u202eevil', 'two\nlines')
PLACES = ('name', 'version', 'integrator', 'namespace', 'attachment')
TEXTS = list(product(PLACES, range(len(ODD))))


@pytest.mark.parametrize(
    'place', quick(TEXTS, *zip(PLACES, range(len(ODD)), strict=True)), ids=str
)
def test_no_text_of_a_log_reaches_the_terminal_as_it_is(place, flight, tmp_path, capsys):
    key, odd = place[0], ODD[place[1]]
    run, scene, attachments = {}, {}, {}
    if key == 'name':
        scene['name'] = odd
    elif key == 'version':
        run['versions'] = {'fluid_sim_ros': odd, 'mujoco': odd, 'machine': odd}
    elif key == 'attachment':
        attachments['fluid_sim/model/' + odd[:60000]] = b'x'
    else:
        run[key] = odd
    log = rewritten(flight, tmp_path / 'l.mcap', run=run, scene=scene, attachments=attachments)
    for command in (['info'], ['replay', '--resimulate'], ['plot', '--out', str(tmp_path)]):
        main([command[0], str(log), *command[1:]])
        said = capsys.readouterr()
        for text in (said.out, said.err):
            assert len(text) < 20_000
            assert text.replace('\n', '').isprintable()
            assert '\x1b' not in text


def test_values_of_a_log_in_a_difference(flight, tmp_path, capsys):
    log: Log = open_log(flight)
    found = mcap.records_of(log)[2]
    changed = [
        record[:31] + record[31:].replace(b'map\x00', b'm\x1b[\x00')
        if b'map\x00' in record
        else record
        for record in found
    ]
    path = rewritten(flight, tmp_path / 'l.mcap', messages=changed)
    assert main(['replay', str(path), '--resimulate']) == 1
    said = capsys.readouterr().out
    assert 'was m\\x1b[, is map' in ' '.join(said.split()) and '\x1b' not in said
