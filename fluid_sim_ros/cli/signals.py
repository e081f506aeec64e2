"""A run that is ended by Ctrl-C or by another program ends in order: summary, log, children."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


class Interruption:
    """What has ended a run early: the name of a signal, or nothing."""

    name = ''


@contextmanager
def stopped_by_signals(stop: Callable[[], None]) -> Iterator[Interruption]:
    """
    Have SIGINT and SIGTERM end a loop at its next boundary; a second one ends it at once.

    Outside of the main thread, which alone gets signals, nothing is changed.

    Parameters
    ----------
    stop
        Ends the loop; returns at once.

    Returns
    -------
    context manager
        Of an ``Interruption``, which says afterwards whether a signal has ended the loop.

    """
    interruption = Interruption()

    def handle(number: int, _: FrameType | None) -> None:
        if interruption.name:
            raise KeyboardInterrupt
        interruption.name = signal.Signals(number).name
        stop()

    if threading.current_thread() is not threading.main_thread():
        yield interruption
        return
    before = {number: signal.signal(number, handle) for number in _NUMBERS}
    try:
        yield interruption
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
