# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What the example controllers share: odometry in, commands out, one answer to each state.

The main thread takes odometry raw and answers it, in a fraction of the time of an executor's spin;
a second thread runs the executor for the parameter services.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, NamedTuple

from geometry_msgs.msg import PoseStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.serialization import deserialize_message

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.gains import Gains
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.waypoints import Waypoint, WaypointPlan, from_flat
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.messages.templates import StampBytes
from fluid_sim_ros.messages.topic import NEWEST
from fluid_sim_ros.ros.controllers import parameters as parameters
from fluid_sim_ros.ros.controllers.command_publisher import CommandPublisher
from fluid_sim_ros.ros.controllers.state_source import StateSource
from fluid_sim_ros.ros.controllers.states import StampedState
from fluid_sim_ros.ros.controllers.velocity_commands import Reach, VelocityCommands
from fluid_sim_ros.ros.health.connections import Connections
from fluid_sim_ros.ros.parameters.changes import judge
from fluid_sim_ros.ros.parameters.table import Table, declare, value_of
from fluid_sim_ros.ros.raw import PolledSubscription, WaitSet
from fluid_sim_ros.simulation.plant import plant_of

#: Longest wait before signals are looked at again [s].
_WAIT = 0.05
_POSE = 'geometry_msgs/msg/PoseStamped'
_FIXED = 'the controller runs'


class Answer(NamedTuple):
    """
    The commands that answer a state.

    Attributes
    ----------
    thrusts
        [N], one per thruster.
    joints
        One per joint actuator that is commanded, in its own unit.

    """

    thrusts: Sequence[float]
    joints: Sequence[float] = ()


