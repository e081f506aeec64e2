# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Ends a program together with all that it has started, even when this process is killed.

A program gets a process group of its own. When this process ends in whatever way, the kernel kills
the program, and a guard, which waits for the end of a pipe that only this process holds, kills the
rest of its group. A program that ignores SIGTERM, as ArduPilot does, ends too.
"""

import ctypes
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

_PR_SET_PDEATHSIG = 1  # prctl(2)
_LIBC = ctypes.CDLL(None)  # found before the fork: between fork and exec only calls are safe
#: A line lets the guard go; the end of the pipe makes it kill the group.
_GUARD = 'read line || kill -s KILL -- "-$1"'
#: Between two looks whether a process has ended [s].
_LOOK_PERIOD = 0.01


class Process(NamedTuple):
    """A process by its id and the time of its start, since an id may be given again."""

    identity: int
    started: int


def die_with_parent() -> None:
    """Ask the kernel to kill this process when the one that started it ends."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


class Guard:
    """
    Kills a process group when this process ends before ``dismiss``.

    Parameters
    ----------
    group
        Id of the process group.

    """

    def __init__(self, group: int) -> None:
        self._process = subprocess.Popen(
            ['/bin/sh', '-c', _GUARD, 'guard', str(group)], stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip

    def dismiss(self) -> None:
        """End the guard; the group goes on."""
        with suppress(BrokenPipeError):
            self._process.communicate(b'\n')


def family_of(identity: int) -> list[Process]:
    """
    Return a process and all that it has started, as far as their parents still live.

    Parameters
    ----------
    identity
        Id of the process.

    Returns
    -------
    list of Process
        The process first; empty where it has gone.

    """
    processes = {process.identity: (process, parent) for process, parent in _processes()}
    found, generation = [], [identity]
    while generation:
        found += [processes[one][0] for one in generation if one in processes]
        generation = [one for one, (_, parent) in processes.items() if parent in generation]
    return found


def kill(family: list[Process]) -> None:
    """
    Kill those that still live.

    Parameters
    ----------
    family
        As ``family_of`` gave it.

    """
    alive = {process for process, _ in _processes()}
    for process in family:
        if process in alive:
            with suppress(ProcessLookupError, PermissionError):
                os.kill(process.identity, signal.SIGKILL)


def ended(identity: int, patience: float) -> int | None:
    """
    Return how a child has ended, and leave it to be reaped, so that its id is not given again.

    Parameters
    ----------
    identity
        Id of the child.
    patience
        Longest wait [s].

    Returns
    -------
    int or None
        Its exit code, or the number of the signal that ended it, negative; None: it runs.

    """
    deadline = time.monotonic() + patience
    while True:
        done = os.waitid(os.P_PID, identity, os.WEXITED | os.WNOHANG | os.WNOWAIT)
        if done is not None:
            return done.si_status if done.si_code == os.CLD_EXITED else -done.si_status
        if time.monotonic() >= deadline:
            return None
        time.sleep(_LOOK_PERIOD)


def _processes() -> Iterator[tuple[Process, int]]:
    """Give every process of this host and its parent's id."""
    for folder in Path('/proc').iterdir():
        if folder.name.isdigit():
            with suppress(OSError):  # it has ended meanwhile
                # the name, in brackets, may hold anything
                fields = (folder / 'stat').read_text().rpartition(')')[2].split()
                yield Process(int(folder.name), int(fields[19])), int(fields[1])
