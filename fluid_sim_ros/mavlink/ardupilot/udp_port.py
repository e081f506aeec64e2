# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The port that ArduPilot sends its packets to.

It waits no longer than it is told, reads bounded datagrams, and never raises for what a peer does.
While a peer is there the system drops what others send: a flood neither costs time nor fills the
queue.
"""

import socket
from typing import Any

from fluid_sim_ros.mavlink import kernel_sockets
from fluid_sim_ros.mavlink.sockets import Watch, listen

#: Bytes and their sender.
Datagram = tuple[bytes, Any]


class UdpPort:
    """
    Takes datagrams on a port.

    Parameters
    ----------
    address, port
        Where to listen; port 0 lets the system choose.
    longest
        Largest datagram that is read whole [bytes]; of a longer one so much arrives that its
        length shows.

    Raises
    ------
    ConfigError
        If the port is in use or the address is not one of this host.

    """

    def __init__(self, address: str, port: int, longest: int) -> None:
        self._socket = listen(socket.SOCK_DGRAM, address, port, 'ardupilot')
        self.port: int = self._socket.getsockname()[1]
        self._longest = longest
        self._watch = Watch(self._socket)
        self._bound_to: Any = None

    def bind_to(self, peer: Any) -> None:
        """
        Hear one peer alone.

        Parameters
        ----------
        peer
            Address that ``receive`` gave; None: hear everybody again.

        """
        if peer == self._bound_to:
            return
        self._bound_to = peer
        try:
            if peer is None:
                kernel_sockets.disconnect(self._socket)
            else:
                self._socket.connect(peer)
        except OSError:  # its network has gone; then everybody is heard, and asked who they are
            return

    @property
    def socket(self) -> int:
        """Its file descriptor."""
        return self._socket.fileno()

    def receive(self, timeout: float) -> Datagram | None:
        """
        Return a datagram and its sender, or None when none came within ``timeout`` [s].

        Parameters
        ----------
        timeout
            Longest wait [s].

        Returns
        -------
        (bytes, address) or None
            The datagram and whom to answer.

        """
        if not self._watch.readable(timeout):
            return None
        try:
            data, sender = self._socket.recvfrom(self._longest + 1)
        except OSError:  # an earlier reply found nobody (ICMP), or it was withdrawn
            return None
        return data, sender

    def send(self, data: bytes, receiver: Any) -> None:
        """
        Send a datagram; a receiver that is not there is no error.

        Parameters
        ----------
        data
            One datagram.
        receiver
            Address that ``receive`` gave.

        """
        try:
            self._socket.sendto(data, receiver)
        except OSError:
            return

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()
