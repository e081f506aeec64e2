# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Messages as bytes through rclpy: the one file that touches what rclpy keeps to itself.

rclpy's own road is an executor that takes each message, turns it into Python objects and calls a
function: 100 us and more per message. The loops of this package take and give bytes in the thread
that steps, which costs 1 to 2 us. For that they need from rclpy:

* the ``handle`` of a subscription: ``take_message`` takes a message now, without an executor;
* the ``handle`` of a publisher: ``publish_raw`` sends bytes at a third of the cost of ``publish``;
* its address, and those of three functions below rclpy: the compiled tick publishes by itself;
* the ``WaitSet`` below the executor, to sleep until a message or a wake-up arrives;
* the ``EventHandle`` of a topic, to ask whether a peer does not fit. An executor that waits for it
  wakes with every message: 40 ms instead of 0.2 ms an exchange;
* ``Node._parameter_overrides``: what the user passed, before anything is declared. Only there can
  a misspelt parameter be found.

The quality of service of every topic may be overridden by the parameters
``qos_overrides.<topic>...``, as is usual in ROS.

A handle must not be destroyed while it is used; here both happen in the thread that owns it.
"""

import ctypes
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from rclpy.duration import Duration
from rclpy.event_handler import (
    PublisherEventCallbacks,
    QoSPublisherEventType,
    QoSSubscriptionEventType,
    SubscriptionEventCallbacks,
    UnsupportedEventTypeError,
)
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions

from fluid_sim_ros.errors import listed
from fluid_sim_ros.messages.topic import Quality
from fluid_sim_ros.ros.endpoints import PolledGroup, profile_of
from fluid_sim_ros.ros.message_types import message_class

_ASKED = QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS
_OFFERED = QoSPublisherEventType.RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS


class Endpoint:
    """
    One end of a topic.

    Attributes
    ----------
    topic, type
        Full name of the topic, after any remapping, and message type.
    quality_of_service
        What is asked for or offered, after the user's overrides.
    """

    topic: str
    type: str
    quality_of_service: QoSProfile
    _event: Any = None
    _unfit = False

    @property
    def incompatible(self) -> bool:
        """Whether the middleware has met a peer with which no message can pass."""
        if not self._unfit and self._event is not None:
            with self._event:
                status = self._event.take_event()
            self._unfit = bool(status and status.total_count)
        return self._unfit

    def _watch(self, handle: Any, kind: Any) -> None:
        with suppress(UnsupportedEventTypeError), handle:  # not every RMW has this event
            self._event = _rclpy.EventHandle(handle, kind)

    def _forget(self) -> None:
        if self._event is not None:
            self._event.destroy_when_not_in_use()
        self._event = None


class PolledSubscription(Endpoint):
    """
    A subscription whose messages the owner's thread takes when it wants them.

    Parameters
    ----------
    node
        Owner.
    message, topic
        Message type (``package/msg/Name``) and topic name.
    quality
        Quality of service that is asked for.
    keep_all
        Keep every message until it is taken, instead of the newest ``quality.depth``.

    """

    def __init__(
        self, node: Node, message: str, topic: str, quality: Quality, keep_all: bool = False
    ) -> None:
        self._node = node
        self.type = message
        self._class = message_class(message)
        self._subscription = node.create_subscription(
            self._class, topic, lambda _: None, profile_of(quality, keep_all),
            callback_group=PolledGroup(), raw=True,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip
        self.quality_of_service = self._subscription.qos_profile
        self.handle = self._subscription.handle
        self._watch(self.handle, _ASKED)
        self._take = self.handle.take_message
        self.topic = str(self._subscription.topic_name)

    def take(self) -> bytes | None:
        """Return the oldest message that waits (CDR), or None."""
        got = self._take(self._class, True)
        return None if got is None else got[0]

    def take_with_time(self) -> tuple[bytes, int] | None:
        """Return the oldest message that waits (CDR) and when it was sent [ns, wall], or None."""
        got = self._take(self._class, True)
        return None if got is None else (got[0], got[1]['source_timestamp'])

    def publisher_count(self) -> int:
        """Return how many publishers of the topic are known."""
        return int(self._subscription.get_publisher_count())

    def destroy(self) -> None:
        """Remove it from its node."""
        self._forget()
        self._node.destroy_subscription(self._subscription)


class RawPublisher(Endpoint):
    """
    A publisher of messages that are bytes already.

    Parameters
    ----------
    node
        Owner.
    message, topic
        Message type (``package/msg/Name``) and topic name.
    quality
        Quality of service that is offered.

    Attributes
    ----------
    publish
        Sends a message, given as ``bytes`` (CDR).
    address
        Of the publisher below rclpy (``rcl_publisher_t``), or 0.

    """

    def __init__(self, node: Node, message: str, topic: str, quality: Quality) -> None:
        self._node = node
        self.type = message
        self._publisher = node.create_publisher(
            message_class(message), topic, profile_of(quality), callback_group=PolledGroup(),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip
        self.topic = str(self._publisher.topic_name)
        self.quality_of_service = self._publisher.qos_profile
        self.publish = self._publisher.handle.publish_raw
        self.address: int = getattr(self._publisher.handle, 'pointer', 0)
        self._watch(self._publisher.handle, _OFFERED)

    def subscription_count(self) -> int:
        """Return how many subscriptions of the topic are known."""
        return int(self._publisher.get_subscription_count())

    def await_delivery(self, timeout: float) -> None:
        """
        Wait until what was published has arrived.

        Parameters
        ----------
        timeout
            Longest wait [s].

        """
        self._publisher.wait_for_all_acked(Duration(seconds=timeout))

    def destroy(self) -> None:
        """Remove it from its node."""
        self._forget()
        self._node.destroy_publisher(self._publisher)


class WaitSet:
    """
    Sleeps until one of several subscriptions has a message, or another thread wakes it.

    Parameters
    ----------
    node
        Owner of the subscriptions.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._guard = node.create_guard_condition(lambda: None, callback_group=PolledGroup())
        self._size = 0
        self._wait_set: Any = None

    def wait(self, subscriptions: Sequence[PolledSubscription], timeout: float) -> bool:
        """
        Block until a message is there.

        Parameters
        ----------
        subscriptions
            What to wait for.
        timeout
            Longest wait [s].

        Returns
        -------
        bool
            Whether ``wake`` ended the wait.

        """
        if self._wait_set is None or len(subscriptions) > self._size:
            self._size = len(subscriptions)
            self._wait_set = _rclpy.WaitSet(self._size, 1, 0, 0, 0, 0, self._node.context.handle)
        wait_set, self._heard = self._wait_set, subscriptions
        wait_set.clear_entities()
        for subscription in subscriptions:
            wait_set.add_subscription(subscription.handle)
        wait_set.add_guard_condition(self._guard.handle)
        wait_set.wait(int(timeout * 1e9))
        return bool(wait_set.get_ready_entities('guard_condition'))

    def only_first(self) -> bool:
        """Return whether the last ``wait`` has found messages of the first subscription alone."""
        ready = self._wait_set.get_ready_entities('subscription')
        return bool(ready == [self._heard[0].handle.pointer])

    def wake(self) -> None:
        """End a ``wait`` from another thread."""
        self._guard.trigger()

    def destroy(self) -> None:
        """Remove the wake-up from its node."""
        self._node.destroy_guard_condition(self._guard)


