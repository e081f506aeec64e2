"""
Asks a running ArduPilot for the parameters that make its frame, and compares.

A frame that is not the model's flies wrong in silence: the outputs of another one are possible
outputs of this one, too. ArduPilot serves MAVLink on its second serial port as well, TCP 5762; the
first one, 5760, is left to the ground station.
"""

import socket
import threading
import time
from collections.abc import Mapping

from fluid_sim_ros.mavlink.ardupilot.station import PORT_STEP

#: Where the first instance serves its second serial port.
SECOND_PORT = 5762
#: How long it is asked [s] of wall time, and how often.
_PATIENCE, _PERIOD = 60.0, 1.0
#: Parameters that say which output is which, and how wide its pulses are.
_PREFIXES = ('FRAME_', 'SERVO')


class FrameCheck:
    """
    Compares in a thread of its own.

    Parameters
    ----------
    instance
        Number of the autopilot on this host.
    parameters
        What the mapping states: value by name. Those of the frame are compared.

    """

    def __init__(self, instance: int, parameters: Mapping[str, float]) -> None:
        self._port = SECOND_PORT + PORT_STEP * instance
        self._wanted = {
            name: value for name, value in parameters.items() if name.startswith(_PREFIXES)
        }
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

    def differences(self) -> str:
        """Return once, when the answers are there, what differs in one line, or nothing."""
        if not self._done:
            return ''
        self._done = False
        wrong = [
            f'{name} is {self._found[name]:g}, and must be {value:g}'
            for name, value in self._wanted.items()
            if name in self._found and self._found[name] != value
        ]
        return f'ArduPilot flies another frame: {"; ".join(wrong)}' if wrong else ''

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
                with socket.create_connection(('127.0.0.1', self._port), _PERIOD) as link:
                    link.settimeout(_PERIOD)
                    while time.monotonic() < end and not self._stopped:
                        if self._exchange(link, mav, dialect):
                            return
            except OSError:  # it is not there yet, or another program has the port
                time.sleep(_PERIOD)

    def _exchange(self, link: socket.socket, mav: object, dialect: object) -> bool:
        """Ask for what is missing, and read for a while; True when all is known."""
        for name in self._wanted.keys() - self._found.keys():
            request = dialect.MAVLink_param_request_read_message(  # type: ignore[attr-defined]
                1, 1, name.encode(), -1
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
            for message in mav.parse_buffer(data) or ():  # type: ignore[attr-defined]
                if message.get_type() == 'PARAM_VALUE' and message.param_id in self._wanted:
                    self._found[message.param_id] = message.param_value
            if self._found.keys() == self._wanted.keys():
                self._done = True
                return True
        return False
