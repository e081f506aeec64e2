# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What Linux alone knows of sockets, or does with them.

Who listens, what a peer has not read; and a datagram socket that is connected to nobody again.
"""

import ctypes
import os
import socket
import struct
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

_TABLES = (Path('/proc/net/tcp'), Path('/proc/net/tcp6'))
_LISTEN = '0A'  # state of a socket that waits for connections


def unread(peer: tuple[str, int], ours: tuple[str, int]) -> int | None:
    """
    Return how many bytes wait in the socket of a peer of this host to be read.

    Parameters
    ----------
    peer, ours
        Address and port of either end of a connection.

    Returns
    -------
    int or None
        Bytes, or None where the peer is on another host.

    """
    ends = [_end(*peer), _end(*ours)]
    for local, remote, _, queues in _sockets():
        if [local, remote] == ends:
            return int(queues.partition(':')[2], 16)
    return None


def disconnect(connected: socket.socket) -> None:
    """
    Have a datagram socket hear everybody again; its own port stays.

    Parameters
    ----------
    connected
        A socket that ``connect`` has bound to a peer.

    Raises
    ------
    OSError
        Where the system cannot do that.

    """
    nobody = struct.pack('=H14x', socket.AF_UNSPEC)  # connect(2): dissolves the association
    library = ctypes.CDLL(None, use_errno=True)
    if library.connect(connected.fileno(), nobody, len(nobody)):
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))


def is_listening(port: int) -> bool:
    """
    Return whether a program of this host waits for TCP connections on a port.

    Parameters
    ----------
    port
        On any of the host's addresses.

    """
    wanted = f':{port:04X}'
    return any(state == _LISTEN and local.endswith(wanted) for local, _, state, _ in _sockets())


def _end(address: str, port: int) -> str:
    """Return an address as the tables have it: words of the machine's order, in hexadecimal."""
    family = socket.AF_INET6 if ':' in address else socket.AF_INET
    words = struct.iter_unpack('=I', socket.inet_pton(family, address))
    return ''.join(f'{word:08X}' for (word,) in words) + f':{port:04X}'


def _sockets() -> Iterator[tuple[str, str, str, str]]:
    """Give (local end, remote end, state, unsent:unread) of each socket."""
    for table in _TABLES:
        with suppress(OSError):  # another system than Linux, or no IPv6
            for line in table.read_text().splitlines()[1:]:
                _, local, remote, state, queues, *_ = line.split()
                yield local, remote, state, queues
