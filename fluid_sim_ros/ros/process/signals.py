# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""SIGINT and SIGTERM end a node's loop in good order."""

import os
import signal
import time
from types import FrameType
from typing import Protocol

from fluid_sim_ros.interruption import (
    NUMBERS,
    SAME_WISH,
    LateEnd,
    end_at_once,
    end_late,
    exit_code,
)


def end_quietly() -> None:
    """
    Have signals end the process at once with exit code 0.

    For a node that is loading: nothing is there yet that has to be ended.
    """
    for number in NUMBERS:
        signal.signal(number, lambda *_: os._exit(0))


class Ending(Protocol):
    """What a signal ends."""

    def end(self) -> None:
        """Have the loop return; safe in a signal handler."""


class EndSignals:
    """
    Takes SIGINT and SIGTERM from when it is made.

    The first signal ends the loop in good order; one that comes more than 2 s later ends the
    process at once, since good order seems to take too long for somebody. So does an end that
    takes longer than 8 s.

    Parameters
    ----------
    name
        What the line about an end at once begins with.

    Attributes
    ----------
    came
        Whether a signal has come.

    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._since = 0.0
        self._target: Ending | None = None
        self.came = False
        for number in NUMBERS:
            signal.signal(number, self._on_signal)
        LateEnd(NUMBERS, lambda: False, lambda number: end_late(name, number))

    def end(self, target: Ending) -> None:
        """
        Have signals end a loop; one that has come already ends it now.

        Parameters
        ----------
        target
            Its ``end`` is called.

        """
        self._target = target
        if self.came:
            target.end()

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if self.came:
            if now - self._since > SAME_WISH:
                line = f'{self._name}: ended at once by a second signal; a log may lack its end'
                end_at_once(line, exit_code(number))
            return
        self.came, self._since = True, now
        if self._target is not None:
            self._target.end()
