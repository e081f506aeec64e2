"""Hands what is recorded to the writer process, without holding up the steps."""

import base64
import contextlib
import fcntl
import json
import os
import select
import subprocess
import sys
import time
from collections import deque
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any

from fluid_sim_ros import __version__
from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.loop.recorder_port import EVENTS, EVENTS_TYPE, RecordedTopic, RecorderOptions
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.recording import rosbag2, wire
from fluid_sim_ros.recording.description import describe
from fluid_sim_ros.simulation import Simulation

#: What is kept is sent when it is this large [bytes] or this old [s]; smaller portions would wake
#: the writer more often than it has to be.
_PORTION, _AGE = 1 << 18, 0.02
#: Size asked of the pipe [bytes]; Linux grants 1 MiB without privilege.
_PIPE_SIZE = 1 << 20
#: Longest wait for the writer to end a file [s]; it may have to bring the queue to a slow disk.
_END_TIMEOUT = 60.0


class Recorder:
    """
    A recording in progress; see ``loop.recorder_port.RecorderPort``.

    Attributes
    ----------
    fault
        Why recording ended by itself (such as a full disk), or empty.
    written, dropped
        Messages handed over, and left out because the queue was full.
    paths
        The files, one per segment.

    """

    def __init__(
        self, simulation: Simulation, topics: Sequence[RecordedTopic], options: RecorderOptions
    ) -> None:
        self._simulation = simulation
        self._options = options
        name = f'{options.namespace.rstrip("/")}/{EVENTS}'
        events = RecordedTopic(name, EVENTS_TYPE, EVENTS)
        self._topics = [*topics, events]
        self._event_topic = len(topics)
        self._limit = int(options.queue_mib * (1 << 20))
        self._kept: list[bytes] = []
        self._kept_size = 0
        self._sent_at = time.monotonic()
        self._queue: deque[memoryview] = deque()
        self._queued = 0
        self._gap = 0
        self.fault = ''
        self.written = self.dropped = 0
        self.paths: list[Path] = []
        self._process: subprocess.Popen[bytes] | None = None
        self._start_segment()

    # ---- what is recorded ------------------------------------------------------------------

    def tick(self, messages: Sequence[tuple[int, bytes]]) -> None:
        """Keep state messages of the present step and hand over what is due."""
        if self._process is None:
            return
        if self._queued > self._limit and not self._make_room():
            self.dropped += len(messages)
            self._gap += len(messages)
            return
        if self._process is None:  # it ended while we waited for room
            return
        if self._gap:
            gap, self._gap = self._gap, 0
            self.event(dropped=gap)
        simulation = self._simulation
        step, time_ns, now_ns = simulation.step_count, simulation.time_ns, time.time_ns()
        pack, kind, fixed, kept = wire.MESSAGE.pack, wire.MESSAGE_KIND, wire.FIXED, self._kept
        for topic, data in messages:  # as wire.head does, without a call for each message
            size = fixed + len(data)
            kept += (pack(kind, size, topic + 1, step, time_ns, now_ns), data)
            self._kept_size += size
        self._kept_size += wire.RECORD_HEAD * len(messages)
        self.written += len(messages)
        self.flush()

    def command(self, topic: int, data: bytes) -> None:
        """Keep a command as it was received; never dropped."""
        if self._process is None:
            return
        simulation = self._simulation
        head = wire.head(
            topic, simulation.step_count, simulation.time_ns, time.time_ns(), len(data)
        )
        self._kept += (head, data)
        self._kept_size += len(head) + len(data)
        self.written += 1

    def event(self, **change: Any) -> None:
        """Keep a change that no command message made."""
        self.command(self._event_topic, string_message(json.dumps(change)))

    # ---- hand-over -------------------------------------------------------------------------

    def flush(self, now: bool = False) -> None:
        """Send what was kept when there is enough of it or it is old enough, or now."""
        if self._process is None:
            return
        clock = time.monotonic()
        if not now and self._kept_size < _PORTION and clock - self._sent_at < _AGE:
            return
        self._sent_at = clock
        if self._kept:
            kept, size = self._kept, self._kept_size
            self._kept, self._kept_size = [], 0
            self._send(wire.MESSAGES, size, kept)
        elif self._queue:
            self._drain()

    def _send(self, kind: bytes, size: int, parts: Sequence[bytes]) -> None:
        frame = b''.join((wire.FRAME.pack(kind, size), *parts))
        self._queue.append(memoryview(frame))
        self._queued += len(frame)
        self._drain()

    def _drain(self) -> None:
        """Write as much of the queue as the pipe takes."""
        queue = self._queue
        try:
            while queue and self._process is not None:
                done = os.write(self._pipe, queue[0])
                self._queued -= done
                if done == len(queue[0]):
                    queue.popleft()
                else:
                    queue[0] = queue[0][done:]
        except BlockingIOError:
            return
        except BrokenPipeError:
            self._writer_ended()

    def _make_room(self) -> bool:
        """Return whether the queue has room; with policy ``block`` wait until it does."""
        self._drain()
        while self._queued > self._limit and self._options.policy == 'block':
            select.select([], [self._pipe], [])
            self._drain()
        return self._queued <= self._limit

    # ---- the process -----------------------------------------------------------------------

    def _start_segment(self) -> None:
        path = _create(_segment_path(self._options.path, len(self.paths)))
        self.paths.append(path)
        description = describe(self._simulation, self._topics, self._options)
        if self._process is None:
            self._start_process()
        run = description.run
        start = {
            'path': str(path.resolve()),
            'bag': self._options.path.suffix != '.mcap',
            'library': f'fluid_sim_ros {__version__}',
            'chunk_s': self._options.chunk_s,
            'wall_ns': time.time_ns(),
            'attachments': {
                name: base64.b64encode(data).decode()
                for name, data in description.attachments().items()
            },
            # for people and tools; what replay uses are the attachments, which have checksums
            'metadata': {
                'fluid_sim': {
                    'scene': run['scene']['name'], 'seed': str(run['seed']),
                    'timestep': repr(run['timestep']), 'integrator': run['integrator'],
                    **{name: str(value) for name, value in run['versions'].items()},
                },
                'parameters': {name: str(value) for name, value in run['settings'].items()},
            },
            'channels': [_channel(topic) for topic in self._topics],
        }  # fmt: skip
        payload = json.dumps(start).encode()
        self._send(wire.START, len(payload), [payload])

    def _start_process(self) -> None:
        # a session of its own: Ctrl-C in a terminal must end the simulation only, whose end ends
        # the writer
        self._process = subprocess.Popen(
            [sys.executable, '-m', 'fluid_sim_ros.recording.writer'],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True, bufsize=0,
        )  # fmt: skip
        self._pipe = _stream(self._process.stdin).fileno()
        os.set_blocking(self._pipe, False)
        with contextlib.suppress(OSError):  # beyond the user's limit: the default will do
            fcntl.fcntl(self._pipe, fcntl.F_SETPIPE_SZ, _PIPE_SIZE)

    def _writer_ended(self) -> None:
        """Note why the writer ended by itself; recording is over."""
        process, self._process = self._process, None
        self._queue.clear()
        self._kept = []
        self._queued = 0
        if process is None:
            return
        with contextlib.suppress(BrokenPipeError):
            _stream(process.stdin).close()
        lines = _stream(process.stdout).read().splitlines()
        code = process.wait()
        said = json.loads(lines[-1]) if lines else {}
        reason = said.get('fault', f'its writer ended with code {code}')
        self.fault = f'recording to {self.paths[-1]} stopped: {reason}'

    def next_segment(self) -> None:
        """Begin a new file: simulated time starts anew."""
        if self._process is None:
            return
        self.flush(now=True)
        self._send(wire.END, 0, [])
        try:
            self._start_segment()
        except FluidSimError as error:
            self.close()
            self.fault = f'recording stopped: {error}'

    def close(self) -> None:
        """End the file; waits until all is written."""
        if self._process is None:
            return
        self.flush(now=True)
        os.set_blocking(self._pipe, True)
        self._drain()
        process = self._process
        if process is None:
            return
        self._process = None
        _stream(process.stdin).close()
        said = _stream(process.stdout).read().splitlines()
        code = process.wait(_END_TIMEOUT)
        last = json.loads(said[-1]) if said else {}
        if code or 'fault' in last:
            reason = last.get('fault', f'its writer ended with code {code}')
            self.fault = f'recording to {self.paths[-1]} stopped: {reason}'


