# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Asks a running autopilot for the parameters that its mapping states, and compares.

One that was started by hand, or that keeps what was set in an earlier flight, flies with others:
with another frame, or without the thrust that it needs. Nothing of that shows in its outputs,
which are possible outputs of the right ones, too. Both autopilots serve MAVLink's parameter
protocol (https://mavlink.io/en/services/parameter.html) on a link that no ground station takes.
"""

import math
import socket
import struct
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

#: How long it is asked [s] of wall time, and how often.
_PATIENCE, _PERIOD = 60.0, 1.0
#: Parameters that say which output is which, and how wide its pulses are.
_FRAME = ('FRAME_', 'SERVO')
#: What an autopilot learns by itself while it flies.
_LEARNED = frozenset({'MOT_THST_HOVER'})
#: MAV_PARAM_TYPE_INT32
_INT32 = 6
#: Values are 32-bit floating-point numbers on their way.
_EQUAL = 1e-6

#: Of a PARAM_VALUE's number and type its value; the autopilots pack integers in two ways.
Unpack = Callable[[float, int], float]


class ParameterCheck:
    """
    Compares in a thread of its own.

    Parameters
    ----------
    name
        What people call the autopilot.
    wanted
        What it must be set to: value by name.
    system
        MAVLink id of the autopilot's system.
    connect
        Opens the link: a connected socket, stream or datagrams.
    unpack
        ``cast_value`` or ``bytewise_value``.
    where
        The link in words.

    """

    def __init__(
        self,
        name: str,
        wanted: Mapping[str, float],
        system: int,
        connect: Callable[[], socket.socket],
        unpack: Unpack,
        where: str,
    ) -> None:
        self._name, self._system, self._where = name, system, where
        self._connect, self._unpack = connect, unpack
        self._wanted = {key: wanted[key] for key in wanted if key not in _LEARNED}
        self._thread: threading.Thread | None = None
        self._found: dict[str, float] = {}
        self._done = self._stopped = False

    def start(self) -> None:
        """Begin anew, as with another process; without pymavlink nothing is asked."""
        if self._wanted and (self._thread is None or not self._thread.is_alive()):
            self._found, self._done = {}, False
            self._thread = threading.Thread(target=self._ask, daemon=True)
            self._thread.start()

    def stop(self) -> None:
        """End the thread soon."""
        self._stopped = True

    def lines(self) -> dict[str, str]:
        """
        Return once, when the answers are there, what differs.

        Returns
        -------
        dict
            One line each of another frame (``frame``), of other parameters that differ
            (``parameters``), and of those that could not be read (``unread``); empty while
            nothing is known, and where nothing differs.

        """
        if not self._done:
            return {}
        self._done = False
        wrong = {
            name: f'{name} is {self._found[name]:g}, and must be {value:g}'
            for name, value in self._wanted.items()
            if name in self._found and not math.isclose(self._found[name], value, rel_tol=_EQUAL)
        }
        frame = [line for name, line in wrong.items() if name.startswith(_FRAME)]
        other = [line for name, line in wrong.items() if not name.startswith(_FRAME)]
        unread = [name for name in self._wanted if name not in self._found]
        lines = {}
        if frame:
            lines['frame'] = f'{self._name} flies another frame: {"; ".join(frame)}'
        if other:
            lines['parameters'] = (
                f'{self._name} is not set as its mapping states: {"; ".join(other)}; set it '
                'there, or state your own value in a mapping of your own'
            )
        if unread:
            lines['unread'] = (
                f'{self._name} did not say on {self._where} what it is set to; not compared '
                f'with the mapping: {", ".join(unread)}'
            )
        return lines

    def _ask(self) -> None:
        try:
            from pymavlink.dialects.v20 import common as dialect
        except ModuleNotFoundError:  # ArduPilot needs nothing that is not there anyway
            return
        mav = dialect.MAVLink(None, srcSystem=254, srcComponent=190)
        mav.robust_parsing = True
        end = time.monotonic() + _PATIENCE
        while time.monotonic() < end and not self._stopped:
            try:
                with self._connect() as link:
                    link.settimeout(_PERIOD)
                    while time.monotonic() < end and not self._stopped:
                        if self._exchange(link, mav, dialect):
                            self._done = True
                            return
            except OSError:  # it is not there yet, or another program has the port
                time.sleep(_PERIOD)
        self._done = not self._stopped

    def _exchange(self, link: socket.socket, mav: Any, dialect: Any) -> bool:
        """Ask for what is missing, and read for a while; True when all is known."""
        for name in self._wanted.keys() - self._found.keys():
            request = dialect.MAVLink_param_request_read_message(
                self._system, 1, name.encode(), -1
            )
            link.sendall(request.pack(mav))
        until = time.monotonic() + _PERIOD
        while time.monotonic() < until:
            try:
                data = link.recv(65536)
            except TimeoutError:
                break
            if not data:
                raise ConnectionResetError
            for message in mav.parse_buffer(data) or ():
                if message.get_type() == 'PARAM_VALUE' and message.param_id in self._wanted:
                    value = self._unpack(message.param_value, message.param_type)
                    self._found[message.param_id] = value
            if self._found.keys() == self._wanted.keys():
                return True
        return False


def cast_value(value: float, kind: int) -> float:
    """
    Return the value of a parameter that is sent as a number, as ArduPilot does.

    Parameters
    ----------
    value, kind
        ``param_value`` and ``param_type`` of PARAM_VALUE.

    Returns
    -------
    float
        The value.

    """
    del kind
    return value


def bytewise_value(value: float, kind: int) -> float:
    """
    Return the value of a parameter whose integers are sent as their bytes, as PX4 does.

    Parameters
    ----------
    value, kind
        ``param_value`` and ``param_type`` of PARAM_VALUE (MAV_PARAM_TYPE: 6 is INT32, 9 is
        REAL32).

    Returns
    -------
    float
        The value.

    """
    if kind != _INT32:
        return value
    (whole,) = struct.unpack('<i', struct.pack('<f', value))
    return float(whole)
