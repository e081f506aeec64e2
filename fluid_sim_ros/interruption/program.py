# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The signals of this process, where it is one of our programs, and blocks that mind them."""

import atexit
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, NoReturn

from fluid_sim_ros.interruption.handler import (
    NUMBERS,
    Interrupted,
    Interruption,
    Signals,
    exit_code,
)
from fluid_sim_ros.interruption.late_end import end_by

#: Of this process, where it is one of our programs.
_present: Signals | None = None


def begin(program: str) -> None:
    """
    Take signals for a program that is loading; a second call changes nothing.

    Parameters
    ----------
    program
        What lines to the user begin with.

    """
    global _present
    if _present is not None or threading.current_thread() is not threading.main_thread():
        return
    _present = Signals(program, loading=True)
    _present.watch()
    before = sys.unraisablehook

    def hook(seen: Any) -> None:
        """Have an interruption that Python would show and forget come once more."""
        if isinstance(seen.exc_value, Interrupted) and _present is not None:
            _present.again()
        else:
            before(seen)

    sys.unraisablehook = hook
    # threads have ended by then; what comes after takes the timer's handler away
    atexit.register(signal.setitimer, signal.ITIMER_REAL, 0.0)


def begun() -> None:
    """Note that the program has loaded: from now on something may have to be ended."""
    if _present is not None:
        _present.loading = False


def owns() -> None:
    """Note that something was made that its maker ends, such as a temporary file."""
    if _present is not None:
        _present.owning = True


def interrupted_by() -> int:
    """Return the exit code of a program that a signal has interrupted; 0 where none has come."""
    return exit_code(_present.number) if _present is not None and _present.number else 0


def settle() -> None:
    """Note that the result of the program is out: a signal changes nothing any more."""
    if _present is not None:
        _present.settled = True


def leave(code: int) -> NoReturn:
    """
    End the process; a signal that comes on the way out changes nothing.

    Python gives signals their default effect while it shuts down, so the second one of a Ctrl-C
    would make the end look like a crash. A program of ours leaves without the rest of that
    shutdown, in which a library once waited without end; and, where an exit function of a library
    does, after a while.

    Parameters
    ----------
    code
        Exit code.

    """
    for number in NUMBERS:
        signal.signal(number, signal.SIG_IGN)
    end_by(code)
    if _present is None:  # a node: the middleware ends by its own
        sys.exit(code)
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


@contextmanager
def held(from_library: bool = False) -> Iterator[None]:
    """
    Finish a block before a signal ends what is around it.

    Parameters
    ----------
    from_library
        Keep signals also from a library that takes them for itself in the block (Ray does, in
        Python and in C++). Processes that are started in it inherit that, so that SIGTERM does
        not end them.

    Returns
    -------
    context manager
        Of the block, such as one that makes something and notes that it must be ended.

    Raises
    ------
    Interrupted
        Behind the block, where a signal has come in it.

    """
    present = _present
    if present is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    present.holds += 1
    present.owning = True
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, NUMBERS if from_library else ())
    try:
        yield
    finally:
        present.take()
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        present.holds -= 1
    if present.waits:
        present.act()


@contextmanager
def stopped_by_signals(stop: Callable[[], None] | None = None) -> Iterator[Interruption]:
    """
    Have SIGINT and SIGTERM end a loop at its next boundary, and its block in order.

    Outside of the main thread, which alone gets signals, nothing is changed.

    Parameters
    ----------
    stop
        Ends the loop; returns at once. None: the block tells of it (``Interruption.stops``).

    Returns
    -------
    context manager
        Of an ``Interruption``, which is told of the loop, and says afterwards whether a signal has
        ended it.

    Raises
    ------
    Interrupted
        Where one has come before, and nothing has been done about it yet.

    """
    interruption = Interruption(stop)
    if threading.current_thread() is not threading.main_thread():
        yield interruption
        return
    signals = _present or Signals('interrupted')
    if signals.waits:  # it came while the loop's modules were imported
        signals.act()
    signals.loops.append(interruption)
    try:
        yield interruption
    finally:
        signals.loops.remove(interruption)
        if signals is not _present:
            signals.restore()
