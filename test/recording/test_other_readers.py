# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Readers of other projects find the same values in a log, and rosbag2's fields beside it."""

import numpy as np
import pytest
import yaml
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader as Bag
from rosbags.typesys import Stores, get_typestore

from fluid_sim_ros.recording.decode import fields
from fluid_sim_ros.recording.inspect import repair
from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def flight(tmp_path_factory):
    """Return the path of a short piloted flight."""
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=1.0, seed=1)
    return path


def flattened(message, prefix=''):
    """Return the numbers and strings of a decoded message by dotted name."""
    found = {}
    slots = getattr(message, '__slots__', None) or vars(message)
    for name in slots:
        value, name = getattr(message, name), f'{prefix}{name}'
        if isinstance(value, str | int | float):
            found[name] = value
        elif isinstance(value, bytes | list | tuple | np.ndarray):
            for i, item in enumerate(value):
                plain = isinstance(item, str | int | float | np.number)
                part = {f'{name}[{i}]': item} if plain else flattened(item, f'{name}[{i}].')
                found |= part
        else:
            found |= flattened(value, f'{name}.')
    constants = ('__msgtype__', *(name for name in found if name.split('.')[-1].isupper()))
    return {name: value for name, value in found.items() if not name.endswith(constants)}


def test_values_equal_those_of_mcap_ros2_support(flight):
    log = open_log(flight)
    ours = [fields(log.topic(m.topic).definition, m.data) for m in log.messages()]
    with flight.open('rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        theirs = [flattened(m) for *_, m in reader.iter_decoded_messages(log_time_order=False)]
    assert ours == theirs


def test_values_equal_those_of_rosbags_also_as_a_bag(flight, tmp_path):
    repair(flight, tmp_path / 'bag')
    log = open_log(flight)
    ours = sorted(
        (m.topic, m.log_ns, str(fields(log.topic(m.topic).definition, m.data)))
        for m in log.messages()
    )
    for path in (flight, tmp_path / 'bag'):
        with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
            assert reader.message_count == len(ours)
            theirs = sorted(
                (
                    connection.topic, time_ns,
                    str(flattened(reader.deserialize(data, connection.msgtype))),
                )
                for connection, time_ns, data in reader.messages()
            )  # fmt: skip
        assert [row[:2] for row in ours] == [row[:2] for row in theirs]
        for mine, other in zip(ours, theirs, strict=True):
            names = {'np': np, 'inf': np.inf}
            assert eval(mine[2], names) == eval(other[2], names)  # noqa: S307 - reprs of numbers


def test_a_folder_is_recorded_as_a_bag(tmp_path):
    record_flight(tmp_path / 'bag', 'sphere', seconds=0.2, piloted=False)
    record_flight(tmp_path / 'a' / 'a_0.mcap', 'sphere', seconds=0.2, piloted=False)
    assert sorted(p.name for p in (tmp_path / 'bag').iterdir()) == ['bag_0.mcap', 'metadata.yaml']
    assert [p.name for p in (tmp_path / 'a').iterdir()] == ['a_0.mcap']
    with AnyReader([tmp_path / 'bag']) as reader:
        topics = {connection.topic: connection for connection in reader.connections}
        assert topics['/sphere/odom'].msgcount == 21
        assert reader.duration == 200_000_001  # rosbags counts the last message's nanosecond
    with Bag(tmp_path / 'bag') as bag:
        offered = {c.topic: c.ext.offered_qos_profiles[0] for c in bag.connections}
    assert offered['/sphere/odom'].durability.name == 'VOLATILE'
    assert offered['/sphere/markers'].durability.name == 'TRANSIENT_LOCAL'
    assert len(list(open_log(tmp_path / 'bag').messages(['/sphere/odom']))) == 21


def test_the_metadata_of_a_bag_has_the_fields_that_jazzy_writes(tmp_path):
    """In their order, as `ros2 bag record -s mcap` of Jazzy writes them (metadata version 9)."""
    record_flight(tmp_path / 'bag', 'sphere', seconds=0.1, piloted=False)
    about = yaml.safe_load((tmp_path / 'bag/metadata.yaml').read_text())
    assert list(about) == ['rosbag2_bagfile_information']
    about = about['rosbag2_bagfile_information']
    assert list(about) == [
        'version', 'storage_identifier', 'duration', 'starting_time', 'message_count',
        'topics_with_message_count', 'compression_format', 'compression_mode',
        'relative_file_paths', 'files', 'custom_data', 'ros_distro',
    ]  # fmt: skip
    assert (about['version'], about['storage_identifier'], about['ros_distro']) == (
        9, 'mcap', 'jazzy',
    )  # fmt: skip
    assert list(about['files'][0]) == ['path', 'starting_time', 'duration', 'message_count']
    assert about['duration'] == {'nanoseconds': 100_000_000}
    assert about['starting_time'] == {'nanoseconds_since_epoch': 0}
    entry = about['topics_with_message_count'][0]
    assert list(entry) == ['topic_metadata', 'message_count']
    assert list(entry['topic_metadata']) == [
        'name', 'type', 'serialization_format', 'offered_qos_profiles', 'type_description_hash',
    ]  # fmt: skip
    offered = entry['topic_metadata']['offered_qos_profiles'][0]
    assert list(offered) == [
        'history', 'depth', 'reliability', 'durability', 'deadline', 'lifespan', 'liveliness',
        'liveliness_lease_duration', 'avoid_ros_namespace_conventions',
    ]  # fmt: skip
    assert offered['lifespan'] == {'sec': 9223372036, 'nsec': 854775807}
    counts = [entry['message_count'] for entry in about['topics_with_message_count']]
    assert sum(counts) == about['message_count'] == about['files'][0]['message_count']
    with (tmp_path / 'bag/bag_0.mcap').open('rb') as stream:
        channels = make_reader(stream).get_summary().channels.values()
    for channel, entry in zip(channels, about['topics_with_message_count'], strict=True):
        topic = entry['topic_metadata']
        assert (
            yaml.safe_load(channel.metadata['offered_qos_profiles'])
            == (topic['offered_qos_profiles'])
        )
        assert channel.metadata['topic_type_hash'] == topic['type_description_hash']
