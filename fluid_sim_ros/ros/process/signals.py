"""SIGINT and SIGTERM end a loop in good order."""

import os
import signal
import sys
import time
from types import FrameType
from typing import NoReturn, Protocol

#: A second signal within this time is the same wish: a terminal signals the whole process group,
#: and ``ros2 launch`` then signals each of its processes once more [s].
_SAME_WISH = 2.0
_NUMBERS = (signal.SIGINT, signal.SIGTERM)


def leave(code: int) -> NoReturn:
    """
    End the process; a signal that comes on the way out changes nothing.

    Python gives signals their default effect while it shuts down, so the second one of a Ctrl-C
    would make the end look like a crash.

    Parameters
    ----------
    code
        Exit code.

    """
    for number in _NUMBERS:
        signal.signal(number, signal.SIG_IGN)
    sys.exit(code)


class Ending(Protocol):
    """What a signal ends."""

    def end(self) -> None:
        """Have the loop return; safe in a signal handler."""


class EndSignals:
    """
    Takes SIGINT and SIGTERM from when it is made.

    The first signal ends the loop in good order; one that comes more than 2 s later ends the
    process at once, since good order seems to take too long for somebody.

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
        for number in _NUMBERS:
            signal.signal(number, self._on_signal)

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
            if now - self._since > _SAME_WISH:
                line = f'{self._name}: ended at once by a second signal; a log may lack its end\n'
                os.write(sys.stderr.fileno(), line.encode())
                os._exit(128 + number)
            return
        self.came, self._since = True, now
        if self._target is not None:
            self._target.end()
