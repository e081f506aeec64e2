# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Publishes recorded messages on their ROS topics, with /clock, at any rate.

While it runs: ``~/pause`` (SetBool), and when paused ``~/step`` (Trigger), which goes on to the
next simulated time. Only the calling thread publishes; the services set flags for it.
"""

import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from std_srvs.srv import SetBool, Trigger

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.interruption import stopped_by_signals
from fluid_sim_ros.loop.recorder_port import RecordedTopic
from fluid_sim_ros.messages.state_topics import CLOCK
from fluid_sim_ros.messages.templates import StampBytes, Template
from fluid_sim_ros.messages.topic import NEWEST, Quality
from fluid_sim_ros.ros.message_types import find_message_class
from fluid_sim_ros.ros.process.run import executor_thread
from fluid_sim_ros.ros.raw import RawPublisher

NODE_NAME = 'fluid_sim_replay'
_CLOCK = '/clock'
#: Longest sleep before flags are looked at again [s].
_LONGEST_SLEEP = 0.05
#: Both ends of a connection find each other within this time [s].
_SETTLED = 0.5

#: (topic, simulated time [ns], bytes), in order.
Messages = Iterable[tuple[str, int, bytes]]


@dataclass(frozen=True)
class ReplayOptions:
    """
    How to replay.

    Attributes
    ----------
    rate
        Simulated seconds per wall second.
    loop
        Begin anew at the end, until ended.
    paused
        Begin paused.
    wait
        Wait up to this long for a subscriber before the begin [s].

    """

    rate: float = 1.0
    loop: bool = False
    paused: bool = False
    wait: float = 2.0

    def __post_init__(self) -> None:
        if not 0 < self.rate < float('inf'):
            raise ConfigError(f'--rate {self.rate:g}: must be finite and above 0')


def is_installed(message: str) -> bool:
    """
    Return whether ROS here has a message type.

    Parameters
    ----------
    message
        ``package/msg/Name``.

    Returns
    -------
    bool
        Whether its messages can be published.

    """
    return find_message_class(message) is not None


class ReplayNode(Node):
    """
    The node that publishes.

    Parameters
    ----------
    topics
        What is published.
    options
        How.

    Attributes
    ----------
    published
        Number of messages so far.
    ending
        Whether ``end`` was called.

    """

    def __init__(self, topics: Sequence[RecordedTopic], options: ReplayOptions) -> None:
        super().__init__(NODE_NAME)
        self._options = options
        self._publishers_by_name = {
            topic.name: RawPublisher(
                self, topic.type, topic.name,
                Quality(topic.reliable, topic.depth, topic.transient_local),
            )
            for topic in topics
        }  # fmt: skip
        self._has_clock = _CLOCK in self._publishers_by_name
        if not self._has_clock:
            self._publishers_by_name[_CLOCK] = RawPublisher(self, CLOCK, _CLOCK, NEWEST)
        self._clock_message, self._stamp = Template.of(CLOCK), StampBytes()
        self._going = threading.Event()
        if not options.paused:
            self._going.set()
        self._steps = 0
        self.ending = False
        self.published = 0
        self.create_service(SetBool, '~/pause', self._on_pause)
        self.create_service(Trigger, '~/step', self._on_step)

    # ---- services (executor thread) --------------------------------------------------------

    def _on_pause(self, request: Any, response: Any) -> Any:
        if request.data:
            self._going.clear()
        else:
            self._going.set()
        response.success = True
        return response

    def _on_step(self, request: Any, response: Any) -> Any:
        response.success = not self._going.is_set()
        if response.success:
            self._steps += 1
        else:
            response.message = 'not paused; call ~/pause with true first'
        return response

    # ---- publishing (the caller's thread) --------------------------------------------------

    def end(self) -> None:
        """Have ``play`` return; safe in a signal handler."""
        self.ending = True

    def play(self, messages: Callable[[], Messages]) -> None:
        """
        Publish all messages, again and again with ``loop``, until ``end``.

        Parameters
        ----------
        messages
            Returns an iterable of (topic, simulated time [ns], CDR bytes), in order; called anew
            for each round.

        """
        self._await_subscribers()
        while not self.ending:
            self._play_once(iter(messages()))
            if not self._options.loop:
                self._await_delivery()
                return

    def _await_subscribers(self) -> None:
        """Wait until there are some, and no more have come for a while."""
        deadline = time.monotonic() + self._options.wait
        present, since = 0, time.monotonic()
        while time.monotonic() < deadline and not self.ending:
            publishers = self._publishers_by_name.values()
            count = sum(publisher.subscription_count() for publisher in publishers)
            if count != present:
                present, since = count, time.monotonic()
            elif present and time.monotonic() - since > _SETTLED:
                return
            time.sleep(_LONGEST_SLEEP)

    def _await_delivery(self) -> None:
        """Wait until what was published has arrived, for a while at most."""
        for publisher in self._publishers_by_name.values():
            publisher.await_delivery(1.0)

    def _play_once(self, messages: Iterator[tuple[str, int, bytes]]) -> None:
        present, begin_ns, begin = -1, 0, 0.0
        for topic, time_ns, data in messages:
            if time_ns != present:
                stepped = self._hold()
                if self.ending:
                    return
                if present < 0 or stepped:
                    begin_ns, begin = time_ns, time.monotonic()
                self._sleep_until(begin + (time_ns - begin_ns) * 1e-9 / self._options.rate)
                present = time_ns
                if not self._has_clock:
                    self._publish_clock(time_ns)
            self._publishers_by_name[topic].publish(data)
            self.published += 1

    def _hold(self) -> bool:
        """Wait while paused; return whether the pace must begin anew."""
        if self._going.is_set():
            return False
        while not self.ending:
            if self._steps:
                self._steps -= 1
                break
            if self._going.wait(_LONGEST_SLEEP):
                break
        return True

    def _sleep_until(self, due: float) -> None:
        while not self.ending:
            left = due - time.monotonic()
            if left <= 0 or not self._going.is_set():
                return
            time.sleep(min(left, _LONGEST_SLEEP))

    def _publish_clock(self, time_ns: int) -> None:
        self._stamp.set(time_ns)
        self._clock_message.stamps[0][:] = self._stamp.view
        self._publishers_by_name[_CLOCK].publish(self._clock_message.bytes())


def replay(
    topics: Sequence[RecordedTopic], messages: Callable[[], Messages], options: ReplayOptions
) -> tuple[int, str]:
    """
    Publish until the end, or until SIGINT or SIGTERM; a later one ends the process at once.

    Parameters
    ----------
    topics
        What is published.
    messages
        Returns an iterable of (topic, simulated time [ns], CDR bytes), in order; called anew for
        each round.
    options
        How.

    Returns
    -------
    published : int
        How many messages were published.
    interrupted : str
        Name of the signal that ended it, or empty.

    """
    with stopped_by_signals() as interruption:
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        node = ReplayNode(topics, options)
        interruption.stops(node.end)
        try:
            with executor_thread(node):
                node.play(messages)
        finally:
            node.destroy_node()
            rclpy.shutdown()
    return node.published, interruption.name
