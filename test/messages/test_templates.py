"""CDR templates: the bytes that are published equal those of the middleware's serialiser."""

import numpy as np
import pytest
from geometry_msgs.msg import Point, TwistStamped, TwistWithCovarianceStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from rosbags.typesys import Stores, get_typestore
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import FluidPressure, Imu, JointState, MagneticField, NavSatFix, Range
from std_msgs.msg import ColorRGBA, Float64MultiArray
from visualization_msgs.msg import Marker, MarkerArray

from fluid_sim_ros.messages import marker_topics, sensor_templates, templates
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.state_topics import TRANSFORMS

pytestmark = pytest.mark.ros

TIME_NS = 1_234_567_890_123


def fill(template, *blocks):
    stamp = templates.StampBytes()
    stamp.set(TIME_NS)
    for place in template.stamps:
        place[:] = stamp.view
    for target, numbers in zip(template.blocks, blocks, strict=True):
        target[:] = templates.as_bytes(np.array(numbers, dtype=float))
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


def test_odometry():
    numbers = np.random.default_rng(0).normal(size=13)
    message = stamped(Odometry())
    message.header.frame_id = 'rov/odom'
    message.child_frame_id = 'rov/base_link'
    pose, twist = message.pose.pose, message.twist.twist
    pose.position.x, pose.position.y, pose.position.z = numbers[:3]
    o = pose.orientation
    o.x, o.y, o.z, o.w = numbers[3:7]
    twist.linear.x, twist.linear.y, twist.linear.z = numbers[7:10]
    twist.angular.x, twist.angular.y, twist.angular.z = numbers[10:]
    message.pose.covariance = np.diag([1.0, 2, 3, 4, 5, 6]).ravel()
    message.twist.covariance = np.diag([6.0, 5, 4, 3, 2, 1]).ravel()
    template = templates.odometry('rov', [1, 2, 3, 4, 5, 6], [6, 5, 4, 3, 2, 1])
    assert_same(fill(template, numbers[:3], numbers[3:7], numbers[7:]), message)


def test_wrench():
    message = stamped(WrenchStamped())
    message.header.frame_id = 'x/base_link'
    w = message.wrench
    w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z = map(float, range(1, 7))
    assert_same(fill(templates.wrench('x/base_link'), range(1, 7)), message)


def test_twist():
    message = stamped(TwistStamped())
    message.header.frame_id = 'map'
    linear = message.twist.linear
    linear.x, linear.y, linear.z = 1.0, 2.0, 3.0
    assert_same(fill(templates.twist('map'), [1, 2, 3]), message)


def test_clock():
    message = Clock()
    message.clock.sec, message.clock.nanosec = divmod(TIME_NS, 10**9)
    assert_same(fill(templates.clock()), message)


@pytest.mark.parametrize('count', [1, 2, 5])
def test_joint_state(count):
    names = [f'joint_{"x" * i}' for i in range(count)]
    message = stamped(JointState(name=names))
    rows = np.random.default_rng(count).normal(size=(3, count))
    message.position, message.velocity, message.effort = (row.tolist() for row in rows)
    assert_same(fill(templates.joint_state(names), *rows), message)


def test_transforms():
    """Read back by an independent reader, as ROS's own message need not be installed."""
    numbers = np.random.default_rng(1).normal(size=(2, 7))
    template = templates.transforms({'rov/odom': 'map', 'rov/base_link': 'rov/odom'})
    stamp = templates.StampBytes()
    stamp.set(TIME_NS)
    for place in template.stamps:
        place[:] = stamp.view
    for block, values in zip(
        template.blocks, [part for row in numbers for part in (row[:3], row[3:])], strict=True
    ):
        block[:] = templates.as_bytes(values.copy())
    kinds = get_typestore(Stores.ROS2_JAZZY)
    message = kinds.deserialize_cdr(template.bytes(), TRANSFORMS)
    assert [(t.header.frame_id, t.child_frame_id) for t in message.transforms] == [
        ('map', 'rov/odom'), ('rov/odom', 'rov/base_link'),
    ]  # fmt: skip
    for transform, row in zip(message.transforms, numbers, strict=True):
        assert transform.header.stamp.sec * 10**9 + transform.header.stamp.nanosec == TIME_NS
        place, turn = transform.transform.translation, transform.transform.rotation
        assert [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w] == row.tolist()
    # the kept definition, too, is that of an independent source
    assert definition(TRANSFORMS).hash == kinds.hash_rihs01(TRANSFORMS)


@pytest.mark.parametrize('count', [0, 1, 4])
def test_joint_command(count):
    names = [f'fin{"x" * i}' for i in range(count)]
    message = stamped(JointState(name=names))
    row = np.random.default_rng(count).normal(size=count)
    message.position = row.tolist()
    assert_same(fill(templates.joint_command(names), *([row] if count else [])), message)


@pytest.mark.parametrize('count', [0, 1, 4])
def test_multi_array(count):
    row = np.random.default_rng(count).normal(size=count)
    template = fill(templates.multi_array(count), *([row] if count else []))
    assert_same(template, Float64MultiArray(data=row.tolist()))


