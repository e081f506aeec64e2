# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What exists while the node is configured: simulation, topics and the loop between them."""

import time
from collections.abc import Sequence
from typing import Any

from rclpy.node import Node

from fluid_sim_ros.errors import CommandError, DivergedError, FluidSimError
from fluid_sim_ros.loop.foxglove_port import LivePort
from fluid_sim_ros.loop.request_queue import RequestQueue
from fluid_sim_ros.loop.runner import Runner
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.ros.autopilot import start_autopilots
from fluid_sim_ros.ros.foxglove import start_foxglove
from fluid_sim_ros.ros.health.diagnostics import Diagnostics
from fluid_sim_ros.ros.health.graph_monitor import GraphMonitor
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.ros.outputs import Outputs
from fluid_sim_ros.ros.pacings import Pacings
from fluid_sim_ros.ros.recording import start_recording
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import rounded_duration

_DIAGNOSTICS_PERIOD = 1.0


class Session:
    """
    A configured node's simulation and topics; every method runs in the stepping thread.

    Parameters
    ----------
    node
        Owner of topics.
    settings
        Values of the parameter table; changed in place by ``change``.
    requests
        Work that other threads want done.
    graph
        Monitor of the ROS graph.
    report
        Takes (key, line): a fault to log, at most once per second and key.
    notes
        What the start found that may not be meant, for diagnostics.

    Attributes
    ----------
    diverged, lost
        Why it stands still; why recording stopped or messages were not sent. Or empty.

    Raises
    ------
    FluidSimError
        If the scene or a setting is wrong.

    """

    def __init__(
        self,
        node: Node,
        settings: dict[str, Any],
        requests: RequestQueue,
        graph: GraphMonitor,
        report: ThrottledLog,
        notes: Sequence[str] = (),
    ) -> None:
        self._node = node
        self._settings = settings
        self._report = report
        self.diverged = self.lost = ''
        run = RunSettings.checked(
            "parameter '{}'",
            **{key: settings[key] or None for key in ('timestep', 'integrator', 'fluid')},
            seed=settings['seed'],
        )
        self.simulation = Simulation(settings['scene'], **run.model_dump())
        self._until, rounded = rounded_duration(settings['duration'], self.simulation.timestep)
        if rounded:
            self.simulation.warnings.add(rounded)
        self.inputs = Inputs(node, self.simulation, settings, report)
        self.outputs = Outputs(node, self.simulation, settings)
        self._diagnostics = Diagnostics(
            node, self.simulation, self.inputs, self.outputs, graph, notes
        )
        self.simulation.enable_wind(settings['enable_wind'])
        self._autopilots = start_autopilots(
            self.simulation, settings, self.inputs, report, node.get_logger().info, self.reset
        )
        self._diagnostics.bridges = self._autopilots.bridges
        self._pacings = Pacings(
            self.simulation,
            settings,
            self.inputs,
            self.outputs,
            self._autopilots.exchange,
            report,
        )
        self.runner = Runner(
            self.simulation, self.inputs, [self.outputs, self._diagnostics.watchdogs],
            self._pacings.chosen(), requests, self._housekeeping,
        )  # fmt: skip
        self._diagnosed_at, self.requests = 0.0, requests
        self._live: LivePort | None = None
        try:
            self._live = start_foxglove(node, self, settings)
            self.tap = start_recording(
                node, self.simulation, settings, self.inputs, self.outputs, self._diagnostics
            )
        except FluidSimError:
            self._autopilots.close()
            if self._live is not None:
                self._live.close()
            raise
        if self._live is not None:
            self.runner.sinks.append(self._live)
        self._graph = graph
        graph.connections.watch(entry.subscription for entry in self.inputs.inputs)
        graph.connections.watch(topic.publisher for topic in self.outputs.topics)
        graph.connections.watch([self._diagnostics.publisher])

    def destroy(self) -> None:
        """End the log and remove every topic from the node."""
        self._graph.connections.forget()
        self._autopilots.close()
        if self._live is not None:
            self._live.close()
        if self.tap is not None:
            self.tap.close()
            if self.tap.fault and not self.lost:
                self.lost = self.tap.fault
                self._report('recording', self.lost)
        self.inputs.destroy()
        try:
            self.outputs.destroy()
        except FluidSimError as error:
            self.lost = self.lost or str(error)
            self._report('publishing', self.lost)
        self._diagnostics.destroy()
        self.simulation.close()

    # ---- the loop --------------------------------------------------------------------------

    def run(self) -> bool:
        """Return whether the run's duration is over, after running until stopped or diverged."""
        self.runner.stopped = False
        try:
            self.runner.run(self._until)
        except DivergedError as error:
            self.diverged = str(error)
            self._report('diverged', f'{error}; call ~/reset to go on')
        return self.simulation.tick >= self._until

    def idle(self, requests: RequestQueue) -> None:
        """
        Wait for requests while there is nothing to run, and stay visible.

        Parameters
        ----------
        requests
            Where they arrive.

        """
        requests.idle()
        self._housekeeping()

    def _housekeeping(self) -> None:
        now = time.monotonic()
        self._report.flush()
        if self.tap is not None:
            self.tap.flush()
            if self.tap.fault and not self.lost:
                self.lost = self.tap.fault
                self._report('recording', f'{self.lost}; going on without')
                self._diagnosed_at = 0.0  # this cannot wait for the next turn
        if now - self._diagnosed_at >= _DIAGNOSTICS_PERIOD:
            self._diagnosed_at = now
            self._diagnostics.publish(self.runner, self.diverged)
        runner = self.runner
        stands = bool(runner.paused or runner.stopped or self.diverged)
        self.outputs.show(self.simulation, now, stands)

    # ---- requests --------------------------------------------------------------------------

    def reset(self) -> str:
        """Return what to tell the caller, back at the keyframe at time 0."""
        self.simulation.reset(self._settings['reset.keyframe'] or None)
        self.simulation.enable_wind(self._settings['enable_wind'])
        self.diverged = ''
        self.inputs.forget()
        self.outputs.restart()
        if self.tap is not None:
            self.tap.next_segment()
        if self._live is not None:
            self._live.restart()
        self.runner.restart()
        return self._time()

    def pause(self, paused: bool) -> str:
        """
        Pause or go on.

        Parameters
        ----------
        paused
            Whether to pause.

        Returns
        -------
        str
            Simulated time and step, to tell the caller.

        Raises
        ------
        CommandError
            If the run has diverged.

        """
        self.check_alive()
        self.runner.paused = paused
        return self._time()

    def step(self, steps: int = 0) -> str:
        """
        Return what to tell the caller, after steps while paused; no more than the run has left.

        Parameters
        ----------
        steps
            How many; 0: ``step_count``.

        """
        self.check_alive()
        if not self.runner.paused:
            raise CommandError('not paused; call ~/pause with true first')
        left = self._until - self.simulation.tick
        self.runner.advance_paused(min(steps or self._settings['step_count'], left))
        return self._time()

    def enable_wind(self, enabled: bool) -> str:
        """
        Switch wind and current on or off.

        Parameters
        ----------
        enabled
            Whether they act.

        Returns
        -------
        str
            Simulated time and step, to tell the caller.

        """
        self.change({'enable_wind': enabled})
        return self._time()

    def change(self, values: dict[str, Any]) -> None:
        """
        Take over live parameters; a pacing that cannot be leaves the old one in place.

        Parameters
        ----------
        values
            New value by parameter name.

        Raises
        ------
        FluidSimError
            If a value does not fit the others; nothing is changed then.

        """
        before = dict(self._settings)
        values = {name: value for name, value in values.items() if value != before[name]}
        if not values:
            return
        self._settings.update(values)
        try:
            if values.keys() & {'pacing', 'realtime.factor'}:
                self.runner.pacing = self._pacings.chosen()
                self.runner.pacing.begin(self.simulation)
                self.inputs.forget()
            if values.keys() & {'pacing', 'publish.thread'}:
                self.outputs.publishing.choose()
            if 'enable_wind' in values:
                self.simulation.enable_wind(values['enable_wind'])
            if self.tap is not None:
                self.tap.event(settings=values)
        except FluidSimError:
            self._settings.update(before)
            raise

    def check_alive(self) -> None:
        """Raise CommandError where the run has diverged."""
        if self.diverged:
            raise CommandError(f'{self.diverged}; call ~/reset first')

    def _time(self) -> str:
        return f'time {self.simulation.time:.9f} s, step {self.simulation.step_count}'
