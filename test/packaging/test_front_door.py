# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The way in: what README, the first page and the pictures promise to somebody new."""

import re

import pytest

from test.support.paths import DOC, ROOT

README = (ROOT / 'README.md').read_text(encoding='utf-8')
INDEX = (DOC / 'index.md').read_text(encoding='utf-8')
PEERS = ('Gazebo', 'Stonefish', 'HoloOcean', 'RotorPy', 'PX4 SIH', 'mujoco_ros2_control')
#: A picture on a line of its own.
PICTURE = re.compile(r'^!\[[^\]]*\]\([^)]+\)$')
#: What draws one.
COMMAND = re.compile(r'`[^`]*(?:benchmarks[./]|fluid_sim |make |new-vehicle)')


def test_the_readme_fits_two_screens():
    # a screen shows about 70 lines
    assert README.count('\n') <= 140


def test_the_readme_holds_two_commands_and_three_next_steps():
    first, steps, *_ = re.findall(r'```\n(.*?)```', README, re.DOTALL)
    assert [line.partition('#')[0].strip() for line in first.splitlines()] == [
        'make demo',
        'make test',
    ]
    assert len(steps.splitlines()) == 3


@pytest.mark.parametrize('peer', PEERS)
def test_the_readme_compares_with_a_peer_and_names_its_source(peer):
    (mark,) = re.findall(rf'\[{peer}\]\[(\w+)\]', README)
    assert re.search(rf'^\[{mark}\]: https://', README, re.MULTILINE)


def test_the_comparison_says_what_we_lack():
    rows = [line.split(' | ') for line in README.splitlines() if line.startswith('| ')]
    ours = [row[1] for row in rows if len(row) == 2 + len(PEERS)]
    assert sum('**' in cell for cell in ours) >= 3


@pytest.mark.parametrize('kind', ['engineer with ROS', 'PX4 or ArduPilot', 'MuJoCo', 'fluids'])
def test_each_kind_of_user_has_a_place_to_start(kind):
    rows = [line for line in INDEX.splitlines() if line.startswith('| a')]
    (row,) = [line for line in rows if kind in line.split('|')[1]]
    assert row.count('](') >= 2


def test_every_tutorial_is_linked_from_the_first_page():
    pages = {f'tutorials/{path.name}' for path in (DOC / 'tutorials').glob('*.md')}
    assert len(pages) >= 9
    assert {page for page in pages if f'({page})' not in INDEX} == set()


def test_every_picture_has_its_command_below_it():
    without = []
    for page in sorted(DOC.rglob('*.md')):
        lines = page.read_text(encoding='utf-8').splitlines()
        for number, line in enumerate(lines):
            if PICTURE.match(line) and not COMMAND.search(
                '\n'.join(lines[number + 1 : number + 8])
            ):
                without.append(f'{page.relative_to(DOC)}:{number + 1}')
    # a picture that a benchmark or a command draws names it: (`.venv/bin/python -m ...`)
    assert without == []
