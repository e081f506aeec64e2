# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the sockets of both autopilots share: how they listen, and how they wait."""

import os
import select
import socket
import time
from typing import Any

from fluid_sim_ros.errors import ConfigError

#: A peer that answers within this time is waited for without sleeping [s]: to fall asleep and wake
#: takes as long, and leaves a processor that is slower for a while.
_QUICK = 200e-6
#: Connections that the system keeps until they are taken in; idle ones leave room for more.
_QUEUE = 128


def listen(kind: Any, address: str, port: int, what: str) -> socket.socket:
    """
    Return a socket that is bound to a port, listens where its kind does, and never blocks.

    Parameters
    ----------
    kind
        ``SOCK_STREAM`` or ``SOCK_DGRAM``.
    address, port
        Where to listen; port 0 lets the system choose.
    what
        Beginning of the error's message.

    Returns
    -------
    socket
        To be closed by the caller.

    Raises
    ------
    ConfigError
        If the port is in use or the address is not one of this host.

    """
    family = socket.AF_INET6 if ':' in address else socket.AF_INET
    listener = socket.socket(family, kind)
    try:
        if kind == socket.SOCK_STREAM:  # a port may be taken again right after a run
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((address, port))
        if kind == socket.SOCK_STREAM:
            listener.listen(_QUEUE)
    except (OSError, OverflowError) as error:
        listener.close()
        reason = getattr(error, 'strerror', None) or error
        raise ConfigError(
            f'{what} cannot listen on {address} port {port}: {reason}; end the other simulator, '
            'or choose another instance or port'
        ) from None
    listener.setblocking(False)
    return listener


def is_alone() -> bool:
    """Return whether this process may use one processor only."""
    return len(os.sched_getaffinity(0)) < 2


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
        self._alone = is_alone()
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
