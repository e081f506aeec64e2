"""Reads what a controller needs from an odometry message, straight from its CDR bytes."""

import struct
from typing import NamedTuple

from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import CommandError

_HEADER = 4
#: Doubles of nav_msgs/Odometry: position 3, orientation 4, covariance 36, twist 6, covariance 36.
_TWIST_AT = 8 * (3 + 4 + 36)
_SIZE = _TWIST_AT + 8 * (6 + 36)
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
    order = _ORDER.get(data[:2])
    if order is None:
        raise CommandError(f'malformed odometry: {len(data)} bytes without a plain CDR header')
    try:
        seconds, nanoseconds, length = struct.unpack_from(order + 'iII', data, _HEADER)
        at = 16 + length
        at += -(at - _HEADER) % 4
        (length,) = struct.unpack_from(order + 'I', data, at)
        at += 4 + length
        at += -(at - _HEADER) % 8
        if at + _SIZE > len(data):
            raise CommandError(
                f'malformed odometry: {len(data)} bytes, needs {at + _SIZE} or more'
            )
        x, y, z, qx, qy, qz, qw = struct.unpack_from(order + '7d', data, at)
        twist = struct.unpack_from(order + '6d', data, at + _TWIST_AT)
    except struct.error:
        raise CommandError(f'malformed odometry: ends at byte {len(data)}') from None
    stamp_ns = seconds * 1_000_000_000 + nanoseconds
    state = State(stamp_ns * 1e-9, (x, y, z), (qw, qx, qy, qz), twist[:3], twist[3:])
    return StampedState(stamp_ns, state)
