"""
What the example controllers share: odometry in, thrusts out, one answer to each state.

The main thread waits on the subscriptions itself and takes them raw, which answers a state in a
fraction of the time of an executor's spin; a second thread runs the executor for the parameter
services. The answer carries the stamp of the odometry, so the simulator can tell in lockstep
which state it belongs to.
"""

import math
import struct
from abc import ABC, abstractmethod
from collections.abc import Mapping

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import SetParametersResult
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.gains import Gains
from fluid_sim_ros.control.waypoints import Waypoint, WaypointPlan, from_flat
from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.ros import controller_parameters as parameters
from fluid_sim_ros.ros.inputs import PolledGroup
from fluid_sim_ros.ros.states import State, read_odometry
from fluid_sim_ros.ros.vehicle_plant import plant_of

#: Longest wait before signals are looked at again [ns].
_WAIT_NS = 50_000_000
# The stamp follows the CDR header in odometry and answer alike.
_STAMP = slice(4, 12)


def thrust_template(thrusters: int) -> Template:
    """Return sensor_msgs/JointState with one block: the efforts; its other lists are empty."""
    template = Template().string('')
    for _ in ('name', 'position', 'velocity'):
        template.uint32(0)
    return template.uint32(thrusters).doubles(thrusters).finish()


class ControllerNode(Node, ABC):
    """
    A controller of one vehicle.

    Subscribes ``<vehicle>/odom`` and ``<vehicle>/cmd/waypoint`` (geometry_msgs/PoseStamped, frame
    ``map`` or ``<vehicle>/odom``), publishes ``<vehicle>/cmd/thrust_stamped``.

    Parameters
    ----------
    name
        Node name.
    scene
        Default of the parameter ``scene``.
    gains
        Class of the gains; each of its fields becomes a parameter ``gains.<field>``.
    own
        Parameters of this controller beside the common ones.

    Raises
    ------
    ConfigError
        If a parameter, the scene or the vehicle is wrong.

    """

    def __init__(
        self,
        name: str,
        scene: str,
        gains: type[Gains],
        own: Mapping[str, parameters.Declared] | None = None,
    ) -> None:
        super().__init__(name)
        self._table = parameters.table_of(gains, own or {})
        parameters.declare(self, self._table)
        self.add_on_set_parameters_callback(self._judge)
        self.add_post_set_parameters_callback(self._take)
        scene = self.get_parameter('scene').value or scene
        self.plant, self.vehicle = plant_of(scene, self.get_parameter('vehicle').value)
        self.plan = WaypointPlan(
            from_flat(self.get_parameter('waypoints').value),
            radius=parameters.number(self, 'waypoint_radius'),
        )
        self.read_live()
        self._create_topics()
        self._ending = False
        self._last_stamp_ns = -1
        self._answered = 0

    def _create_topics(self) -> None:
        vehicle, reliable = self.vehicle.name, ReliabilityPolicy.RELIABLE
        self._frames = ('', 'map', f'{vehicle}/odom')
        group = PolledGroup()
        self._odometry = self.create_subscription(
            Odometry, f'{vehicle}/odom', lambda _: None,
            QoSProfile(depth=10, reliability=reliable), callback_group=group, raw=True,
        )  # fmt: skip
        self._waypoint = self.create_subscription(
            PoseStamped, f'{vehicle}/cmd/waypoint', lambda _: None,
            QoSProfile(depth=1, reliability=reliable), callback_group=group, raw=True,
        )  # fmt: skip
        self._publisher = self.create_publisher(
            JointState, f'{vehicle}/cmd/thrust_stamped',
            QoSProfile(depth=10, reliability=reliable),
        )  # fmt: skip
        count = len(self.vehicle.thrusters)
        self._template = thrust_template(count)
        self._pack = struct.Struct(f'<{count}d').pack_into
        self._wait_set = _rclpy.WaitSet(2, 0, 0, 0, 0, 0, self.context.handle)

    # ---- what a controller adds --------------------------------------------------------------

    @abstractmethod
    def answer(self, time: float, state: State) -> list[float]:
        """Return the thrusts [N] that answer a state; ``time`` is its stamp [s]."""

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
            f'{len(self.vehicle.thrusters)} thrusters; waiting for {self._odometry.topic_name}'
        )
        odometry, waypoint = self._odometry.handle, self._waypoint.handle
        wait_set = self._wait_set
        while not self._ending:
            wait_set.clear_entities()
            wait_set.add_subscription(odometry)
            wait_set.add_subscription(waypoint)
            wait_set.wait(_WAIT_NS)
            # every state is answered, in order, so that the same states get the same answers
            while got := odometry.take_message(Odometry, True):
                self._on_odometry(got[0])
            if got := waypoint.take_message(PoseStamped, True):
                self._on_waypoint(got[0])

    def close(self) -> None:
        """Do nothing: a controller holds nothing that must be closed."""

    def end(self) -> None:
        """Have ``run`` return; safe in a signal handler and in any thread."""
        self._ending = True

    def _on_odometry(self, data: bytes) -> None:
        try:
            state = read_odometry(data)
        except CommandError as error:
            self.get_logger().error(str(error), throttle_duration_sec=1.0)
            return
        if not state.is_sound():
            # one such number would stay in the controller's integrators for ever
            self.get_logger().error(
                'the odometry holds numbers that are not finite, or no attitude: not answered',
                throttle_duration_sec=1.0,
            )
            return
        if state.stamp_ns < self._last_stamp_ns:
            self.plan.restart()
            self.restart()
            self.get_logger().info('time went back: starting anew')
        self._last_stamp_ns = state.stamp_ns
        thrusts = self.answer(state.stamp_ns * 1e-9, state)
        template = self._template
        template.stamp[:] = data[_STAMP]
        self._pack(template.blocks[0], 0, *thrusts)
        self._publisher.handle.publish_raw(template.bytes())

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
            return
        self.get_logger().error(f'waypoint rejected: {fault}')

    # ---- parameters (executor thread) ----------------------------------------------------------

    def _judge(self, changes: list[Parameter]) -> SetParametersResult:
        return parameters.judge(self._table, changes)

    def _take(self, changes: list[Parameter]) -> None:
        if any(change.name in self._table for change in changes):
            self.read_live()
