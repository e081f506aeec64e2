# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Ends a process whose end in order takes too long, also while its main thread is inside a library.

Python runs a signal's handler in the main thread alone, between two of its own instructions: not
while a library works there, or waits. The system's handler, though, writes the signal's number
into a pipe at once (``signal.set_wakeup_fd``), and a thread of its own reads that.
"""

import os
import signal
import threading
import time
from collections.abc import Callable

#: Longest time from the first signal, or from the last ``held`` block, to the end [s].
LONGEST_END = 8.0
#: Time between two looks [s].
_LOOK = 0.05


class LateEnd:
    """
    Watches for signals from when it is made; for the main thread, once in a process.

    Parameters
    ----------
    numbers
        Signals that end the process.
    waits
        Whether the process is in a block that is to be finished whatever it takes.
    end
        Ends the process; takes the number of the first signal.

    """

    def __init__(
        self, numbers: tuple[int, ...], waits: Callable[[], bool], end: Callable[[int], object]
    ) -> None:
        self._numbers, self._waits, self._end = numbers, waits, end
        self._reads, writes = os.pipe()
        os.set_blocking(writes, False)
        signal.set_wakeup_fd(writes, warn_on_full_buffer=False)
        # a child has the handle and not the thread: its signals are not ours
        os.register_at_fork(after_in_child=lambda: signal.set_wakeup_fd(-1))
        # the thread takes the mask over: where the main thread blocks signals, nobody has them
        before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
        threading.Thread(target=self._watch, daemon=True, name='late end').start()
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

    def _watch(self) -> None:
        number = 0
        while number not in self._numbers:
            number = os.read(self._reads, 1)[0]
        since = time.monotonic()
        while time.monotonic() < since + LONGEST_END:
            time.sleep(_LOOK)
            if self._waits():
                since = time.monotonic()
        self._end(number)


def end_by(code: int) -> None:
    """
    End the process at the latest after the longest end, without a word.

    Parameters
    ----------
    code
        Exit code.

    """

    def wait() -> None:
        time.sleep(LONGEST_END)
        os._exit(code)

    threading.Thread(target=wait, daemon=True, name='late end').start()
