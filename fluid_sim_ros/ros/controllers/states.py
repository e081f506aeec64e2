# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads what a controller needs from an odometry message, straight from its CDR bytes."""

import struct
from functools import lru_cache
from typing import Any, NamedTuple

from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import CommandError

_HEADER = 4
#: Doubles of nav_msgs/Odometry: position 3, orientation 4, covariance 36, twist 6, covariance 36.
_TWIST_AT = 8 * (3 + 4 + 36)
_SIZE = _TWIST_AT + 8 * (6 + 36)
#: By the length of a message: its header, where its pose begins, its names, and its layout. The
#: messages of a vehicle differ in their numbers alone.
_seen: dict[int, tuple[bytes, int, bytes, struct.Struct]] = {}
_MOST_SEEN = 8
_ORDER = {b'\x00\x00': '>', b'\x00\x01': '<'}


class StampedState(NamedTuple):
    """
    A state as an odometry message has it.

    Attributes
    ----------
    stamp_ns
        [ns].
    state
        In the odometry's frame (the world's axes).

    """

    stamp_ns: int
    state: State


def read_odometry(data: bytes) -> StampedState:
    """
    Return the state in a nav_msgs/Odometry.

    Plain CDR (see ``cdr``); one function without a reader object, as it stands in the loop that
    answers every state.

    Parameters
    ----------
    data
        The message (CDR).

    Returns
    -------
    StampedState
        Its stamp [ns], and the state: pose in the odometry's frame, twist in base_link axes.

    Raises
    ------
    CommandError
        If the message is truncated or malformed.

    """
    known = _seen.get(len(data))
    if known is not None and data[:4] == known[0] and data[12 : known[1]] == known[2]:
        return _state(known[3].unpack_from(data))
    order = _ORDER.get(data[:2])
    if order is None:
        raise CommandError(f'malformed odometry: {len(data)} bytes without a plain CDR header')
    try:
        (length,) = struct.unpack_from(order + 'I', data, _HEADER + 8)
        second = 16 + length
        second += -(second - _HEADER) % 4
        (length,) = struct.unpack_from(order + 'I', data, second)
        at = second + 4 + length
        at += -(at - _HEADER) % 8
        if at + _SIZE > len(data):
            raise CommandError(
                f'malformed odometry: {len(data)} bytes, needs {at + _SIZE} or more'
            )
        layout = _layout(order, at)
    except struct.error:
        raise CommandError(f'malformed odometry: ends at byte {len(data)}') from None
    if len(_seen) < _MOST_SEEN:
        _seen[len(data)] = (data[:4], at, data[12:at], layout)
    return _state(layout.unpack_from(data))


def _state(numbers: tuple[Any, ...]) -> StampedState:
    seconds, nanoseconds, x, y, z, qx, qy, qz, qw, u, v, w, p, q, r = numbers
    stamp_ns = seconds * 1_000_000_000 + nanoseconds
    state = State(stamp_ns * 1e-9, (x, y, z), (qw, qx, qy, qz), (u, v, w), (p, q, r))
    return StampedState(stamp_ns, state)


@lru_cache(maxsize=8)
def _layout(order: str, at: int) -> struct.Struct:
    """Return the layout of stamp, pose and twist where the pose begins at a byte."""
    names, covariance = at - _HEADER - 8, _TWIST_AT - 8 * 7
    return struct.Struct(f'{order}{_HEADER}xiI{names}x7d{covariance}x6d')
