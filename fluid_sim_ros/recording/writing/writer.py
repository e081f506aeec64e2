# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The process that writes a log: frames of ``wire`` in on standard input, an MCAP file out.

It ends with its input, so a simulation that is killed still leaves a complete file. Chunks are
closed at 1 MiB, and after a wall time are brought to the disk: a crash of the machine costs no
more than that. A disk that is full, a quota, or a file that somebody has deleted ends it with one
JSON line on standard output; the file is cut back to its last whole chunk. A file that was moved
is written to its end where it is.
"""

import base64
import contextlib
import errno
import json
import os
import select
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.recording.writing import rosbag2, wire
from fluid_sim_ros.recording.writing.mcap_file import McapFile

#: Size at which a chunk is closed [bytes].
CHUNK_SIZE = 1 << 20
#: Niceness of the writer: the simulator goes first.
_NICE = 5
_READ_SIZE = 1 << 20


class LogFile:
    """
    One MCAP file being written.

    Parameters
    ----------
    start
        Content of the frame that begins a file.

    """

    def __init__(self, start: dict[str, Any]) -> None:
        self._chunk_s: float = start['chunk_s']
        self._path = Path(start['path'])
        self._bag: bool = start['bag']
        self._stream = self._path.open('r+b')
        self._file = McapFile(self._stream)
        self._channels = start['channels']
        self._pending = False
        self._deadline = 0.0
        self.whole = 0  # the file is good up to here [bytes]
        self._begin(start)

    def _begin(self, start: dict[str, Any]) -> None:
        file = self._file
        file.start('ros2', start['library'])
        for name, content in start['attachments'].items():
            data = base64.b64decode(content)
            kind = 'application/json' if name.endswith('.json') else 'application/octet-stream'
            file.attach(name, kind, data, start['wall_ns'])
        for name, pairs in start['metadata'].items():
            file.add_metadata(name, pairs)
        schemas: dict[str, int] = {}
        for channel in self._channels:
            kind = channel['type']
            if kind not in schemas:
                schemas[kind] = file.add_schema(kind, channel['definition'].encode())
            file.add_channel(channel['topic'], schemas[kind], channel['metadata'])
        self._sync()

    @property
    def deadline(self) -> float | None:
        """When the open chunk must be closed [s, monotonic]; None without one."""
        return self._deadline if self._pending else None

    def add(self, payload: bytes) -> None:
        """
        Add the messages of a frame.

        Parameters
        ----------
        payload
            Message records, one behind the other.

        """
        if not self._pending:
            self._deadline = time.monotonic() + self._chunk_s
            self._pending = True
        self._file.add(payload)
        if self._file.chunk_size >= CHUNK_SIZE:
            self._file.close_chunk()
            self.whole = self._stream.tell()
            # the disk is waited for once per deadline only
            if time.monotonic() >= self._deadline:
                self._sync()

    def close_chunk(self) -> None:
        """Close the open chunk and bring everything to the disk."""
        self._file.close_chunk()
        self._sync()

    def _sync(self) -> None:
        if not os.fstat(self._stream.fileno()).st_nlink:
            raise FileNotFoundError(errno.ENOENT, 'its file was deleted')
        self._stream.flush()
        os.fdatasync(self._stream.fileno())
        self.whole = self._stream.tell()
        self._pending = False

    def finish(self) -> dict[str, Any]:
        """
        End the file with its summary; return what it holds.

        Returns
        -------
        dict
            ``path``, number of ``messages``, and ``bytes`` of the file.

        """
        self._file.finish()
        self._sync()
        size, path = self._stream.tell(), self._place()
        self._stream.close()
        counts = list(self._file.counts.values())
        if self._bag:
            rosbag2.write_metadata(
                path, self._channels, counts, self._file.first_ns, self._file.last_ns
            )
        return {'path': str(path), 'messages': sum(counts), 'bytes': size}

    def _place(self) -> Path:
        """Return where the file is, also when its folder was moved."""
        try:
            return Path(f'/proc/self/fd/{self._stream.fileno()}').readlink()
        except OSError:  # not Linux
            return self._path

    def cut(self) -> None:
        """Cut the file back to its last whole chunk, after a failed write."""
        os.ftruncate(self._stream.fileno(), self.whole)


def frames(deadline: Any) -> Iterator[tuple[bytes, bytes]]:
    """
    Return frames from standard input until it ends; an empty kind when the deadline passed.

    Parameters
    ----------
    deadline
        Returns the time at which to go on without a frame [s, monotonic], or None.

    Yields
    ------
    kind, payload
        Kind and content; both empty when the deadline has passed.

    """
    buffer, begin, end = memoryview(bytearray(_READ_SIZE)), 0, 0  # what was read and not returned
    arrivals = select.poll()
    arrivals.register(0, select.POLLIN)
    while True:
        due = deadline()
        timeout = None if due is None else max(0.0, due - time.monotonic())
        # poll takes any file number, select those below 1024 only
        if not arrivals.poll(None if timeout is None else 1e3 * timeout):
            yield b'', b''
            continue
        got = os.readv(0, [buffer[end:]])
        if not got:
            return
        end += got
        needed = wire.FRAME.size
        while end - begin >= wire.FRAME.size:
            kind, size = wire.FRAME.unpack_from(buffer, begin)
            needed = wire.FRAME.size + size
            if end - begin < needed:
                break
            yield kind, bytes(buffer[begin + wire.FRAME.size : begin + needed])
            begin += needed
        buffer, begin, end = _moved(buffer, begin, end, needed)


def _moved(buffer: memoryview, begin: int, end: int, needed: int) -> tuple[memoryview, int, int]:
    """Return a buffer with what is left at its start, and room for the frame that it begins."""
    left = bytes(buffer[begin:end])
    if needed > len(buffer):
        buffer = memoryview(bytearray(needed))
    buffer[: len(left)] = left
    return buffer, 0, len(left)


class Server:
    """Writes what comes in until the input ends."""

    def __init__(self) -> None:
        self._log: LogFile | None = None

    def serve(self) -> None:
        """Run; a failed write ends the process."""
        try:
            for kind, payload in frames(self._deadline):
                self._take(kind, payload)
            self._take(wire.END, b'')
        except (OSError, FluidSimError) as error:
            _say({'fault': error.strerror if isinstance(error, OSError) else str(error)})
            if self._log is not None:
                self._log.cut()
            os._exit(1)  # a buffered stream would try, and fail, once more

    def _deadline(self) -> float | None:
        return self._log.deadline if self._log else None

    def _take(self, kind: bytes, payload: bytes) -> None:
        if kind == wire.START:
            self._log = LogFile(json.loads(payload))
        elif self._log is None:
            return
        elif kind == wire.MESSAGES:
            self._log.add(payload)
        elif kind == wire.END:
            _say(self._log.finish())
            self._log = None
        else:
            self._log.close_chunk()


def _say(what: dict[str, Any]) -> None:
    with contextlib.suppress(BrokenPipeError):  # the simulator was killed: nobody listens
        os.write(1, json.dumps(what).encode() + b'\n')


def _stand_back() -> None:
    """Have the system prefer the simulator where both want the same processor."""
    os.nice(_NICE)
    with contextlib.suppress(AttributeError, OSError):  # Linux only
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))


if __name__ == '__main__':
    _stand_back()
    Server().serve()
