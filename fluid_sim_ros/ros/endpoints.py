# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What subscriptions and publishers of bytes are made with."""

from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from fluid_sim_ros.messages.topic import Quality


class PolledGroup(CallbackGroup):
    """
    Keeps the executor away from what a loop takes itself: it would take the messages first.

    Each topic has a group of its own: the common one of a node never forgets what was in it.
    """

    def can_execute(self, entity: Any) -> bool:
        """
        Return False: the executor takes no message.

        Parameters
        ----------
        entity
            What the executor asks for.

        """
        return False

    beginning_execution = can_execute

    def ending_execution(self, entity: Any) -> None:
        """
        Do nothing: nothing begins.

        Parameters
        ----------
        entity
            What the executor asks for.

        """


def profile_of(quality: Quality, keep_all: bool = False) -> QoSProfile:
    """
    Return a quality of service in the words of rclpy.

    Parameters
    ----------
    quality
        Which.
    keep_all
        Keep every message until it is taken, instead of the newest ``quality.depth``.

    """
    reliability, durability = ReliabilityPolicy, DurabilityPolicy
    return QoSProfile(
        history=HistoryPolicy.KEEP_ALL if keep_all else HistoryPolicy.KEEP_LAST,
        depth=quality.depth,
        reliability=reliability.RELIABLE if quality.reliable else reliability.BEST_EFFORT,
        durability=(
            durability.TRANSIENT_LOCAL if quality.transient_local else durability.VOLATILE
        ),
    )
