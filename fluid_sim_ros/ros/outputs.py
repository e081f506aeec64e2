"""The node's state topics: computed and published only when due and subscribed to."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from geometry_msgs.msg import TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.ros import templates
from fluid_sim_ros.ros.inputs import REFRESH_PERIOD
from fluid_sim_ros.runner import period_steps
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.vehicle import Vehicle

_STATE_QOS = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
_CLOCK_QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)


@dataclass
class Topic:
    """One state topic: its template and which bytes go where before it is published."""

    name: str
    publisher: Any
    template: templates.Template
    period: int
    copies: list[tuple[memoryview, memoryview]]
    needs_forces: bool = False
    prepare: Callable[[], None] | None = None
    published: int = 0

    def publish(self, stamp: memoryview) -> None:
        """Publish the present numbers."""
        if self.prepare is not None:
            self.prepare()
        self.template.stamp[:] = stamp
        for target, source in self.copies:
            target[:] = source
        self.publisher.handle.publish_raw(self.template.bytes())
        self.published += 1


class Outputs:
    """
    Every state topic of a node, as one sink for the runner.

    Its period is the greatest common divisor of the topics' periods; wrenches and accelerations
    are evaluated only at steps where a subscribed topic needs them.
    """

    def __init__(self, node: Node, simulation: Simulation, settings: dict[str, Any]) -> None:
        self._node = node
        self._simulation = simulation
        self._settings = settings
        self._stamp = templates.StampBytes()
        self._rows = simulation.observe(forces=True)
        self.topics: list[Topic] = []
        for index, vehicle in enumerate(simulation.vehicles.values()):
            self._add_vehicle(vehicle, self._rows[index])
        self._add('/clock', Clock, templates.clock(), 'clock.rate', [], _CLOCK_QOS)
        self.period = math.gcd(*(topic.period for topic in self.topics))
        self._active: list[Topic] = []
        self._refreshed_at = -math.inf

    # ---- topics ----------------------------------------------------------------------------

    def _add_vehicle(self, vehicle: Vehicle, row: Any) -> None:
        name, settings = vehicle.name, self._settings
        quat = row[nat.QUATERNION]
        velocity = row[nat.LINEAR_VELOCITY.start : nat.ANGULAR_VELOCITY.stop]
        odometry = templates.odometry(
            name, settings['odom.pose_covariance'], settings['odom.twist_covariance']
        )
        position, orientation, twist = odometry.blocks
        self._add(f'{name}/odom', Odometry, odometry, 'odom.rate', [
            (position, templates.as_bytes(row[nat.POSITION])),
            # wxyz inside, xyzw in the message
            (orientation[:24], templates.as_bytes(quat[1:])),
            (orientation[24:], templates.as_bytes(quat[:1])),
            (twist, templates.as_bytes(velocity)),
        ])  # fmt: skip
        columns = {'total': nat.TOTAL, 'thrust': nat.THRUST}
        columns |= {term: nat.term_columns(term) for term in nat.TERMS}
        for term, place in columns.items():
            template = templates.wrench(f'{name}/base_link')
            copies = [(template.blocks[0], templates.as_bytes(row[place]))]
            self._add(
                f'{name}/wrench/{term}', WrenchStamped, template, 'wrench.rate', copies,
                needs_forces=True,
            )  # fmt: skip
        # of the fluid that the base_link origin is in, where a scene has two
        for stream in self._simulation.streams:
            template = templates.twist('map')
            copies = [(template.blocks[0], templates.as_bytes(row[nat.MEDIUM_VELOCITY]))]
            self._add(f'{name}/medium/{stream}', TwistStamped, template, 'medium.rate', copies)
        self._add_joint_states(vehicle)

    def _add_joint_states(self, vehicle: Vehicle) -> None:
        """Publish the joints below the base, then the thrusters with their force as effort."""
        model, data = self._simulation.model, self._simulation.observed
        joints = [j for j in range(model.njnt) if _is_single_joint(model, j, vehicle.body_id)]
        names = [model.joint(j).name or f'joint{j}' for j in joints] + list(vehicle.thrusters)
        if not names:
            return
        template = templates.joint_state(names)
        numbers = np.zeros((3, len(names)))
        qpos_places, dof_places = model.jnt_qposadr[joints], model.jnt_dofadr[joints]
        count = len(joints)

        def prepare() -> None:
            numbers[0, :count] = data.qpos[qpos_places]
            numbers[1, :count] = data.qvel[dof_places]
            numbers[2, :count] = data.qfrc_actuator[dof_places]
            numbers[2, count:] = data.actuator_force[vehicle.thruster_ids]

        copies = [
            (block, templates.as_bytes(numbers[i])) for i, block in enumerate(template.blocks)
        ]
        self._add(
            f'{vehicle.name}/joint_states', JointState, template, 'joint_states.rate', copies,
            needs_forces=True, prepare=prepare,
        )  # fmt: skip

    def _add(
        self,
        name: str,
        message: type,
        template: templates.Template,
        rate: str,
        copies: list[tuple[memoryview, memoryview]],
        qos: QoSProfile = _STATE_QOS,
        needs_forces: bool = False,
        prepare: Callable[[], None] | None = None,
    ) -> None:
        period = period_steps(
            self._settings[rate], self._simulation.timestep, f"parameter '{rate}'"
        )
        publisher = self._node.create_publisher(
            message, name, qos,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )  # fmt: skip
        self.topics.append(Topic(name, publisher, template, period, copies, needs_forces, prepare))

    def destroy(self) -> None:
        """Remove the publishers from the node."""
        for topic in self.topics:
            self._node.destroy_publisher(topic.publisher)

    # ---- the runner's sink -----------------------------------------------------------------

    def write(self, simulation: Simulation) -> None:
        """Publish every topic that is due at this step and has a subscriber."""
        now = time.monotonic()
        if now - self._refreshed_at > REFRESH_PERIOD:
            self._refreshed_at = now
            self.refresh()
        step = simulation.step_count
        due = [topic for topic in self._active if step % topic.period == 0]
        if due:
            self._publish(simulation, due)

    def repeat(self, simulation: Simulation) -> None:
        """Publish the present state again, also to subscribers that came since."""
        self.refresh()
        step = simulation.step_count
        self._publish(simulation, [t for t in self._active if step % t.period == 0])

    def refresh(self) -> None:
        """Look which topics have subscribers."""
        self._active = [t for t in self.topics if t.publisher.get_subscription_count()]

    def _publish(self, simulation: Simulation, topics: list[Topic]) -> None:
        simulation.observe(any([topic.needs_forces for topic in topics]))
        self._stamp.set(simulation.time_ns)
        for topic in topics:
            topic.publish(self._stamp.view)


def _is_single_joint(model: Any, joint: int, base: int) -> bool:
    """Return whether a joint has one position and lies below a base body."""
    if model.jnt_type[joint] not in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
        return False
    body = model.jnt_bodyid[joint]
    while body > base:
        body = model.body_parentid[body]
    return bool(body == base)
