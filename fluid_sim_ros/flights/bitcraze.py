# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Bitcraze's logs of the uSD deck, as a Crazyflie writes them.

0xBC, a 16-bit version, a 16-bit count of event types; each type: 16-bit number, name, 16-bit
count of variables, each ``name(t)`` with a letter of Python's struct. Then events: 16-bit type,
time (version 1: 32 bits [ms], 2: 64 bits [us]), packed values. The last four bytes are the CRC-32
of all before.
https://www.bitcraze.io/documentation/repository/crazyflie-firmware/master/userguides/tuning/
"""

import re
import struct
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import printable
from fluid_sim_ros.flights.flight import FlightError, RawLog, Stream

MAGIC = 0xBC
#: Letters of struct that a variable may have.
_LETTERS = 'bBhHiIlLqQfd'
_VARIABLE = re.compile(rf'(.*)\(([{_LETTERS}])\)')
#: Version -> letter and length [bytes] of the time, and its unit [s].
_TIMES = {1: ('I', 4, 1e-3), 2: ('Q', 8, 1e-6)}
_MOST_TYPES, _MOST_VARIABLES, _LONGEST_NAME = 4096, 4096, 256


@dataclass
class _Event:
    """One type of event: how its values are packed, and those found."""

    name: str
    variables: list[str]
    packed: struct.Struct
    rows: list[tuple[Any, ...]] = field(default_factory=list)


def read_bitcraze(path: Path, content: bytes) -> RawLog:
    """
    Read a log of the uSD deck.

    Parameters
    ----------
    path
        Of the file, for errors.
    content
        The whole file.

    Returns
    -------
    RawLog
        One stream per event type; where the checksum does not hold, all before the first event
        that is not whole.

    Raises
    ------
    FlightError
        If the header is damaged, or the version is not known.

    """
    try:
        version, types, at = _header(content)
    except (struct.error, ValueError, IndexError) as error:
        raise FlightError(f'{path}: the header of this uSD log is damaged ({error})') from None
    letter, size, unit = _TIMES[version]
    faults = []
    if zlib.crc32(content[:-4]) != struct.unpack('<I', content[-4:])[0]:
        faults.append('the checksum does not hold: cut off or damaged; what is whole is read')
    end = len(content) - 4
    head = struct.Struct(f'<H{letter}')
    while at + 2 + size <= end:
        number, time = head.unpack_from(content, at)
        event = types.get(number)
        at += 2 + size
        if event is None or at + event.packed.size > end:
            faults.append(f'byte {at - 2 - size}: no whole event; the rest is left out')
            break
        event.rows.append((time, *event.packed.unpack_from(content, at)))
        at += event.packed.size
    return RawLog(
        path, f'Bitcraze uSD log, version {version}', 'bitcraze',
        {event.name: _stream(event, unit) for event in types.values()},
        {'vehicle': 'Crazyflie'}, tuple(faults),
    )  # fmt: skip


def _stream(event: _Event, unit: float) -> Stream:
    table = np.array(event.rows, dtype=np.float64).reshape(-1, 1 + len(event.variables))
    columns = {name: table[:, 1 + i] for i, name in enumerate(event.variables)}
    return Stream(table[:, 0] * unit, columns)


def _header(content: bytes) -> tuple[int, dict[int, _Event], int]:
    """Return version, types by number, and where events begin; ValueError says what is wrong."""
    version, count = struct.unpack_from('<HH', content, 1)
    if version not in _TIMES:
        raise ValueError(f'version {version}; known: 1, 2')
    if count > _MOST_TYPES:
        raise ValueError(f'{count} event types')
    types: dict[int, _Event] = {}
    at = 5
    for _ in range(count):
        (number,) = struct.unpack_from('<H', content, at)
        name, at = _name(content, at + 2)
        (variables,) = struct.unpack_from('<H', content, at)
        if variables > _MOST_VARIABLES:
            raise ValueError(f'{variables} variables')
        at += 2
        names, letters = [], '<'
        for _ in range(variables):
            text, at = _name(content, at)
            match = _VARIABLE.fullmatch(text)
            if match is None:
                raise ValueError(f'variable {printable(text, 60)!r}')
            names.append(match[1])
            letters += match[2]
        types[number] = _Event(name, names, struct.Struct(letters))
    return version, types, at


def _name(content: bytes, at: int) -> tuple[str, int]:
    end = content.index(0, at, at + _LONGEST_NAME)
    return content[at:end].decode('utf-8', 'replace'), end + 1
