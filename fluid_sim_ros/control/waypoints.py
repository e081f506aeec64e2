# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Waypoints: where to be, which way to look, and for how long."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from fluid_sim_ros.control.rotation import wrap
from fluid_sim_ros.errors import ConfigError

#: Numbers of one waypoint in a flat list: x, y, z [m, world], yaw [rad], hold [s].
FIELDS = ('x', 'y', 'z', 'yaw', 'hold')


@dataclass(frozen=True)
class Waypoint:
    """
    A place to hold.

    Attributes
    ----------
    position_w
        [m], world axes (ENU).
    yaw
        Heading [rad], counter-clockwise from east.
    hold
        How long to stay after arrival, before the next waypoint [s].

    """

    position_w: tuple[float, float, float]
    yaw: float = 0.0
    hold: float = 0.0


def from_flat(numbers: Sequence[float]) -> list[Waypoint]:
    """
    Read waypoints from a flat list: x, y, z, yaw, hold, x, y, ...

    Parameters
    ----------
    numbers
        x, y, z [m], yaw [rad], hold [s] of each waypoint.

    Returns
    -------
    list
        The waypoints, in order.

    Raises
    ------
    ConfigError
        If the length is not a multiple of 5, a number is not finite, or a hold is below 0.

    """
    width = len(FIELDS)
    if len(numbers) % width:
        raise ConfigError(
            f'waypoints: {len(numbers)} numbers; must be a multiple of {width} '
            f'({", ".join(FIELDS)} for each)'
        )
    plan = []
    for start in range(0, len(numbers), width):
        x, y, z, yaw, hold = (float(n) for n in numbers[start : start + width])
        if not all(map(math.isfinite, (x, y, z, yaw, hold))) or hold < 0:
            raise ConfigError(
                f'waypoint {start // width + 1}: {[x, y, z, yaw, hold]}; '
                'all must be finite and hold at least 0 s'
            )
        plan.append(Waypoint((x, y, z), yaw, hold))
    return plan


class WaypointPlan:
    """
    Goes through waypoints: the next one after staying ``hold`` seconds within ``radius``.

    The last one is held for ever. An empty plan has no target until ``go_to``.

    Parameters
    ----------
    waypoints
        To go through, in order.
    radius
        Distance at which a waypoint counts as reached [m].
    turn
        Heading error at which it does [rad].

    """

    def __init__(
        self, waypoints: Sequence[Waypoint] = (), *, radius: float = 0.25, turn: float = 0.2
    ) -> None:
        self._plan = list(waypoints)
        self._radius_squared = radius * radius  # [m^2]
        self._turn = turn  # heading error at which a waypoint counts as reached [rad]
        self._override: Waypoint | None = None
        self.restart()

    def restart(self) -> None:
        """Begin again at the first waypoint (the simulation was reset)."""
        self._index = 0
        self._arrived: float | None = None
        self._override = None

    def go_to(self, waypoint: Waypoint) -> None:
        """
        Leave the plan and hold this waypoint until the next ``go_to`` or ``restart``.

        Parameters
        ----------
        waypoint
            What to hold.

        """
        self._override = waypoint

    @property
    def asks(self) -> bool:
        """Whether ``target`` looks at where the vehicle is."""
        return self._index + 1 < len(self._plan)

    @property
    def index(self) -> int:
        """Index of the present waypoint of the plan."""
        return self._index

    def target(self, time: float, position_w: Sequence[float], yaw: float) -> Waypoint | None:
        """
        Return the waypoint to hold now.

        Parameters
        ----------
        time
            Stamp of the state [s].
        position_w, yaw
            Where the vehicle is [m] and looks [rad], world axes.

        """
        if self._override is not None:
            return self._override
        if not self._plan:
            return None
        present = self._plan[self._index]
        if self._index + 1 == len(self._plan):
            return present
        if self._arrived is None and self._is_at(present, position_w, yaw):
            self._arrived = time
        if self._arrived is not None and time - self._arrived >= present.hold:
            self._index += 1
            self._arrived = None
            present = self._plan[self._index]
        return present

    def _is_at(self, waypoint: Waypoint, position_w: Sequence[float], yaw: float) -> bool:
        x, y, z = waypoint.position_w
        dx, dy, dz = position_w[0] - x, position_w[1] - y, position_w[2] - z
        near = dx * dx + dy * dy + dz * dz <= self._radius_squared
        return near and abs(wrap(yaw - waypoint.yaw)) <= self._turn
