# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Work that other threads want done by the stepping thread, between two steps."""

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

from fluid_sim_ros.errors import FluidSimError

Result = TypeVar('Result')

#: How long a paused loop sleeps between looks at its surroundings [s].
IDLE_WAIT = 0.05


class RequestQueue:
    """
    Work that other threads want done between two steps (reset, pause, parameter changes).

    Parameters
    ----------
    on_arrival
        Called in the other thread when work has arrived, to wake the stepping thread.

    """

    def __init__(self, on_arrival: Callable[[], None] = lambda: None) -> None:
        self._waiting: deque[tuple[Callable[[], object], Future[object]]] = deque()
        self._arrived = threading.Event()
        self._on_arrival = on_arrival
        self._closed = False

    def call(self, work: Callable[[], Result], timeout: float) -> Result:
        """
        Have the stepping thread run ``work`` at its next step boundary and return its result.

        Parameters
        ----------
        work
            Called once, in the stepping thread.
        timeout
            Of wall time [s].

        Returns
        -------
        object
            What ``work`` returned.

        Raises
        ------
        FluidSimError
            If the loop has ended, or does not answer within ``timeout`` [s].

        """
        if self._closed:
            raise FluidSimError('the simulation loop has ended')
        future: Future[object] = Future()
        self._waiting.append((work, future))
        self._arrived.set()
        self._on_arrival()
        try:
            return future.result(timeout)  # type: ignore[return-value]
        except TimeoutError:
            if future.cancel():
                raise FluidSimError(
                    f'the simulation loop did not answer within {timeout:g} s'
                ) from None
            return future.result(timeout)  # type: ignore[return-value]

    def serve(self) -> None:
        """Run what waits; called by the stepping thread only, at every turn of its loop."""
        if not self._waiting:
            return
        while self._waiting:
            work, future = self._waiting.popleft()
            if not future.set_running_or_notify_cancel():
                continue
            try:
                future.set_result(work())
            except Exception as error:  # noqa: BLE001 - the caller in the other thread gets it
                future.set_exception(error)
        self._arrived.clear()

    def idle(self) -> None:
        """Sleep until a request arrives, a short while at most."""
        if not self._waiting:
            self._arrived.wait(IDLE_WAIT)

    def close(self) -> None:
        """Refuse new requests and end those that wait."""
        self._closed = True
        while self._waiting:
            _, future = self._waiting.popleft()
            future.cancel()
