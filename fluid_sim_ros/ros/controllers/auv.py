"""``auv_controller``: holds depth, heading and speed with a propeller, a rudder and planes."""

import math
from collections.abc import Sequence

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.torpedo import CruiseTarget, TorpedoController, TorpedoGains
from fluid_sim_ros.ros.controllers import parameters as parameters
from fluid_sim_ros.ros.controllers.base import Answer, ControllerNode
from fluid_sim_ros.ros.controllers.parameters import DEPTH, HEADING
from fluid_sim_ros.ros.parameters.table import Declared
from fluid_sim_ros.ros.process.run import Executable, run_process
from fluid_sim_ros.ros.process.signals import leave

NODE_NAME = 'auv_controller'
SUMMARY = 'Holds depth, heading and speed with a propeller, a rudder and stern planes.'
DEFAULT_SCENE = 'remus100'
#: Joint actuators in the order of the law's answer.
FINS = ('rudder', 'planes')

OWN = {
    'depth': DEPTH,
    'heading': HEADING,
    'speed': Declared(1.5, '[m/s] forward speed over ground to hold', low=0, live=True),
    'waypoints': Declared(
        [], '[m, m, m, rad, s] x, y, z, yaw, hold of each waypoint, one after another; it heads '
        'for each (whatever its yaw) at its depth, and circles about the last'
    ),
    'waypoint_radius': Declared(5.0, '[m] distance at which a waypoint counts as reached', low=0),
}  # fmt: skip


class AuvController(ControllerNode):
    """Answers odometry with the thrust and the deflections of a `TorpedoController`."""

    turn = math.pi  # it passes a waypoint in whatever direction

    def __init__(self) -> None:
        super().__init__(NODE_NAME, DEFAULT_SCENE, TorpedoGains, OWN)
        self._order = self.order_of_joints(FINS)
        self._law = TorpedoController(
            self.plant, float(abs(self.vehicle.joint_range).min()),
            parameters.gains(self, TorpedoGains),
        )  # fmt: skip
        self._first: tuple[float, float] | None = None

    def read_live(self) -> None:
        """Read depth, heading and speed."""
        names = ('depth', 'heading', 'speed')
        # one assignment, so that the loop in the other thread never sees half of a change
        self._wanted = tuple(parameters.number(self, name) for name in names)

    def restart(self) -> None:
        """Take the depth and heading to hold from the next state."""
        self._first = None

    def answer(self, state: State) -> Answer:
        """
        Return the thrust and the deflections that hold what is wanted.

        Parameters
        ----------
        state
            State of base_link as odometry has it, world axes and base_link axes.

        Returns
        -------
        Answer
            Thrust [N] and deflections [rad].

        """
        x, y, z = state.position_w
        yaw = rot.yaw_of(rot.from_quaternion(state.quat_wb_wxyz))
        if self._first is None:
            self._first = (-z, yaw)
        depth, heading, speed = self._wanted
        depth = self._first[0] if math.isnan(depth) else depth
        heading = self._first[1] if math.isnan(heading) else heading
        waypoint = self.plan.target(state.time, state.position_w, yaw)
        if waypoint is not None:
            to_x, to_y, to_z = waypoint.position_w
            depth, heading = -to_z, math.atan2(to_y - y, to_x - x)
        thrust, *fins = self._law.step(state, CruiseTarget(depth, heading, speed))
        return Answer([thrust], [fins[i] for i in self._order])


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
    table = parameters.table_of(TorpedoGains, OWN)
    return run_process(Executable(NODE_NAME, SUMMARY, table, AuvController), args)


if __name__ == '__main__':
    leave(main())
