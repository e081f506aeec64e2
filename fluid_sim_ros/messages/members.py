# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Members of messages, read from their definitions (the texts of ``.msg`` files).

A definition in the encoding ``ros2msg`` holds the text of a message, and behind separator lines
the texts of all messages in it.
"""

import ast
import re
from dataclasses import dataclass
from functools import cache
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages.definitions import definition

#: Primitive types of numbers, and their codes for ``struct`` and NumPy (without the byte order).
NUMBERS = {
    'bool': '?', 'byte': 'B', 'char': 'B', 'int8': 'b', 'uint8': 'B', 'int16': 'h', 'uint16': 'H',
    'int32': 'i', 'uint32': 'I', 'int64': 'q', 'uint64': 'Q', 'float32': 'f', 'float64': 'd',
}  # fmt: skip

_SEPARATOR = re.compile(r'^={10,}$', re.MULTILINE)
_MEMBER = re.compile(r'^([A-Za-z][\w/]*)(?:<=\d+)?(?:\[(<=)?(\d*)\])?\s+([A-Za-z]\w*)\s*(.*)$')


@dataclass(frozen=True)
class Member:
    """
    A member of a message.

    Attributes
    ----------
    type, name
        Type (of one element, where there are several) and name.
    length
        Number of elements of a fixed array, -1 for a sequence, None for a single value.
    default
        Value as the text of the definition, or empty.

    """

    type: str
    name: str
    length: int | None
    default: str = ''

    def default_value(self) -> Any:
        """Return the default (number, string, list of these), or None where there is none."""
        text = {'true': 'True', 'false': 'False'}.get(self.default.lower(), self.default)
        return ast.literal_eval(text) if text else None


class MessageType:
    """
    The members of a message and of all messages in it.

    Parameters
    ----------
    text
        Definition in the encoding ``ros2msg``.

    """

    def __init__(self, text: str) -> None:
        self._types: dict[str, list[Member]] = {}
        for number, part in enumerate(_SEPARATOR.split(text)):
            name, body = '', part
            if number:
                head, _, body = part.strip().partition('\n')
                name = head.removeprefix('MSG:').strip().replace('/msg/', '/')
            self._types[name] = [member for line in body.splitlines() if (member := _read(line))]

    def members(self, kind: str = '', owner: str = '') -> tuple[str, list[Member]]:
        """
        Return the full name and the members of a message type.

        Parameters
        ----------
        kind
            Type as a member names it, with or without its package; empty: the message itself.
        owner
            Full name of the message that has such a member, where the package is looked for
            first.

        Returns
        -------
        tuple
            ``package/Name`` (empty for the message itself), and its members in their order.

        Raises
        ------
        ConfigError
            If the definition lacks the type.

        """
        kind = kind.replace('/msg/', '/')
        package = owner.partition('/')[0]
        for name in (kind, f'{package}/{kind}'):
            if name in self._types:
                return name, self._types[name]
        for name, found in self._types.items():  # a type of the message's own package
            if name.rpartition('/')[2] == kind:
                return name, found
        raise ConfigError(f"the definition lacks the type '{kind}'")


@cache
def message_type(name: str) -> MessageType:
    """
    Return the members of a message type whose definition is kept here.

    Parameters
    ----------
    name
        ``package/msg/Name``.

    Returns
    -------
    MessageType
        Its members.

    Raises
    ------
    ConfigError
        If the definition is not kept.

    """
    return MessageType(definition(name).text)


def _read(line: str) -> Member | None:
    """Return the member that a line declares, or None (a comment, a constant)."""
    match = _MEMBER.match(line.partition('#')[0].strip())
    if not match or match[5].startswith('='):
        return None
    kind, bounded, count, name, default = match.groups()
    length = None if count is None else int(count) if count and not bounded else -1
    return Member(kind, name, length, default)