def publish_functions() -> tuple[tuple[int, int, int] | None, str]:
    """
    Return the addresses of what publishes below rclpy.

    Returns
    -------
    functions
        ``rcl_publish_serialized_message``, ``rcutils_get_error_string``, ``rcutils_reset_error``;
        None where this rclpy does not lead to them.
    reason
        What is missing, or empty.

    """
    names = ('rcl_publish_serialized_message', 'rcutils_get_error_string', 'rcutils_reset_error')
    if not hasattr(_rclpy.Publisher, 'pointer'):
        return None, 'address of a publisher in this rclpy'
    try:
        library = ctypes.CDLL(_rclpy.__file__)  # is loaded; its names lead to what it needs
        found = [ctypes.cast(getattr(library, name), ctypes.c_void_p).value for name in names]
    except (OSError, AttributeError) as error:
        return None, f'{listed(names)} in the libraries of this rclpy ({error})'
    return (found[0] or 0, found[1] or 0, found[2] or 0), ''


def parameter_overrides(node: Node) -> Mapping[str, Parameter]:
    """
    Return the parameters that the user passed on the command line or in files.

    Parameters
    ----------
    node
        The node that they are for.

    Returns
    -------
    Mapping
        By name; also those that are not declared.

    """
    overrides: Mapping[str, Parameter] = node._parameter_overrides
    return overrides
