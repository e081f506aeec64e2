# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""CDR templates: the bytes that are published equal those of the middleware's serialiser."""

import array

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import JointState, NavSatFix
from std_msgs.msg import Float64MultiArray
from visualization_msgs.msg import Marker, MarkerArray

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages import definitions
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.members import MessageType
from fluid_sim_ros.messages.templates import StampBytes, Template, as_bytes
from fluid_sim_ros.ros.message_types import message_class

pytestmark = pytest.mark.ros

TIME_NS = 1_234_567_890_123
TRANSFORMS = 'tf2_msgs/msg/TFMessage'
ODOMETRY = 'nav_msgs/msg/Odometry'
TYPES = sorted(definitions.known())


def fill(template, *blocks):
    """Set all stamps and blocks of a template."""
    stamp = StampBytes()
    stamp.set(TIME_NS)
    for place in template.stamps:
        place[:] = stamp.view
    for target, numbers in zip(template.blocks, blocks, strict=True):
        target[:] = as_bytes(np.array(numbers, dtype=float))
    return template


def assert_same(template, message):
    """Compare every byte but the padding, which the middleware leaves to chance."""
    ours = bytearray(template.bytes())
    # behind an empty sequence the middleware reckons with padding that is not there
    theirs = bytearray(serialize_message(message))[: len(ours)]
    for place in template.padding:
        assert ours[place] == 0
        theirs[place] = 0
    assert ours == theirs


def stamped(message):
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(TIME_NS, 10**9)
    return message


def set_xyz(target, numbers):
    for axis, number in zip('xyzw', numbers, strict=False):
        setattr(target, axis, float(number))


def fill_at_random(message, random, depth=0):
    """Give every member of a ROS message a random value, and return the same as nested values."""
    values = {}
    for name, kind in message.get_fields_and_field_types().items():
        member = getattr(message, name)
        if hasattr(member, 'get_fields_and_field_types'):
            values[name] = fill_at_random(member, random, depth + 1)
            continue
        if isinstance(member, str):
            value = 'x' * int(random.integers(0, 6))
        elif isinstance(member, bool):
            value = bool(random.integers(2))
        elif isinstance(member, np.ndarray):
            value = random.normal(size=member.shape).astype(member.dtype)
        elif isinstance(member, array.array):
            count = int(random.integers(0, 4))
            value = array.array(member.typecode, random.integers(0, 100, count).tolist())
        elif isinstance(member, bytes):
            value = bytes([int(random.integers(256))])
        elif isinstance(member, list):
            item = kind.removeprefix('sequence<').removesuffix('>')
            count = int(random.integers(0, 3))
            if item == 'string':
                value = ['y' * int(random.integers(0, 6)) for _ in range(count)]
            else:
                package, name_of_type = item.split('/')
                value = [message_class(f'{package}/msg/{name_of_type}')() for _ in range(count)]
                values[name] = [fill_at_random(v, random, depth + 1) for v in value]
        elif isinstance(member, int):
            value = int(random.integers(0, 100))
        else:
            value = float(np.float32(random.normal()))
        setattr(message, name, value)
        if name not in values:
            values[name] = value[0] if isinstance(value, bytes) else value
    return values


@pytest.mark.parametrize('name', [name for name in TYPES if name != TRANSFORMS])
def test_every_kept_type_is_written_as_the_middleware_writes_it(name):
    """Sixteen messages with random numbers, strings and lengths: every alignment occurs."""
    random = np.random.default_rng(1)
    for _ in range(16):
        message = message_class(name)()
        assert_same(Template.of(name, fill_at_random(message, random)), message)


@pytest.mark.parametrize('name', [name for name in TYPES if name != TRANSFORMS])
def test_what_is_not_given_has_the_default_of_the_definition(name):
    """Such as a quaternion, whose w is 1."""
    assert_same(Template.of(name), message_class(name)())


def test_blocks_and_stamps_are_views_that_change_the_message():
    numbers = np.random.default_rng(0).normal(size=13)
    message = stamped(Odometry())
    message.header.frame_id = 'rov/odom'
    message.child_frame_id = 'rov/base_link'
    pose, twist = message.pose.pose, message.twist.twist
    set_xyz(pose.position, numbers[:3])
    set_xyz(pose.orientation, numbers[3:7])
    set_xyz(twist.linear, numbers[7:10])
    set_xyz(twist.angular, numbers[10:])
    message.pose.covariance = np.diag([1.0, 2, 3, 4, 5, 6]).ravel()
    template = Template.of(
        ODOMETRY,
        {
            'header.frame_id': 'rov/odom',
            'child_frame_id': 'rov/base_link',
            'pose.covariance': np.diag([1.0, 2, 3, 4, 5, 6]).ravel(),
        },
        ['twist.twist', 'pose.pose.position', 'pose.pose.orientation'],
    )
    assert_same(fill(template, numbers[7:], numbers[:3], numbers[3:7]), message)


@pytest.mark.parametrize('count', [0, 1, 2, 5])
def test_sequences_as_blocks(count):
    names = [f'joint_{"x" * i}' for i in range(count)]
    rows = np.random.default_rng(count).normal(size=(3, count))
    message = stamped(JointState(name=names))
    message.position, message.velocity, message.effort = (row.tolist() for row in rows)
    lists = ['position', 'velocity', 'effort']
    constants = {'name': names, **{member: [0.0] * count for member in lists}}
    template = Template.of('sensor_msgs/msg/JointState', constants, lists)
    assert_same(fill(template, *rows), message)
    array_of_numbers = Template.of('std_msgs/msg/Float64MultiArray', {'data': rows[0]}, ['data'])
    assert_same(array_of_numbers, Float64MultiArray(data=rows[0].tolist()))


