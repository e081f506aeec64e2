# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What became of a hostile file: an error of ours, a traceback, too much time or memory."""

import io
import os
import shutil
import time
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

from fluid_sim_ros.errors import FluidSimError

#: Content of a file that lies outside.
_SECRET = 'nobody-has-asked-for-this'
#: What is allowed: processor time [s], wall time on a busy machine, without that of waiting for a
#: processor [s], and memory beyond four times the file [bytes].
MOST_SECONDS, MOST_WALL, MOST_BYTES = 10.0, 60.0, 256 << 20
#: Processor time of processes that worked for this one and that it did not start itself [s].
elsewhere: list[float] = []


@dataclass
class Verdict:
    """
    What became of one file.

    Attributes
    ----------
    outcome
        ``read``, ``refused`` (an error of ours), or what is wrong.
    line
        The error's message, or what is wrong in words.
    seconds, memory
        Processor time [s], that of child processes too, and growth of the resident memory at its
        peak [bytes].

    """

    outcome: str
    line: str
    seconds: float
    memory: int

    @property
    def right(self) -> bool:
        """Whether nothing is wrong."""
        return self.outcome in ('read', 'refused')


def judged(action: Callable[[], object], size: int) -> Verdict:
    """
    Run something with a hostile file.

    Parameters
    ----------
    action
        What is done; an int other than 0 and 1 that it returns is an error of the command line.
    size
        Of the file [bytes].

    """
    before = _reset_peak()
    said = io.StringIO()
    begin, worked, queued = time.monotonic(), _worked(), _queued()
    outcome, line = 'read', ''
    try:
        with redirect_stderr(said), redirect_stdout(said):
            code = action()
        if isinstance(code, int) and code not in (0, 1):
            outcome, line = 'refused', said.getvalue().strip()
        if not said.getvalue().replace('\n', '').isprintable():
            outcome, line = 'unprintable output', repr(said.getvalue()[:300])
    except FluidSimError as error:
        outcome, line = 'refused', str(error)
    except Exception as error:  # noqa: BLE001  that is what is looked for
        outcome, line = 'traceback', f'{type(error).__name__}: {error}'[:500]
    wall = time.monotonic() - begin - (_queued() - queued)
    seconds, memory = _worked() - worked, _peak() - before
    if outcome == 'refused' and (not line.isprintable() or len(line) > 5000):
        outcome, line = 'unprintable line', repr(line[:300])
    if seconds > MOST_SECONDS or wall > MOST_WALL:
        outcome, line = 'slow', f'{seconds:.1f} s of {wall:.1f} s: {line}'
    if memory > 4 * size + MOST_BYTES:
        outcome, line = 'large', f'{memory / 2**20:.0f} MiB for {size} bytes: {line}'
    return Verdict(outcome, line, seconds, memory)


def _worked() -> float:
    """Return the processor time of this process and of those that worked for it and ended."""
    return sum(os.times()[:4]) + sum(elsewhere)


def _queued() -> float:
    """Return how long this thread has waited for a processor [s]."""
    # Documentation/scheduler/sched-stats.rst: time on a processor, time in its queue [ns]
    return int(Path('/proc/thread-self/schedstat').read_text(encoding='ascii').split()[1]) * 1e-9


def _reset_peak() -> int:
    """Set the peak of the resident memory back to what it is now [bytes]."""
    Path('/proc/self/clear_refs').write_text('5', encoding='ascii')
    return _peak()


def _peak() -> int:
    status = Path('/proc/self/status').read_text(encoding='ascii')
    line = next(line for line in status.splitlines() if line.startswith('VmHWM'))
    return int(line.split()[1]) << 10


class Outside:
    """
    What must stay as it is while hostile files are read: a folder, and all names beside it.

    Parameters
    ----------
    folder
        Holds the working folder, which may change.

    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.working = folder / 'working'
        self.working.mkdir()
        self.kept = folder / 'kept'
        self.kept.write_text(_SECRET)
        self._before = self._seen()

    def _seen(self) -> dict[str, int]:
        return {
            str(path): path.stat().st_mtime_ns
            for path in self._folder.iterdir()
            if path != self.working
        }

    def changed(self) -> bool:
        """Return whether anything beside the working folder is new or another."""
        return self._seen() != self._before

    def told(self, verdict: Verdict) -> bool:
        """Return whether the content of the file outside came out, in words or in a file."""
        return _SECRET in verdict.line or any(
            _SECRET.encode() in file.read_bytes()
            for file in self.working.rglob('*')
            if file.is_file()
        )

    def clear(self) -> None:
        """Empty the working folder."""
        shutil.rmtree(self.working)
        self.working.mkdir()