def open_recorder(
    simulation: Simulation, topics: Sequence[RecordedTopic], options: RecorderOptions
) -> Recorder:
    """Begin to record; see ``loop.recorder_port.open_recorder``."""
    return Recorder(simulation, topics, options)


def string_message(text: str) -> bytes:
    """Return a std_msgs/String as CDR bytes."""
    return Template(stamped=False).string(text).finish().bytes()


def _stream(stream: IO[bytes] | None) -> IO[bytes]:
    if stream is None:
        raise RuntimeError('the writer was started without its pipes')
    return stream


def _channel(topic: RecordedTopic) -> dict[str, Any]:
    known = definition(topic.type)
    return {
        'topic': topic.name,
        'type': topic.type,
        'definition': known.text,
        'metadata': {
            'offered_qos_profiles': rosbag2.qos_text(topic), 'topic_type_hash': known.hash
        },
    }  # fmt: skip


def _segment_path(path: Path, number: int) -> Path:
    """Return a segment's file; a path without ``.mcap`` is a folder (a rosbag2 bag)."""
    if path.suffix == '.mcap':
        return path.with_stem(f'{path.stem}_{number}') if number else path
    folder = path.with_name(f'{path.name}_{number}') if number else path
    return folder / f'{folder.name}_0.mcap'


def _create(path: Path) -> Path:
    """Make an empty file; an existing one is never overwritten."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch(exist_ok=False)
    except FileExistsError:
        raise ConfigError(f'record: {path} exists already; choose another path') from None
    except OSError as error:
        raise ConfigError(f'record: {path}: {error.strerror}') from None
    return path
