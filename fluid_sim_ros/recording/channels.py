# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The topics of a log: its schemas and channels, so far as their names are names of ROS."""

from fluid_sim_ros.errors import printable
from fluid_sim_ros.recording.damage import BadRecordError
from fluid_sim_ros.recording.log import LogTopic
from fluid_sim_ros.recording.records import Fields
from fluid_sim_ros.schema.limits import check_limit
from fluid_sim_ros.schema.ros_names import is_topic_name, is_type_name


class Channels:
    """
    Collects topics from records that may repeat one another, as they do in each chunk.

    Parameters
    ----------
    topics
        By channel id; filled.

    Attributes
    ----------
    left_out
        A line for each channel whose topic or type is no name: nothing of it is read, so that no
        such text reaches a path, an import or a terminal; and for one whose topic an earlier
        channel describes otherwise.

    """

    def __init__(self, topics: dict[int, LogTopic]) -> None:
        self._topics = topics
        self._schemas: dict[int, tuple[str, str]] = {}  # type and definition
        self._first: dict[str, LogTopic] = {}  # of channels that share a topic
        self._left_out: dict[int, str] = {}

    @property
    def left_out(self) -> list[str]:
        """The lines."""
        return list(self._left_out.values())

    def take_schema(self, record: bytes) -> None:
        """
        Take a schema.

        Parameters
        ----------
        record
            A schema record, without its head.

        Raises
        ------
        BadRecordError
            If it is cut, or another than before.

        """
        fields = Fields(record)
        number = fields.uint16()
        name = fields.string()
        fields.string()
        text = fields.string()
        check_limit('log_definition_bytes', len(text), f'the definition of schema {number}')
        if self._schemas.setdefault(number, (name, text)) != (name, text):
            raise BadRecordError(f'schema {number} is another than before')

    def take_channel(self, record: bytes) -> None:
        """
        Take a channel, whose schema stands before it.

        Parameters
        ----------
        record
            A channel record, without its head.

        Raises
        ------
        BadRecordError
            If it is cut, or another than before.

        """
        fields = Fields(record)
        number, schema = fields.uint16(), fields.uint16()
        name = fields.string()
        fields.string()
        pairs = Fields(fields.block())
        metadata = {}
        while pairs.left:
            key = pairs.string()
            metadata[key] = pairs.string()
        kind, text = self._schemas.get(schema, ('', ''))
        topic = LogTopic(name, kind, text, metadata)
        if not is_topic_name(name):
            fault = f"topic '{printable(name)}' is no name of ROS"
        elif not is_type_name(kind):
            fault = f"topic '{name}': type '{printable(kind)}' is no name of ROS"
        elif _described(self._first.setdefault(name, topic)) != (kind, text):
            fault = f"topic '{name}' has another type or definition in an earlier channel"
        elif self._topics.setdefault(number, topic) == topic:
            return
        else:
            raise BadRecordError(f'channel {number} is another than before')
        self._left_out[number] = f'channel {number} is left out: {fault}'


def _described(topic: LogTopic) -> tuple[str, str]:
    return topic.type, topic.definition
