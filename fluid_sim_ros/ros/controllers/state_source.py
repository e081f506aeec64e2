# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where a controller's states come from: odometry, and the medium's velocity where asked for."""

from collections import deque
from collections.abc import Iterator

from rclpy.node import Node

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.messages.cdr import read_stamped_pair
from fluid_sim_ros.messages.commands import TWIST
from fluid_sim_ros.messages.state_topics import ODOMETRY
from fluid_sim_ros.messages.topic import STATE
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.ros.controllers.states import StampedState, read_odometry
from fluid_sim_ros.ros.raw import PolledSubscription


class StateSource:
    """
    Every state of a vehicle, once and in order.

    Parameters
    ----------
    node
        Owner of the subscriptions; what is malformed is logged on it.
    vehicle
        Vehicle name.
    medium
        ``wind`` or ``current``: a state waits for the message of its own stamp on
        ``<vehicle>/medium/<medium>`` and carries its velocity; '' for odometry alone.

    Attributes
    ----------
    rejected
        Takes (key, line) of what arrives and is not taken: one line a second, with a count.

    """

    def __init__(self, node: Node, vehicle: str, medium: str = '') -> None:
        self.rejected = ThrottledLog(node.get_logger().error)
        self._odometry = PolledSubscription(node, ODOMETRY, f'{vehicle}/odom', STATE)
        self._medium = None
        if medium:
            self._medium = PolledSubscription(node, TWIST, f'{vehicle}/medium/{medium}', STATE)
        self._states: deque[StampedState] = deque(maxlen=STATE.depth)
        self._velocities: deque[tuple[int, tuple[float, ...]]] = deque(maxlen=STATE.depth)

    @property
    def topic(self) -> str:
        """Name of the odometry topic."""
        return self._odometry.topic

    @property
    def subscriptions(self) -> list[PolledSubscription]:
        """What to wait for."""
        both = (self._odometry, self._medium)
        return [subscription for subscription in both if subscription is not None]

    def take(self) -> Iterator[StampedState]:
        """Yield the states that are complete now."""
        self.rejected.flush()
        while data := self._odometry.take():
            try:
                state = read_odometry(data)
            except CommandError as error:
                self.rejected('odometry', str(error))
                continue
            if self._medium is None:
                yield state
            else:
                self._keep(state)
        if self._medium is not None:
            self._take_velocities(self._medium)
            yield from self._pairs()

    def _keep(self, state: StampedState) -> None:
        if self._states and state.stamp_ns < self._states[-1].stamp_ns:  # a reset
            self._states.clear()
            self._velocities.clear()
        self._states.append(state)

    def _take_velocities(self, medium: PolledSubscription) -> None:
        while data := medium.take():
            try:
                message = read_stamped_pair(data)
            except CommandError as error:
                self.rejected('medium', str(error))
                continue
            self._velocities.append((message.stamp_ns, tuple(message.first.tolist())))

    def _pairs(self) -> Iterator[StampedState]:
        """Yield states with the velocity of their stamp; drop what lost its other half."""
        states, velocities = self._states, self._velocities
        while states and velocities:
            stamp_ns, velocity_w = velocities[0]
            behind = states[0].stamp_ns - stamp_ns
            if behind <= 0:
                state = states.popleft()
            if behind >= 0:
                velocities.popleft()
            if behind == 0:
                yield StampedState(stamp_ns, state.state._replace(medium_w=velocity_w))
