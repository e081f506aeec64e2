# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``rov_controller``: holds depth, heading and a level attitude with an underwater vehicle."""

import math
from collections.abc import Sequence

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.axes import NAMES
from fluid_sim_ros.control.guidance.velocity import Velocity
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController, UnderwaterGains
from fluid_sim_ros.interruption import leave
from fluid_sim_ros.ros.controllers import parameters as parameters
from fluid_sim_ros.ros.controllers.base import Answer, ControllerNode
from fluid_sim_ros.ros.controllers.parameters import DEPTH, HEADING
from fluid_sim_ros.ros.controllers.velocity_commands import Reach
from fluid_sim_ros.ros.parameters.table import Declared
from fluid_sim_ros.ros.process.run import Executable, run_process

NODE_NAME = 'rov_controller'
SUMMARY = (
    'Holds depth, heading and a level attitude with an underwater vehicle, and flies waypoints.'
)
DEFAULT_SCENE = 'rov'

OWN = {
    'depth': DEPTH,
    'heading': HEADING,
    'surge': Declared(
        0.0, '[m/s] speed over ground along the heading, without a waypoint', live=True
    ),
    'sway': Declared(
        0.0, '[m/s] speed over ground to the left of the heading, without a waypoint', live=True
    ),
}  # fmt: skip


class RovController(ControllerNode):
    """Answers odometry with the thrusts of an `UnderwaterController`."""

    def __init__(self) -> None:
        super().__init__(NODE_NAME, DEFAULT_SCENE, UnderwaterGains, OWN)
        self._law = UnderwaterController(self.plant, parameters.gains(self, UnderwaterGains))
        if self._law.lacks:
            self.warn(_words(self.vehicle.name, self._law.lacks))
        self._first: tuple[float, float] | None = None

    def read_live(self) -> None:
        """Read depth, heading and speeds."""
        names = ('depth', 'heading', 'surge', 'sway')
        # one assignment, so that the loop in the other thread never sees half of a change
        self._wanted = tuple(parameters.number(self, name) for name in names)

    def reach(self, gains: UnderwaterGains) -> Reach:
        """
        Return which velocities the controller can follow.

        Parameters
        ----------
        gains
            Its gains.

        Returns
        -------
        Reach
            Speeds of the law, 0 along axes that the thrusters do not reach.

        """
        lacks = UnderwaterController(self.plant, gains).lacks
        bounds = {
            'fx': gains.max_speed, 'fy': gains.max_speed, 'fz': gains.max_climb,
            'tz': gains.max_rate,
        }  # fmt: skip
        most = Velocity(*(0.0 if axis in lacks else bound for axis, bound in bounds.items()))
        return Reach(most, 1.5 * gains.max_climb / gains.position)

    def restart(self) -> None:
        """Take the depth and heading to hold from the next state."""
        self._first = None

    def answer(self, state: State) -> Answer:
        """
        Return the thrusts that hold what is wanted.

        Parameters
        ----------
        state
            State of base_link as odometry has it, world axes and base_link axes.

        Returns
        -------
        Answer
            Thrusts [N].

        """
        yaw = 0.0
        if self._first is None or self.plan.asks:
            yaw = rot.yaw_of(rot.from_quaternion(state.quat_wb_wxyz))
        if self._first is None:
            self._first = (-state.position_w[2], yaw)
        depth, heading, surge, sway = self._wanted
        depth = self._first[0] if math.isnan(depth) else depth
        heading = self._first[1] if math.isnan(heading) else heading
        place = None
        waypoint = self.plan.target(state.time, state.position_w, yaw)
        if waypoint is not None:
            place = waypoint.position_w[:2]
            depth, heading = -waypoint.position_w[2], waypoint.yaw
        piloted = self.velocity.target(state)
        if piloted is not None:
            (surge, sway, _, _), moving = piloted
            depth, heading, place = -moving.position_w[2], moving.heading, None
        target = DepthTarget(depth, heading, (surge, sway), place)
        return Answer(self._law.step(state, target))


def _words(vehicle: str, lacks: Sequence[str]) -> str:
    """Return which axes a vehicle lacks, and what that means."""
    names = ', '.join(NAMES[axis] for axis in lacks)
    meaning = [
        text
        for axes, text in (
            (('fz',), 'the depth is not held'),
            (('tz',), 'the heading is not held'),
            (('fx',), 'it does not move ahead'),
            (('fy',), 'it heads for a waypoint instead of moving sideways'),
            (('tx', 'ty'), 'its righting moment alone keeps it level'),
        )
        if set(axes) & set(lacks)
    ]
    return f"the thrusters of '{vehicle}' do not reach: {names}; {', '.join(meaning)}"


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the controller.

    Parameters
    ----------
    args
        Command line; None means that of the process.

    Returns
    -------
    int
        The process's exit code.

    """
    table = parameters.table_of(UnderwaterGains, OWN)
    return run_process(Executable(NODE_NAME, SUMMARY, table, RovController), args)


if __name__ == '__main__':
    leave(main())
