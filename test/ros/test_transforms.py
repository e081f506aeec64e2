# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``/tf`` and ``/tf_static`` on the graph, with ROS's own type or without the package tf2_msgs."""

import pytest
from rclpy.type_support import check_for_type_support
from rosbags.typesys import Stores, get_typestore
from rosidl_generator_type_description import calculate_type_hash
from type_description_interfaces.srv import GetTypeDescription

from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.messages.topic import LATCHED, STATE
from fluid_sim_ros.messages.transform_topics import TRANSFORMS
from fluid_sim_ros.ros import transforms_type
from fluid_sim_ros.ros.message_types import find_message_class
from fluid_sim_ros.ros.raw import PolledSubscription, RawPublisher
from test.support.ros_processes import Peer, node, wait_until

pytestmark = pytest.mark.ros

KINDS = get_typestore(Stores.ROS2_JAZZY)
#: Of tf2_msgs/msg/TFMessage in ROS 2 Jazzy, as its package states it.
JAZZY = 'RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087'


def frames(data):
    message = KINDS.deserialize_cdr(data, TRANSFORMS)
    return {(t.header.frame_id, t.child_frame_id) for t in message.transforms}


def take(subscription, what):
    """Return the first message of a subscription."""
    found = []
    wait_until(lambda: found.append(subscription.take()) or found[-1], what)
    return found[-1]


def test_a_node_publishes_tf_and_who_comes_later_gets_tf_static():
    with Peer() as peer, node(scene='remus100'):
        moving = PolledSubscription(peer.node, TRANSFORMS, '/tf', STATE)
        found = frames(take(moving, '/tf'))
        assert ('remus100/base_link', 'remus100/rudder') in found
        for _ in range(2):  # the second comes after the first has had its message
            still = PolledSubscription(peer.node, TRANSFORMS, '/tf_static', LATCHED)
            assert ('map', 'remus100/odom') in frames(take(still, '/tf_static'))
        for topic in ('/tf', '/tf_static'):
            known = peer.node.get_publishers_info_by_topic(topic)
            assert [(i.topic_type, str(i.topic_type_hash)) for i in known] == [(TRANSFORMS, JAZZY)]


def test_its_description_has_the_hash_of_jazzy():
    """Asked for over ROS's own service, and hashed by ROS's own code."""
    with Peer() as peer:
        RawPublisher(peer.node, TRANSFORMS, '/tf', STATE)
        answer = peer.call(
            GetTypeDescription, f'{peer.node.get_name()}/get_type_description',
            type_name=TRANSFORMS, type_hash=JAZZY, include_type_sources=True,
        )  # fmt: skip
    assert answer.successful, answer.failure_reason
    assert calculate_type_hash(as_json(answer.type_description)) == JAZZY
    sources = {source.type_name: source.raw_file_contents for source in answer.type_sources}
    assert sources[TRANSFORMS].startswith('geometry_msgs/TransformStamped[] transforms')
    assert 'geometry_msgs/msg/TransformStamped' in sources


def as_json(message):
    """Return a message as nested values."""
    if isinstance(message, list):
        return [as_json(item) for item in message]
    if hasattr(message, 'get_fields_and_field_types'):
        names = message.get_fields_and_field_types()
        return {name: as_json(getattr(message, name)) for name in names}
    return message


def test_messages_pass_as_bytes_and_as_objects_they_are_refused():
    kind = find_message_class(TRANSFORMS)
    check_for_type_support(kind)
    data = Template.of(TRANSFORMS, {'transforms': [{'child_frame_id': 'a' * 300}] * 200}).bytes()
    with Peer() as peer:
        publisher = RawPublisher(peer.node, TRANSFORMS, 'some', LATCHED)
        publisher.publish(data)
        subscription = PolledSubscription(peer.node, TRANSFORMS, 'some', LATCHED)
        assert take(subscription, 'the message') == data
        if kind is transforms_type.transforms_type():
            own = peer.node.create_publisher(kind, 'other', 1)
            with pytest.raises(TypeError, match='capsule'):
                own.publish(kind())


def test_the_type_is_made_once_and_for_the_middleware_of_the_wheels_alone(monkeypatch):
    assert transforms_type.transforms_type() is transforms_type.transforms_type()
    transforms_type.transforms_type.cache_clear()
    monkeypatch.setattr(
        transforms_type, 'get_rmw_implementation_identifier', lambda: 'rmw_cyclonedds_cpp'
    )
    assert transforms_type.transforms_type() is None
    transforms_type.transforms_type.cache_clear()


def test_the_hash_that_is_kept_is_that_of_jazzy():
    assert definition(TRANSFORMS).hash == JAZZY


def test_what_cannot_be_published_is_said_with_the_remedy(monkeypatch):
    """Such as with another middleware, where ROS lacks tf2_msgs."""
    from fluid_sim_ros import Simulation
    from fluid_sim_ros.messages.state_topics import DEFAULTS
    from fluid_sim_ros.ros import outputs

    find = outputs.find_message_class
    monkeypatch.setattr(
        outputs, 'find_message_class', lambda kind: None if kind == TRANSFORMS else find(kind)
    )
    lines = []
    with Peer() as peer:
        monkeypatch.setattr(peer.node.get_logger(), 'warning', lines.append)
        settings = {**DEFAULTS, 'publish.thread': 'auto', 'pacing': 'free'}
        made = outputs.Outputs(peer.node, Simulation('sphere'), settings)
        made.destroy()
    (line,) = lines
    assert line.startswith('/tf_static, /tf: in logs only') and 'ros-jazzy-tf2-msgs' in line
