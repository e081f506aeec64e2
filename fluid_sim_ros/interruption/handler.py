# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a signal does, by the state of the process."""

import os
import signal
import time
from collections.abc import Callable
from types import FrameType
from typing import NoReturn

from fluid_sim_ros.interruption import late_end
from fluid_sim_ros.interruption.late_end import LateEnd

NUMBERS = (signal.SIGINT, signal.SIGTERM)
#: A second signal within this time is the same wish: a terminal signals the whole process group,
#: and ``ros2 launch`` then signals each of its processes once more [s].
SAME_WISH = 2.0
#: Wait where an exception would be lost or leave something half made [s].
_PAUSE = 0.02
#: In these an exception is shown and forgotten, a child is lost, or a module stays half made.
_DELICATE = ('__del__', 'Popen.__init__', '_find_and_load')
_IMPORT = ('_find_and_load',)
_SHOW_CURSOR = b'\x1b[?25h'


class Interrupted(KeyboardInterrupt):
    """
    A signal ended what was under way.

    Parameters
    ----------
    number
        Of the signal.

    """

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.code = exit_code(number)


class Interruption:
    """
    What has ended a loop early; see ``stopped_by_signals``.

    Parameters
    ----------
    stop
        As of ``stops``; None: there is no loop yet.

    Attributes
    ----------
    name
        Of the signal, or empty.

    """

    def __init__(self, stop: Callable[[], None] | None = None) -> None:
        self.name = ''
        self._stop = stop

    def stops(self, stop: Callable[[], None]) -> None:
        """
        Have a signal end this loop; one that has come already ends it now.

        Parameters
        ----------
        stop
            Returns at once; safe in a signal handler.

        """
        self._stop = stop
        if self.name:
            stop()

    def came(self, number: int) -> None:
        """
        Note a signal.

        Parameters
        ----------
        number
            Of the signal.

        """
        self.name = signal.Signals(number).name
        if self._stop is not None:
            self._stop()


class Signals:
    """
    Takes SIGINT and SIGTERM from when it is made.

    Parameters
    ----------
    program
        What lines to the user begin with.
    loading
        Whether there is nothing yet that has to be ended.

    Attributes
    ----------
    owning
        Whether something has been made that its maker ends: then imports are waited for, too.
    number
        Of the first signal, or 0.
    waits
        Whether nothing has been done about it yet.

    """

    def __init__(self, program: str, loading: bool = False) -> None:
        self.program, self.loading = program, loading
        self.owning = False
        self.number = 0
        self.settled = False
        self.loops: list[Interruption] = []
        self.holds = 0
        self.waits = False
        self._since = 0.0
        self._before = {number: signal.getsignal(number) for number in NUMBERS}
        self.take()

    @property
    def interrupted(self) -> str:
        """What is said of an end in order."""
        return f'{self.program}: interrupted'

    def take(self) -> None:
        """Take the signals, also from a library that has taken them for itself."""
        for number in NUMBERS:
            signal.signal(number, self._on_signal)

    def restore(self) -> None:
        """Give the signals back to whom they belonged."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def act(self, frame: FrameType | None = None) -> None:
        """
        Do what the state says about a signal that has come.

        Parameters
        ----------
        frame
            Where it has met the program.

        Raises
        ------
        Interrupted
            Where that ends what is under way.

        """
        if self.settled or self.holds:
            return
        if self.loops:
            self.waits = False
            self.loops[-1].came(self.number)
        elif _is_in(frame, _IMPORT) and not self.owning:
            end_at_once(self.interrupted, exit_code(self.number))
        elif _is_in(frame, _DELICATE):
            self.again()
        else:
            self.waits = False
            raise Interrupted(self.number)

    def again(self) -> None:
        """Act in a moment."""
        self.waits = True
        signal.signal(signal.SIGALRM, lambda number, frame: self.act(frame))
        signal.setitimer(signal.ITIMER_REAL, _PAUSE)

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        if self.loading:
            end_at_once(self.interrupted, exit_code(number))
        now = time.monotonic()
        if self.number:
            if now - self._since > SAME_WISH:
                line = f'{self.program}: ended at once by a second signal; a log may lack its end'
                end_at_once(line, exit_code(number))
            return
        self.number, self._since, self.waits = number, now, True
        self.act(frame)

    def watch(self) -> None:
        """Have an end that takes too long cut, whatever the main thread does."""
        LateEnd(NUMBERS, lambda: bool(self.holds), lambda number: end_late(self.program, number))


def end_late(program: str, number: int) -> NoReturn:
    """
    End a process that takes too long to end in order.

    Parameters
    ----------
    program
        What the line begins with.
    number
        Of the signal.

    """
    line = f'{program}: ended at once, since an end in order took over {late_end.LONGEST_END:g} s'
    end_at_once(line, exit_code(number))


def exit_code(number: int) -> int:
    """
    Return the exit code of a program that a signal has ended, as shells have it.

    Parameters
    ----------
    number
        Of the signal.

    """
    return 128 + number


def end_at_once(line: str, code: int) -> NoReturn:
    """
    End the process now, with a line on standard error; safe in a signal handler.

    Parameters
    ----------
    line
        What is said; may be empty.
    code
        Exit code.

    """
    try:
        if line:
            # a bar in a terminal has hidden the cursor
            os.write(2, (_SHOW_CURSOR if os.isatty(2) else b'') + f'{line}\n'.encode())
    finally:
        os._exit(code)


def _is_in(frame: FrameType | None, names: tuple[str, ...]) -> bool:
    """Return whether a function of these names, or qualified names, is being called."""
    while frame is not None:
        code = frame.f_code
        if code.co_name in names or code.co_qualname in names:
            return True
        frame = frame.f_back
    return False
