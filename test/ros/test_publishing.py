# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How messages reach the middleware: whole, in order, with and without a thread; its faults."""

import ctypes
from types import SimpleNamespace

import pytest
from rclpy.serialization import serialize_message
from std_msgs.msg import String

from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.messages.topic import Quality
from fluid_sim_ros.ros import publishing
from fluid_sim_ros.ros.publishing import Publishing, cores, wants_thread
from fluid_sim_ros.ros.raw import PolledSubscription, RawPublisher
from test.support.ros_processes import Peer, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

STRING = 'std_msgs/msg/String'
ON, OFF = ({'publish.thread': choice, 'pacing': 'free'} for choice in ('always', 'never'))


@pytest.fixture
def pair():
    """Yield a subscription that keeps all and a publisher that know each other, with its node."""
    with Peer('listener') as listener, Peer('speaker') as speaker:
        quality = Quality(depth=1000)
        subscription = PolledSubscription(listener.node, STRING, 'words', quality)
        publisher = RawPublisher(speaker.node, STRING, 'words', quality)
        wait_until(publisher.subscription_count, 'the subscription')
        yield subscription, publisher, speaker.node
        subscription.destroy()
        publisher.destroy()


@pytest.mark.parametrize('settings', [ON, OFF], ids=['thread', 'no thread'])
def test_bytes_and_order_are_those_that_were_sent(pair, settings):
    subscription, publisher, owner = pair
    queue = Publishing(owner, [publisher], [100], settings)
    assert queue.queue is not None and queue.threaded == (settings is ON)
    sent = [serialize_message(String(data='x' * (i % 90))) for i in range(500)]
    for data in sent:
        queue.send(publisher, data)
    queue.close()
    taken = []

    def take_all():
        while (data := subscription.take()) is not None:
            taken.append(data)
        return len(taken) >= len(sent)

    wait_until(take_all, 'all')
    assert taken == sent


@pytest.mark.parametrize('settings', [ON, OFF], ids=['thread', 'no thread'])
def test_what_the_middleware_refuses_is_raised_with_its_topic(pair, settings):
    _, publisher, owner = pair
    nobody = (ctypes.c_void_p * 4)()  # an rcl_publisher_t that was not made
    broken = SimpleNamespace(address=ctypes.addressof(nobody), topic='/broken')
    queue = Publishing(owner, [publisher, broken], [100, 100], settings)
    queue.send(publisher, serialize_message(String(data='a')))
    queue.check()
    queue.send(broken, b'1234')
    with pytest.raises(FluidSimError, match=r'^/broken: a message could not be published: .*300'):
        queue.close()


def test_a_thread_is_refused_where_rclpy_hides_its_publishers(pair, monkeypatch):
    subscription, publisher, owner = pair
    monkeypatch.setattr(publishing, 'publish_functions', lambda: (None, 'address'))
    with pytest.raises(ConfigError, match='there is no address; set auto'):
        Publishing(owner, [publisher], [100], ON)
    queue = Publishing(owner, [publisher], [100], {**ON, 'publish.thread': 'auto'})
    assert (
        queue.queue is None
        and not queue.threaded
        and queue.way == 'through rclpy, because there is no address'
    )
    data = serialize_message(String(data='through rclpy'))
    queue.send(publisher, data)
    queue.close()
    taken = []
    wait_until(lambda: taken.append(subscription.take()) or taken[-1] == data, 'it')


@pytest.mark.parametrize(
    ('thread', 'pacing', 'count', 'wanted'),
    [
        ('auto', 'free', 2, True), ('auto', 'free', 1, False),
        ('auto', 'lockstep', 8, False), ('auto', 'realtime', 8, False),
        ('always', 'lockstep', 1, True), ('never', 'free', 8, False),
    ],
)  # fmt: skip
def test_who_gets_a_thread(thread, pacing, count, wanted):
    assert wants_thread({'publish.thread': thread, 'pacing': pacing}, count) == wanted


def test_cores_are_those_of_the_affinity_and_of_the_quota(monkeypatch, tmp_path):
    monkeypatch.setattr('os.sched_getaffinity', lambda pid: set(range(8)))
    monkeypatch.setattr(publishing, '_GROUPS', tmp_path)
    own = tmp_path / 'own'
    monkeypatch.setattr(publishing, '_OWN_GROUP', own)
    assert cores() == 8  # no groups
    own.write_text('4:cpu:/old\n0::/a/b\n')
    assert cores() == 8  # no such file
    (tmp_path / 'a/b').mkdir(parents=True)
    for text, count in (('max 100000', 8), ('250000 100000', 2), ('20000 100000', 1)):
        (tmp_path / 'a/b/cpu.max').write_text(f'{text}\n')
        assert cores() == count
