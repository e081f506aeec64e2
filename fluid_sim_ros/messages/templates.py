# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Outgoing messages as CDR templates that are patched in place.

A template is the serialised form of a message whose strings and sequence lengths never change.
It is written once, member by member in the order of the message definition, with zero padding
(the middleware's own serialiser leaves chance bytes there, which would make equal runs differ);
publishing copies the present numbers over it and hands the bytes to the middleware.
"""

import struct
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from numpy.typing import NDArray

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.messages.members import NUMBERS, Member, message_type

_STAMP = struct.Struct('<iI')
#: Plain CDR, little endian.
_HEADER = b'\x00\x01\x00\x00'
_TIME = 'builtin_interfaces/Time'

#: Numbers that follow each other in a block: one contiguous array, or several.
Source = NDArray[Any] | tuple[NDArray[Any], ...]


class Template:
    """
    The bytes of one message; made by ``Template.of``.

    Parameters
    ----------
    buffer
        The message as written (CDR).
    stamps
        Where its stamps begin [bytes].
    blocks
        Where its runs of numbers that change begin and end [bytes].
    padding
        See below.

    Attributes
    ----------
    stamps
        Views of its stamps (every builtin_interfaces/Time that is not given), in the order of the
        definition.
    blocks
        Views of its runs of numbers that change, in the order in which they were asked for.
    padding
        Offsets of the bytes between members, which are zero.
    buffer
        The message as it now stands.

    """

    def __init__(
        self,
        buffer: bytearray,
        stamps: Sequence[int],
        blocks: Sequence[tuple[int, int]],
        padding: Sequence[int],
    ) -> None:
        self.buffer = buffer
        self.padding = padding
        view = memoryview(buffer)
        self.stamps = [view[start : start + _STAMP.size] for start in stamps]
        self.blocks = [view[start:stop] for start, stop in blocks]

    @classmethod
    def of(
        cls, message: str, constants: Mapping[str, Any] | None = None, blocks: Sequence[str] = ()
    ) -> 'Template':
        """
        Return the template of a message type.

        Parameters
        ----------
        message
            Message type, ``package/msg/Name``.
        constants
            Values of members by their dotted names, such as ``header.frame_id``; a message may be
            given as a mapping, a sequence of messages as a list of mappings. What is not given
            has the default of the definition: 0, the empty string, the empty sequence.
        blocks
            Dotted names of the members whose numbers change, such as ``pose.pose.position`` or
            ``markers[0].points``; a sequence has the length that ``constants`` gives it.

        Returns
        -------
        Template
            Its bytes, and views of what changes.

        Raises
        ------
        ConfigError
            If the definition is not kept, there is no such member, a value does not fit, or the
            numbers of a block do not lie side by side.

        """
        writer = _Writer(message, constants or {}, blocks)
        return cls(
            writer.buffer, writer.stamps, [writer.blocks[name] for name in blocks], writer.padding
        )

    def bytes(self) -> bytes:
        """Return the message as it now stands."""
        return bytes(self.buffer)

    def copies(self, sources: Sequence[Source]) -> list[tuple[memoryview, memoryview]]:
        """
        Return what to copy where, so that the blocks hold the present values of arrays.

        Parameters
        ----------
        sources
            One per block: contiguous arrays of the block's own type of number.

        Returns
        -------
        list
            Pairs of a target in this template and a source, both views.

        Raises
        ------
        ConfigError
            If a source has another size than its block.

        """
        pairs = []
        for block, source in zip(self.blocks, sources, strict=True):
            start = 0
            for numbers in source if isinstance(source, tuple) else (source,):
                view = as_bytes(numbers)
                pairs.append((block[start : start + len(view)], view))
                start += len(view)
            if start != len(block):
                raise ConfigError(f'a block of {len(block)} bytes was given {start} bytes')
        return pairs


class _Writer:
    """Writes a message once, noting where stamps, blocks and padding lie."""

    def __init__(self, message: str, constants: Mapping[str, Any], blocks: Sequence[str]) -> None:
        self._message = message
        self._types = message_type(message)
        self._given = dict(constants)
        self._wanted = set(blocks)
        self.buffer = bytearray(_HEADER)
        self.stamps: list[int] = []
        self.blocks: dict[str, tuple[int, int]] = {}
        self.padding: list[int] = []
        self._numbers: list[tuple[int, int]] = []  # where runs of numbers begin and end
        self._open = 0  # blocks within which we are: only numbers may stand there
        self._write_members('', '', '')
        unknown = [*self._given, *(self._wanted - self.blocks.keys())]
        if unknown:
            has = listed(member.name for member in self._types.members()[1])
            raise ConfigError(f'{message} has no member {listed(unknown)}; it has: {has}')

    def _write_members(self, kind: str, owner: str, prefix: str) -> None:
        owner, members = self._types.members(kind, owner)
        for member in members:
            name = f'{prefix}{member.name}'
            if name not in self._wanted:
                self._write(member, owner, name)
                continue
            before, self._open = len(self._numbers), self._open + 1
            self._write(member, owner, name)
            self._open -= 1
            self.blocks[name] = self._span(name, self._numbers[before:])

    def _span(self, name: str, runs: Sequence[tuple[int, int]]) -> tuple[int, int]:
        """Return where a block begins and ends."""
        for (_, stop), (start, _) in pairwise(runs):
            if stop != start:
                raise self._fault(name, 'its numbers do not lie side by side')
        return (runs[0][0], runs[-1][1]) if runs else (len(self.buffer), len(self.buffer))

    def _write(self, member: Member, owner: str, name: str) -> None:
        value = self._given.pop(name, None)
        if value is None:
            value = member.default_value()
        if member.length is None:
            self._write_one(member.type, owner, name, value)
            return
        values = () if value is None else value
        if member.length < 0:
            self._pack('I', [len(values)])
        elif value is None:
            values = (None,) * member.length
        elif len(values) != member.length:
            raise self._fault(name, f'{len(values)} values, needs {member.length}')
        if member.type in NUMBERS:
            self._write_numbers(
                name, NUMBERS[member.type], [0 if v is None else v for v in values]
            )
            return
        for i, item in enumerate(values):
            self._write_one(member.type, owner, f'{name}[{i}]', item)

    def _write_one(self, kind: str, owner: str, name: str, value: Any) -> None:
        if kind in NUMBERS:
            self._write_numbers(name, NUMBERS[kind], [0 if value is None else value])
        elif kind == 'string':
            self._only_numbers(name)
            text = (value or '').encode() + b'\x00'
            self._pack('I', [len(text)])
            self.buffer += text
        elif value is None and kind == _TIME:
            self._only_numbers(name)
            self._align(4)
            self.stamps.append(len(self.buffer))
            self.buffer += bytes(_STAMP.size)
        else:
            for key, item in (value or {}).items():
                self._given[f'{name}.{key}'] = item
            self._write_members(kind, owner, f'{name}.')

    def _only_numbers(self, name: str) -> None:
        if self._open:
            raise self._fault(name, 'stands in a block, which holds only numbers')

    def _write_numbers(self, name: str, code: str, values: Sequence[float]) -> None:
        if not values:  # an empty sequence aligns nothing behind it
            return
        try:
            start = self._pack(code, values)
        except struct.error as error:
            raise self._fault(name, str(error)) from None
        self._numbers.append((start, len(self.buffer)))

    def _pack(self, code: str, values: Sequence[float]) -> int:
        """Write numbers of one type; return where they begin."""
        data = struct.pack(f'<{len(values)}{code}', *values)
        self._align(len(data) // len(values))
        start = len(self.buffer)
        self.buffer += data
        return start

    def _align(self, size: int) -> None:
        gap = -(len(self.buffer) - len(_HEADER)) % size
        self.padding += range(len(self.buffer), len(self.buffer) + gap)
        self.buffer += bytes(gap)

    def _fault(self, name: str, fault: str) -> ConfigError:
        return ConfigError(f'{self._message}: {name}: {fault}')


class StampBytes:
    """The present stamp, packed once per tick for all templates."""

    def __init__(self) -> None:
        self._buffer = bytearray(_STAMP.size)
        self.view = memoryview(self._buffer)

    def set(self, time_ns: int) -> None:
        """
        Hold a time.

        Parameters
        ----------
        time_ns
            [ns].

        """
        _STAMP.pack_into(self._buffer, 0, *divmod(time_ns, 1_000_000_000))


def as_bytes(numbers: NDArray[Any]) -> memoryview:
    """
    Return a view of an array's bytes that follows the array's values.

    Parameters
    ----------
    numbers
        Contiguous array, any shape.

    Returns
    -------
    memoryview
        Its bytes.

    """
    return memoryview(numbers.reshape(-1)).cast('B')  # type: ignore[arg-type]
