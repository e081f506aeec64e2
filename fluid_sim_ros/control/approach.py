# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The speed with which to approach a target: as fast as braking in time allows."""

import math


class Approach:
    """
    A reference speed in a plane (or along a line) towards a target.

    v = K d close to the target, sqrt(2 a (d - a / (2 K^2))) farther away, the speed from which
    braking at ``a`` ends at the target without a kink at d = a / K^2; never above ``max_speed``.
    The reference changes by no more than ``a`` per second, and its rate of change is known, so a
    controller can feed it forward instead of winding up its integrator.

    Parameters
    ----------
    gain
        K [1/s].
    max_speed
        [m/s].
    max_acceleration
        a [m/s^2].

    Attributes
    ----------
    velocity
        Reference [m/s], two axes.
    acceleration
        Its rate of change [m/s^2].

    """

    def __init__(self, gain: float, max_speed: float, max_acceleration: float) -> None:
        self._gain = gain
        self._max_speed = max_speed
        self._most = max_acceleration
        self._linear = max_acceleration / gain**2 if gain else math.inf
        self.restart(0.0, 0.0)

    def restart(self, vx: float, vy: float) -> None:
        """
        Begin at a velocity, the present one of the vehicle.

        Parameters
        ----------
        vx, vy
            Of the vehicle along the two axes [m/s].

        """
        self.velocity = (vx, vy)
        self.acceleration = (0.0, 0.0)

    def distance(self, speed: float) -> float:
        """
        Return how far away a target is for which ``speed`` gives a speed.

        Parameters
        ----------
        speed
            [m/s], from 0 to the largest.

        Returns
        -------
        float
            [m].

        """
        if speed * self._gain <= self._most:
            return speed / self._gain
        return speed**2 / (2.0 * self._most) + 0.5 * self._linear

    def speed(self, distance: float) -> float:
        """
        Return the speed to have at a distance from the target.

        Parameters
        ----------
        distance
            To the target [m], at least 0.

        Returns
        -------
        float
            [m/s], at most the largest speed.

        """
        if distance <= self._linear:
            return min(self._gain * distance, self._max_speed)
        braking = math.sqrt(2.0 * self._most * (distance - 0.5 * self._linear))
        return min(braking, self._max_speed)

    def step(self, dx: float, dy: float, dt: float) -> None:
        """
        Move the reference on.

        Parameters
        ----------
        dx, dy
            Target less position along the two axes [m].
        dt
            Time since the last step [s]; 0 for the same state again, which changes nothing.

        """
        if dt <= 0.0:  # the same state again
            return
        distance = math.hypot(dx, dy)
        scale = self.speed(distance) / distance if distance > 0.0 else 0.0
        vx, vy = self.velocity
        change_x, change_y = scale * dx - vx, scale * dy - vy
        change = math.hypot(change_x, change_y)
        if change > self._most * dt:
            share = self._most * dt / change
            change_x, change_y = share * change_x, share * change_y
        self.velocity = (vx + change_x, vy + change_y)
        self.acceleration = (change_x / dt, change_y / dt)
