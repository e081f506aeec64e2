"""Keeps the raw messages of some topics in memory, for evaluation after a run."""

import time
from collections.abc import Mapping
from typing import Any

import numpy as np
import rclpy
from geometry_msgs.msg import TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from numpy.typing import NDArray
from rclpy.context import Context
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState

from fluid_sim_ros.messages.cdr import read_joint_state, read_stamped_pair
from fluid_sim_ros.ros.inputs import PolledGroup
from fluid_sim_ros.ros.states import read_odometry

Array = NDArray[np.float64]

#: Messages kept per topic between two calls of ``take``.
_DEPTH = 5000


def _odometry_row(data: bytes) -> list[float]:
    state = read_odometry(data)
    numbers = (*state.position_w, *state.quat_wb_wxyz, *state.velocity_b, *state.omega_b)
    return [state.stamp_ns * 1e-9, *numbers]


def _pair_row(data: bytes) -> list[float]:
    pair = read_stamped_pair(data)
    return [pair.stamp_ns * 1e-9, *pair.first, *pair.second]


def _effort_row(data: bytes) -> list[float]:
    command = read_joint_state(data)
    return [command.stamp_ns * 1e-9, *command.effort]


_ROWS = {
    Odometry: _odometry_row, WrenchStamped: _pair_row, TwistStamped: _pair_row,
    JointState: _effort_row,
}  # fmt: skip


class Recorder:
    """
    A ROS node in a context of its own that takes messages raw.

    Parameters
    ----------
    domain
        ROS_DOMAIN_ID.
    topics
        Topic name -> message type (Odometry, WrenchStamped, TwistStamped or JointState).

    """

    def __init__(self, domain: int, topics: Mapping[str, type]) -> None:
        self._context = Context()
        rclpy.init(
            args=[], context=self._context, domain_id=domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )  # fmt: skip
        self.node = rclpy.create_node('demo_recorder', context=self._context)
        group = PolledGroup()
        quality = QoSProfile(depth=_DEPTH, reliability=ReliabilityPolicy.RELIABLE)
        self._subscriptions: dict[str, tuple[type, Any]] = {
            topic: (
                kind,
                self.node.create_subscription(
                    kind, topic, lambda _: None, quality, callback_group=group, raw=True
                ),
            )
            for topic, kind in topics.items()
        }
        self.messages: dict[str, list[bytes]] = {topic: [] for topic in topics}
        #: When each message was published, wall clock [ns].
        self.sent_ns: dict[str, list[int]] = {topic: [] for topic in topics}

    def take(self, pause: float) -> bool:
        """
        Sleep for ``pause`` [s], then take what has arrived; True when something had.

        The messages of the pause wait in the middleware: a wake-up for each would take
        processor time from those who are recorded.
        """
        time.sleep(pause)
        any_taken = False
        for topic, (kind, subscription) in self._subscriptions.items():
            kept, sent = self.messages[topic], self.sent_ns[topic]
            while got := subscription.handle.take_message(kind, True):
                kept.append(got[0])
                sent.append(got[1]['source_timestamp'])
                any_taken = True
        return any_taken

    def rows(self, topic: str) -> Array:
        """
        Return a topic's messages as rows, the first column the stamp [s], repeats left out.

        Odometry: position, quaternion (wxyz), velocity, rate. Wrench and twist: two vectors.
        Joint state: efforts.
        """
        read = _ROWS[self._subscriptions[topic][0]]
        rows = np.array([read(data) for data in self.messages[topic]])
        if not len(rows):
            return np.empty((0, 1))
        _, first = np.unique(rows[:, 0], return_index=True)
        picked: Array = rows[first]
        return picked

    def close(self) -> None:
        """Leave the ROS graph."""
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)
