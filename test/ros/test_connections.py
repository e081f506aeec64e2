# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A peer with which no message can pass is named in log and diagnostics, with the remedy."""

import pytest
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64MultiArray

from test.support.ros_processes import Peer, controller, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
RELIABLE = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def graph_of(peer):
    return peer.diagnostics.get('graph', (0, ''))


def test_a_best_effort_publisher_of_cmd_thrust_is_named_with_the_quality_that_fits():
    with Peer('pilot') as peer:
        peer.watch_diagnostics()
        with node(scene='quadrotor') as process:
            thrust = peer.node.create_publisher(Float64MultiArray, 'x500/cmd/thrust', BEST_EFFORT)
            wait_until(lambda: '/pilot' in graph_of(peer)[1], 'the mismatch in diagnostics')
            level, line = graph_of(peer)[:2]
            assert level == 1
            for words in (
                '/pilot publishes /x500/cmd/thrust', 'best_effort but reliable is asked for',
                'publish with reliability reliable',
                'qos_overrides./x500/cmd/thrust.subscription.reliability:=best_effort',
            ):  # fmt: skip
                assert words in line
                assert words in process.output
            assert process.output.count('/pilot publishes') == 1  # said once
            peer.node.destroy_publisher(thrust)
            wait_until(lambda: graph_of(peer)[1] == 'alone', 'the end of it')


def test_the_remedy_that_is_named_works():
    remedy = {'qos_overrides./x500/cmd/thrust.subscription.reliability': 'best_effort'}
    with Peer('pilot') as peer:
        joints = peer.collect(JointState, 'x500/joint_states')
        with node(scene='quadrotor', command_timeout=0.0, **remedy) as process:
            thrust = peer.node.create_publisher(Float64MultiArray, 'x500/cmd/thrust', BEST_EFFORT)

            def flies():
                thrust.publish(Float64MultiArray(data=[2.0] * 4))
                return joints and joints[-1].effort[0] == 2.0

            wait_until(flies, 'the thrust')
            assert 'does not fit' not in process.output


@pytest.mark.parametrize(
    ('message', 'topic', 'quality', 'words'),
    [
        (Imu, 'x500/imu/data_raw', RELIABLE, 'subscribe with reliability best_effort'),
        (Odometry, 'x500/odom', LATCHED, 'subscribe with durability volatile'),
    ],
)
def test_a_subscriber_that_asks_for_more_is_named(message, topic, quality, words):
    with Peer('viewer') as peer:
        peer.watch_diagnostics()
        with node(scene='quadrotor') as process:
            peer.node.create_subscription(message, topic, lambda _: None, quality)
            wait_until(lambda: '/viewer' in graph_of(peer)[1], 'the mismatch in diagnostics')
            assert f'/viewer subscribes to /{topic}' in graph_of(peer)[1]
            assert words in graph_of(peer)[1]
            assert words in process.output


def test_a_publisher_of_another_type_is_named():
    with Peer('teleop') as peer:
        peer.watch_diagnostics()
        with node(scene='quadrotor') as process:
            peer.node.create_publisher(Twist, 'wind', RELIABLE)
            words = 'as geometry_msgs/msg/Twist, which is geometry_msgs/msg/TwistStamped here'
            wait_until(lambda: words in graph_of(peer)[1], 'the other type')
            assert words in process.output


def test_a_controller_names_what_it_cannot_hear_and_who_cannot_hear_it():
    with Peer('sim') as peer, controller('quad') as process:
        peer.node.create_publisher(Odometry, 'x500/odom', BEST_EFFORT)
        peer.node.create_publisher(PoseStamped, 'x500/cmd/waypoint', BEST_EFFORT)
        peer.node.create_subscription(
            JointState, 'x500/cmd/thrust_stamped', lambda _: None, LATCHED
        )
        for words in (
            '/sim publishes /x500/odom', '/sim publishes /x500/cmd/waypoint',
            '/sim subscribes to /x500/cmd/thrust_stamped',
        ):  # fmt: skip
            wait_until(lambda words=words: words in process.output, words)


def test_diagnostics_are_stamped_in_simulated_time():
    from diagnostic_msgs.msg import DiagnosticArray

    with Peer() as peer:
        statuses = peer.collect(DiagnosticArray, '/diagnostics')
        odometry = peer.collect(Odometry, 'sphere/odom')
        with node(scene='sphere', realtime__factor=0.5):
            wait_until(lambda: len(statuses) > 3 and odometry, 'diagnostics')
        stamps = [stamp_ns(message) for message in statuses]
        assert stamps == sorted(stamps)
        assert stamps[-1] <= stamp_ns(odometry[-1]) + 600_000_000 < 60_000_000_000
        values = {pair.key: pair.value for pair in statuses[-1].status[0].values}
        assert float(values['time_s']) == pytest.approx(stamps[-1] * 1e-9, abs=1e-9)
