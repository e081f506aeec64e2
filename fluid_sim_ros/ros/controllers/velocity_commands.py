# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Velocities that a pilot asks a controller for: ``cmd_vel``, as teleoperation publishes it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rclpy.node import Node

from fluid_sim_ros.control.guidance.velocity import Moving, Velocity, VelocityGuide
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.messages.cdr import read_pair, read_stamped_pair
from fluid_sim_ros.messages.commands import TWIST
from fluid_sim_ros.messages.topic import NEWEST
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.ros.raw import PolledSubscription

_PLAIN = 'geometry_msgs/msg/Twist'
#: Members of a Twist in the order of ``Velocity``, and the two that no vehicle here follows.
_MEMBERS = ('linear.x', 'linear.y', 'linear.z', 'angular.z')
_TILTS = ('angular.x', 'angular.y')
_STILL = Velocity()


@dataclass(frozen=True)
class Reach:
    """
    What a controller can follow.

    Attributes
    ----------
    most
        Largest velocity on each axis; 0 where it follows none.
    upward
        How far above or below the vehicle its target may be [m].
    lead
        How far ahead it is [m] for a speed [m/s], for a law that holds places.

    """

    most: Velocity
    upward: float
    lead: Callable[[float], float] = float


class VelocityCommands:
    """
    The topics ``<vehicle>/cmd_vel`` (Twist) and ``<vehicle>/cmd_vel_stamped`` (TwistStamped).

    linear.x is ahead, linear.y to the left, linear.z up [m/s], and angular.z the rate of the
    heading [rad/s], in the axes of base_link with the vehicle level. Without a message for the
    timeout the velocity is 0, so that place or depth and heading are held.

    Parameters
    ----------
    node
        Owner.
    vehicle
        Name of the vehicle.
    reach
        What the controller can follow.
    timeout
        Time of the states [s] after which a message is stale; 0: never.
    warn
        Takes a line of what is ignored or limited, once each.

    """

    def __init__(
        self,
        node: Node,
        vehicle: str,
        reach: Reach,
        timeout: Callable[[], float],
        warn: Callable[[str], None],
    ) -> None:
        self._timeout, self._warn = timeout, warn
        self._rejected = ThrottledLog(node.get_logger().error)
        self._most = reach.most
        self._guide = VelocityGuide(reach.lead, reach.upward)
        self._plain = PolledSubscription(node, _PLAIN, f'{vehicle}/cmd_vel', NEWEST)
        self._stamped = PolledSubscription(node, TWIST, f'{vehicle}/cmd_vel_stamped', NEWEST)
        self.subscriptions = [self._plain, self._stamped]
        self._frames = ('', 'base_link', f'{vehicle}/base_link')
        self._wanted: Velocity | None = None
        self._since: float | None = None
        self._said: set[str] = set()

    def take(self, asked: bool = True) -> None:
        """
        Take the newest message; a wrong one is rejected with a word.

        Parameters
        ----------
        asked
            A message may be there.

        """
        self._rejected.flush()
        if not asked:
            return
        try:
            if data := self._plain.take():
                self._accept(*(pair.tolist() for pair in read_pair(data)))
            if data := self._stamped.take():
                message = read_stamped_pair(data)
                if message.frame not in self._frames:
                    raise CommandError(
                        f"frame '{message.frame}' is not that of the vehicle; allowed: "
                        f'{", ".join(self._frames[1:])}, or none'
                    )
                self._accept(message.first.tolist(), message.second.tolist())
        except CommandError as error:
            self._rejected('cmd_vel', f'cmd_vel rejected: {error}')

    def forget(self) -> None:
        """Follow no velocity until the next message: a waypoint came, or a reset."""
        self._wanted = None
        self._guide.restart()

    def target(self, state: State) -> tuple[Velocity, Moving] | None:
        """
        Return what to hold at a state.

        Parameters
        ----------
        state
            Of the vehicle.

        Returns
        -------
        tuple or None
            The velocity, and the place and heading that move with it. None where no message came.

        """
        if self._wanted is None:
            return None
        if self._since is None or state.time < self._since:
            self._since = state.time
        timeout = self._timeout()
        stale = timeout > 0.0 and state.time - self._since > timeout
        velocity = _STILL if stale else self._wanted
        return velocity, self._guide.step(state, velocity)

    def _accept(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        if not all(map(math.isfinite, (*linear, *angular))):
            raise CommandError('every number must be finite')
        for name, value in zip(_TILTS, angular[:2], strict=True):
            if value:
                self._say(f'cmd_vel: {name} is ignored: the vehicle is held level')
        given = (*linear, angular[2])
        bounded = map(self._limited, _MEMBERS, given, self._most)
        self._wanted = Velocity(*bounded)
        self._since = None  # begins with the next state: no clock but that of the states counts

    def _limited(self, name: str, value: float, most: float) -> float:
        if most == 0.0 and value:
            self._say(f'cmd_vel: {name} is ignored: the vehicle does not move that way')
        elif abs(value) > most:
            self._say(f'cmd_vel: {name} {value:g} is limited to {most:g} (gains.max_*)')
        return min(max(value, -most), most)

    def _say(self, line: str) -> None:
        topic = line.split()[1]
        if topic not in self._said:
            self._said.add(topic)
            self._warn(line)
