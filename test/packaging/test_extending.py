# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""doc/extending.md shows code that exists: each block stands in the file named above it."""

import re
import textwrap
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / 'doc' / 'extending.md'
_BLOCK = re.compile(r'`([\w./]+)`[^\n`]*\n\n( *)```\w*\n(.*?)\n *```', re.DOTALL)
#: A line of a block that stands for lines left out.
_GAP = re.compile(r'^\s*(\.\.\.|# \.\.\.|// \.\.\.)$')


def blocks():
    """Return (file, code) of every block of the page."""
    return [
        (file, textwrap.dedent(code))
        for file, _, code in _BLOCK.findall(PAGE.read_text(encoding='utf-8'))
    ]


def chunks(code):
    """Return the runs of lines between gaps, without their common indent."""
    found, run = [], []
    for line in [*code.splitlines(), '...']:
        if _GAP.match(line):
            found.append(textwrap.dedent('\n'.join(run)).strip('\n'))
            run = []
        else:
            run.append(line)
    return [chunk for chunk in found if chunk.strip()]


def stands_in(chunk, text):
    """Return whether a run of lines stands in a text, whatever its indent."""
    lines = [line.strip() for line in chunk.splitlines()]
    present = [line.strip() for line in text.splitlines()]
    return any(present[i : i + len(lines)] == lines for i in range(len(present)))


def test_the_page_has_a_block_for_each_kind_of_extension():
    text = PAGE.read_text(encoding='utf-8')
    titles = re.findall(r'^## (.*)$', text, re.MULTILINE)

    assert len(blocks()) == text.count('```') // 2 >= 12
    for word in ('sensor', 'topic', 'fluid term', 'weather model', 'problem', 'command'):
        assert any(word in title for title in titles), word


@pytest.mark.parametrize(('file', 'code'), blocks(), ids=lambda value: value.split('\n')[0][:40])
def test_each_block_stands_in_its_file(file, code):
    text = (ROOT / file).read_text(encoding='utf-8')
    for chunk in chunks(code):
        assert stands_in(chunk, text), chunk


def test_a_block_that_is_not_in_the_file_is_found():
    assert stands_in('def f():\n    return 1', 'x\n  def f():\n      return 1\n')
    assert not stands_in('def f():\n    return 2', 'x\n  def f():\n      return 1\n')
