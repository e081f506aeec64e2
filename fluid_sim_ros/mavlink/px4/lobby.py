# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Clients that wait for the place of the one that is served.

Whoever connects is taken in at once, so that idle ones do not fill the system's queue; who says
nothing for 5 s is sent away, and who speaks is served first. A PX4 speaks as soon as it is
connected.
"""

import socket
import time

#: A client that says nothing for so long is dropped [s].
QUIET = 5.0
#: Most that wait; of more the oldest silent one goes.
_MOST = 64


class Lobby:
    """
    Those who wait at a listener.

    Parameters
    ----------
    listener
        The listening socket; it does not block.

    """

    def __init__(self, listener: socket.socket) -> None:
        self._listener = listener
        self._silent: list[tuple[float, socket.socket]] = []  # since when [s], the oldest first
        self._speaking: list[socket.socket] = []

    @property
    def speaks(self) -> bool:
        """Whether one of them has spoken."""
        return bool(self._speaking)

    def look(self) -> None:
        """Take in who has come; find who speaks, has gone away, or was silent for too long."""
        now = time.monotonic()
        for _ in range(_MOST):  # those of a flood in turns
            client = self._accepted()
            if client is None:
                break
            self._silent.append((now, client))
        self._speaking = [client for client in self._speaking if _said(client)]
        left = []
        for since, client in self._silent:
            said = _said(client)
            if said:
                self._speaking.append(client)
            elif said is None and now - since < QUIET:
                left.append((since, client))
            else:
                client.close()
        for _, client in left[:-_MOST]:
            client.close()
        self._silent = left[-_MOST:]
        for client in self._speaking[_MOST:]:
            client.close()
        del self._speaking[_MOST:]

    def next(self) -> socket.socket | None:
        """Return who is served next: the first that has spoken, else the first; or None."""
        if self._speaking:
            return self._speaking.pop(0)
        return self._silent.pop(0)[1] if self._silent else None

    def close(self) -> None:
        """Send everybody away."""
        for client in [*self._speaking, *(client for _, client in self._silent)]:
            client.close()
        self._speaking, self._silent = [], []

    def _accepted(self) -> socket.socket | None:
        try:
            client = self._listener.accept()[0]
        except OSError:  # nobody, or gone again, or no file handle left
            return None
        client.setblocking(False)
        return client


def _said(client: socket.socket) -> bool | None:
    """Return whether a client has said something; None: not yet, False: it is gone."""
    try:
        return bool(client.recv(1, socket.MSG_PEEK))
    except BlockingIOError:
        return None
    except OSError:
        return False
