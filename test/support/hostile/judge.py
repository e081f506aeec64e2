# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What became of a hostile file: an error of ours, a traceback, too much time or memory."""

import io
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.recording.model import trial

#: Content of a file that lies outside.
_SECRET = 'nobody-has-asked-for-this'
#: What is allowed: processor time [s], wall time on a busy machine, without that of waiting for a
#: processor [s], and memory beyond four times the file [bytes].
MOST_SECONDS, MOST_WALL, MOST_BYTES = 10.0, 60.0, 256 << 20


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
    """Return the processor time of this process and of those that it started and that ended."""
    return sum(os.times()[:4])


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


#: Starts a command from a small process: what Linux counts as the peak of a child begins with the
#: memory of whoever started it. Ends as the command does.
_SMALL = """\
import os, sys
child = os.posix_spawn(sys.argv[2], sys.argv[2:], os.environ)
_, status, used = os.wait4(child, 0)
with open(sys.argv[1], 'a') as peaks:
    peaks.write(f'{used.ru_maxrss}\\n')
code = os.waitstatus_to_exitcode(status)
if code < 0:
    os.kill(os.getpid(), -code)
os._exit(code)
"""


class Trials:
    """
    The trials of models, started so that their memory is known.

    Parameters
    ----------
    path
        A file for the numbers.

    """

    def __init__(self, path: Path) -> None:
        self._path = path
        trial.subprocess = self  # type: ignore[assignment]  # it uses run and TimeoutExpired

    TimeoutExpired = subprocess.TimeoutExpired

    def run(self, command: Sequence[str], **options: Any) -> subprocess.CompletedProcess[bytes]:
        """Run a command as ``subprocess.run`` does."""
        start = [sys.executable, '-S', '-c', _SMALL, str(self._path)]
        return subprocess.run([*start, *command], **options)

    def peak(self) -> int:
        """Return the largest resident memory of a trial so far [bytes]."""
        if not self._path.exists():
            return 0
        return max(map(int, self._path.read_text().split())) << 10


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
