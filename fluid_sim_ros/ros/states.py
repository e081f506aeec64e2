"""Reads what a controller needs from an odometry message, straight from its CDR bytes."""

import math
import struct
from typing import NamedTuple

from fluid_sim_ros.errors import CommandError

_HEADER = 4
#: Doubles of nav_msgs/Odometry: position 3, orientation 4, covariance 36, twist 6, covariance 36.
_TWIST_AT = 8 * (3 + 4 + 36)
_SIZE = _TWIST_AT + 8 * (6 + 36)
_ORDER = {b'\x00\x00': '>', b'\x00\x01': '<'}


class State(NamedTuple):
    """
    State of a vehicle's base_link as its odometry has it.

    Attributes
    ----------
    stamp_ns
        [ns].
    position_w, quat_wb_wxyz
        Pose in the odometry's frame (the world's axes): [m]; body to world, scalar first.
    velocity_b, omega_b
        Twist, base_link axes [m/s], [rad/s].
    medium_w
        Velocity of the medium at the vehicle [m/s], world axes; zero where nobody asked for it.

    """

    stamp_ns: int
    position_w: tuple[float, ...]
    quat_wb_wxyz: tuple[float, ...]
    velocity_b: tuple[float, ...]
    omega_b: tuple[float, ...]
    medium_w: tuple[float, ...] = (0.0, 0.0, 0.0)

    def is_sound(self) -> bool:
        """Return whether every number is finite and the quaternion is near a unit one."""
        _, position, quat, velocity, omega, medium = self
        w, x, y, z = quat
        finite = math.isfinite(sum(position) + sum(velocity) + sum(omega) + sum(medium))
        return finite and 0.5 < w * w + x * x + y * y + z * z < 2.0


def read_odometry(data: bytes) -> State:
    """
    Return the state in a nav_msgs/Odometry.

    Plain CDR (see ``cdr``); one function without a reader object, as it stands in the loop that
    answers every state.

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
    return State(stamp_ns, (x, y, z), (qw, qx, qy, qz), twist[:3], twist[3:])
