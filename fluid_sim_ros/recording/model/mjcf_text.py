# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
MJCF and URDF text as a tree, read as leniently as MuJoCo reads it, and written strictly.

What MuJoCo is given of a log is this strict text alone: whatever its own parser would have made
of the text in the log, it sees the elements and attributes that were looked at here.
"""

import re
from xml.etree import ElementTree

from fluid_sim_ros.errors import FluidSimError, printable

Element = ElementTree.Element
#: Elements within one another; MuJoCo's own functions go as deep.
_DEEPEST = 200
_COMMENT = re.compile(r'<!--.*?-->', re.DOTALL)
#: What may stand before the root, and means nothing to MuJoCo.
_PROLOG = re.compile(r'\s*(?:<\?[^>]*\?>|<![A-Za-z][^>\[]*>)')
_QUOTED = re.compile(r'=\s*("[^"]*"|\'[^\']*\')')
_AMPERSAND = re.compile(r'&(?!(?:amp|lt|gt|quot|apos|#\d{1,7}|#x[0-9A-Fa-f]{1,6});)')


class MjcfError(FluidSimError):
    """A model's text cannot be read, or names what it may not; one line."""


class _Builder(ElementTree.TreeBuilder):
    """Builds a tree that is not too deep."""

    _depth = 0

    def start(self, tag: str, attrs: dict[str, str], /) -> Element:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise MjcfError(f'its elements stand more than {_DEEPEST} deep in one another')
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> Element:
        self._depth -= 1
        return super().end(tag)


def parse_mjcf(content: bytes) -> Element:
    """
    Return the root of a model's text.

    Parameters
    ----------
    content
        UTF-8; comments, declarations and stray ampersands may be as MuJoCo accepts them.

    Returns
    -------
    Element
        ``mujoco``, ``robot`` (URDF), or the root of an included file.

    Raises
    ------
    MjcfError
        If it is no XML, or declares entities.

    """
    try:
        text = content.decode('utf-8-sig')
    except UnicodeDecodeError as error:
        raise MjcfError(f'not UTF-8: byte {error.start}') from None
    text = _COMMENT.sub(' ', text)
    while match := _PROLOG.match(text):
        text = text[match.end() :]
    text = _QUOTED.sub(_strict_value, text.strip())
    if '<!' in text:
        raise MjcfError('it declares what XML may stand for; only elements are allowed')
    parser = ElementTree.XMLParser(target=_Builder())
    try:
        parser.feed(text)
        root = parser.close()
    except ElementTree.ParseError as error:
        raise MjcfError(f'no well-formed XML: {printable(str(error))}') from None
    except ValueError as error:  # such as half a surrogate pair
        raise MjcfError(f'no XML: {printable(str(error))}') from None
    return root


def _strict_value(match: re.Match[str]) -> str:
    """Return a value that strict XML reads as MuJoCo reads the lenient one."""
    value = _AMPERSAND.sub('&amp;', match[1]).replace('<', '&lt;')
    return '=' + value.replace('\r\n', '\n').replace('\n', '&#10;').replace('\t', '&#9;')


def mjcf_text(root: Element) -> str:
    """
    Return a tree as text.

    Parameters
    ----------
    root
        The tree.

    """
    return ElementTree.tostring(root, encoding='unicode')
