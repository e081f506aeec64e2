"""
The process that writes a log: frames of ``wire`` in on standard input, an MCAP file out.

It ends with its input, so a simulation that is killed still leaves a complete file. Chunks are
closed at 1 MiB, and after a wall time are brought to the disk: a crash of the machine costs no
more than that. A disk that is full ends it with one JSON line on standard output; the file is cut
back to its last whole chunk.
"""

import base64
import json
import os
import select
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.writer import CompressionType, Writer

from fluid_sim_ros.recording import rosbag2, wire

#: Size at which a chunk is closed [bytes].
CHUNK_SIZE = 1 << 20
_READ_SIZE = 1 << 20
#: A chunk is never closed by the library itself, so that we know where the last whole one ends.
_NEVER = 1 << 40


class LogFile:
    """One MCAP file being written."""

    def __init__(self, start: dict[str, Any]) -> None:
        self._chunk_s: float = start['chunk_s']
        self._path = Path(start['path'])
        self._stream = self._path.open('r+b')
        self._writer = Writer(
            self._stream, _NEVER, CompressionType.ZSTD, enable_crcs=True, enable_data_crcs=True
        )
        self._channels = start['channels']
        self.messages = 0
        self._counts = [0] * len(self._channels)
        self._first_ns, self._last_ns = 0, 0
        self._pending = 0
        self._deadline = 0.0
        self.whole = 0  # the file is good up to here [bytes]
        self._begin(start)

    def _begin(self, start: dict[str, Any]) -> None:
        writer = self._writer
        writer.start(profile='ros2', library=start['library'])
        for name, content in start['attachments'].items():
            data = base64.b64decode(content)
            kind = 'application/json' if name.endswith('.json') else 'application/octet-stream'
            writer.add_attachment(start['wall_ns'], 0, name, kind, data)
        for name, pairs in start['metadata'].items():
            writer.add_metadata(name, pairs)
        schemas: dict[str, int] = {}
        self._ids = []
        for channel in self._channels:
            kind = channel['type']
            if kind not in schemas:
                text = channel['definition'].encode()
                schemas[kind] = writer.register_schema(kind, 'ros2msg', text)
            self._ids.append(
                writer.register_channel(
                    channel['topic'], 'cdr', schemas[kind], channel['metadata']
                )
            )
        self._sync()

    @property
    def deadline(self) -> float | None:
        """When the open chunk must be closed [s, monotonic]; None without one."""
        return self._deadline if self._pending else None

    def add(self, payload: memoryview) -> None:
        """Add the messages of a frame."""
        add, ids = self._writer.add_message, self._ids
        if not self._pending:
            self._deadline = time.monotonic() + self._chunk_s
        for channel, step, log_ns, publish_ns, data in wire.unpack(payload):
            if not self.messages:
                self._first_ns = log_ns
            add(ids[channel], log_ns, data, publish_ns, step)
            self.messages += 1
            self._counts[channel] += 1
            self._last_ns = log_ns
        self._pending += len(payload)
        if self._pending >= CHUNK_SIZE:
            self._writer.flush()
            self.whole = self._stream.tell()
            # the disk is waited for once per deadline only
            if time.monotonic() >= self._deadline:
                self._sync()
            else:
                self._pending = 1

    def close_chunk(self) -> None:
        """Close the open chunk and bring everything to the disk."""
        self._writer.flush()
        self._sync()

    def _sync(self) -> None:
        self._stream.flush()
        os.fdatasync(self._stream.fileno())
        self.whole = self._stream.tell()
        self._pending = 0

    def finish(self) -> dict[str, Any]:
        """End the file with its summary; return what it holds."""
        self._writer.finish()
        self._stream.flush()
        self._stream.truncate()
        os.fsync(self._stream.fileno())
        size = self._stream.tell()
        self._stream.close()
        if self._path.parent.name == self._path.stem.rpartition('_')[0]:
            rosbag2.write_metadata(
                self._path, self._channels, self._counts, self._first_ns, self._last_ns
            )
        return {'path': str(self._path), 'messages': self.messages, 'bytes': size}

    def cut(self) -> None:
        """Cut the file back to its last whole chunk, after a failed write."""
        os.ftruncate(self._stream.fileno(), self.whole)


def frames(deadline: Any) -> Iterator[tuple[bytes, memoryview]]:
    """Return frames from standard input until it ends; an empty kind when the deadline passed."""
    buffer = bytearray()
    while True:
        due = deadline()
        timeout = None if due is None else max(0.0, due - time.monotonic())
        if not select.select([0], [], [], timeout)[0]:
            yield b'', memoryview(b'')
            continue
        got = os.read(0, _READ_SIZE)
        if not got:
            return
        buffer += got
        at = 0
        while len(buffer) - at >= wire.FRAME.size:
            kind, size = wire.FRAME.unpack_from(buffer, at)
            begin = at + wire.FRAME.size
            if len(buffer) < begin + size:
                break
            yield kind, memoryview(bytes(buffer[begin : begin + size]))
            at = begin + size
        del buffer[:at]


class Server:
    """Writes what comes in until the input ends."""

    def __init__(self) -> None:
        self._log: LogFile | None = None

    def serve(self) -> None:
        """Run; a failed write ends the process."""
        try:
            for kind, payload in frames(self._deadline):
                self._take(kind, payload)
            self._take(wire.END, memoryview(b''))
        except OSError as error:
            _say({'fault': error.strerror})
            if self._log is not None:
                self._log.cut()
            os._exit(1)  # a buffered stream would try, and fail, once more

    def _deadline(self) -> float | None:
        return self._log.deadline if self._log else None

    def _take(self, kind: bytes, payload: memoryview) -> None:
        if kind == wire.START:
            self._log = LogFile(json.loads(bytes(payload)))
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
    sys.stdout.write(json.dumps(what) + '\n')
    sys.stdout.flush()


if __name__ == '__main__':
    Server().serve()
