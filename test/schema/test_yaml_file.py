# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""YAML of others: the values that PyYAML gives, or one line; never a traceback, never a bomb."""

import datetime
import os
import time
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.errors import ConfigError, LimitError
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.schema.base import parse
from fluid_sim_ros.schema.limits import VARIABLE
from fluid_sim_ros.schema.scene import SceneFile
from fluid_sim_ros.schema.yaml_file import parse_yaml, read_yaml


def fault(text):
    """Return the error of a text; it must be one printable line, and quick."""
    begin = time.process_time()  # other work on this machine does not count
    with pytest.raises(ConfigError) as caught:
        parse_yaml(text if isinstance(text, bytes) else text.encode(), 'a.yaml')
    assert time.process_time() - begin < 5
    line = str(caught.value)
    assert line.startswith('a.yaml: ') and line.isprintable() and len(line) < 1000
    return line


@pytest.mark.parametrize('path', sorted(config_folder().rglob('*.yaml')), ids=lambda p: p.stem)
def test_our_files_read_as_pyyaml_reads_them(path):
    assert read_yaml(path) == yaml.safe_load(path.read_text(encoding='utf-8'))


@pytest.mark.parametrize(
    'text',
    [
        '', '# nothing\n', '--- 5\n...\n', 'a: 1', '- 1\n- x', '{a: [1, 2.5, ~, yes, "1"]}',
        'a: &x [1, 2]\nb: *x', 'base: &b {k: 1, l: 2}\nc: {<<: *b, l: 3}',
        'c: {l: 3, <<: [{k: 1}, {k: 2, m: 4}]}', 'd: 2020-02-29', '0x1F', '1_000', '1:30', '.inf',
        '!!str 5', '!!float 5', '!!binary aGk=', 't: |\n  two\n  lines\n', '"\\u263a"',
        '? 5\n: 6', '! plain', '"<<": 1',
    ],
)  # fmt: skip
def test_values_are_those_of_pyyaml(text):
    try:
        expected = yaml.safe_load(text)
    except yaml.YAMLError:
        fault(text)
    else:
        assert parse_yaml(text.encode(), '') == expected


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('when: 2020-13-45', "'2020-13-45' is no value: month must be in 1..12 (line 1)"),
        ('a: 1\nwhen: 2020-02-30T25:00:00', '(line 2)'),
        ('a: !!python/object/apply:os.system [ls]', 'python/object/apply:os.system is not'),
        ('a: !!python/name:os.system x', 'is not allowed (line 1)'),
        ('a: !mine {b: 1}', 'the tag !mine is not allowed (line 1)'),
        ('a: !!omap [b: 1]', 'omap is not allowed'),
        ('a: !!set {b}', 'set is not allowed'),
        ('a: !!int seven', "'seven' is no value"),
        ('a: !!float ""', "'' is no value"),
        ('a: !!bool maybe', "'maybe' is no value"),
        ('a: !!binary "a"', 'failed to decode base64'),
        ('a: !!timestamp noon', 'is no value'),
        (f'a: {"9" * 5000}', 'is no value: Exceeds the limit'),
        ('{a: 1}: 2', 'a key must be a text or a number (line 1)'),
        ('[1, 2]: 3', 'a key must be a text or a number'),
        ('a: 1\na: 2', "key 'a' stands twice (line 2)"),
        ('a: {b: 1, b: 2}', "key 'b' stands twice"),
        ('a: *none', 'alias none has no anchor before it'),
        ('a: &x [*x]', 'alias x is part of itself'),
        ('a: {<<: 5}', '<< needs a mapping'),
        ('a: {<<: [1]}', '<< needs a mapping'),
        ('a: 1\n---\nb: 2', 'one document only (line 2)'),
        ('a: [', 'not valid YAML'),
        ('a: "\\x', 'not valid YAML'),
        ('%YAML 9.9\n---\na', 'not valid YAML'),
        ('a: b: c', 'not valid YAML'),
        ('\t- a', 'not valid YAML'),
        (b'a: \xff', 'not UTF-8: byte 3'),
        (b'\xff\xfea\x00', 'not UTF-8: byte 0'),
        ('a: \x1b[2J', 'not valid YAML'),
        ('a: !\x1b x', 'not valid YAML'),
        ('"\\e[2J": 1\n"\\e[2J": 2', "key '\\\\x1b[2J' stands twice"),
        ('a: !<tag:\\e> 1', 'not valid YAML'),
        ('[' * 3000, 'maximum nesting depth'),
        ('{a: ' * 3000, 'yaml_depth'),
    ],
)  # fmt: skip
def test_each_fault_is_one_line(text, words):
    assert words in fault(text)


