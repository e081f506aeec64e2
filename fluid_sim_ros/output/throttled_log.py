# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log of faults that does not repeat itself many times per second."""

import time
from collections.abc import Callable

#: Least wall time between two lines about the same fault [s].
_PERIOD = 1.0


class ThrottledLog:
    """
    Logs faults, each not more often than once per second; call it with (key, line).

    A line says how many like it were left out since the last one; ``flush`` says it where no other
    one follows.

    Parameters
    ----------
    log
        Takes a line.

    """

    def __init__(self, log: Callable[[str], object]) -> None:
        self._log = log
        self._logged_at: dict[str, float] = {}
        self._left_out: dict[str, int] = {}
        self._last: dict[str, str] = {}

    def __call__(self, key: str, line: str) -> None:
        """
        Log a fault.

        Parameters
        ----------
        key
            What it is about.
        line
            What to say.

        """
        now = time.monotonic()
        if now - self._logged_at.get(key, -_PERIOD) < _PERIOD:
            self._left_out[key] = self._left_out.get(key, 0) + 1
            self._last[key] = line
            return
        self._say(key, line, self._left_out.pop(key, 0), now)

    def flush(self) -> None:
        """Say what was left out more than a second ago; to be called now and then."""
        if not self._left_out:
            return
        now = time.monotonic()
        for key in list(self._left_out):  # other threads log, too
            if now - self._logged_at[key] >= _PERIOD:
                left_out = self._left_out.pop(key, 0)
                if left_out:
                    self._say(key, self._last[key], left_out - 1, now)

    def _say(self, key: str, line: str, left_out: int, now: float) -> None:
        self._logged_at[key] = now
        self._log(f'{line} ({left_out} more like it before)' if left_out else line)
