"""
Outgoing messages as CDR templates that are patched in place.

A template is the serialised form of a message whose strings and sequence lengths never change.
It is written once, member by member in the order of the message definition, with zero padding
(the middleware's own serialiser leaves chance bytes there, which would make equal runs differ);
publishing copies the present numbers over it and hands the bytes to the middleware.
"""

import struct
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.physics.arrays import Array

_STAMP = struct.Struct('<iI')
#: Plain CDR, little endian.
_HEADER = b'\x00\x01\x00\x00'


class Template:
    """
    The bytes of one message, built member by member; a stamp stands first unless told otherwise.

    ``stamps`` and ``blocks`` are views of its stamps and of its runs of numbers that change, in
    the order of the ``stamp``, ``doubles`` and ``floats`` calls; they exist after ``finish``.
    """

    def __init__(self, stamped: bool = True) -> None:
        self._buffer = bytearray(_HEADER)
        self._stamps: list[int] = []
        self._places: list[tuple[int, int]] = []
        self.padding: list[int] = []
        self.blocks: list[memoryview] = []
        self.stamps: list[memoryview] = []
        if stamped:
            self.stamp()

    def _align(self, size: int) -> None:
        gap = -(len(self._buffer) - len(_HEADER)) % size
        self.padding += range(len(self._buffer), len(self._buffer) + gap)
        self._buffer += bytes(gap)

    def stamp(self) -> 'Template':
        """Append a stamp that changes."""
        self._align(4)
        self._stamps.append(len(self._buffer))
        self._buffer += bytes(_STAMP.size)
        return self

    def uint32(self, value: int) -> 'Template':
        """Append an unsigned 32-bit integer (also a sequence's length)."""
        self._align(4)
        self._buffer += struct.pack('<I', value)
        return self

    def number(self, code: str, value: float) -> 'Template':
        """Append a number that stays, of a type of ``struct``."""
        size = struct.calcsize(code)
        self._align(size)
        self._buffer += struct.pack('<' + code, value)
        return self

    def string(self, value: str) -> 'Template':
        """Append a string."""
        text = value.encode() + b'\x00'
        self.uint32(len(text))
        self._buffer += text
        return self

    def doubles(self, count: int) -> 'Template':
        """Append doubles that change: a block."""
        return self._block(8, count)

    def floats(self, count: int) -> 'Template':
        """Append single-precision numbers that change: a block."""
        return self._block(4, count)

    def _block(self, size: int, count: int) -> 'Template':
        self._align(size)
        self._places.append((len(self._buffer), size * count))
        self._buffer += bytes(size * count)
        return self

    def constants(self, values: Sequence[float]) -> 'Template':
        """Append doubles that stay."""
        self._align(8)
        self._buffer += struct.pack(f'<{len(values)}d', *values)
        return self

    def finish(self) -> 'Template':
        """End the message; its size is fixed from here on."""
        view = memoryview(self._buffer)
        self.stamps = [view[start : start + _STAMP.size] for start in self._stamps]
        self.blocks = [view[start : start + size] for start, size in self._places]
        return self

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


def as_bytes(numbers: Array | NDArray[np.float32]) -> memoryview:
    """Return a view of a contiguous array's bytes that follows the array's values."""
    return memoryview(numbers.reshape(-1)).cast('B')  # type: ignore[arg-type]


def odometry(
    vehicle: str, pose_variance: Sequence[float], twist_variance: Sequence[float]
) -> Template:
    """Return nav_msgs/Odometry with blocks: position (3), orientation xyzw (4), twist (6)."""
    return (
        Template()
        .string(f'{vehicle}/odom')
        .string(f'{vehicle}/base_link')
        .doubles(3)
        .doubles(4)
        .constants(np.diag(pose_variance).ravel().tolist())
        .doubles(6)
        .constants(np.diag(twist_variance).ravel().tolist())
        .finish()
    )


def wrench(frame: str) -> Template:
    """Return geometry_msgs/WrenchStamped with one block: force and torque (6)."""
    return Template().string(frame).doubles(6).finish()


def twist(frame: str) -> Template:
    """Return geometry_msgs/TwistStamped with one block: linear velocity (3)."""
    return Template().string(frame).doubles(3).constants([0.0, 0.0, 0.0]).finish()


def clock() -> Template:
    """Return rosgraph_msgs/Clock."""
    return Template().finish()


def joint_state(names: Sequence[str]) -> Template:
    """Return sensor_msgs/JointState with blocks: position, velocity, effort (one per name)."""
    template = Template().string('').uint32(len(names))
    for name in names:
        template.string(name)
    for _ in range(3):
        template.uint32(len(names)).doubles(len(names))
    return template.finish()


def transforms(children: Mapping[str, str]) -> Template:
    """
    Return tf2_msgs/TFMessage with a transform per child -> parent frame.

    Blocks: translation (3) and rotation xyzw (4) of each.
    """
    template = Template(stamped=False).uint32(len(children))
    for child, parent in children.items():
        template.stamp().string(parent).string(child).doubles(3).doubles(4)
    return template.finish()


def joint_command(names: Sequence[str]) -> Template:
    """Return sensor_msgs/JointState that commands positions: one block (one per name)."""
    template = Template().string('').uint32(len(names))
    for name in names:
        template.string(name)
    template.uint32(len(names))
    if names:  # an empty sequence aligns nothing behind it
        template.doubles(len(names))
    return template.uint32(0).uint32(0).finish()


def multi_array(size: int) -> Template:
    """Return std_msgs/Float64MultiArray without a layout, with one block (of ``size``)."""
    template = Template(stamped=False).uint32(0).uint32(0).uint32(size)
    if size:
        template.doubles(size)
    return template.finish()
