"""
The server that PX4 connects to, for one client.

It waits no longer than it is told, reads bounded portions, and never raises for what a peer does:
a peer that goes away, or sends too fast or nothing, is a state.
"""

import select
import socket

from fluid_sim_ros.mavlink import kernel_sockets
from fluid_sim_ros.mavlink.sockets import Watch, listen

#: Largest portion read at once [bytes].
_PORTION = 65536
#: What a peer that does not read may leave unsent on our side before it counts as stuck [bytes].
_LARGEST_BACKLOG = 65536


class TcpServer:
    """
    Accepts one client at a time on a port; further ones wait in the queue, or are refused.

    Parameters
    ----------
    address, port
        Where to listen; port 0 lets the system choose.

    Attributes
    ----------
    port
        Where it listens.
    peer
        Address of the client, or ''.

    Raises
    ------
    ConfigError
        If the port is in use or the address is not one of this host.

    """

    def __init__(self, address: str, port: int) -> None:
        self._listener = listen(socket.SOCK_STREAM, address, port, 'px4')
        self.port: int = self._listener.getsockname()[1]
        self._client: socket.socket | None = None
        self._watch: Watch | None = None
        self._backlog = b''
        self.peer = ''

    @property
    def connected(self) -> bool:
        """Whether there is a client."""
        return self._client is not None

    @property
    def stuck(self) -> bool:
        """Whether the client has left so much unread that nothing more is to be sent."""
        return len(self._backlog) > _LARGEST_BACKLOG

    @property
    def reads(self) -> bool | None:
        """Whether the client has read all that was sent, None where that cannot be known."""
        if self._client is None or self._backlog:
            return False
        left = kernel_sockets.unread(
            self._client.getpeername()[:2], self._client.getsockname()[:2]
        )
        return None if left is None else not left

    def accept(self, timeout: float) -> bool:
        """
        Wait up to ``timeout`` [s] for a client; return whether there is one.

        Parameters
        ----------
        timeout
            Longest wait [s].

        Returns
        -------
        bool
            Whether there is a client.

        """
        if self._client is None and select.select([self._listener], [], [], timeout)[0]:
            try:
                client, peer = self._listener.accept()
            except OSError:  # it went away again
                return False
            client.setblocking(False)
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            # beyond this a peer does not read: that shall show
            client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _LARGEST_BACKLOG)
            self._client, self._backlog = client, b''
            self.peer = f'{peer[0]}:{peer[1]}'
            self._watch = Watch(client)
        return self._client is not None

    def send(self, data: bytes = b'') -> None:
        """
        Send bytes; what the client does not take yet is kept and sent first next time.

        Parameters
        ----------
        data
            What to send; empty to try again what is left.

        """
        if self._client is None:
            return
        if self._backlog:
            data = self._backlog + data
        try:
            sent = self._client.send(data)
        except BlockingIOError:
            sent = 0
        except OSError:
            self.disconnect()
            return
        self._backlog = data[sent:]

    def receive(self, timeout: float) -> bytes | None:
        """
        Return what arrives within ``timeout`` [s], b'' for nothing, None when it has gone.

        Parameters
        ----------
        timeout
            Longest wait [s].

        Returns
        -------
        bytes or None
            At most 64 KiB.

        """
        client, watch = self._client, self._watch
        if client is None or watch is None:
            return None
        if not watch.readable(timeout):
            return b''
        try:
            data = client.recv(_PORTION)
        except BlockingIOError:
            return b''
        except OSError:
            data = b''
        if not data:
            self.disconnect()
            return None
        return data

    def disconnect(self) -> None:
        """Close the connection; go on listening."""
        if self._client is not None:
            self._client.close()
            self._client = self._watch = None
            self.peer = ''

    def close(self) -> None:
        """Close everything."""
        self.disconnect()
        self._listener.close()
