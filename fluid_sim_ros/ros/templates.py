"""
Outgoing messages as CDR templates that are patched in place.

A template is the serialised form of a message whose strings and sequence lengths never change.
Its doubles are found once by sentinels, so no byte offset is written down here; publishing copies
the present numbers over them and hands the bytes to the middleware.
"""

import struct
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from geometry_msgs.msg import TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from numpy.typing import NDArray
from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

# Any double that no message holds by default.
_SENTINEL = 1.2345678e77
_STAMP = struct.Struct('<iI')
#: The stamp is the first member of every stamped message: right behind the CDR header.
_STAMP_OFFSET = 4

Array = NDArray[np.float64]


class Template:
    """
    The bytes of one message; ``blocks`` are views of its runs of doubles.

    Parameters
    ----------
    message
        The message with everything constant filled in.
    blocks
        For each run of doubles: a function that puts a value into its first double, and its
        length in doubles.

    """

    def __init__(
        self, message: Any, blocks: Sequence[tuple[Callable[[float], None], int]]
    ) -> None:
        plain = serialize_message(message)
        self._buffer = bytearray(plain)
        view = memoryview(self._buffer)
        self.stamp = view[_STAMP_OFFSET : _STAMP_OFFSET + _STAMP.size]
        self.blocks = []
        for mark, length in blocks:
            mark(_SENTINEL)
            start = serialize_message(message).find(struct.pack('<d', _SENTINEL))
            mark(0.0)
            if start < 0:
                raise ValueError('a block of the template is not among the message bytes')
            self.blocks.append(view[start : start + 8 * length])

    def bytes(self) -> bytes:
        """Return the message as it now stands."""
        return bytes(self._buffer)


class StampBytes:
    """The present stamp, packed once per tick for all templates."""

    def __init__(self) -> None:
        self._buffer = bytearray(_STAMP.size)
        self.view = memoryview(self._buffer)

    def set(self, time_ns: int) -> None:
        """Hold a time [ns]."""
        _STAMP.pack_into(self._buffer, 0, *divmod(time_ns, 1_000_000_000))


def as_bytes(numbers: Array) -> memoryview:
    """Return a view of a contiguous array's bytes that follows the array's values."""
    return memoryview(numbers.reshape(-1)).cast('B')  # type: ignore[arg-type]


def odometry(vehicle: str, pose_variance: Sequence[float], twist_variance: Sequence[float]) -> Template:
    """Return nav_msgs/Odometry with blocks: position, orientation (xyzw), twist (6)."""
    message = Odometry()
    message.header.frame_id = f'{vehicle}/odom'
    message.child_frame_id = f'{vehicle}/base_link'
    message.pose.covariance = np.diag(pose_variance).ravel()
    message.twist.covariance = np.diag(twist_variance).ravel()
    pose, twist = message.pose.pose, message.twist.twist
    return Template(
        message,
        [
            (lambda x: setattr(pose.position, 'x', x), 3),
            (lambda x: setattr(pose.orientation, 'x', x), 4),
            (lambda x: setattr(twist.linear, 'x', x), 6),
        ],
    )


def wrench(frame: str) -> Template:
    """Return geometry_msgs/WrenchStamped with one block: force and torque (6)."""
    message = WrenchStamped()
    message.header.frame_id = frame
    return Template(message, [(lambda x: setattr(message.wrench.force, 'x', x), 6)])


def twist(frame: str) -> Template:
    """Return geometry_msgs/TwistStamped with one block: linear velocity (3)."""
    message = TwistStamped()
    message.header.frame_id = frame
    return Template(message, [(lambda x: setattr(message.twist.linear, 'x', x), 3)])


def clock() -> Template:
    """Return rosgraph_msgs/Clock."""
    return Template(Clock(), [])


def joint_state(names: Sequence[str]) -> Template:
    """Return sensor_msgs/JointState with blocks: position, velocity, effort (one per name)."""
    count = len(names)
    message = JointState()
    message.name = list(names)
    message.position = [0.0] * count
    message.velocity = [0.0] * count
    message.effort = [0.0] * count

    def mark(field: str) -> Callable[[float], None]:
        def put(value: float) -> None:
            getattr(message, field)[0] = value

        return put

    return Template(message, [(mark(f), count) for f in ('position', 'velocity', 'effort')])
