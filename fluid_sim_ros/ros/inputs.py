# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node's command topics: taken by the stepping thread itself, checked, applied, counted."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rclpy.node import Node

from fluid_sim_ros.errors import ConfigError, FluidSimError, listed
from fluid_sim_ros.loop.recorder_port import RecorderPort
from fluid_sim_ros.messages.commands import Commands, CommandTopic, Effect
from fluid_sim_ros.messages.topic import NEWEST
from fluid_sim_ros.ros.health.stale_commands import StaleCommands
from fluid_sim_ros.ros.raw import PolledSubscription, WaitSet
from fluid_sim_ros.simulation import Simulation

#: Topics of which every message counts in lockstep by count.
_COUNTED = ('/cmd/thrust', '/cmd/joints')
#: Wall time between two looks at which topics have publishers [s].
REFRESH_PERIOD = 0.1


@dataclass
class Input:
    """One command topic and what became of its messages."""

    topic: str
    subscription: PolledSubscription
    command: CommandTopic
    record: int = -1
    required: bool = False
    optional: bool = False
    received: int = 0
    rejected: int = 0
    last_error: str = ''


class Inputs:
    """
    Every command topic of a node, as a source for the runner.

    ``poll`` takes what has arrived; ``wait`` blocks until the awaited topics have answered the
    present state. Both run in the stepping thread.

    Parameters
    ----------
    node
        Owner of the subscriptions.
    simulation
        What is commanded.
    settings
        Values of the node's parameters; ``pacing`` and ``command_timeout`` may change.
    report
        Takes (key, line): a fault to log.

    Attributes
    ----------
    inputs
        The topics, and what became of their messages.
    stale
        Age of each vehicle's thrust command.
    saturated, ignored_answers
        Values beyond their range, and answers to states of the past, so far.
    busy_s
        Wall time spent in ``poll`` so far [s].
    tap
        The recorder, or None.

    Raises
    ------
    ConfigError
        If ``lockstep.wait_for`` names no command topic, or the thrust unit does not fit a vehicle.

    """

    def __init__(
        self,
        node: Node,
        simulation: Simulation,
        settings: dict[str, Any],
        report: Callable[[str, str], None],
    ) -> None:
        self._node = node
        self._report = report
        self._by_count = settings['lockstep.match'] == 'count'
        self.tap: RecorderPort | None = None
        self.saturated = 0
        self.busy_s = 0.0
        self.ignored_answers = 0
        self.stale = StaleCommands(simulation, settings, report)
        self.inputs: list[Input] = []
        for topic in Commands(simulation, settings).topics:
            self.add(topic)
        self._choose_awaited(simulation, settings['lockstep.wait_for'])
        self._wait_set = WaitSet(node)
        self._missing: list[Input] = []
        self._missing_step = -1
        self._refreshed_at = 0.0
        self._active: list[Input] = []
        self._refresh()

    # ---- topics ----------------------------------------------------------------------------

    def add(self, topic: CommandTopic) -> None:
        """
        Take commands on one more topic.

        Parameters
        ----------
        topic
            Its name, message type and effect.

        """
        keep_all = self._by_count and topic.name.endswith(_COUNTED)
        subscription = PolledSubscription(self._node, topic.type, topic.name, NEWEST, keep_all)
        self.inputs.append(Input(topic.name, subscription, topic))

    def _choose_awaited(self, simulation: Simulation, wait_for: Sequence[str]) -> None:
        wanted = [topic for topic in wait_for if topic]
        if not wanted:
            leaf = 'thrust' if self._by_count else 'thrust_stamped'
            for vehicle in simulation.vehicles.values():
                if vehicle.thrusters:
                    wanted.append(f'{vehicle.name}/cmd/{leaf}')
                    wanted += [f'{vehicle.name}/cmd/joints'] if vehicle.joints else []
        by_topic = {entry.topic: entry for entry in self.inputs}
        for topic in wanted:
            entry = by_topic.get(topic.removesuffix('?'))
            if entry is None:
                raise ConfigError(
                    f"parameter 'lockstep.wait_for': '{topic}' is no command topic of this scene; "
                    f'it has: {listed(by_topic)}'
                )
            entry.required = True
            entry.optional = topic.endswith('?')

    def check_awaited(self) -> None:
        """
        Check that lockstep has something to wait for.

        Raises
        ------
        ConfigError
            If no vehicle has thrusters and ``lockstep.wait_for`` is empty.

        """
        if not any(entry.required for entry in self.inputs):
            raise ConfigError(
                "parameter 'pacing': lockstep needs a topic to wait for, and no vehicle of the "
                "scene has thrusters; set 'lockstep.wait_for' or another pacing"
            )

    def destroy(self) -> None:
        """Remove the subscriptions from the node."""
        for entry in self.inputs:
            entry.subscription.destroy()
        self._wait_set.destroy()

    # ---- the runner's source ---------------------------------------------------------------

    def poll(self, simulation: Simulation) -> None:
        """
        Apply what has arrived; topics without a publisher are looked at ten times a second.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        begin = time.monotonic()
        for entry in self.inputs if self._refresh_when_due(begin) else self._active:
            self._drain(simulation, entry)
        self._expire()
        self.busy_s += time.monotonic() - begin

    def wait(self, simulation: Simulation, timeout: float) -> bool:
        """
        Block until every awaited topic has answered this step.

        Parameters
        ----------
        simulation
            At a step boundary.
        timeout
            Longest wait [s], wall time.

        Returns
        -------
        bool
            Whether all have answered; False on timeout or a wake-up.

        """
        if self._missing_step != simulation.step_count:
            self._missing_step = simulation.step_count
            self._missing = [
                e for e in self.inputs
                if e.required and (not e.optional or e.subscription.publisher_count())
            ]  # fmt: skip
        deadline = time.monotonic() + timeout
        self.poll_unawaited(simulation)
        while True:
            self._missing = [e for e in self._missing if not self._answered(simulation, e)]
            if not self._missing:
                self._expire()
                return True
            left = deadline - time.monotonic()
            if left <= 0 or self._wait_set.wait([e.subscription for e in self._missing], left):
                return False

    def wake(self) -> None:
        """End a ``wait`` from another thread."""
        self._wait_set.wake()

    def poll_unawaited(self, simulation: Simulation) -> None:
        """
        Apply what has arrived on topics that the lockstep does not wait for.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        self._refresh_when_due(time.monotonic())
        for entry in self._active:
            if not entry.required:
                self._drain(simulation, entry)

    def awaited(self) -> list[str]:
        """Return the topics whose answer is missing now."""
        return [entry.topic for entry in self._missing]

    def _refresh_when_due(self, now: float) -> bool:
        if now - self._refreshed_at <= REFRESH_PERIOD:
            return False
        self._refreshed_at = now
        self._refresh()
        return True

    def _refresh(self) -> None:
        self._active = [e for e in self.inputs if e.subscription.publisher_count()]

    def _drain(self, simulation: Simulation, entry: Input) -> None:
        while (data := entry.subscription.take()) is not None:
            self._offer(simulation, entry, data)

    def _answered(self, simulation: Simulation, entry: Input) -> bool:
        """Take one topic's messages until one of them answers the present state."""
        while (data := entry.subscription.take()) is not None:
            if self._offer(simulation, entry, data):
                return True
        return False

    def _offer(self, simulation: Simulation, entry: Input, data: bytes) -> bool:
        """Apply one message; a fault is counted and reported. True when it answers this step."""
        entry.received += 1
        if self.tap is not None and entry.record >= 0:
            self.tap.command(entry.record, data)
        try:
            effect = entry.command.apply(data)
        except FluidSimError as error:
            entry.rejected += 1
            entry.last_error = str(error)
            self._report(entry.topic, f'{entry.topic}: rejected: {error}')
            return False
        self._note(simulation, entry.command.thrust, effect)
        return effect.answers

    def _note(self, simulation: Simulation, vehicle: str, effect: Effect) -> None:
        """Count what became of a command; ``vehicle`` is the one whose thrust it was, or empty."""
        if not effect.applied:
            self.ignored_answers += 1
            return
        if effect.saturated:
            self.saturated += effect.saturated
            if vehicle:
                count = len(simulation.vehicles[vehicle].thrusters)
                self._report(
                    f'{vehicle} saturated',
                    f"thrust of '{vehicle}': {effect.saturated} of {count} values saturated",
                )
        if effect.shortfall:
            self.saturated += 1
            self._report(f'{vehicle} allocated', effect.shortfall)
        if vehicle:
            self.stale.commanded(vehicle)

    def _expire(self) -> None:
        for vehicle in self.stale.expire():
            if self.tap is not None:
                self.tap.event(stale=vehicle)

    def forget(self) -> None:
        """Start anew after a reset: nothing is stale before the first command."""
        self.stale.forget()
        self._missing_step = -1
