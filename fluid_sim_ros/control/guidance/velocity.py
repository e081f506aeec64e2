# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A pilot's velocity as a place and a heading that move, which laws that hold them can follow."""

import math
from collections.abc import Callable
from typing import NamedTuple

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.law import within
from fluid_sim_ros.control.state import State

#: Longest time between two states that counts as motion [s]; what is longer was a pause.
_LONGEST = 0.5
#: Below this a vehicle has come to rest, and keeps its place [m/s].
_AT_REST = 0.1


class Velocity(NamedTuple):
    """
    Velocity over ground that a pilot asks for.

    Attributes
    ----------
    ahead, left, up
        [m/s], along the heading, to its left, and up: base_link's axes with the vehicle level.
    turn
        Rate of the heading [rad/s], counter-clockwise seen from above.

    """

    ahead: float = 0.0
    left: float = 0.0
    up: float = 0.0
    turn: float = 0.0


class Moving(NamedTuple):
    """
    Place and heading to hold at one time.

    Attributes
    ----------
    position_w
        [m], world axes, shape (3,).
    heading
        [rad], counter-clockwise from east.

    """

    position_w: tuple[float, float, float]
    heading: float


class VelocityGuide:
    """
    Moves a place and a heading with the velocity that is asked for.

    Height and heading are the sums of their rates. They run ahead of the vehicle by no more than
    their leashes, so that a vehicle that is held back neither winds them up nor chases them
    afterwards. The place in the plane is always as far ahead as the law wants it for the speed, so
    that it turns with the vehicle; without a speed it is where the vehicle comes to rest.

    Parameters
    ----------
    lead
        How far away a place has to be [m] for the law to ask for a speed [m/s].
    upward
        Leash of the height [m].
    turned
        Leash of the heading [rad], below pi.

    """

    def __init__(self, lead: Callable[[float], float], upward: float, turned: float = 1.0) -> None:
        self._lead, self._upward, self._turned = lead, upward, turned
        self._height: float | None = None
        self._heading = self._time = 0.0
        self._rest: tuple[float, float] | None = None

    def restart(self) -> None:
        """Begin at the vehicle's next state."""
        self._height = self._rest = None

    def step(self, state: State, velocity: Velocity) -> Moving:
        """
        Return what to hold at a state.

        Parameters
        ----------
        state
            Of the vehicle; later than the one before.
        velocity
            That is asked for since then.

        Returns
        -------
        Moving
            Place and heading.

        """
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        yaw, (x, y, z) = rot.yaw_of(r_wb), state.position_w
        if self._height is None:
            self._height, self._heading, self._time = z, yaw, state.time
        dt = min(max(state.time - self._time, 0.0), _LONGEST)
        self._time = state.time
        error = rot.wrap(self._heading + velocity.turn * dt - yaw)
        self._heading = rot.wrap(yaw + within(error, self._turned))
        self._height = z + within(self._height + velocity.up * dt - z, self._upward)
        speed = math.hypot(velocity.ahead, velocity.left)
        if speed:
            self._rest = None
            ahead, left = (v / speed * self._lead(speed) for v in velocity[:2])
            c, s = math.cos(yaw), math.sin(yaw)
            x, y = x + c * ahead - s * left, y + s * ahead + c * left
        elif self._rest is not None:
            x, y = self._rest
        else:
            vx, vy, _ = rot.to_world(r_wb, state.velocity_b)
            if math.hypot(vx, vy) < _AT_REST:
                self._rest = (x, y)
        return Moving((x, y, self._height), self._heading)
