# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``plane_controller``: holds altitude, heading and airspeed with a fixed-wing aircraft."""

import math
from collections.abc import Sequence

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.fixed_wing import (
    FixedWingCommand,
    FixedWingController,
    FixedWingGains,
    FlightTarget,
)
from fluid_sim_ros.control.guidance.velocity import Velocity
from fluid_sim_ros.control.state import State
from fluid_sim_ros.interruption import leave
from fluid_sim_ros.ros.controllers import parameters as parameters
from fluid_sim_ros.ros.controllers.base import Answer, ControllerNode
from fluid_sim_ros.ros.controllers.parameters import HEADING, OF_FIRST
from fluid_sim_ros.ros.controllers.velocity_commands import Reach
from fluid_sim_ros.ros.parameters.table import Declared
from fluid_sim_ros.ros.process.run import Executable, run_process

NODE_NAME = 'plane_controller'
SUMMARY = 'Holds altitude, heading and airspeed with a fixed-wing aircraft, and flies waypoints.'
DEFAULT_SCENE = 'aerosonde'
#: Joint actuators that the law commands, in any order.
SURFACES = FixedWingCommand._fields[1:]

OWN = {
    'altitude': Declared(
        math.nan, f'[m] altitude to hold, above z = 0; {OF_FIRST}', live=True, may_be_nan=True
    ),
    'heading': HEADING,
    'airspeed': Declared(25.0, '[m/s] airspeed to hold', low=0, live=True),
    'waypoints': Declared(
        [], '[m, m, m, rad, s] x, y, z, course, hold of each waypoint, one after another; flown '
        'on the line through it over ground with this course; empty = hold altitude and heading'
    ),
    'waypoint_radius': Declared(30.0, '[m] distance at which a waypoint counts as reached', low=0),
}  # fmt: skip


class PlaneController(ControllerNode):
    """
    Answers odometry with thrust and surfaces of a `FixedWingController`.

    Airspeed is that of odometry less ``<vehicle>/medium/wind``, as ideal air data: the simulator's
    ``medium.rate`` has to be its ``odom.rate``.
    """

    turn = math.pi  # it passes a waypoint on whatever course

    def __init__(self) -> None:
        super().__init__(NODE_NAME, DEFAULT_SCENE, FixedWingGains, OWN, medium='wind')
        self._order = self.order_of_joints(SURFACES)
        self.command_joints(self.vehicle.joints)
        self._law = FixedWingController(
            self.plant, float(abs(self.vehicle.joint_range).min()),
            parameters.gains(self, FixedWingGains),
        )  # fmt: skip
        self._first: tuple[float, float] | None = None

    def read_live(self) -> None:
        """Read altitude, heading and airspeed."""
        names = ('altitude', 'heading', 'airspeed')
        # one assignment, so that the loop in the other thread never sees half of a change
        self._wanted = tuple(parameters.number(self, name) for name in names)

    def reach(self, gains: FixedWingGains) -> Reach:
        """
        Return which velocities the controller can follow.

        Parameters
        ----------
        gains
            Its gains.

        Returns
        -------
        Reach
            Any airspeed, the law's climb, and the turn of its largest bank at cruise.

        """
        gravity = self.plant.weight / self.plant.mass
        turn = gravity * math.tan(gains.max_bank) / gains.cruise_airspeed
        most = Velocity(math.inf, 0.0, gains.max_climb, turn)
        return Reach(most, 1.5 * gains.max_climb / gains.balance)

    def restart(self) -> None:
        """Take the altitude and heading to hold from the next state."""
        self._first = None

    def answer(self, state: State) -> Answer:
        """
        Return thrust and deflections that hold what is wanted.

        Parameters
        ----------
        state
            State of base_link as odometry has it, world axes and base_link axes.

        Returns
        -------
        Answer
            Thrust [N] and deflections [rad].

        """
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        if self._first is None:
            self._first = (state.position_w[2], rot.yaw_of(r_wb))
        altitude, heading, airspeed = self._wanted
        altitude = self._first[0] if math.isnan(altitude) else altitude
        heading = self._first[1] if math.isnan(heading) else heading
        line = None
        waypoint = self.plan.target(state.time, state.position_w, rot.yaw_of(r_wb))
        if waypoint is not None:
            line, altitude, heading = waypoint.position_w, waypoint.position_w[2], waypoint.yaw
        piloted = self.velocity.target(state)
        if piloted is not None:
            velocity, moving = piloted
            # an aircraft cannot stand still: without a speed it keeps its airspeed
            airspeed = velocity.ahead if velocity.ahead > 0 else airspeed
            altitude, heading, line = moving.position_w[2], moving.heading, None
        target = FlightTarget(altitude, heading, airspeed, line)
        thrust, *surfaces = self._law.step(state, target)
        return Answer([thrust], [surfaces[i] for i in self._order])


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
    table = parameters.table_of(FixedWingGains, OWN)
    return run_process(Executable(NODE_NAME, SUMMARY, table, PlaneController), args)


if __name__ == '__main__':
    leave(main())
