"""
The two sockets that autopilots connect to: a TCP server for one client, and a UDP port.

Both wait no longer than they are told, read bounded portions, and never raise for what a peer
does: a peer that goes away, or sends too fast or nothing, is a state.
"""

import os
import select
import socket
import time
from typing import Any

from fluid_sim_ros.errors import ConfigError

#: Largest portion read at once [bytes].
_PORTION = 65536
#: What a peer that does not read may leave unsent on our side before it counts as stuck [bytes].
_LARGEST_BACKLOG = 65536

#: A peer that answers within this time is waited for without sleeping [s]: to fall asleep and wake
#: takes as long, and leaves a processor that is slower for a while.
_QUICK = 200e-6

#: Bytes and their sender.
Datagram = tuple[bytes, Any]


def _listen(kind: Any, address: str, port: int, what: str) -> socket.socket:
    family = socket.AF_INET6 if ':' in address else socket.AF_INET
    listener = socket.socket(family, kind)
    try:
        if kind == socket.SOCK_STREAM:  # a port may be taken again right after a run
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((address, port))
        if kind == socket.SOCK_STREAM:
            listener.listen(1)
    except (OSError, OverflowError) as error:
        listener.close()
        reason = getattr(error, 'strerror', None) or error
        raise ConfigError(
            f'{what} cannot listen on {address} port {port}: {reason}; end the other simulator, '
            'or choose another instance or port'
        ) from None
    listener.setblocking(False)
    return listener


class Watch:
    """
    Waits until a socket can be read; without sleeping while its peer is a quick one.

    Quick is who has answered within 200 us the last time, and only where this process may use
    more than one processor.

    Parameters
    ----------
    watched
        The socket, connected or bound.

    """

    def __init__(self, watched: socket.socket) -> None:
        self._readable = select.poll()
        self._readable.register(watched, select.POLLIN)
        self._alone = len(os.sched_getaffinity(0)) < 2
        self._quick = False

    def readable(self, timeout: float) -> bool:
        """
        Return whether there is something to read within ``timeout`` [s].

        Parameters
        ----------
        timeout
            Longest wait [s].

        """
        poll = self._readable.poll
        if timeout <= _QUICK:
            return bool(poll(max(0.0, timeout) * 1000.0))
        begin = time.perf_counter()
        while self._quick and time.perf_counter() - begin < _QUICK:
            if poll(0):
                return True
        found = bool(poll(timeout * 1000.0))
        self._quick = found and not self._alone and time.perf_counter() - begin < _QUICK
        return found


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
        self._listener = _listen(socket.SOCK_STREAM, address, port, 'px4')
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
        self._socket = _listen(socket.SOCK_DGRAM, address, port, 'ardupilot')
        self.port: int = self._socket.getsockname()[1]
        self._longest = longest
        self._watch = Watch(self._socket)

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
