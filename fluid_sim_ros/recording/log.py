# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An opened log: what is in it, and its messages from those chunks that are sound."""

from array import array
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.recording.damage import BadRecordError, LogError, reading
from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.description import RunDescription
from fluid_sim_ros.recording.records import MESSAGE, MESSAGE_HEAD, Chunk, decompress, records

#: What each later pass over a file is called.
_READING = 'reading [chunks]'


class LogMessage(NamedTuple):
    """One message: topic, step, simulated time [ns], wall time [ns], CDR bytes."""

    topic: str
    step: int
    log_ns: int
    publish_ns: int
    data: bytes


@dataclass(frozen=True)
class LogTopic:
    """A topic of a log."""

    name: str
    type: str
    definition: str
    metadata: dict[str, str]


@dataclass
class Log:
    """
    An opened log.

    Attributes
    ----------
    path, size
        The file and its size [bytes].
    faults
        One line for each part that is damaged or missing; empty for a sound file.
    complete
        Whether the file was ended properly.
    topics
        By channel id.
    attachments
        By name.
    chunks
        Where the messages stand, in the order of the file; the checksum of each is right.
    report
        Is told how far each pass over the file is.

    """

    path: Path
    size: int = 0
    faults: list[str] = field(default_factory=list)
    complete: bool = False
    library: str = ''
    topics: dict[int, LogTopic] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)
    report: Report = silent

    def messages(
        self, topics: Collection[str] | None = None, lost: list[str] | None = None
    ) -> Iterator[LogMessage]:
        """
        Return messages in the order of the file.

        Parameters
        ----------
        topics
            Full names of topics; None: all.
        lost
            Takes a line for each chunk that lies, which is then left behind; None: an error.

        Returns
        -------
        Iterator
            The messages.

        Raises
        ------
        LogError
            If a chunk does not hold what its checksum vouches for: its writer lied.

        """
        wanted = {
            number: topic.name
            for number, topic in self.topics.items()
            if topics is None or topic.name in topics
        }
        with self.path.open('rb') as stream:
            for number, chunk in enumerate(self.chunks):
                self.report(_READING, number, len(self.chunks))
                try:
                    with reading(self.path, f'chunk at byte {chunk.at}'):
                        stream.seek(chunk.offset)
                        content = decompress(chunk, stream.read(chunk.size))
                        yield from _messages(content, wanted)
                except LogError as error:
                    if lost is None:
                        raise
                    lost.append(f'chunk at byte {chunk.at}: {error.__cause__}')
        self.report(_READING, len(self.chunks), len(self.chunks))

    def topic(self, name: str) -> LogTopic:
        """
        Return a topic by name.

        Parameters
        ----------
        name
            Full name.

        Returns
        -------
        LogTopic
            The topic.

        Raises
        ------
        LogError
            With the names that exist.

        """
        for topic in self.topics.values():
            if topic.name == name:
                return topic
        names = sorted(t.name for t in self.topics.values())
        hint = did_you_mean(name, names)
        raise LogError(f"{self.path}: no topic '{name}'{hint} it has: {listed(names)}")

    def series(self, topics: Collection[str]) -> dict[str, 'Series']:
        """
        Return the messages of some topics as arrays, in one pass over the file.

        Parameters
        ----------
        topics
            Their full names.

        Returns
        -------
        dict
            By topic, in the order of the file.

        Raises
        ------
        LogError
            As ``messages``.

        """
        found = {name: Series() for name in topics}
        for message in self.messages(topics):
            found[message.topic].add(message)
        return found

    def table(self, topic: LogTopic, messages: Sequence[bytes]) -> dict[str, NDArray[Any]]:
        """
        Return one array per field of a topic's messages; see ``decode.columns``.

        Parameters
        ----------
        topic
            Of this log.
        messages
            CDR bytes of its messages.

        Returns
        -------
        dict
            Array of shape (messages,) by name.

        Raises
        ------
        LogError
            If a message does not fit the definition, or the table goes beyond a limit.

        """
        with reading(self.path, f"topic '{topic.name}'"):
            return columns(topic.definition, messages)

    def description(self) -> RunDescription:
        """Return the run's description, or raise LogError."""
        with reading(self.path):
            return RunDescription.of_attachments(self.attachments)


class Series:
    """
    Messages of one topic, packed: a log may hold millions.

    Attributes
    ----------
    steps, log_ns, publish_ns
        Step, simulated time [ns] and wall time [ns] of each.
    data
        CDR bytes of each.

    """

    def __init__(self) -> None:
        self._steps, self._log_ns, self._publish_ns = array('Q'), array('Q'), array('Q')
        self.data: list[bytes] = []

    def __len__(self) -> int:
        return len(self.data)

    def add(self, message: LogMessage) -> None:
        """
        Add a message.

        Parameters
        ----------
        message
            Of the topic.

        """
        self._steps.append(message.step)
        self._log_ns.append(message.log_ns)
        self._publish_ns.append(message.publish_ns)
        self.data.append(message.data)

    @property
    def steps(self) -> NDArray[Any]:
        """Step of each."""
        return _whole(self._steps)

    @property
    def log_ns(self) -> NDArray[Any]:
        """Simulated time of each [ns]."""
        return _whole(self._log_ns)

    @property
    def publish_ns(self) -> NDArray[Any]:
        """Wall time of each [ns]."""
        return _whole(self._publish_ns)


def _whole(numbers: 'array[int]') -> NDArray[Any]:
    """Return whole numbers, signed ones where they fit: files have other types of column else."""
    found = np.array(numbers, dtype=np.uint64)
    return found if (found >> np.uint64(63)).any() else found.astype(np.int64)


def _messages(content: bytes, wanted: Mapping[int, str]) -> Iterator[LogMessage]:
    """Yield the messages of some channels that stand in a chunk's content."""
    size = MESSAGE_HEAD.size
    for kind, begin, end in records(content):
        if kind != MESSAGE:
            continue
        if begin + size > end:
            raise BadRecordError(f'the message at byte {begin} of its content is too short')
        channel, step, log_ns, wall_ns = MESSAGE_HEAD.unpack_from(content, begin)
        name = wanted.get(channel)
        if name is not None:
            yield LogMessage(name, step, log_ns, wall_ns, content[begin + size : end])
