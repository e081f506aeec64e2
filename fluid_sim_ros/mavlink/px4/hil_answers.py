# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The MAVLink 2 messages of PX4 to a simulator: outputs of the autopilot, and what is wrong.

The codec is pymavlink's ``common`` dialect; see https://mavlink.io/en/messages/common.html.
"""

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, field

from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.plugins.exchange import Px4Answer, exchange_library

#: First byte of a message of MAVLink 1.
MAVLINK1 = 0xFE
#: MAV_MODE_FLAG_SAFETYARMED of ``mode``, HIL_ACTUATOR_CONTROLS_FLAGS_LOCKSTEP of ``flags``.
ARMED, _LOCKSTEP = 128, 1
#: Message ids.
_ACTUATORS, _OLD_CONTROLS = 93, 91


@dataclass
class Actuators:
    """A HIL_ACTUATOR_CONTROLS: time [us], 16 outputs, armed, lockstep."""

    time_us: int
    controls: Sequence[float]
    armed: bool
    lockstep: bool


@dataclass
class Received:
    """What a portion of the stream held."""

    actuators: list[Actuators] = field(default_factory=list)
    messages: int = 0
    faults: list[str] = field(default_factory=list)


class HilReader:
    """Reads the stream of one autopilot, in portions of any size."""

    def __init__(self) -> None:
        self._mav = dialect.MAVLink(None)
        self._mav.robust_parsing = True
        self._answer = Px4Answer()
        self._address = ctypes.addressof(self._answer)
        self._read = exchange_library().px4_answer

    @property
    def idle(self) -> bool:
        """Whether no unfinished message waits for its rest."""
        return not self._mav.buf

    def receive(self, data: bytes) -> Received:
        """
        Read a portion of the stream; an unfinished message waits for the next portion.

        Parameters
        ----------
        data
            Bytes as they came from the socket; they may begin and end inside a message.

        Returns
        -------
        Received
            Actuator outputs, the number of messages, and one line for each fault.

        """
        received, mav = Received(), self._mav
        # most portions are one whole answer
        if not mav.buf and self._read(data, len(data), self._address):
            answer = self._answer
            received.messages = 1
            received.actuators.append(
                _actuators(answer.time_us, answer.controls[:], answer.mode, answer.flags)
            )
            return received
        for message in mav.parse_buffer(data) or ():
            kind = message.get_msgId()
            if kind == _ACTUATORS:
                received.messages += 1
                received.actuators.append(
                    _actuators(message.time_usec, message.controls, message.mode, message.flags)
                )
            elif kind == _OLD_CONTROLS:
                received.faults.append('HIL_CONTROLS: this PX4 is too old; it needs 1.9 or later')
            elif kind < 0:
                received.faults.append(_fault(message))
            else:
                received.messages += 1
        # the parser keeps what it has read until it has read all
        if mav.buf_index:
            del mav.buf[: mav.buf_index]
            mav.buf_index = 0
        return received


def _actuators(time_us: int, controls: Sequence[float], mode: int, flags: int) -> Actuators:
    return Actuators(time_us, controls, bool(mode & ARMED), bool(flags & _LOCKSTEP))


def _fault(message: dialect.MAVLink_message) -> str:
    data = message.data if message.get_type() == 'BAD_DATA' else b''
    if data[:1] == bytes([MAVLINK1]):
        return 'MAVLink 1: this autopilot is too old, or these are other bytes'
    return f'{len(data)} bytes are no MAVLink message'