class ControllerNode(Node, ABC):
    """
    A controller of one vehicle.

    Subscribes ``<vehicle>/odom``, ``<vehicle>/cmd/waypoint`` (geometry_msgs/PoseStamped, frame
    ``map`` or ``<vehicle>/odom``) and ``<vehicle>/cmd_vel`` (`VelocityCommands`); publishes
    ``<vehicle>/cmd/thrust_stamped`` and, for joint actuators, ``<vehicle>/cmd/joints``, both with
    the stamp of the odometry.

    Parameters
    ----------
    name
        Node name.
    scene
        Default of the parameter ``scene``.
    gains
        Class of the gains; each of its fields becomes a parameter ``gains.<field>``.
    own
        Parameters of this controller beside the common ones, or in their place.
    medium
        ``wind`` or ``current`` to have its velocity at the vehicle in each state (`StateSource`).

    Raises
    ------
    ConfigError
        If a parameter, the scene or the vehicle is wrong.

    """

    #: Heading error at which a waypoint counts as reached [rad].
    turn = 0.2
    lost = ''  # as of LoopingNode

    def __init__(
        self, name: str, scene: str, gains: type[Gains], own: Table | None = None, medium: str = ''
    ) -> None:
        super().__init__(name)
        self._table = parameters.table_of(gains, own or {})
        declare(self, self._table, _FIXED)
        self.add_on_set_parameters_callback(self._judge)
        self.add_post_set_parameters_callback(self._take)
        self.scene = self.get_parameter('scene').value or scene
        self.plant, self.vehicle = plant_of(self.scene, self.get_parameter('vehicle').value)
        self.plan = WaypointPlan(
            from_flat(value_of(self, self._table, 'waypoints')),
            radius=parameters.number(self, 'waypoint_radius'),
            turn=self.turn,
        )
        self.read_live()
        self._create_topics(medium, self.reach(parameters.gains(self, gains)))
        self._ending = False
        self._last_stamp_ns = -1
        self._stamp = StampBytes()

    def _create_topics(self, medium: str, reach: Reach) -> None:
        vehicle, name = self.vehicle, self.vehicle.name
        self._frames = ('', 'map', f'{name}/odom')
        self._states = StateSource(self, name, medium)
        self._waypoint = PolledSubscription(self, _POSE, f'{name}/cmd/waypoint', NEWEST)
        self.velocity = VelocityCommands(
            self, name, reach, lambda: parameters.number(self, 'cmd_vel.timeout'), self.warn
        )
        self._heard = [*self._states.subscriptions, self._waypoint, *self.velocity.subscriptions]
        self._thrusts = CommandPublisher(
            self, f'{name}/cmd/thrust_stamped', 'effort', len(vehicle.thrusters)
        )
        self._joints: CommandPublisher | None = None
        self._connections = Connections(self, self.warn)
        self._connections.watch(self._heard)
        self._connections.watch([self._thrusts.publisher])

    def command_joints(self, names: Sequence[str]) -> None:
        """
        Have each answer command joint actuators, too.

        Parameters
        ----------
        names
            Which, in the order of ``Answer.joints``.

        """
        all_in_order = tuple(names) == self.vehicle.joints
        self._joints = CommandPublisher(
            self, f'{self.vehicle.name}/cmd/joints', 'position', len(names),
            () if all_in_order else names,
        )  # fmt: skip
        self._connections.watch([self._joints.publisher])

    def order_of_joints(self, commanded: Sequence[str]) -> list[int]:
        """
        Return where each joint actuator of the vehicle stands among those that a law commands.

        Parameters
        ----------
        commanded
            Joint actuators in the order of the law's answer.

        Returns
        -------
        list of int
            One index into ``commanded`` per joint actuator of the vehicle, in its order.

        Raises
        ------
        ConfigError
            If the vehicle has others.

        """
        joints = self.vehicle.joints
        if set(joints) != set(commanded):
            raise ConfigError(
                f"vehicle '{self.vehicle.name}' has the joint actuators: {listed(joints)}; this "
                f'controller needs: {listed(commanded)}'
            )
        return [commanded.index(name) for name in joints]

    # ---- what a controller adds --------------------------------------------------------------

    @abstractmethod
    def reach(self, gains: Any) -> Reach:
        """
        Return which velocities the controller can follow.

        Parameters
        ----------
        gains
            Its gains.

        """

    @abstractmethod
    def answer(self, state: State) -> Answer:
        """
        Return the commands that answer a state.

        Parameters
        ----------
        state
            State of base_link as odometry has it, world axes and base_link axes.

        Returns
        -------
        Answer
            Thrusts [N], and joint commands in their own units.

        """

    @abstractmethod
    def restart(self) -> None:
        """Forget targets taken from states: the simulation was reset."""

    def read_live(self) -> None:
        """Read the parameters that may change at run time; called at the start and after."""

    # ---- the loop ----------------------------------------------------------------------------

    def run(self) -> None:
        """Answer states until ``end``."""
        self.get_logger().info(
            f"vehicle '{self.vehicle.name}': {self.plant.mass:.2f} kg, "
            f'{len(self.vehicle.thrusters)} thrusters; waiting for {self._states.topic}'
        )
        wait_set = WaitSet(self)
        while not self._ending:
            wait_set.wait(self._heard, _WAIT)
            asked = not wait_set.only_first()  # each look at an empty topic takes 2 us
            self.velocity.take(asked)
            # every state is answered, in order, so that the same states get the same answers
            for stamped in self._states.take():
                self._on_state(stamped)
            if asked and (data := self._waypoint.take()):
                self._on_waypoint(data)

    def close(self) -> None:
        """Do nothing: a controller holds nothing that must be closed."""

    def warn(self, line: str) -> None:
        """
        Tell the user of something that may not be meant.

        Parameters
        ----------
        line
            What.

        """
        self.get_logger().warning(line)

    def end(self) -> None:
        """Have ``run`` return; safe in a signal handler and in any thread."""
        self._ending = True

    def _on_state(self, stamped: StampedState) -> None:
        stamp_ns, state = stamped
        if not state.is_sound():
            # one such number would stay in the controller's integrators for ever
            self._states.rejected(
                'state',
                'the odometry holds numbers that are not finite, or no attitude: not answered',
            )
            return
        if stamp_ns < self._last_stamp_ns:
            self.plan.restart()
            self.velocity.forget()
            self.restart()
            self.get_logger().info('time went back: starting anew')
        self._last_stamp_ns = stamp_ns
        thrusts, joints = self.answer(state)
        self._stamp.set(stamp_ns)
        if self._joints is not None:
            self._joints.publish(self._stamp.view, joints)
        self._thrusts.publish(self._stamp.view, thrusts)

    def _on_waypoint(self, data: bytes) -> None:
        message = deserialize_message(data, PoseStamped)
        position, q = message.pose.position, message.pose.orientation
        quat = (q.w, q.x, q.y, q.z)
        place = (position.x, position.y, position.z)
        if message.header.frame_id not in self._frames:
            fault = f"frame '{message.header.frame_id}' is not known; allowed: map"
        elif not all(map(math.isfinite, (*place, *quat))) or not any(quat):
            fault = 'position and orientation must be finite, the quaternion not zero'
        else:
            yaw = rot.yaw_of(rot.from_quaternion(quat))
            self.plan.go_to(Waypoint(place, yaw))
            self.velocity.forget()
            return
        self._states.rejected('waypoint', f'waypoint rejected: {fault}')

    # ---- parameters (executor thread) ----------------------------------------------------------

    def _judge(self, changes: list[Parameter]) -> SetParametersResult:
        return judge(self, self._table, changes, _FIXED)

    def _take(self, changes: list[Parameter]) -> None:
        if any(change.name in self._table for change in changes):
            self.read_live()