def bomb(levels, width=10):
    """Return YAML of a few lines that stands for width ** levels values."""
    lines = ['a0: &a0 [x]']
    for i in range(levels):
        aliases = ', '.join([f'*a{i}'] * width)
        lines.append(f'a{i + 1}: &a{i + 1} [{aliases}]')
    return '\n'.join(lines)


def merge_bomb(levels):
    lines = ['a0: &a0 {k: [1, 1, 1, 1]}']
    lines += [f'a{i + 1}: &a{i + 1} {{l: *a{i}, r: *a{i}, <<: *a{i}}}' for i in range(levels)]
    return '\n'.join(lines)


@pytest.mark.parametrize(
    ('text', 'name'),
    [
        ('[' * 900, 'yaml_depth'),
        ('[' * 900 + ']' * 900, 'yaml_depth'),
        ('{a: ' * 900, 'yaml_depth'),
        ('- ' * 3000, 'yaml_depth'),
        ('? ' * 3000, 'yaml_depth'),
        ('\n'.join(' ' * i + 'a:' for i in range(3000)), 'yaml_depth'),
        (bomb(9), 'yaml_values'),
        (bomb(300, 2), 'yaml_values'),
        (merge_bomb(40), 'yaml_values'),
        ('[' + '1,' * 1_100_000 + ']', 'yaml_values'),
        (' ' * 17_000_000, 'yaml_bytes'),
    ],
    ids=range(11),
)
def test_bombs_meet_a_limit_that_names_itself(text, name):
    line = fault(text)
    assert f'the limit {name} = ' in line and f'{VARIABLE}={name}=NUMBER raises it' in line


def test_a_limit_is_raised_by_name(monkeypatch):
    text = ('[' * 100 + ']' * 100).encode()
    with pytest.raises(LimitError):
        parse_yaml(text, 'a.yaml')
    monkeypatch.setenv(VARIABLE, 'yaml_depth=100')
    value = parse_yaml(text, 'a.yaml')
    for _ in range(99):
        (value,) = value
    assert value == []


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(ConfigError, match='no such file'):
        read_yaml(tmp_path / 'none.yaml')
    os.mkfifo(tmp_path / 'pipe.yaml')
    for path in (tmp_path, tmp_path / 'pipe.yaml', Path('/dev/zero')):
        with pytest.raises(ConfigError, match='not a regular file'):
            read_yaml(path)


@given(st.text('[]{}&*!<>:-?,#|"\'%@` \n\tab01.eE+~=/\\\x1b', max_size=60))
def test_no_text_ends_in_another_error(text):
    try:
        parse_yaml(text.encode(), 'a.yaml')
    except ConfigError as error:
        assert str(error).isprintable()


# ---- what a schema says of such values ---------------------------------------------------------


@pytest.mark.parametrize(
    'text',
    [
        f'model: a\nduration: {"9" * 400}',
        'model: a\nduration: 1e-400000000000000000000',
        'model: a\nduration: 1e400000000',
        'model: a\nduration: 2020-01-01',
        'model: a\nduration: [[[[[[1]]]]]]',
        'model: a\n5: 6',
        'model: a\n2020-01-01: 6',
        'model: a\n"k\\e[2J": 6',
        f'model: a\n{"k" * 900}: 6',
        f'model: a\nintegrator: "{"n" * 100_000}"',
        'model: a\nwind: [{model: "\\e[2J"}]',
        'model: a\nvehicles: {"\\e": b}',
        f'model: a\nschedule: [{bomb(5).splitlines()[-1]}]',
        f'{bomb(5)}\nmodel: a',
        f'model: a\nduration: [{"*b, " * 90}*b]'.replace('[', '[&b [1, 2, 3, 4], ', 1),
    ],
)
def test_a_schema_says_in_one_line_what_it_does_not_take(text, tmp_path):
    path = tmp_path / 'scene.yaml'
    path.write_text(text)
    begin = time.process_time()  # other work on this machine does not count
    with pytest.raises(ConfigError) as caught:
        parse(SceneFile, read_yaml(path), path)
    assert time.process_time() - begin < 5
    line = str(caught.value)
    assert line.startswith(f'{path}: ') and line.isprintable() and len(line) < 2000


def test_dates_are_dates():
    assert parse_yaml(b'2020-02-29', '') == datetime.date(2020, 2, 29)
