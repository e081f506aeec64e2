# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Bounds-checked readers of the CDR bytes that commands arrive as.

Plain CDR version 1 (OMG DDS-XTypes 1.3, section 7.4.3), as every ROS 2 middleware sends it: a
header of four bytes, then members in order, each aligned to its size counted from the header's
end. A truncated or malformed message raises CommandError and never reads past its end.
"""

import struct
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.physics.arrays import Array

HEADER_SIZE = 4
_ENDIANNESS = {b'\x00\x00': '>', b'\x00\x01': '<'}


class CdrReader:
    """
    Reads members one after another from a CDR message.

    Parameters
    ----------
    data
        The message with its header of four bytes.

    Raises
    ------
    CommandError
        If it has no plain CDR header; the methods raise it where the message ends too early.

    """

    def __init__(self, data: bytes) -> None:
        order = _ENDIANNESS.get(data[:2])
        if len(data) < HEADER_SIZE or order is None:
            raise CommandError(f'malformed message: {len(data)} bytes without a plain CDR header')
        self._data = data
        self._order = order
        self._position = HEADER_SIZE

    def _take(self, size: int, alignment: int) -> int:
        """Return the offset of the next ``size`` bytes and move past them."""
        offset = self._position
        offset += -(offset - HEADER_SIZE) % alignment
        if offset + size > len(self._data):
            raise CommandError(
                f'malformed message: ends at byte {len(self._data)}, needs {offset + size} or more'
            )
        self._position = offset + size
        return offset

    def int32(self) -> int:
        """Return a signed 32-bit integer."""
        return int(struct.unpack_from(self._order + 'i', self._data, self._take(4, 4))[0])

    def uint32(self) -> int:
        """Return an unsigned 32-bit integer (also every sequence length)."""
        return int(struct.unpack_from(self._order + 'I', self._data, self._take(4, 4))[0])

    def float64_array(self, length: int) -> Array:
        """
        Return doubles of a known number.

        Parameters
        ----------
        length
            How many.

        Returns
        -------
        Array
            Read-only, shape (length,).

        """
        if length == 0:
            return np.empty(0)
        offset = self._take(8 * length, 8)
        return np.frombuffer(self._data, self._order + 'f8', length, offset)

    def array32(self, kind: str) -> Array:
        """
        Return a sequence of four-byte numbers.

        Parameters
        ----------
        kind
            NumPy's code of their type: ``f4`` or ``i4``.

        Returns
        -------
        Array
            As doubles, shape (n,).

        """
        length = self.uint32()
        if length == 0:
            return np.empty(0)
        offset = self._take(4 * length, 4)
        return np.frombuffer(self._data, self._order + kind, length, offset).astype(np.float64)

    def float64_sequence(self) -> Array:
        """Return a sequence of doubles."""
        return self.float64_array(self.uint32())

    def string(self) -> str:
        """Return a string (length with its terminating zero, then UTF-8)."""
        size = self.uint32()
        offset = self._take(size, 1)
        text = self._data[offset : offset + size]
        try:
            return text.rstrip(b'\x00').decode()
        except UnicodeDecodeError:
            raise CommandError('malformed message: a string is not UTF-8') from None

    def string_sequence(self) -> list[str]:
        """Return a sequence of strings."""
        return [self.string() for _ in range(self.uint32())]

    def stamp_ns(self) -> int:
        """Return a builtin_interfaces/Time [ns]."""
        return self.int32() * 1_000_000_000 + self.uint32()


@dataclass(frozen=True)
class JointStateCommand:
    """A sensor_msgs/JointState."""

    stamp_ns: int
    names: list[str]
    position: Array
    velocity: Array
    effort: Array


@dataclass(frozen=True)
class PairCommand:
    """A stamped pair of vectors: geometry_msgs/WrenchStamped or TwistStamped."""

    stamp_ns: int
    frame: str
    first: Array
    second: Array


def read_float64_multi_array(data: bytes) -> Array:
    """
    Return the values of a std_msgs/Float64MultiArray; its layout is read past.

    Parameters
    ----------
    data
        The message (CDR).

    Returns
    -------
    Array
        Shape (n,), in the unit of the topic.

    Raises
    ------
    CommandError
        If the message is truncated or malformed.

    """
    reader = CdrReader(data)
    for _ in range(reader.uint32()):
        reader.string()
        reader.uint32()
        reader.uint32()
    reader.uint32()
    return reader.float64_sequence()


def read_joint_state(data: bytes) -> JointStateCommand:
    """
    Return a sensor_msgs/JointState.

    Parameters
    ----------
    data
        The message (CDR).

    Returns
    -------
    JointStateCommand
        Its stamp, names and lists.

    Raises
    ------
    CommandError
        If the message is truncated or malformed.

    """
    reader = CdrReader(data)
    stamp_ns = reader.stamp_ns()
    reader.string()
    return JointStateCommand(
        stamp_ns,
        reader.string_sequence(),
        reader.float64_sequence(),
        reader.float64_sequence(),
        reader.float64_sequence(),
    )


def read_joy(data: bytes) -> tuple[Array, Array]:
    """
    Return the axes and buttons of a sensor_msgs/Joy.

    Parameters
    ----------
    data
        The message (CDR).

    Returns
    -------
    axes, buttons
        Shapes (n,) and (m,); axes from -1 to 1.

    Raises
    ------
    CommandError
        If the message is truncated or malformed.

    """
    reader = CdrReader(data)
    reader.stamp_ns()
    reader.string()
    return reader.array32('f4'), reader.array32('i4')


def read_stamped_pair(data: bytes) -> PairCommand:
    """
    Return a geometry_msgs/WrenchStamped (force, torque) or TwistStamped (linear, angular).

    Parameters
    ----------
    data
        The message (CDR).

    Returns
    -------
    PairCommand
        Its stamp, frame, and both vectors in that frame, shape (3,) each: [N], [N m] or [m/s],
        [rad/s].

    Raises
    ------
    CommandError
        If the message is truncated or malformed.

    """
    reader = CdrReader(data)
    return PairCommand(
        reader.stamp_ns(), reader.string(), reader.float64_array(3), reader.float64_array(3)
    )


def read_pair(data: bytes) -> tuple[Array, Array]:
    """
    Return both vectors of a geometry_msgs/Twist.

    Parameters
    ----------
    data
        The message (CDR).

    Returns
    -------
    linear, angular
        [m/s] and [rad/s], shape (3,) each.

    Raises
    ------
    CommandError
        If the message is truncated or malformed.

    """
    reader = CdrReader(data)
    return reader.float64_array(3), reader.float64_array(3)
