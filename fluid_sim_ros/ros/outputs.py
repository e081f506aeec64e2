# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node's state topics: computed and published only when due and subscribed to."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rclpy.node import Node

from fluid_sim_ros.errors import listed
from fluid_sim_ros.loop.recorder_port import RecorderPort
from fluid_sim_ros.messages.compiled_tick import CompiledTick
from fluid_sim_ros.messages.state_topics import CLOCK, StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.ros.inputs import REFRESH_PERIOD
from fluid_sim_ros.ros.message_types import find_message_class
from fluid_sim_ros.ros.publishing import Publishing
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

    def __post_init__(self) -> None:
        self.name, self.period = self.state.name, self.state.period


class Outputs:
    """
    Every state topic of a node, as one sink for the runner.

    A tick is one call of the compiled library, unless Python has to make numbers in between.
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
    publishing
        How messages reach the middleware.
    tap
        The recorder, or None.
    busy_s, recording_s
        Wall time spent in ``write`` so far, and that part of it for the recorder [s].

    Raises
    ------
    ConfigError
        If a rate is above the step rate, a sensor does not fit the model, or a publishing thread
        is asked for that cannot be.

    """

    def __init__(self, node: Node, simulation: Simulation, settings: dict[str, Any]) -> None:
        self._node = node
        self._states = StateTopics(simulation, settings)
        self.suites = self._states.suites
        self.topics = [
            Topic(state, self._publisher(state), node.resolve_topic_name(state.name))
            for state in self._states.topics
        ]
        sizes = [len(state.template.buffer) for state in self._states.topics]
        publishers = [topic.publisher for topic in self.topics if topic.publisher]
        self.publishing = Publishing(node, publishers, sizes, settings)
        self._compiled = CompiledTick(simulation, self._states, self.publishing.queue)
        self._by_python = [0] * len(self.topics)  # messages that the compiled tick did not send
        self.tap: RecorderPort | None = None
        self.busy_s = self.recording_s = 0.0
        self._clock = next(topic for topic in self.topics if topic.state.type == CLOCK)
        self._active: list[int] = []
        self._records = False
        self._for_display = [
            (place, topic) for place, topic in enumerate(self.topics) if topic.state.for_display
        ]
        self._show_period = 1.0 / settings['markers.rate']
        self._show_due = 0.0
        self._refreshed_at = -math.inf
        self._begun = False  # whether the log has what never changes
        for place, topic in enumerate(self.topics):
            if topic.state.once:
                self._send(place, topic.state.data())
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
        """
        Remove the publishers from the node, when their messages are sent.

        Raises
        ------
        FluidSimError
            If messages were left out at the end.

        """
        try:
            self.publishing.close()
        finally:
            for topic in self.topics:
                if topic.publisher is not None:
                    topic.publisher.destroy()

    def published(self) -> dict[str, int]:
        """Return how many messages went out so far, by the names of the topics."""
        return {
            topic.name: self._compiled.published(place) + self._by_python[place]
            for place, topic in enumerate(self.topics)
        }

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
        recorded = self._once() if not self._begun else []
        recorded += self._tick()
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
        self._tick()

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
        due = [(i, t) for i, t in self._for_display if stands or tick % t.period == 0]
        wanted = [(i, t) for i, t in due if t.publisher and t.publisher.subscription_count()]
        if due:
            self._show_due = max(self._show_due + self._show_period, now)
        if wanted:
            self._states.take_state()
        for place, topic in wanted:
            self._send(place, self._states.data(topic.state))

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
        self.choose(shown)

    def choose(self, shown: Sequence[Topic] = ()) -> None:
        """
        Have what is subscribed to or recorded made from now on.

        Parameters
        ----------
        shown
            Topics for display that somebody looks at.

        """
        active = {
            place: topic for place, topic in enumerate(self.topics)
            if topic.subscribed or (topic.record >= 0 and not topic.state.once)
        }  # fmt: skip
        self._active = list(active)
        self._records = any(topic.record >= 0 for topic in active.values())
        self._compiled.choose(
            self._active,
            [t.publisher.address if t.subscribed and t.publisher else 0 for t in active.values()],
        )
        self.period = math.gcd(
            self._clock.period, *(topic.period for topic in [*active.values(), *shown])
        )

    def restart(self) -> None:
        """Forget what belongs to the time before a reset; a log begins anew."""
        self._states.restart()
        self._begun = False

    def _tick(self) -> list[tuple[int, bytes]]:
        """Publish what is due of the present state; return the messages to record."""
        compiled = self._compiled
        if not compiled.take():
            self.publishing.check()
        if not self._records and self.publishing.queue is not None:
            return []
        recorded = []
        for place in compiled.made():
            topic = self.topics[place]
            if self.publishing.queue is None and topic.subscribed:
                self._send(place, topic.state.template.bytes())
            if topic.record >= 0:
                recorded.append((topic.record, topic.state.template.bytes()))
        return recorded

    def _once(self) -> list[tuple[int, bytes]]:
        """Return the messages that stand at the beginning of a log, once."""
        self._begun = True
        return [(t.record, t.state.data()) for t in self.topics if t.state.once and t.record >= 0]

    def _send(self, place: int, data: bytes) -> None:
        publisher = self.topics[place].publisher
        if publisher is not None and data:
            self.publishing.send(publisher, data)
            self._by_python[place] += 1
