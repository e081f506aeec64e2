# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Tells a PX4 that sends no outputs from one that is halted: it still reads what it gets."""

from collections.abc import Callable

from fluid_sim_ros.mavlink.px4.tcp_server import TcpServer
from fluid_sim_ros.mavlink.silence import REPORT_AFTER

#: A PX4 that reads all it gets for so long, and does not answer, sends no outputs [s].
_QUIET = 5.0


class Reading:
    """
    Sends a silent PX4 what has no effect, and watches whether it reads that.

    Parameters
    ----------
    server
        Its connection.

    """

    def __init__(self, server: TcpServer) -> None:
        self._server = server
        self.forget()

    def forget(self) -> None:
        """Begin anew: it has answered, or is another process."""
        self._probes = 0
        self._since: float | None = None  # [s] of silence

    @property
    def goes_on(self) -> bool:
        """Whether it has read the last of what it got."""
        return self._since is not None

    def look(self, seconds: float, probe: Callable[[], bytes]) -> bool:
        """
        Return whether it has read for so long that it is not halted.

        Parameters
        ----------
        seconds
            How long it is silent.
        probe
            Gives a message without effect.

        """
        if seconds < REPORT_AFTER * (self._probes + 1):
            return False
        if not self._server.reads:
            self._since = None
        elif self._since is None and self._probes:
            self._since = seconds - REPORT_AFTER
        self._probes += 1
        self._server.send(probe())
        return self._since is not None and seconds - self._since >= _QUIET
