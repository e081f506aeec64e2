# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Files made of foreign data: never through a link, whole or not there, no two of one name."""

import json
import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.output.html_page import write_page
from fluid_sim_ros.output.new_file import file_names, new_file


def test_a_file_takes_its_place_when_it_is_whole(tmp_path):
    path = tmp_path / 'a.txt'
    path.write_text('old')
    with new_file(path) as file:
        file.write_text('new')
        assert path.read_text() == 'old' and file.suffix == '.txt'
    assert path.read_text() == 'new' and list(tmp_path.iterdir()) == [path]
    umask = os.umask(0)
    os.umask(umask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~umask


def test_nothing_is_left_of_one_that_failed(tmp_path):
    with pytest.raises(KeyError), new_file(tmp_path / 'a.txt') as file:
        file.write_text('half')
        raise KeyError
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize('where', ['file', 'nowhere', 'folder', 'itself'])
def test_a_link_is_not_followed(where, tmp_path):
    other = tmp_path / 'other'
    if where == 'file':
        other.write_text('mine')
    elif where == 'folder':
        other.mkdir()
    path = tmp_path / 'a.txt'
    path.symlink_to(path if where == 'itself' else other)
    with pytest.raises(ConfigError, match='a link stands there'), new_file(path) as file:
        file.write_text('not mine')
    assert path.is_symlink() and (where != 'file' or other.read_text() == 'mine')
    assert len(list(tmp_path.iterdir())) == 1 + (where in ('file', 'folder'))


def test_another_name_of_the_file_keeps_its_content(tmp_path):
    (tmp_path / 'precious').write_text('mine')
    (tmp_path / 'a.txt').hardlink_to(tmp_path / 'precious')
    with new_file(tmp_path / 'a.txt') as file:
        file.write_text('new')
    assert (tmp_path / 'precious').read_text() == 'mine'


def test_a_link_that_comes_while_the_file_is_made_is_replaced(tmp_path):
    (tmp_path / 'precious').write_text('mine')
    with new_file(tmp_path / 'a.txt') as file:
        file.write_text('new')
        (tmp_path / 'a.txt').symlink_to(tmp_path / 'precious')
    assert (tmp_path / 'precious').read_text() == 'mine'
    assert (tmp_path / 'a.txt').read_text() == 'new'


@pytest.mark.parametrize('place', ['folder', 'none/a.txt', 'a.txt/b.txt', '/proc/a.txt'])
def test_where_nothing_can_be_written_is_one_line(place, tmp_path):
    (tmp_path / 'folder').mkdir()
    (tmp_path / 'a.txt').write_text('')
    with pytest.raises(ConfigError) as caught, new_file(tmp_path / place):
        pass
    assert '\n' not in str(caught.value)


@pytest.mark.parametrize(
    ('names', 'expected'),
    [
        (['/rov/odom', '/tf'], ['rov_odom', 'tf']),
        (['/a/b', '/a_b', '/a/b_2', '/a_b/'], ['a_b', 'a_b_2', 'a_b_2_2', 'a_b_3']),
        (['/A', '/a'], ['A', 'a_2']),
        (['', '/', '..'], ['nameless', 'nameless_2', 'nameless_3']),
        (['/../../etc/passwd'], ['etc_passwd']),
        (['a\x00b', 'é', '-rf', 'a b;c'], ['a_b', 'nameless', '-rf', 'a_b_c']),
        (['x' * 5000], ['x' * 150]),
    ],
)  # fmt: skip
def test_names_of_files(names, expected):
    assert file_names(names) == expected


@given(st.lists(st.text(max_size=20), max_size=20))
def test_no_two_share_a_file_and_none_leaves_its_folder(names):
    found = file_names(names)
    assert len({name.lower() for name in found}) == len(names)
    assert all(name and '/' not in name and name not in ('.', '..') for name in found)


@pytest.mark.parametrize(
    'text',
    [
        '</script><script>alert(1)</script>',
        '<!--',
        'TITLE',
        'DATA',
        '/* SCRIPT */',
        '\u2028',
        '"\\',
    ],
)
def test_text_stays_text_in_a_page(text, tmp_path):
    template = tmp_path / 'template.html'
    template.write_text(
        '<title>TITLE</title><h1>TITLE</h1><style>/* STYLE */</style>'
        '<script id="data" type="application/json">DATA</script><script>/* SCRIPT */</script>'
    )
    page = write_page(template, text, {'name': text}, tmp_path / 'a.html').read_text('utf-8')
    assert page.count('<script') == 2 and page.count('</script') == 2 and '<!--' not in page
    data = page.split('application/json">')[1].split('</script>')[0]
    assert json.loads(data) == {'name': text}
    assert page.count('<title>') == 1 and '{' not in page.split('</h1>')[0]
