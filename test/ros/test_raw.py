# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Subscriptions that a loop takes from itself, publishers of bytes, and the wait for both."""

import threading
import time

import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import String

from fluid_sim_ros.errors import MissingExtraError
from fluid_sim_ros.messages.topic import Quality
from fluid_sim_ros.ros.message_types import find_message_class, message_class
from fluid_sim_ros.ros.raw import PolledSubscription, RawPublisher, WaitSet, parameter_overrides
from test.support.ros_processes import Peer, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

STRING = 'std_msgs/msg/String'


@pytest.fixture
def pair():
    """Yield a subscription and a publisher that know each other, and the subscription's node."""
    with Peer('listener') as listener, Peer('speaker') as speaker:
        subscription = PolledSubscription(listener.node, STRING, 'words', Quality(depth=100))
        publisher = RawPublisher(speaker.node, STRING, 'words', Quality(depth=100))
        wait_until(publisher.subscription_count, 'the subscription')
        wait_until(subscription.publisher_count, 'the publisher')
        yield subscription, publisher, listener.node
        subscription.destroy()
        publisher.destroy()


def test_every_message_is_taken_once_and_in_order_though_an_executor_spins(pair):
    subscription, publisher, _ = pair
    sent = [serialize_message(String(data=f'{i}')) for i in range(50)]
    before_ns = time.time_ns()
    for data in sent:
        publisher.publish(data)
    publisher.await_delivery(5.0)
    taken = []
    wait_until(lambda: taken.append(subscription.take()) or sum(map(bool, taken)) == 50, 'all')
    words = [deserialize_message(data, String).data for data in taken if data]
    assert words == [f'{i}' for i in range(50)]
    assert subscription.take() is None
    publisher.publish(sent[0])
    got = []
    wait_until(lambda: got.append(subscription.take_with_time()) or got[-1], 'one more')
    assert before_ns < got[-1][1] < time.time_ns()


def test_a_wait_ends_with_a_message_with_a_wake_up_and_with_its_time(pair):
    subscription, publisher, node = pair
    waiting = WaitSet(node)
    begin = time.monotonic()
    assert not waiting.wait([subscription], 0.05)
    assert time.monotonic() - begin > 0.04
    publisher.publish(serialize_message(String(data='a')))
    assert not waiting.wait([subscription], 20.0)
    assert subscription.take()
    timer = threading.Timer(0.1, waiting.wake)
    timer.start()
    assert waiting.wait([subscription], 20.0)
    timer.join()
    assert time.monotonic() - begin < 15.0
    more = PolledSubscription(node, STRING, 'more', Quality())
    publisher.publish(serialize_message(String(data='b')))
    assert not waiting.wait([more, subscription], 20.0)  # more than it was made for
    assert subscription.take()
    waiting.destroy()


def test_what_the_user_passed_is_seen_before_it_is_declared():
    with Peer() as peer:
        assert parameter_overrides(peer.node) == {}


@pytest.mark.parametrize(
    'name', ['os', 'os/msg/path', 'fluid_sim_ros/msg/X', '../msg/X', 'std_msgs/srv/String', '']
)
def test_no_name_imports_what_is_no_message(name):
    assert find_message_class(name) is None
    with pytest.raises(MissingExtraError, match='not part of the ROS'):
        message_class(name)


def test_every_installed_message_is_found_by_its_name():
    assert message_class(STRING) is String
    assert message_class('geometry_msgs/msg/Accel').__name__ == 'Accel'  # of no topic of ours
    assert find_message_class('std_msgs/msg/Strange') is None
