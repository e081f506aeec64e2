# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``quad_controller``: holds position and flies waypoints with a multirotor, in wind."""

from collections.abc import Sequence

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.approach import Approach
from fluid_sim_ros.control.guidance.velocity import Velocity
from fluid_sim_ros.control.multirotor import MultirotorController, MultirotorGains, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.waypoints import Waypoint
from fluid_sim_ros.interruption import leave
from fluid_sim_ros.ros.controllers import parameters as parameters
from fluid_sim_ros.ros.controllers.base import Answer, ControllerNode
from fluid_sim_ros.ros.controllers.velocity_commands import Reach
from fluid_sim_ros.ros.process.run import Executable, run_process

NODE_NAME = 'quad_controller'
SUMMARY = 'Holds position and flies waypoints with a multirotor, in wind.'
DEFAULT_SCENE = 'quadrotor'


class QuadController(ControllerNode):
    """Answers odometry with the thrusts of a `MultirotorController`."""

    def __init__(self) -> None:
        super().__init__(NODE_NAME, DEFAULT_SCENE, MultirotorGains)
        self._law = MultirotorController(self.plant, parameters.gains(self, MultirotorGains))
        self._home: Waypoint | None = None

    def reach(self, gains: MultirotorGains) -> Reach:
        """
        Return which velocities the controller can follow.

        Parameters
        ----------
        gains
            Its gains.

        Returns
        -------
        Reach
            Speeds of the law, and its target half as far again as it lags behind at most.

        """
        most = Velocity(gains.max_speed, gains.max_speed, gains.max_climb, gains.max_rate)
        approach = Approach(gains.position, gains.max_speed, gains.max_acceleration)
        return Reach(most, 1.5 * gains.max_climb / gains.position, approach.distance)

    def restart(self) -> None:
        """Take the place to hold from the next state."""
        self._home = None

    def answer(self, state: State) -> Answer:
        """
        Return the thrusts towards the present waypoint.

        Parameters
        ----------
        state
            State of base_link as odometry has it, world axes and base_link axes.

        Returns
        -------
        Answer
            Thrusts [N].

        """
        yaw = rot.yaw_of(rot.from_quaternion(state.quat_wb_wxyz))
        if self._home is None:
            x, y, z = state.position_w
            self._home = Waypoint((x, y, z), yaw)
        piloted = self.velocity.target(state)
        if piloted is not None:
            _, moving = piloted
            return Answer(self._law.step(state, PoseTarget(moving.position_w, moving.heading)))
        target = self.plan.target(state.time, state.position_w, yaw) or self._home
        return Answer(self._law.step(state, PoseTarget(target.position_w, target.yaw)))


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
    table = parameters.table_of(MultirotorGains, {})
    return run_process(Executable(NODE_NAME, SUMMARY, table, QuadController), args)


if __name__ == '__main__':
    leave(main())
