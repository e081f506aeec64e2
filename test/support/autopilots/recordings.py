# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Sessions with the real programs (PX4 1.17-alpha iris, ArduCopter and ArduSub 4.7-dev, SITL).

Parts of them: data/*.bin.gz. Records, little endian: direction (u8: 0 to the autopilot, 1 from
it), simulated time [ms] (u32), length (u16), bytes: of PX4 a TCP stream in portions, of ArduPilot
datagrams.
"""

import gzip
import struct
from pathlib import Path

DATA = Path(__file__).with_name('data')
_HEAD = struct.Struct('<BIH')
TO_AUTOPILOT, FROM_AUTOPILOT = 0, 1


def records(name: str) -> list[tuple[int, int, bytes]]:
    """Return (direction, time [ms], bytes) of every record."""
    data, at, found = gzip.decompress((DATA / name).read_bytes()), 0, []
    while at < len(data):
        direction, time_ms, length = _HEAD.unpack_from(data, at)
        at += _HEAD.size
        found.append((direction, time_ms, data[at : at + length]))
        at += length
    return found


def portions(name: str, direction: int) -> list[bytes]:
    return [data for way, _, data in records(name) if way == direction]
