"""The node's state topics: computed and published only when due and subscribed to."""

import importlib.util
import math
import time
from dataclasses import dataclass
from typing import Any

from geometry_msgs.msg import TwistStamped, TwistWithCovarianceStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    QoSProfile,
    ReliabilityPolicy,
    qos_profile_sensor_data,
)
from rclpy.qos_overriding_options import QoSOverridingOptions
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import (
    FluidPressure,
    Imu,
    JointState,
    MagneticField,
    NavSatFix,
    Range,
)
from visualization_msgs.msg import MarkerArray

from fluid_sim_ros.loop.recorder_port import RecorderPort
from fluid_sim_ros.messages.commands import JOINT_STATE, TWIST, WRENCH
from fluid_sim_ros.messages.marker_topics import MARKERS
from fluid_sim_ros.messages.sensor_topics import (
    FLUID_PRESSURE,
    IMU,
    MAGNETIC_FIELD,
    NAV_SAT_FIX,
    RANGE,
    VELOCITY,
)
from fluid_sim_ros.messages.state_topics import CLOCK, ODOMETRY, TRANSFORMS, StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.ros.inputs import REFRESH_PERIOD
from fluid_sim_ros.simulation import Simulation

_STATE_QOS = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
_CLOCK_QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
_LATCHED_QOS = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)
_MESSAGES: dict[str, type] = {
    ODOMETRY: Odometry, WRENCH: WrenchStamped, TWIST: TwistStamped, JOINT_STATE: JointState,
    CLOCK: Clock, IMU: Imu, MAGNETIC_FIELD: MagneticField, FLUID_PRESSURE: FluidPressure,
    NAV_SAT_FIX: NavSatFix, RANGE: Range, VELOCITY: TwistWithCovarianceStamped,
    MARKERS: MarkerArray,
}  # fmt: skip
# an optional part of ROS: without it the transforms can be recorded, but not published
if importlib.util.find_spec('tf2_msgs') is not None:
    from tf2_msgs.msg import TFMessage

    _MESSAGES[TRANSFORMS] = TFMessage


@dataclass
class Topic:
    """
    One state topic.

    ``publisher`` is None where ROS lacks the message type, ``full`` the name on the graph, and
    ``record`` the place in the log, or -1.
    """

    state: StateTopic
    publisher: Any
    full: str
    record: int = -1
    subscribed: bool = False
    published: int = 0

    def __post_init__(self) -> None:
        self.name, self.period = self.state.name, self.state.period


class Outputs:
    """
    Every state topic of a node, as one sink for the runner.

    Its period is the greatest common divisor of the periods of the topics that are wanted now
    and of the clock; wrenches and accelerations are evaluated, and sensors sampled, only at steps
    where a subscribed or recorded topic needs them. Topics for eyes, such as markers, go to
    the log like all others, and to subscribers by ``show``.
    """

    def __init__(self, node: Node, simulation: Simulation, settings: dict[str, Any]) -> None:
        self._node = node
        self._states = StateTopics(simulation, settings)
        self.suites = self._states.suites
        self.topics = [
            Topic(state, self._publisher(state), node.resolve_topic_name(state.name))
            for state in self._states.topics
        ]
        self.tap: RecorderPort | None = None
        self._clock = next(topic for topic in self.topics if topic.state.type == CLOCK)
        self._active: list[Topic] = []
        self._for_display = [topic for topic in self.topics if topic.state.for_display]
        self._show_period = 1.0 / settings['markers.rate']
        self._show_due = 0.0
        self._refreshed_at = -math.inf
        self.refresh()

    def _publisher(self, state: StateTopic) -> Any:
        if state.type not in _MESSAGES:
            return None
        return self._node.create_publisher(
            _MESSAGES[state.type], state.name,
            self._quality(state),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )  # fmt: skip

    @staticmethod
    def _quality(state: StateTopic) -> QoSProfile:
        if state.type == CLOCK:
            return _CLOCK_QOS
        if state.transient_local:
            return _LATCHED_QOS
        return _STATE_QOS if state.reliable else qos_profile_sensor_data

    def destroy(self) -> None:
        """Remove the publishers from the node."""
        for topic in self.topics:
            if topic.publisher is not None:
                self._node.destroy_publisher(topic.publisher)

    # ---- the runner's sink -----------------------------------------------------------------

    def write(self, simulation: Simulation) -> None:
        """Publish and record every topic that is due at this step and wanted."""
        now = time.monotonic()
        if now - self._refreshed_at > REFRESH_PERIOD:
            self._refreshed_at = now
            self.refresh()
        tick = simulation.tick
        due = [topic for topic in self._active if tick % topic.period == 0]
        if due:
            recorded = self._publish(due)
            if recorded and self.tap is not None:
                self.tap.tick(recorded)

    def repeat(self, simulation: Simulation) -> None:
        """Publish the present state again, also to subscribers that came since."""
        self.refresh()
        tick = simulation.tick
        self._publish([t for t in self._active if tick % t.period == 0])

    def show(self, simulation: Simulation, now: float, stands: bool) -> None:
        """
        Publish topics for eyes, where their period and their rate of wall time say so.

        Parameters
        ----------
        simulation
            At a step boundary.
        now
            Wall time [s], monotonic.
        stands
            The simulation is not going on, so that the present state is all there is to see.

        """
        # half a period of slack, so that steps in real time do not miss their turn by a hair
        if now < self._show_due - 0.5 * self._show_period:
            return
        tick = simulation.tick
        due = [t for t in self._for_display if stands or tick % t.period == 0]
        wanted = [t for t in due if t.publisher.get_subscription_count()]
        if due:
            self._show_due = max(self._show_due + self._show_period, now)
        if wanted:
            self._states.look()
        for topic in wanted:
            topic.publisher.handle.publish_raw(self._states.data(topic.state))
            topic.published += 1

    def refresh(self) -> None:
        """Look which topics have subscribers; what is recorded is wanted without any."""
        shown = []
        for topic in self.topics:
            publisher = topic.publisher
            heard = publisher is not None and publisher.get_subscription_count() > 0
            topic.subscribed = heard and not topic.state.for_display
            if heard and topic.state.for_display:
                shown.append(topic)
        self._active = [t for t in self.topics if t.subscribed or t.record >= 0]
        self.period = math.gcd(
            self._clock.period, *(topic.period for topic in [*self._active, *shown])
        )

    def restart(self) -> None:
        """Forget what belongs to the time before a reset."""
        self._states.restart()

    def _publish(self, topics: list[Topic]) -> list[tuple[int, bytes]]:
        """Publish the present numbers; return the messages to record."""
        self._states.look()
        recorded = []
        for topic in topics:
            data = self._states.data(topic.state)
            if not data:
                continue
            if topic.subscribed:
                topic.publisher.handle.publish_raw(data)
                topic.published += 1
            if topic.record >= 0:
                recorded.append((topic.record, data))
        return recorded
