# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Whole frames of MAVLink 2, for the messages of every exchange; plugins/src/exchange has a twin.

Layout and checksum are the dialect's own; what is left out is the message object around them,
which takes most of the time. https://mavlink.io/en/guide/serialization.html has the frame.
"""

import struct
from collections.abc import Sequence
from typing import Any

from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.plugins.exchange import exchange_library

#: Magic, payload length, incompatible and compatible flags, sequence, system, component, id.
_HEAD = struct.Struct('<BBBBBBBHB')
_CHECKSUM = struct.Struct('<H')
_MAGIC = 0xFD
#: Upper triangle of a 6x6 covariance: places of its diagonal.
_DIAGONAL = (0, 6, 11, 15, 18, 20)


class Frame:
    """
    Packs and reads frames of one message whose fields stand in the order of their definition.

    Parameters
    ----------
    message
        Message class of the dialect.

    """

    def __init__(self, message: type[dialect.MAVLink_message]) -> None:
        self._id = message.id
        self._layout = message.unpacker
        self._extra = message.crc_extra
        self._sum = exchange_library().checksum

    def pack(self, sequence: int, system: int, component: int, *fields: Any) -> bytes:
        """
        Return the frame of a message; trailing zeros of its payload are left out.

        Parameters
        ----------
        sequence
            Number of the message on this connection, 0 to 255.
        system, component
            MAVLink ids of the sender.
        *fields
            In the order of the message's layout on the wire.

        Returns
        -------
        bytes
            The frame.

        """
        payload = self._layout.pack(*fields).rstrip(b'\0') or b'\0'
        head = _HEAD.pack(
            _MAGIC, len(payload), 0, 0, sequence, system, component, self._id & 0xFFFF,
            self._id >> 16,
        )  # fmt: skip
        frame = head + payload
        return frame + _CHECKSUM.pack(self._checksum(frame))

    def read(self, data: bytes) -> tuple[Any, ...] | None:
        """
        Return the fields where the bytes are one sound, unsigned frame of this message.

        Parameters
        ----------
        data
            Bytes that may be one frame.

        Returns
        -------
        fields or None
            In the order of the message's layout on the wire.

        """
        size, whole = len(data) - 12, self._layout.size
        if not 0 < size <= whole or data[0] != _MAGIC or data[1] != size or data[2]:
            return None
        if int.from_bytes(data[7:10], 'little') != self._id:
            return None
        if int.from_bytes(data[-2:], 'little') != self._checksum(data[:-2]):
            return None
        fields: tuple[Any, ...] = self._layout.unpack(data[10:-2].ljust(whole, b'\0'))
        return fields

    def _checksum(self, frame: bytes) -> int:
        return self._sum(frame[1:], len(frame) - 1, self._extra)


def triangle(variances: Sequence[float]) -> list[float]:
    """
    Return the upper triangle of a diagonal 6x6 covariance, row by row.

    Parameters
    ----------
    variances
        Of its diagonal, six numbers of any unit.

    """
    numbers = [0.0] * 21
    for place, variance in zip(_DIAGONAL, variances, strict=True):
        numbers[place] = variance
    return numbers
