# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Commands of a controller as messages: lists of numbers with the stamp that they answer."""

import struct
from collections.abc import Sequence

from rclpy.node import Node

from fluid_sim_ros.messages.commands import JOINT_STATE
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.messages.topic import STATE
from fluid_sim_ros.ros.raw import RawPublisher


class CommandPublisher:
    """
    Publishes commands as one list of a JointState, with a stamp.

    Parameters
    ----------
    node
        Owner of the publisher.
    topic
        Its name.
    member
        List of the JointState that holds the values: ``effort`` or ``position``.
    count
        How many values.
    names
        Their names; none: all, in order.

    Attributes
    ----------
    publisher
        Of the topic.

    """

    def __init__(
        self, node: Node, topic: str, member: str, count: int, names: Sequence[str] = ()
    ) -> None:
        values = {'name': names, member: [0.0] * count}
        self._template = Template.of(JOINT_STATE, values, [member])
        self._pack = struct.Struct(f'<{count}d').pack_into
        self.publisher = RawPublisher(node, JOINT_STATE, topic, STATE)

    def publish(self, stamp: memoryview, values: Sequence[float]) -> None:
        """
        Send the values as the answer to the state of a stamp.

        Parameters
        ----------
        stamp
            As in the message.
        values
            One per name, in its own unit.

        """
        self._template.stamps[0][:] = stamp
        self._pack(self._template.blocks[0], 0, *values)
        self.publisher.publish(self._template.bytes())