def test_imu():
    numbers = np.random.default_rng(2).normal(size=(2, 3))
    message = stamped(Imu())
    message.header.frame_id = 'x500/imu'
    message.orientation_covariance[0] = -1.0
    w, f = message.angular_velocity, message.linear_acceleration
    w.x, w.y, w.z = numbers[0]
    f.x, f.y, f.z = numbers[1]
    message.angular_velocity_covariance = (2.0 * np.eye(3)).ravel()
    message.linear_acceleration_covariance = (3.0 * np.eye(3)).ravel()
    assert_same(fill(sensor_templates.imu('x500/imu', 2.0, 3.0), *numbers), message)


def test_magnetic_field():
    message = stamped(MagneticField())
    message.header.frame_id = 'm'
    field = message.magnetic_field
    field.x, field.y, field.z = 1e-5, 2e-5, -4e-5
    message.magnetic_field_covariance = (1e-14 * np.eye(3)).ravel()
    assert_same(fill(sensor_templates.magnetic_field('m', 1e-14), [1e-5, 2e-5, -4e-5]), message)


def test_fluid_pressure():
    message = stamped(FluidPressure(fluid_pressure=101325.0, variance=2.5))
    message.header.frame_id = 'x500/barometer'
    assert_same(fill(sensor_templates.fluid_pressure('x500/barometer', 2.5), [101325.0]), message)


@pytest.mark.parametrize('frame', ['g', 'gn', 'gns', 'gnss'])  # each alignment of what follows
def test_nav_sat_fix(frame):
    message = stamped(NavSatFix(latitude=47.4, longitude=8.5, altitude=500.0))
    message.header.frame_id = frame
    message.status.status, message.status.service = 0, 1
    message.position_covariance = np.diag([4.0, 4.0, 9.0]).ravel()
    message.position_covariance_type = NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
    assert_same(fill(sensor_templates.nav_sat_fix(frame, 4.0, 9.0), [47.4, 8.5, 500.0]), message)


def test_velocity():
    message = stamped(TwistWithCovarianceStamped())
    message.header.frame_id = 'rov/dvl'
    linear = message.twist.twist.linear
    linear.x, linear.y, linear.z = 1.0, 2.0, 3.0
    message.twist.covariance = np.diag([5.0, 5.0, 5.0, 1e6, 1e6, 1e6]).ravel()
    assert_same(fill(sensor_templates.velocity('rov/dvl', 5.0), [1, 2, 3]), message)


@pytest.mark.parametrize('frame', ['r', 'ra', 'ran', 'rang'])
@pytest.mark.parametrize(('by_sound', 'kind'), [(True, Range.ULTRASOUND), (False, Range.INFRARED)])
def test_range(frame, by_sound, kind):
    message = stamped(Range(radiation_type=kind, min_range=0.5, max_range=12.0, range=3.25))
    message.header.frame_id = frame
    message.variance = 0.25
    template = sensor_templates.distance(frame, by_sound, 0.5, 12.0, 0.25)
    for place in template.stamps:
        place[:] = fill(templates.clock()).stamps[0]
    template.blocks[0][:] = templates.as_bytes(np.array([3.25], dtype=np.float32))
    assert_same(template, message)


@pytest.mark.parametrize('name', ['a', 'ab', 'abc', 'abcd'])  # each alignment of what follows
def test_marker_array(name):
    """A geom and an arrow, as ROS's own message holds them."""
    pose, ends = np.random.default_rng(3).normal(size=7), np.arange(1.0, 7.0)
    geom = stamped(Marker(ns=name, id=3, type=Marker.CUBE, action=Marker.ADD))
    p, o = geom.pose.position, geom.pose.orientation
    p.x, p.y, p.z, o.x, o.y, o.z, o.w = pose
    geom.scale.x, geom.scale.y, geom.scale.z = 1.0, 2.0, 3.0
    geom.color = ColorRGBA(r=0.25, g=0.5, b=0.75, a=1.0)
    arrow = stamped(Marker(ns='forces', id=1, type=Marker.ARROW, text=name))
    arrow.scale.x, arrow.scale.y, arrow.scale.z = 4.0, 5.0, 6.0
    arrow.color = ColorRGBA(r=1.0, a=0.5)
    arrow.points = [Point(x=1.0, y=2.0, z=3.0), Point(x=4.0, y=5.0, z=6.0)]
    for marker in (geom, arrow):
        marker.header.frame_id = 'map'
    template = marker_topics.marker_array([
        marker_topics.Marker(name, 3, Marker.CUBE, (1.0, 2.0, 3.0), (0.25, 0.5, 0.75, 1.0)),
        marker_topics.Marker(
            'forces', 1, Marker.ARROW, (4.0, 5.0, 6.0), (1.0, 0.0, 0.0, 0.5), name, corners=2
        ),
    ])  # fmt: skip
    assert_same(fill(template, pose, ends), MarkerArray(markers=[geom, arrow]))
