# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Messages of one topic as columns of numbers, from any definition in the encoding ``ros2msg``.

Messages of a topic rarely differ in more than their numbers, so the place of each number is found
once per layout and then read from all messages at the same time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import ConfigError, printable
from fluid_sim_ros.messages.members import NUMBERS, Member, MessageType
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.schema.limits import beyond, check_limit, limit

_HEADER_SIZE = 4
#: Longest dotted name of a field [characters].
_LONGEST_NAME = 500
#: A table may be this many times as large as its messages, beyond the limit: bytes become numbers.
_GROWTH = 10


@dataclass(frozen=True)
class Place:
    """Where a number (dtype) or a string (empty dtype) of a message stands."""

    name: str
    offset: int
    dtype: str
    size: int


class Schema:
    """
    The types of one definition; the first is the message itself.

    Parameters
    ----------
    definition
        Text of the message type and of all types in it, encoding ``ros2msg``.

    """

    def __init__(self, definition: str) -> None:
        check_limit('log_definition_bytes', len(definition), 'the message definition')
        try:
            self._types = MessageType(definition)
        except ValueError:  # a length of thousands of digits
            raise LogError('the message definition cannot be read') from None
        self._known: dict[tuple[str, str], tuple[str, list[Member]]] = {}

    def layout(self, data: bytes) -> tuple[list[Place], list[int]]:
        """
        Return the places of a message's numbers and strings, and those of its length words.

        Parameters
        ----------
        data
            The message, little-endian CDR.

        Returns
        -------
        places, lengths
            Places of numbers and strings; offsets of the words that state a length [bytes].

        Raises
        ------
        LogError
            If the message does not fit its definition.
        LimitError
            If it has more fields, or levels of messages in messages, than a limit allows.

        """
        walk = _Walk(data)
        self._walk(walk, '', '', '', 0)
        return walk.places, walk.lengths

    def _members(self, kind: str, owner: str) -> tuple[str, list[Member]]:
        key = (kind, owner)
        if key not in self._known:
            try:
                self._known[key] = self._types.members(kind, owner)
            except ConfigError:
                raise LogError(
                    f"the message definition lacks the type '{printable(kind)}'"
                ) from None
        return self._known[key]

    def _walk(self, walk: '_Walk', kind: str, owner: str, prefix: str, depth: int) -> None:
        check_limit('log_depth', depth, 'levels of messages in a message')
        owner, members = self._members(kind, owner)
        for field in members:
            name = f'{prefix}{field.name}'
            walk.visit(name)
            if field.length is None:
                self._item(walk, field.type, owner, name, depth)
                continue
            count = walk.length() if field.length < 0 else field.length
            if field.type in NUMBERS and count:
                walk.number(name, NUMBERS[field.type], count)
                continue
            for i in range(count):
                walk.visit(name)
                self._item(walk, field.type, owner, f'{name}[{i}]', depth)

    def _item(self, walk: '_Walk', kind: str, owner: str, name: str, depth: int) -> None:
        if kind in NUMBERS:
            walk.number(name, NUMBERS[kind], None)
        elif kind == 'string':
            walk.string(name)
        else:
            self._walk(walk, kind, owner, f'{name}.', depth + 1)


class _Walk:
    """Goes through one message, noting what stands where."""

    def __init__(self, data: bytes) -> None:
        if data[:2] != b'\x00\x01':
            raise LogError('a message is not plain little-endian CDR')
        self._data = data
        self._at = _HEADER_SIZE
        self.places: list[Place] = []
        self.lengths: list[int] = []
        self._most = limit('log_columns')
        self._visited = 0

    def visit(self, name: str) -> None:
        """Count a member: messages without members would go on for ever without a byte."""
        self._visited += 1
        if self._visited > 4 * self._most or len(name) > _LONGEST_NAME:
            raise beyond('log_columns', self._most, f"field '{printable(name, 60)}'")

    def _take(self, size: int, alignment: int) -> int:
        at = self._at + -(self._at - _HEADER_SIZE) % alignment
        if at + size > len(self._data):
            raise LogError('a message is shorter than its definition says')
        self._at = at + size
        return at

    def length(self) -> int:
        at = self._take(4, 4)
        self.lengths.append(at)
        count = int.from_bytes(self._data[at : at + 4], 'little')
        if count > len(self._data):
            raise LogError('a message is shorter than its definition says')
        return count

    def number(self, name: str, dtype: str, count: int | None) -> None:
        width = np.dtype(dtype).itemsize
        at = self._take(width * (count or 1), width)
        if len(self.places) + (count or 1) > self._most:
            raise beyond('log_columns', self._most, f"field '{printable(name, 60)}'")
        if count is None:
            self.places.append(Place(name, at, dtype, width))
        for i in range(count or 0):
            self.places.append(Place(f'{name}[{i}]', at + i * width, dtype, width))

    def string(self, name: str) -> None:
        size = self.length()
        self.places.append(Place(name, self._take(size, 1), '', size))


