# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Processes that judge what some seeds draw, and go on after each crash.

A worker is a process of a benchmark's own module. It takes lines ``FIRST LAST`` on its standard
input and prints lines of JSON: ``{"begun": SEED}`` before each seed, what became of it with its
``outcome``, and ``{"done": LAST}`` in the end. It starts once: what it imports and records first
is not done again for each portion.
"""

import contextlib
import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

Found = dict[str, Any]
#: A process that has not begun by then has a fault, also on a busy machine [s of wall time].
_START = 1800.0


def serve(judge: Callable[[int], Found], end: Callable[[], Found] = dict) -> None:
    """
    Judge the seeds that standard input asks for.

    Parameters
    ----------
    judge
        Returns what became of a seed, with its ``outcome``.
    end
        Returns what is said at the end of each portion.

    """
    with os.fdopen(os.dup(1), 'w', encoding='utf-8') as told:
        os.dup2(2, 1)  # what is judged may print
        for line in sys.stdin:
            first, last = map(int, line.split())
            for seed in range(first, last):
                print(json.dumps({'begun': seed}), file=told, flush=True)
                print(json.dumps(judge(seed)), file=told, flush=True)
            print(json.dumps(end() | {'done': last}), file=told, flush=True)


class Worker:
    """
    A process that judges one portion after another.

    Parameters
    ----------
    module
        Of the benchmark.
    words
        Its arguments there.
    cwd, env
        Working folder and environment of the process.
    patience
        Wall time allowed for one seed [s].

    """

    def __init__(
        self, module: str, words: Sequence[str], cwd: Path, env: Mapping[str, str],
        patience: float,
    ) -> None:  # fmt: skip
        self._command = [sys.executable, '-m', module, *words]
        self._cwd, self._env, self._patience = cwd, env, patience
        self._process: subprocess.Popen[str] | None = None
        self._hung = False
        self._said = tempfile.TemporaryFile()  # noqa: SIM115  as long as the worker

    def judged(self, first: int, last: int) -> list[Found]:
        """Return what became of some seeds, in a new process after each crash."""
        found: list[Found] = []
        while first < last:
            seed = self._portion(first, last, found)
            if seed is None:
                break
            words = self._end()
            if seed < first:
                raise RuntimeError(f'a worker ended before its first seed: {words[-2000:]}')
            if found and found[-1].get('seed') == seed:
                found.pop()  # what it left behind ended the process
            outcome = 'hang' if self._hung else 'crash'
            found.append({'seed': seed, 'outcome': outcome, 'line': words, 'seconds': 0.0})
            first = seed + 1
        return found

    def _portion(self, first: int, last: int, found: list[Found]) -> int | None:
        """
        Judge seeds in one process; return the seed at which it ended.

        None: at none; ``first - 1``: before it began one.
        """
        if self._process is None:
            self._process = subprocess.Popen(
                self._command, cwd=self._cwd, env=self._env, text=True, stdin=subprocess.PIPE,
                stdout=subprocess.PIPE, stderr=self._said,
            )  # fmt: skip
        process, begun = self._process, first - 1
        assert process.stdin and process.stdout  # they are pipes
        self._hung = False
        timer = self._timer(_START)
        try:
            print(first, last, file=process.stdin, flush=True)
            for line in process.stdout:
                told = json.loads(line)
                if 'begun' in told:
                    if begun < first:
                        timer.cancel()
                        timer = self._timer(self._patience * (last - first))
                    begun = told['begun']
                    continue
                found.append(told)
                if 'done' in told:
                    return None
        except (BrokenPipeError, json.JSONDecodeError):
            pass  # it has ended, perhaps in the middle of a line
        finally:
            timer.cancel()
        return begun

    def _timer(self, seconds: float) -> threading.Timer:
        timer = threading.Timer(seconds, self._too_long)
        timer.start()
        return timer

    def _too_long(self) -> None:
        self._hung = True
        if self._process:
            self._process.kill()

    def _end(self) -> str:
        """End the process; return the last words that it said to standard error."""
        if self._process is None:
            return ''
        process, self._process = self._process, None
        if process.stdin:
            with contextlib.suppress(BrokenPipeError):  # it has ended
                process.stdin.close()
        if process.stdout:
            process.stdout.close()
        process.wait()
        self._said.seek(0)
        words = self._said.read().decode(errors='replace')
        self._said.seek(0)
        self._said.truncate()
        return words

    def close(self) -> None:
        """End the process when it has judged what it was asked for."""
        self._end()
        self._said.close()


def in_portions(
    worker: Callable[[], Worker], seeds: range, size: int, seconds: float, workers: int
) -> Iterator[list[Found]]:
    """
    Judge seeds for so long; yield what became of each portion, in the order of the seeds.

    A portion that was begun is finished: no seed is left out before those that were judged.

    Parameters
    ----------
    worker
        Makes a worker.
    seeds
        Which seeds.
    size
        How many are a portion.
    seconds
        No portion begins later [s].
    workers
        How many work at once.

    """
    end, lock = time.monotonic() + seconds, threading.Lock()
    starts = iter(seeds[::size])
    ended: queue.Queue[tuple[int, list[Found]] | None] = queue.Queue()

    def work() -> None:
        mine = worker()
        try:
            while True:
                with lock:  # portions begin in order
                    first = next(starts, None) if time.monotonic() < end else None
                if first is None:
                    break
                ended.put((first, mine.judged(first, min(first + size, seeds.stop))))
        finally:
            mine.close()
            ended.put(None)

    with ThreadPoolExecutor(workers) as pool:
        works = [pool.submit(work) for _ in range(workers)]
        waiting: dict[int, list[Found]] = {}
        expected, at_work = seeds.start, workers
        while at_work:
            portion = ended.get()
            if portion is None:
                at_work -= 1
                continue
            waiting[portion[0]] = portion[1]
            while expected in waiting:
                yield waiting.pop(expected)
                expected += size
        for each in works:
            each.result()
