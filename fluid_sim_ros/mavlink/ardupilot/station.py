# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An ArduPilot that waits for a ground station before its first packet, and how that shows."""

import time

from fluid_sim_ros.mavlink.kernel_sockets import is_listening

#: Where the first instance waits for a ground station (TCP), and from one instance to the next.
STATION_PORT, PORT_STEP = 5760, 10
#: Where the first instance serves its second serial port, which no ground station takes.
SECOND_PORT = 5762
#: Between two looks at that port [s].
_LOOK_PERIOD = 1.0


def second_port(instance: int) -> tuple[str, int]:
    """
    Return where an instance serves MAVLink besides the ground station's port.

    Parameters
    ----------
    instance
        Number of the autopilot on this host.

    Returns
    -------
    address, port
        TCP.

    """
    return '127.0.0.1', SECOND_PORT + PORT_STEP * instance


class Station:
    """
    Looks at the port where ArduPilot waits for a ground station.

    Parameters
    ----------
    instance
        Number of the autopilot on this host.

    """

    def __init__(self, instance: int) -> None:
        self.port = STATION_PORT + PORT_STEP * instance
        self._seen = 0  # times in a row
        self._looked_at = time.monotonic()

    @property
    def waits(self) -> bool:
        """Whether a program of this host listens there."""
        return is_listening(self.port)

    @property
    def line(self) -> str:
        """What to say of one that waits."""
        return (
            f'something listens on TCP port {self.port} and sends no servo packets: ArduPilot '
            'waits there for a ground station; connect one, or start it with --serial0 tcp:0'
        )

    def look(self) -> bool:
        """Return once that ArduPilot waits; to be asked while nothing is heard of it."""
        now = time.monotonic()
        if now - self._looked_at < _LOOK_PERIOD:
            return False
        self._looked_at = now
        self._seen = self._seen + 1 if self.waits else 0
        return self._seen == 2  # one that does not wait listens there for a moment, too
