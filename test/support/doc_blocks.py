# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The commands and programs that README.md and doc/ show."""

import re
from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

from test.support.paths import DOC, ROOT

_BLOCK = re.compile(r'^( *)```(\w*)\n(.*?)^ *```', re.DOTALL | re.MULTILINE)
#: The first line of a block that is a file of the reader's.
_FILE = re.compile(r'# (\w+\.\w+)\n')
_SHELL = ('', 'sh', 'bash', 'console')
#: Its blocks are excerpts of the package's own files (test_extending.py).
_EXCERPTS = DOC / 'extending.md'


class Block(NamedTuple):
    """A fenced block: its page, its first line, and what is in it."""

    page: str
    line: int
    language: str
    text: str

    @property
    def commands(self) -> list[str]:
        """The commands of a shell block, without the remarks behind them."""
        lines = (
            re.sub(r'(^|\s+)#.*', '', line).strip()
            for line in self.text.replace('\\\n', ' ').splitlines()
        )
        return [line for line in lines if line]


def blocks(shell: bool) -> Iterator[Block]:
    """
    Yield the blocks of all pages.

    Parameters
    ----------
    shell
        Whether those of commands are wanted, or those of Python.

    """
    for page in (ROOT / 'README.md', *sorted(DOC.rglob('*.md'))):
        text = page.read_text(encoding='utf-8')
        for match in _BLOCK.finditer(text):
            kinds = _SHELL if shell else ('python',)
            if match[2] in kinds and page != _EXCERPTS:
                line = text[: match.start()].count('\n') + 1
                yield Block(_name(page), line, match[2], match[3])


def files_of(page: str) -> dict[str, str]:
    """
    Return the files that a page has its reader save: blocks that begin with their name.

    Parameters
    ----------
    page
        As `Block.page`.

    Returns
    -------
    dict
        Text by name, such as ``my_quad.py`` of a block that begins with ``# my_quad.py``.

    """
    text = (ROOT / page).read_text(encoding='utf-8')
    return {
        found[1]: match[3]
        for match in _BLOCK.finditer(text)
        if match[2] in ('python', 'yaml') and (found := _FILE.match(match[3]))
    }


def tutorials(shown: Iterable[Block]) -> Iterator[Block]:
    """
    Yield blocks, those of a tutorial as one: its reader types them one after another.

    Parameters
    ----------
    shown
        Blocks, those of a page together.

    """
    for page, several in groupby(shown, key=lambda block: block.page):
        if page.startswith('doc/tutorials/'):
            parts = list(several)
            yield parts[0]._replace(text='\n'.join(block.text for block in parts))
        else:
            yield from several


def _name(page: Path) -> str:
    return str(page.relative_to(ROOT))
