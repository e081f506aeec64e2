# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What rosbag2 wants beside the messages: quality of service and ``metadata.yaml``."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.recorder_port import RecordedTopic
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.schema.yaml_file import parse_yaml

#: Version of metadata.yaml that ROS 2 Jazzy writes.
_VERSION = 9
#: Longest text of a topic's quality of service [characters]; ours has 400.
_LONGEST_PROFILES = 10_000
_INFINITE = {'sec': 9223372036, 'nsec': 854775807}


def qos(topic: RecordedTopic) -> list[dict[str, Any]]:
    """
    Return a topic's offered quality of service as rosbag2 (Jazzy) writes it.

    Parameters
    ----------
    topic
        The topic.

    Returns
    -------
    list
        One mapping, as rosbag2 has it.

    """
    return [
        {
            'history': 'keep_last',
            'depth': topic.depth,
            'reliability': 'reliable' if topic.reliable else 'best_effort',
            'durability': 'transient_local' if topic.transient_local else 'volatile',
            'deadline': dict(_INFINITE),
            'lifespan': dict(_INFINITE),
            'liveliness': 'automatic',
            'liveliness_lease_duration': dict(_INFINITE),
            'avoid_ros_namespace_conventions': False,
        }
    ]


def qos_text(topic: RecordedTopic) -> str:
    """
    Return the quality of service as the text that channel metadata holds.

    Parameters
    ----------
    topic
        The topic.

    Returns
    -------
    str
        YAML.

    """
    return yaml.dump(qos(topic), sort_keys=False, Dumper=_Plain)


def recorded_topic(name: str, kind: str, channel: Mapping[str, str]) -> RecordedTopic:
    """
    Return a topic with the quality of service that its channel's metadata tells, if it does.

    Parameters
    ----------
    name, kind
        Full name and message type.
    channel
        Metadata of the channel.

    Returns
    -------
    RecordedTopic
        The topic; with the default quality of service where the channel tells none.

    """
    try:
        offered = _profiles(channel)[0]
        reliable, durable = offered['reliability'], offered['durability']
    except (TypeError, LookupError):
        return RecordedTopic(name, kind)
    # words since rosbag2 of Jazzy, numbers before; the depth matters to the sender only
    return RecordedTopic(
        name, kind, reliable=reliable in ('reliable', 1),
        transient_local=durable in ('transient_local', 1),
    )  # fmt: skip


def _profiles(channel: Mapping[str, str]) -> Any:
    """Return the quality of service that a channel's metadata states, or an empty list."""
    text = channel.get('offered_qos_profiles', '')
    if len(text) > _LONGEST_PROFILES or '*' in text:  # an alias: written out it could be huge
        return []
    try:
        return parse_yaml(text.encode(), '') or []
    except ConfigError:
        return []


class _Plain(yaml.SafeDumper):
    """Writes equal values out in full; rosbag2 reads no anchors."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def write_metadata(
    path: Path,
    channels: Sequence[dict[str, Any]],
    counts: Sequence[int],
    first_ns: int,
    last_ns: int,
) -> None:
    """
    Write ``metadata.yaml`` beside an MCAP file, so that its folder is a bag.

    Parameters
    ----------
    path
        The MCAP file.
    channels
        ``topic``, ``type`` and ``metadata`` of each channel.
    counts
        Messages of each channel.
    first_ns, last_ns
        Simulated time of the first and last message [ns].

    """
    start, duration = {'nanoseconds_since_epoch': first_ns}, {'nanoseconds': last_ns - first_ns}
    total = sum(counts)
    topics = [
        {
            'topic_metadata': {
                'name': channel['topic'],
                'type': channel['type'],
                'serialization_format': 'cdr',
                'offered_qos_profiles': _profiles(channel['metadata']),
                'type_description_hash': channel['metadata'].get('topic_type_hash', ''),
            },
            'message_count': count,
        }
        for channel, count in zip(channels, counts, strict=True)
    ]
    file = {
        'path': path.name, 'starting_time': start, 'duration': duration, 'message_count': total
    }  # fmt: skip
    content = {
        'rosbag2_bagfile_information': {
            'version': _VERSION,
            'storage_identifier': 'mcap',
            'duration': duration,
            'starting_time': start,
            'message_count': total,
            'topics_with_message_count': topics,
            'compression_format': '',
            'compression_mode': '',
            'relative_file_paths': [path.name],
            'files': [file],
            'custom_data': None,
            'ros_distro': 'jazzy',
        }
    }
    text = yaml.dump(content, sort_keys=False, Dumper=_Plain)
    with new_file(path.parent / 'metadata.yaml') as file_:
        file_.write_text(text, encoding='utf-8')
