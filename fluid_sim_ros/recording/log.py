"""An opened log: what is in it, and its messages from those chunks that are sound."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.recording.description import LogError, RunDescription
from fluid_sim_ros.recording.records import MESSAGE, MESSAGE_HEAD, Chunk, decompress, records


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

    """

    path: Path
    size: int = 0
    faults: list[str] = field(default_factory=list)
    complete: bool = False
    library: str = ''
    topics: dict[int, LogTopic] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)

    def messages(self, topics: Collection[str] | None = None) -> Iterator[LogMessage]:
        """
        Return messages in the order of the file.

        Parameters
        ----------
        topics
            Full names of topics; None: all.

        Returns
        -------
        Iterator
            The messages.

        """
        wanted = {
            number: topic.name
            for number, topic in self.topics.items()
            if topics is None or topic.name in topics
        }
        with self.path.open('rb') as stream:
            for chunk in self.chunks:
                stream.seek(chunk.offset)
                content = decompress(chunk, stream.read(chunk.size))
                for kind, begin, end in records(content):
                    if kind != MESSAGE:
                        continue
                    channel, step, log_ns, wall_ns = MESSAGE_HEAD.unpack_from(content, begin)
                    name = wanted.get(channel)
                    if name is not None:
                        data = content[begin + MESSAGE_HEAD.size : end]
                        yield LogMessage(name, step, log_ns, wall_ns, data)

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

    def description(self) -> RunDescription:
        """Return the run's description, or raise LogError."""
        try:
            return RunDescription.of_attachments(self.attachments)
        except LogError as error:
            raise LogError(f'{self.path}: {error}') from None
