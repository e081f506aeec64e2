# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The server that PX4 connects to, for one client.

It waits no longer than it is told, reads bounded portions, and never raises for what a peer does:
a peer that goes away, or sends too fast or nothing, is a state.
"""

import select
import socket
import time

from fluid_sim_ros.mavlink import kernel_sockets
from fluid_sim_ros.mavlink.px4 import lobby
from fluid_sim_ros.mavlink.sockets import Watch, listen

#: Largest portion read at once [bytes].
_PORTION = 65536
#: What a peer that does not read may leave unsent on our side before it counts as stuck [bytes].
_LARGEST_BACKLOG = 65536
#: Wall time between two looks at who else has come [s].
_LOOK_PERIOD = 0.1


class TcpServer:
    """
    Serves one client at a time on a port; further ones wait (``Lobby``).

    Parameters
    ----------
    address, port
        Where to listen; port 0 lets the system choose.

    Attributes
    ----------
    port
        Where it listens.
    peer, host
        Address of the client with and without its port, or ''.

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
        self._lobby = lobby.Lobby(self._listener)
        self._backlog = b''
        self._spoke = False
        self._asked_at: float | None = None  # since when it owes a word [s]
        self._look_at = 0.0
        self.peer = self.host = ''

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
        if self._client is not None:
            return True
        if not self._meet():
            select.select([self._listener], [], [], timeout)
            self._meet()
        return self._client is not None

    def _meet(self) -> bool:
        self._lobby.look()
        client = self._lobby.next()
        if client is None:
            return False
        try:
            peer = client.getpeername()
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            # beyond this a peer does not read: that shall show
            client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _LARGEST_BACKLOG)
        except OSError:  # it went away again
            client.close()
            return False
        self._client, self._backlog = client, b''
        self._spoke, self._asked_at = False, time.monotonic()
        self.peer, self.host = f'{peer[0]}:{peer[1]}', peer[0]
        self._watch = Watch(client)
        return True

    def displaced(self) -> str:
        """
        Return why the client loses its place, or ''; asked at each exchange.

        Who has never said a word gives way to one that speaks, and goes after 5 s in any case; who
        has spoken and owes an answer for 5 s gives way.
        """
        now = time.monotonic()
        if self._client is None or self._watch is None or now < self._look_at:
            return ''
        self._look_at = now + _LOOK_PERIOD
        self._lobby.look()
        if self._watch.readable(0.0) or self._asked_at is None:
            return ''
        silent = now - self._asked_at >= lobby.QUIET
        if not self._spoke and (silent or self._lobby.speaks):
            return f'{self.peer} has said nothing'
        if silent and self._lobby.speaks:
            return f'{self.peer} is silent, and another speaks'
        return ''

    @property
    def socket(self) -> int:
        """File descriptor of the client's connection; -1 without one."""
        return -1 if self._client is None else self._client.fileno()

    @property
    def held(self) -> bool:
        """Whether something is still to be sent before all else."""
        return bool(self._backlog)

    def asked(self, when: float) -> None:
        """
        Note that somebody else has sent to the client, which now owes a word.

        Parameters
        ----------
        when
            [s].

        """
        if self._asked_at is None:
            self._asked_at = when

    def heard(self) -> None:
        """Note that somebody else has read what the client has said."""
        self._spoke, self._asked_at = True, None

    def keep(self, data: bytes) -> None:
        """
        Keep what the client did not take, to be sent first next time.

        Parameters
        ----------
        data
            The rest of what was sent.

        """
        self._backlog = data

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
        if self._asked_at is None:
            self._asked_at = time.monotonic()
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
        self.heard()
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
        self._lobby.close()
        self._listener.close()
