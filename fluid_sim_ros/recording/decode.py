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

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages.members import NUMBERS, MessageType
from fluid_sim_ros.recording.description import LogError

_HEADER_SIZE = 4


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
        self._types = MessageType(definition)

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

        """
        walk = _Walk(data)
        self._walk(walk, '', '', '')
        return walk.places, walk.lengths

    def _walk(self, walk: '_Walk', kind: str, owner: str, prefix: str) -> None:
        try:
            owner, members = self._types.members(kind, owner)
        except ConfigError as error:
            raise LogError(str(error)) from None
        for field in members:
            name = f'{prefix}{field.name}'
            if field.length is None:
                self._item(walk, field.type, owner, name)
                continue
            count = walk.length() if field.length < 0 else field.length
            if field.type in NUMBERS and count:
                walk.number(name, NUMBERS[field.type], count)
                continue
            for i in range(count):
                self._item(walk, field.type, owner, f'{name}[{i}]')

    def _item(self, walk: '_Walk', kind: str, owner: str, name: str) -> None:
        if kind in NUMBERS:
            walk.number(name, NUMBERS[kind], None)
        elif kind == 'string':
            walk.string(name)
        else:
            self._walk(walk, kind, owner, f'{name}.')


class _Walk:
    """Goes through one message, noting what stands where."""

    def __init__(self, data: bytes) -> None:
        if data[:2] != b'\x00\x01':
            raise LogError('a message is not plain little-endian CDR')
        self._data = data
        self._at = _HEADER_SIZE
        self.places: list[Place] = []
        self.lengths: list[int] = []

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

    """
    schema, count = Schema(definition), len(messages)
    result: dict[str, NDArray[Any]] = {}
    left = list(range(count))
    while left:
        first = messages[left[0]]
        places, lengths = schema.layout(first)
        same = [i for i in left if len(messages[i]) == len(first)]
        table = np.frombuffer(b''.join([messages[i] for i in same]), np.uint8)
        table = table.reshape(len(same), len(first))
        words = [at + byte for at in lengths for byte in range(4)]
        alike = (table[:, words] == table[0, words]).all(axis=1)
        rows, table = np.array(same)[alike], table[alike]
        for place in places:
            _fill(result, place, count, rows, table)
        left = sorted(set(left) - set(rows.tolist()))
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
