# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Listens to one topic from outside and keeps its messages raw."""

import time

import rclpy
from rclpy.context import Context
from rclpy.signals import SignalHandlerOptions

from fluid_sim_ros.messages.state_topics import ODOMETRY
from fluid_sim_ros.messages.topic import Quality
from fluid_sim_ros.ros.raw import PolledSubscription

#: Messages that the middleware keeps between two calls of ``take``.
_DEPTH = 5000


class Listener:
    """
    A ROS node, in a context of its own, that takes odometry.

    Parameters
    ----------
    domain
        ROS_DOMAIN_ID.
    topic
        Topic of nav_msgs/Odometry.

    Attributes
    ----------
    messages
        What was heard, as CDR bytes.
    sent_ns
        When each was published, wall clock [ns].

    """

    def __init__(self, domain: int, topic: str) -> None:
        self._context = Context()
        rclpy.init(
            args=[], context=self._context, domain_id=domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )  # fmt: skip
        self._node = rclpy.create_node('demo_listener', context=self._context)
        self._subscription = PolledSubscription(self._node, ODOMETRY, topic, Quality(depth=_DEPTH))
        self.messages: list[bytes] = []
        self.sent_ns: list[int] = []

    def is_alone(self) -> bool:
        """Return whether no other node is in the domain, as far as is known."""
        return len(self._node.get_node_names()) <= 1

    def take(self, pause: float) -> bool:
        """
        Sleep, then take what has arrived.

        The messages of the pause wait in the middleware: a wake-up for each would take
        processor time from those who are listened to.

        Parameters
        ----------
        pause
            How long to sleep [s].

        Returns
        -------
        bool
            Whether something had arrived.

        """
        time.sleep(pause)
        before = len(self.messages)
        while got := self._subscription.take_with_time():
            self.messages.append(got[0])
            self.sent_ns.append(got[1])
        return len(self.messages) > before

    def close(self) -> None:
        """Leave the ROS graph."""
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)
