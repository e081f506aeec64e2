# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hands what is recorded to the writer process, without holding up the steps."""

import base64
import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros import __version__
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.loop.recorder_port import EVENTS, EVENTS_TYPE, RecordedTopic, RecorderOptions
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.recording.description import describe
from fluid_sim_ros.recording.writing import rosbag2, wire
from fluid_sim_ros.recording.writing.segments import create_segment
from fluid_sim_ros.recording.writing.writer_process import WriterProcess
from fluid_sim_ros.simulation import Simulation

#: Messages are sent when they are this many [bytes] or this old [s]; smaller portions would wake
#: the writer too often.
_PORTION, _AGE = 1 << 18, 0.02


class Recorder:
    """
    A recording in progress; see ``loop.recorder_port.RecorderPort``.

    Parameters
    ----------
    simulation
        At step 0.
    topics
        What is recorded beside the events; messages name a topic by its place here.
    options
        Where to, and how.

    Attributes
    ----------
    fault
        Why recording ended by itself (such as a full disk), or empty.
    written, dropped
        Messages handed over, and left out because the queue was full.
    paths
        The files, one per segment.
    writer
        The process that writes them.

    Raises
    ------
    ConfigError
        If the file cannot be made.

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
        self._kept: list[bytes] = []
        self._kept_size = 0
        self._sent_at = time.monotonic()
        self._gap = 0
        self.fault = ''
        self.written = self.dropped = 0
        self.paths: list[Path] = []
        self.writer = WriterProcess(int(options.queue_mib * (1 << 20)), options.policy == 'block')
        try:
            start = self._start()
        except FluidSimError:
            self.writer.close()
            raise
        self._send(wire.START, len(start), [start])

    # ---- what is recorded ------------------------------------------------------------------

    def tick(self, messages: Sequence[tuple[int, bytes]]) -> None:
        """
        Keep state messages of the present step and hand over what is due.

        Parameters
        ----------
        messages
            Place of the topic, and CDR bytes.

        """
        writer = self.writer
        if not writer.running:
            return
        if not writer.has_room():
            self.dropped += len(messages)
            self._gap += len(messages)
            return
        if not writer.running:  # it ended while we waited for room
            self._note_end()
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
        """
        Keep a command as it was received; never dropped.

        Parameters
        ----------
        topic
            Place of the topic.
        data
            CDR bytes.

        """
        if not self.writer.running:
            return
        simulation = self._simulation
        head = wire.head(
            topic, simulation.step_count, simulation.time_ns, time.time_ns(), len(data)
        )
        self._kept += (head, data)
        self._kept_size += len(head) + len(data)
        self.written += 1

    def event(self, **change: Any) -> None:
        """
        Keep a change that no command message made.

        Parameters
        ----------
        change
            Its fields, which JSON can hold.

        """
        self.command(self._event_topic, string_message(json.dumps(change)))

    # ---- hand-over -------------------------------------------------------------------------

    def flush(self, now: bool = False) -> None:
        """
        Send what was kept when there is enough of it or it is old enough.

        Parameters
        ----------
        now
            Send it anyhow.

        """
        if not self.writer.running:
            return
        clock = time.monotonic()
        if not now and self._kept_size < _PORTION and clock - self._sent_at < _AGE:
            return
        self._sent_at = clock
        if self._kept:
            kept, size = self._kept, self._kept_size
            self._kept, self._kept_size = [], 0
            self._send(wire.MESSAGES, size, kept)
        else:
            self.writer.drain()
            self._note_end()

    def _send(self, kind: bytes, size: int, parts: Sequence[bytes]) -> None:
        self.writer.send(kind, size, parts)
        self._note_end()

    def _note_end(self) -> None:
        """Say why the writer ended by itself, if it did; recording is over then."""
        if self.writer.fault and not self.fault:
            self._kept, self._kept_size = [], 0
            self.fault = f'recording to {self.paths[-1]} stopped: {self.writer.fault}'

    # ---- files -----------------------------------------------------------------------------

    def _start(self) -> bytes:
        """Make the next of the files, and return the frame that begins it."""
        description = describe(self._simulation, self._topics, self._options)
        self.paths.append(create_segment(self._options.path, len(self.paths)))
        run = description.run
        start = {
            'path': str(self.paths[-1].resolve()),
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
        return json.dumps(start).encode()

    def next_segment(self) -> None:
        """Begin a new file: simulated time starts anew."""
        if not self.writer.running:
            return
        self.flush(now=True)
        self._send(wire.END, 0, [])
        try:
            start = self._start()
        except (FluidSimError, OSError) as error:  # such as a full disk, or too few file handles
            self.close()
            self.fault = self.fault or f'recording stopped: {error}'
            return
        self._send(wire.START, len(start), [start])

    def close(self) -> None:
        """End the file; waits until all is written."""
        if not self.writer.running:
            return
        self.flush(now=True)
        if self.writer.running:
            self.writer.close()
            self._note_end()


def open_recorder(
    simulation: Simulation, topics: Sequence[RecordedTopic], options: RecorderOptions
) -> Recorder:
    """
    Begin to record; see ``loop.recorder_port.open_recorder``.

    Parameters
    ----------
    simulation
        At step 0.
    topics
        What is recorded beside the events; messages name a topic by its place here.
    options
        Where to, and how.

    Returns
    -------
    Recorder
        The recording.

    Raises
    ------
    ConfigError
        If the file cannot be made.

    """
    return Recorder(simulation, topics, options)


def string_message(text: str) -> bytes:
    """
    Return a std_msgs/String as CDR bytes.

    Parameters
    ----------
    text
        What it says.

    Returns
    -------
    bytes
        The message.

    """
    return Template.of(EVENTS_TYPE, {'data': text}).bytes()


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
