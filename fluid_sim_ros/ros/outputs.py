# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node's state topics: computed and published only when due and subscribed to."""

import math
import time
from dataclasses import dataclass
from typing import Any

from rclpy.node import Node

from fluid_sim_ros.errors import listed
from fluid_sim_ros.loop.recorder_port import RecorderPort
from fluid_sim_ros.messages.state_topics import CLOCK, StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.ros.inputs import REFRESH_PERIOD
from fluid_sim_ros.ros.message_types import find_message_class
from fluid_sim_ros.ros.raw import RawPublisher
from fluid_sim_ros.simulation import Simulation


@dataclass
class Topic:
    """
    One state topic.

    ``publisher`` is None where ROS lacks the message type, ``full`` the name on the graph, and
    ``record`` the place in the log, or -1.
    """

    state: StateTopic
    publisher: RawPublisher | None
    full: str
    record: int = -1
    subscribed: bool = False
    published: int = 0

    def __post_init__(self) -> None:
        self.name, self.period = self.state.name, self.state.period

    def publish(self, data: bytes) -> None:
        """
        Send a message to the subscribers.

        Parameters
        ----------
        data
            The message (CDR).

        """
        if self.publisher is not None:
            self.publisher.publish(data)
            self.published += 1


class Outputs:
    """
    Every state topic of a node, as one sink for the runner.

    Its period is the greatest common divisor of the periods of the topics that are wanted now
    and of the clock; wrenches and accelerations are evaluated, and sensors sampled, only at steps
    where a subscribed or recorded topic needs them. Topics for display, such as markers, go to
    the log like all others, and to subscribers by ``show``.

    Parameters
    ----------
    node
        Owner of the publishers.
    simulation
        Whose state is published.
    settings
        Values of the node's parameters.

    Attributes
    ----------
    topics
        The topics, in the order in which they are published.
    suites
        Sensors of each vehicle.
    period
        Steps between two calls of ``write``.
    tap
        The recorder, or None.
    busy_s, recording_s
        Wall time spent in ``write`` so far, and that part of it for the recorder [s].

    Raises
    ------
    ConfigError
        If a rate is above the step rate, or a sensor does not fit the model.

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
        self.busy_s = self.recording_s = 0.0
        self._clock = next(topic for topic in self.topics if topic.state.type == CLOCK)
        self._active: list[Topic] = []
        self._for_display = [topic for topic in self.topics if topic.state.for_display]
        self._show_period = 1.0 / settings['markers.rate']
        self._show_due = 0.0
        self._refreshed_at = -math.inf
        self._begun = False  # whether the log has what never changes
        for topic in self.topics:
            if topic.state.once:
                topic.publish(topic.state.data())
        for line in self._states.notes:
            node.get_logger().warning(f'robot_description: {line}')
        self._tell_of_missing_types()
        self.refresh()

    def _publisher(self, state: StateTopic) -> RawPublisher | None:
        # a topic whose type ROS here lacks can be recorded, but not published
        if find_message_class(state.type) is None:
            return None
        return RawPublisher(self._node, state.type, state.name, state.quality)

    def _tell_of_missing_types(self) -> None:
        missing = [topic for topic in self.topics if topic.publisher is None]
        for kind in sorted({topic.state.type for topic in missing}):
            names = listed(topic.name for topic in missing if topic.state.type == kind)
            package = kind.partition('/')[0].replace('_', '-')
            self._node.get_logger().warning(
                f'{names}: in logs only, because ROS here lacks {kind}; install '
                f'ros-jazzy-{package}, or use the middleware rmw_fastrtps_cpp'
            )

    def destroy(self) -> None:
        """Remove the publishers from the node."""
        for topic in self.topics:
            if topic.publisher is not None:
                topic.publisher.destroy()

    # ---- the runner's sink -----------------------------------------------------------------

    def write(self, simulation: Simulation) -> None:
        """
        Publish and record every topic that is due at this step and wanted.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        now = time.monotonic()
        if now - self._refreshed_at > REFRESH_PERIOD:
            self._refreshed_at = now
            self.refresh()
        tick = simulation.tick
        due = [topic for topic in self._active if tick % topic.period == 0]
        if not self._begun:
            self._begun = True
            due = [t for t in self.topics if t.state.once and t.record >= 0] + due
        if due:
            recorded = self._publish(due)
            if recorded and self.tap is not None:
                before = time.monotonic()
                self.tap.tick(recorded)
                self.recording_s += time.monotonic() - before
        self.busy_s += time.monotonic() - now

    def repeat(self, simulation: Simulation) -> None:
        """
        Publish the present state again, also to subscribers that came since.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
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
        wanted = [t for t in due if t.publisher and t.publisher.subscription_count()]
        if due:
            self._show_due = max(self._show_due + self._show_period, now)
        if wanted:
            self._states.take_state()
        for topic in wanted:
            topic.publish(self._states.data(topic.state))

    def refresh(self) -> None:
        """Look which topics have subscribers; what is recorded is wanted without any."""
        shown = []
        for topic in self.topics:
            publisher = topic.publisher
            heard = publisher is not None and publisher.subscription_count() > 0
            if heard and topic.state.new_name and not topic.subscribed:
                self._node.get_logger().warning(
                    f'{topic.name} is called {topic.state.new_name} now; the next release does '
                    'not publish the old name'
                )
            topic.subscribed = heard and not (topic.state.for_display or topic.state.once)
            if heard and topic.state.for_display:
                shown.append(topic)
        self._active = [
            t for t in self.topics if t.subscribed or (t.record >= 0 and not t.state.once)
        ]
        self.period = math.gcd(
            self._clock.period, *(topic.period for topic in [*self._active, *shown])
        )

    def restart(self) -> None:
        """Forget what belongs to the time before a reset; a log begins anew."""
        self._states.restart()
        self._begun = False

    def _publish(self, topics: list[Topic]) -> list[tuple[int, bytes]]:
        """Publish the present numbers; return the messages to record."""
        self._states.take_state()
        recorded = []
        for topic in topics:
            data = self._states.data(topic.state)
            if not data:
                continue
            if topic.subscribed:
                topic.publish(data)
            if topic.record >= 0:
                recorded.append((topic.record, data))
        return recorded
