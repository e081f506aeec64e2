# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""States of a controller, alone and with the medium's velocity of the same stamp."""

import math

import pytest
import rclpy
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rclpy.context import Context

from fluid_sim_ros.ros.controllers.state_source import StateSource
from test.support.ros_processes import Peer, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


@pytest.fixture
def owner():
    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node('owner', context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def stamped(message, second):
    message.header.stamp.sec = second
    return message


def wind(second, speed):
    message = stamped(TwistStamped(), second)
    message.twist.linear.x = float(speed)
    return message


def test_states_alone_come_in_order(owner):
    source, found = StateSource(owner, 'plane'), []
    with Peer() as peer:
        states = peer.publisher(Odometry, 'plane/odom', depth=10)
        for second in (1, 2, 3):
            states.publish(stamped(Odometry(), second))
        wait_until(lambda: found.extend(source.take()) or len(found) == 3, 'three states')
    assert [each.stamp_ns // 10**9 for each in found] == [1, 2, 3]
    assert all(each.state.medium_w == (0.0, 0.0, 0.0) for each in found)


def test_a_state_waits_for_the_velocity_of_its_own_stamp(owner):
    source, found = StateSource(owner, 'plane', 'wind'), []
    with Peer() as peer:
        states = peer.publisher(Odometry, 'plane/odom', depth=10)
        winds = peer.publisher(TwistStamped, 'plane/medium/wind', depth=10)

        def deliver(*messages, until):
            for message in messages:
                (winds if isinstance(message, TwistStamped) else states).publish(message)
            wait_until(lambda: found.extend(source.take()) or until(), 'delivery')

        # 2 has lost its wind, 4 its odometry; the state at 6 s still waits
        odometry = [stamped(Odometry(), second) for second in (1, 2, 3, 5, 6)]
        deliver(*odometry, until=lambda: len(source._states) == 5)
        deliver(*(wind(s, 10 * s) for s in (1, 3, 4, 5)), until=lambda: len(found) == 3)
        pairs = [(each.stamp_ns // 10**9, each.state.medium_w[0]) for each in found]
        assert pairs == [(1, 10), (3, 30), (5, 50)]
        # after a reset, nothing of before stands in the way
        found.clear()
        deliver(stamped(Odometry(), 0), until=lambda: source._states[-1].stamp_ns == 0)
        deliver(wind(0, math.nan), until=lambda: len(found) == 1)
    assert found[0].stamp_ns == 0 and not found[0].state.is_sound()