def fields(definition: str, data: bytes) -> dict[str, Any]:
    """
    Return every number and string of one message by its dotted name.

    Parameters
    ----------
    definition
        Text of the message type, encoding ``ros2msg``.
    data
        The message, little-endian CDR.

    Returns
    -------
    dict
        Number or text by name.

    Raises
    ------
    LogError
        If the message does not fit its definition.

    """
    found: dict[str, Any] = {}
    for place in Schema(definition).layout(data)[0]:
        content = data[place.offset : place.offset + place.size]
        if place.dtype:
            found[place.name] = np.frombuffer(content, '<' + place.dtype)[0].item()
        else:
            found[place.name] = content.rstrip(b'\x00').decode(errors='replace')
    return found


def columns(definition: str, messages: Sequence[bytes]) -> dict[str, NDArray[Any]]:
    """
    Return one array per field, one value per message.

    Fields that some messages lack (sequences of changing length) hold NaN there; strings are
    object arrays.

    Parameters
    ----------
    definition
        Text of the message type, encoding ``ros2msg``.
    messages
        Messages of this type, little-endian CDR.

    Returns
    -------
    dict
        Array of shape (messages,) by name.

    Raises
    ------
    LogError
        If a message does not fit its definition.
    LimitError
        If the table would be larger than the limits of logs allow.

    """
    schema, count = Schema(definition), len(messages)
    allowed = limit('log_table_bytes') + _GROWTH * sum(map(len, messages))
    result: dict[str, NDArray[Any]] = {}
    lengths: dict[int, list[int]] = {}
    for i, message in enumerate(messages):
        lengths.setdefault(len(message), []).append(i)
    layouts = 0
    for size, numbers in lengths.items():
        rows = np.array(numbers)
        table = np.frombuffer(b''.join([messages[i] for i in numbers]), np.uint8)
        table = table.reshape(len(rows), size)
        while len(rows):
            layouts += 1
            check_limit('log_layouts', layouts, 'messages of different layout')
            places, words = schema.layout(table[0].tobytes())
            columns_of_words = [at + byte for at in words for byte in range(4)]
            alike = (table[:, columns_of_words] == table[0, columns_of_words]).all(axis=1)
            new = sum(place.name not in result for place in places)
            if (len(result) + new) * count * 8 > allowed:
                raise beyond(
                    'log_table_bytes', limit('log_table_bytes'),
                    f'{len(result) + new} fields of {count} messages',
                )  # fmt: skip
            for place in places:
                _fill(result, place, count, rows[alike], table[alike])
            rows, table = rows[~alike], table[~alike]
    return result


def _fill(
    result: dict[str, NDArray[Any]],
    place: Place,
    count: int,
    rows: NDArray[np.int64],
    table: NDArray[np.uint8],
) -> None:
    """Put one field of the messages of one layout in its column."""
    cells = np.ascontiguousarray(table[:, place.offset : place.offset + place.size])
    whole = len(rows) == count
    values: NDArray[Any]
    if place.dtype:
        values = cells.view('<' + place.dtype).reshape(len(rows))
    else:
        texts = [bytes(row).rstrip(b'\x00').decode(errors='replace') for row in cells]
        values = np.array(texts, dtype=object)
    if whole:
        result[place.name] = values
        return
    if place.name not in result:
        missing = np.nan if place.dtype else ''
        result[place.name] = np.full(count, missing, object if not place.dtype else float)
    result[place.name][rows] = values
