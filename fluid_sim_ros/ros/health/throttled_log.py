"""A log of faults that does not repeat itself many times per second."""

import time
from collections.abc import Callable

#: Least wall time between two lines about the same fault [s].
_PERIOD = 1.0


class ThrottledLog:
    """
    Logs faults, each not more often than once per second; call it with (key, line).

    A line says how many like it were left out since the last one.

    Parameters
    ----------
    log
        Takes a line.

    """

    def __init__(self, log: Callable[[str], object]) -> None:
        self._log = log
        self._logged_at: dict[str, float] = {}
        self._left_out: dict[str, int] = {}

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
            return
        self._logged_at[key] = now
        left_out = self._left_out.pop(key, 0)
        self._log(f'{line} ({left_out} more like it before)' if left_out else line)
