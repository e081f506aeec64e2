# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Limits of what files may ask for: each names itself, and is raised by name."""

import re

import pytest

from fluid_sim_ros.errors import ConfigError, LimitError
from fluid_sim_ros.schema.limits import LIMITS, VARIABLE, check_limit, expanded_size, limit
from test.support.paths import ROOT


@pytest.mark.parametrize('name', LIMITS)
def test_a_limit_names_itself_and_is_raised_as_it_says(name, monkeypatch):
    most = LIMITS[name].most
    check_limit(name, most, 'the file')
    with pytest.raises(LimitError, match='the file') as caught:
        check_limit(name, most + 1, 'the file')
    line = str(caught.value)
    assert f'{name} = {most}' in line and LIMITS[name].what in line
    assert f'{VARIABLE}={name}=' in line
    monkeypatch.setenv(VARIABLE, f'{name}={most + 1}')
    check_limit(name, most + 1, 'the file')


def test_several_are_raised_at_once(monkeypatch):
    monkeypatch.setenv(VARIABLE, ' scene_events=1e6, yaml_depth = 60,')
    assert (limit('scene_events'), limit('yaml_depth')) == (1_000_000, 60)
    assert limit('yaml_bytes') == LIMITS['yaml_bytes'].most


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('depth=3', "'depth' is no limit; limits: yaml_bytes, "),
        ('yaml_depth', 'yaml_depth: needs yaml_depth=NUMBER'),
        ('yaml_depth=many', 'needs yaml_depth=NUMBER'),
        ('yaml_depth=inf', 'needs yaml_depth=NUMBER'),
        ('\x1b[2J=3', r"'\x1b[2J' is no limit"),
    ],
)
def test_what_cannot_be_read_is_refused(text, words, monkeypatch):
    monkeypatch.setenv(VARIABLE, text)
    with pytest.raises(ConfigError) as caught:
        limit('yaml_bytes')
    assert words in str(caught.value)


def test_what_compressed_data_may_become(monkeypatch):
    assert expanded_size(0) == 32 << 20
    monkeypatch.setenv(VARIABLE, 'expansion=1000')
    assert expanded_size(1000) == (32 << 20) + 1_000_000


def test_every_limit_is_one_that_something_asks_for():
    """Each is checked, or stated where it ends a process, by its name; and no other is."""
    sources = (ROOT / 'fluid_sim_ros').rglob('*.py')
    text = '\n'.join(path.read_text() for path in sources if path.name != 'limits.py')
    asked = set(re.findall(r"(?:check_limit|beyond|limit)\(\s*'(\w+)'", text))
    limits_file = (ROOT / 'fluid_sim_ros' / 'schema' / 'limits.py').read_text()
    asked |= set(re.findall(r"\blimit\('(\w+)'\)", limits_file))
    assert asked - {'name'} == set(LIMITS)
