# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``auv_controller``: holds depth, heading and speed with a propeller, a rudder and planes."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.fins import PITCH, YAW, FinMixer
from fluid_sim_ros.control.guidance.velocity import Velocity
from fluid_sim_ros.control.propulsion import Propulsion
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.torpedo import CruiseTarget, TorpedoController, TorpedoGains
from fluid_sim_ros.errors import listed
from fluid_sim_ros.interruption import leave
from fluid_sim_ros.ros.controllers import parameters as parameters
from fluid_sim_ros.ros.controllers.base import Answer, ControllerNode
from fluid_sim_ros.ros.controllers.parameters import DEPTH, HEADING
from fluid_sim_ros.ros.controllers.velocity_commands import Reach
from fluid_sim_ros.ros.parameters.table import Declared
from fluid_sim_ros.ros.process.run import Executable, run_process
from fluid_sim_ros.simulation.fin_effect import fin_effect

NODE_NAME = 'auv_controller'
SUMMARY = 'Holds depth, heading and speed with a propeller, a rudder and stern planes.'
DEFAULT_SCENE = 'remus100'
#: Joint actuators in the order of the law's answer.
FINS = ('rudder', 'planes')
#: Share of the gains' authority by which measured fins may differ and still be those.
_AS_EXPECTED = 0.15

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
    """
    Answers odometry with the thrust and the deflections of a `TorpedoController`.

    Fins other than a rudder and planes as the REMUS 100 has them are measured on the model:
    whatever their number, names and signs, they are mixed so that they turn the vehicle as a
    rudder and planes do.
    """

    turn = math.pi  # it passes a waypoint in whatever direction

    def __init__(self) -> None:
        super().__init__(NODE_NAME, DEFAULT_SCENE, TorpedoGains, OWN)
        gains = parameters.gains(self, TorpedoGains)
        self._mixer = mixer = self._mixer_of(gains)
        if mixer is None:
            self._order = self.order_of_joints(FINS)
            self.command_joints(self.vehicle.joints)
            most = float(abs(self.vehicle.joint_range).min())
        else:
            self.command_joints(mixer.names)
            most = mixer.max_deflection
            if gains.fin_authority == TorpedoGains().fin_authority:
                gains = replace(gains, fin_authority=mixer.authority)
        self._propulsion = Propulsion(self.plant)
        self._law = TorpedoController(self._propulsion.plant, most, gains)
        self._first: tuple[float, float] | None = None

    def _mixer_of(self, gains: TorpedoGains) -> FinMixer | None:
        """Measure what the fins do; None for a rudder and planes as the gains expect them."""
        joints = self.vehicle.joints
        effect = fin_effect(self.scene, self.vehicle)
        if set(joints) == set(FINS):
            rudder, planes = effect[:, joints.index('rudder')], effect[:, joints.index('planes')]
            turns = np.array([planes[PITCH], rudder[YAW], planes[YAW], rudder[PITCH]])
            expected = gains.fin_authority * np.array([1.0, 1.0, 0.0, 0.0])
            if abs(turns - expected).max() < _AS_EXPECTED * gains.fin_authority:
                return None
        mixer = FinMixer(joints, effect, self.vehicle.joint_range)
        self.get_logger().info(
            f'fins {listed(mixer.names)}: {mixer.authority:.3g} 1/m^2 in pitch and yaw (measured)'
        )
        held = {'pitch': 'depth', 'yaw': 'heading'}
        for axis in mixer.lacks:
            self.warn(
                f"the fins of '{self.vehicle.name}' do not turn it in {axis}: the {held[axis]} is "
                'not held'
            )
        return mixer

    def read_live(self) -> None:
        """Read depth, heading and speed."""
        names = ('depth', 'heading', 'speed')
        # one assignment, so that the loop in the other thread never sees half of a change
        self._wanted = tuple(parameters.number(self, name) for name in names)

    def reach(self, gains: TorpedoGains) -> Reach:
        """
        Return which velocities the controller can follow.

        Parameters
        ----------
        gains
            Its gains.

        Returns
        -------
        Reach
            Any forward speed, and no motion sideways.

        """
        most = Velocity(math.inf, 0.0, gains.max_climb, gains.max_rate)
        return Reach(most, 1.5 * gains.max_climb / gains.depth)

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
        piloted = self.velocity.target(state)
        if piloted is not None:
            velocity, moving = piloted
            speed = max(velocity.ahead, 0.0)
            depth, heading = -moving.position_w[2], moving.heading
        thrust, *fins = self._law.step(state, CruiseTarget(depth, heading, speed))
        joints = [fins[i] for i in self._order] if self._mixer is None else self._mixer.mix(*fins)
        return Answer(self._propulsion.thrusts(thrust), joints)


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
