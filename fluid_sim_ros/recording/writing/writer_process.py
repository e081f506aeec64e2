# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The process that writes a log, seen from the simulator: a pipe and a queue before it."""

import contextlib
import fcntl
import json
import os
import select
import subprocess
import sys
from collections import deque
from collections.abc import Sequence
from typing import IO

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.recording.writing import wire

#: Size asked of the pipe [bytes]; Linux grants 1 MiB without privilege.
_PIPE_SIZE = 1 << 20
#: Longest wait for the writer to end a file [s]; it may have to bring the queue to a slow disk.
_END_TIMEOUT = 60.0


class WriterProcess:
    """
    A running writer (``writer``), which takes frames (``wire``) as fast as it can.

    Parameters
    ----------
    limit
        Size of the queue [bytes].
    block
        Whether to wait for room in a full queue.

    Attributes
    ----------
    queued
        What waits for the writer [bytes].
    running
        Whether it takes frames; False after it ended, by itself or by ``close``.
    fault
        Why it ended by itself (such as a full disk), or empty.
    pid
        Number of the process.

    Raises
    ------
    ConfigError
        If the process cannot be started.

    """

    def __init__(self, limit: int, block: bool) -> None:
        self._limit = limit
        self._block = block
        self._queue: deque[memoryview] = deque()
        self.queued = 0
        self.running = True
        self.fault = ''
        # its own session, so that Ctrl-C in a terminal ends the simulation only; the writer ends
        # when its input does
        try:
            self._process = subprocess.Popen(
                # -P: modules that lie in the working folder are not imported
                [sys.executable, '-P', '-m', 'fluid_sim_ros.recording.writing.writer'],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True, bufsize=0,
            )  # fmt: skip
        except OSError as error:  # such as too few file handles, or no memory
            raise ConfigError(f'record: the log cannot be written: {error.strerror}') from None
        self.pid = self._process.pid
        self._pipe = _stream(self._process.stdin).fileno()
        # poll takes any file number, select those below 1024 only
        self._room = select.poll()
        self._room.register(self._pipe, select.POLLOUT)
        os.set_blocking(self._pipe, False)
        with contextlib.suppress(OSError):  # beyond the user's limit: the default will do
            fcntl.fcntl(self._pipe, fcntl.F_SETPIPE_SZ, _PIPE_SIZE)

    def send(self, kind: bytes, size: int, parts: Sequence[bytes]) -> None:
        """
        Queue a frame, and write as much of the queue as the pipe takes.

        Parameters
        ----------
        kind
            Of the frame.
        size
            Of all parts together [bytes].
        parts
            What the frame holds.

        """
        if not self.running:
            return
        frame = b''.join((wire.FRAME.pack(kind, size), *parts))
        self._queue.append(memoryview(frame))
        self.queued += len(frame)
        self.drain()

    def drain(self) -> None:
        """Write as much of the queue as the pipe takes, and note whether the process has ended."""
        queue = self._queue
        if not queue and self.running and self._process.poll() is not None:
            self._end()
        try:
            while queue and self.running:
                done = os.write(self._pipe, queue[0])
                self.queued -= done
                if done == len(queue[0]):
                    queue.popleft()
                else:
                    queue[0] = queue[0][done:]
        except BlockingIOError:
            return
        except BrokenPipeError:
            self._end()

    def has_room(self) -> bool:
        """Return whether the queue has room, after the wait for it where one is wanted."""
        if self.queued > self._limit:
            self.drain()
        while self.queued > self._limit and self._block:
            self._room.poll()
            self.drain()
        return self.queued <= self._limit

    def close(self) -> None:
        """Write the whole queue and end the file; waits until all is on the disk."""
        os.set_blocking(self._pipe, True)
        self.drain()
        if self.running:
            self._end(_END_TIMEOUT)

    def _end(self, timeout: float | None = None) -> None:
        """Close the pipe, which ends the process, and note how it ended."""
        self.running = False
        self._queue.clear()
        self.queued = 0
        with contextlib.suppress(BrokenPipeError):
            _stream(self._process.stdin).close()
        self._process.stdin = None
        try:
            lines = self._process.communicate(timeout=timeout)[0].splitlines()
        except subprocess.TimeoutExpired:  # a disk that does not answer
            self.fault = f'its writer has not ended within {timeout:g} s'
            return
        code = self._process.returncode
        said = json.loads(lines[-1]) if lines else {}
        if code or 'fault' in said:
            self.fault = said.get('fault', f'its writer ended with code {code}')


def _stream(stream: IO[bytes] | None) -> IO[bytes]:
    if stream is None:
        raise RuntimeError('the writer was started without its pipes')
    return stream
