# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Round trips of odometry between two processes: an echo, the other end, and their times."""

import statistics
import time
from typing import Any

import rclpy
from nav_msgs.msg import Odometry
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message

RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)


def echo(node: Node, odometry: str, command: str, answer: Any) -> None:
    """
    Answer each odometry with constant bytes until the process is ended.

    Parameters
    ----------
    node
        Owner of the topics.
    odometry, command
        Topics of what is heard, and of what is answered.
    answer
        The message.

    """
    inward = node.create_subscription(Odometry, odometry, lambda _: None, RELIABLE, raw=True)
    outward = node.create_publisher(type(answer), command, RELIABLE).handle
    data = serialize_message(answer)
    waiting = _rclpy.WaitSet(1, 0, 0, 0, 0, 0, node.context.handle)
    while rclpy.ok():
        waiting.clear_entities()
        waiting.add_subscription(inward.handle)
        waiting.wait(int(5e7))
        while inward.handle.take_message(Odometry, True):
            outward.publish_raw(data)


class Asker:
    """
    The end that sends odometry and waits for what comes back.

    Parameters
    ----------
    node
        Owner of the topics.
    odometry, command
        Topics of what is sent, and of what is answered.
    kind
        Class of the answers.

    """

    def __init__(self, node: Node, odometry: str, command: str, kind: type[Any]) -> None:
        self._kind = kind
        self._source = node.create_publisher(Odometry, odometry, RELIABLE).handle
        self._answers = node.create_subscription(
            kind, command, lambda _: None, RELIABLE, raw=True
        ).handle
        self._waiting = _rclpy.WaitSet(1, 0, 0, 0, 0, 0, node.context.handle)

    def ask(self, data: bytes, patience: float) -> float | None:
        """
        Send and wait for the answer.

        Parameters
        ----------
        data
            The odometry (CDR).
        patience
            How long to wait [s].

        Returns
        -------
        float or None
            Time from the one to the other [s]; None when none has come.

        """
        begin = time.perf_counter()
        self._source.publish_raw(data)
        while not self._answers.take_message(self._kind, True):
            self._waiting.clear_entities()
            self._waiting.add_subscription(self._answers)
            self._waiting.wait(int(1e8))
            if time.perf_counter() > begin + patience:
                return None
        return time.perf_counter() - begin

    def forget(self) -> None:
        """Drop the answers that have come."""
        while self._answers.take_message(self._kind, True):
            pass


def quantiles(times: list[float]) -> dict[str, float]:
    """
    Return median, 10 % and 99 % quantiles [us].

    Parameters
    ----------
    times
        [s], one at least.

    """
    ordered = sorted(times)
    return {
        'median_us': round(1e6 * statistics.median(ordered), 1),
        'p10_us': round(1e6 * ordered[len(ordered) // 10], 1),
        'p99_us': round(1e6 * ordered[int(0.99 * len(ordered))], 1),
    }