@pytest.mark.parametrize('frame', ['g', 'gn', 'gns', 'gnss'])  # each alignment of what follows
def test_numbers_of_several_sizes(frame):
    message = stamped(NavSatFix(latitude=47.4, longitude=8.5, altitude=500.0))
    message.header.frame_id = frame
    message.status.service = 1
    message.position_covariance_type = NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
    template = Template.of(
        'sensor_msgs/msg/NavSatFix',
        {
            'header.frame_id': frame, 'status': {'status': -1, 'service': 1},
            'position_covariance_type': 2,
        },
        ['altitude', 'latitude', 'longitude'],
    )  # fmt: skip
    message.status.status = -1
    assert_same(fill(template, [500.0], [47.4], [8.5]), message)


@pytest.mark.parametrize('name', ['a', 'ab', 'abc', 'abcd'])  # each alignment of what follows
def test_sequences_of_messages_have_blocks_of_their_own(name):
    """A pose of one marker and the points of another; a stamp that is given stays."""
    pose, ends = np.random.default_rng(3).normal(size=7), np.arange(1.0, 7.0)
    cube = stamped(Marker(ns=name, type=Marker.CUBE))
    set_xyz(cube.pose.position, pose[:3])
    set_xyz(cube.pose.orientation, pose[3:])
    arrow = stamped(Marker(type=Marker.ARROW, text=name))
    points = message_class('geometry_msgs/msg/Point')
    arrow.points = [points(x=1.0, y=2.0, z=3.0), points(x=4.0, y=5.0, z=6.0)]
    no_texture = {'texture.header.stamp': {}}
    markers = [
        {'ns': name, 'type': 1, **no_texture},
        {'type': 0, 'text': name, 'points': [{}, {}], **no_texture},
    ]
    template = Template.of(
        'visualization_msgs/msg/MarkerArray', {'markers': markers},
        ['markers[0].pose', 'markers[1].points'],
    )  # fmt: skip
    assert_same(fill(template, pose, ends), MarkerArray(markers=[cube, arrow]))


def test_transforms():
    """Read back by an independent reader, as ROS's own message need not be installed."""
    rows = np.random.default_rng(1).normal(size=(2, 7))
    frames = [('map', 'rov/odom'), ('rov/odom', 'rov/base_link')]
    transforms = [{'header.frame_id': p, 'child_frame_id': c} for p, c in frames]
    blocks = [
        f'transforms[{i}].transform.{part}' for i in (0, 1) for part in ('translation', 'rotation')
    ]
    template = Template.of(TRANSFORMS, {'transforms': transforms}, blocks)
    fill(template, *(part for row in rows for part in (row[:3], row[3:])))
    kinds = get_typestore(Stores.ROS2_JAZZY)
    message = kinds.deserialize_cdr(template.bytes(), TRANSFORMS)
    assert [(t.header.frame_id, t.child_frame_id) for t in message.transforms] == frames
    for transform, row in zip(message.transforms, rows, strict=True):
        assert transform.header.stamp.sec * 10**9 + transform.header.stamp.nanosec == TIME_NS
        place, turn = transform.transform.translation, transform.transform.rotation
        assert [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w] == row.tolist()
    # the kept definition, too, is that of an independent source
    assert definition(TRANSFORMS).hash == kinds.hash_rihs01(TRANSFORMS)


def test_copies_follow_arrays_one_or_several_to_a_block():
    quat_wxyz, place = np.array([1.0, 2.0, 3.0, 4.0]), np.zeros(3)
    template = Template.of(ODOMETRY, {}, ['pose.pose.orientation', 'pose.pose.position'])
    copies = template.copies([(quat_wxyz[1:], quat_wxyz[:1]), place])
    place[:] = 7.0
    for target, source in copies:
        target[:] = source
    turn, where = (np.frombuffer(block) for block in template.blocks)
    assert turn.tolist() == [2.0, 3.0, 4.0, 1.0]
    assert where.tolist() == [7.0] * 3
    with pytest.raises(ConfigError, match='a block of 32 bytes was given 24 bytes'):
        template.copies([place, place])


@pytest.mark.parametrize(
    ('constants', 'blocks', 'words'),
    [
        ({'pos': 1}, [], 'no member pos; it has: header, child_frame_id, pose, twist'),
        ({}, ['pose.pos'], 'no member pose.pos'),
        ({'pose.covariance': [1.0]}, [], 'pose.covariance: 1 values, needs 36'),
        ({'pose.covariance': ['a'] * 36}, [], 'pose.covariance: required argument'),
        ({}, ['header'], 'header.stamp: stands in a block, which holds only numbers'),
    ],
)
def test_what_does_not_fit_the_definition_is_named(constants, blocks, words):
    with pytest.raises(ConfigError, match=words):
        Template.of(ODOMETRY, constants, blocks)


def test_numbers_that_do_not_lie_side_by_side_are_no_block():
    with pytest.raises(ConfigError, match='its numbers do not lie side by side'):
        Template.of('sensor_msgs/msg/NavSatFix', {'header.frame_id': 'g'}, ['status'])


def test_a_definition_without_one_of_its_types_is_refused():
    with pytest.raises(ConfigError, match="lacks the type 'Pose'"):
        MessageType('Pose pose\n').members('Pose')
