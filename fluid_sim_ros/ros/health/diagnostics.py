# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the node says of itself on /diagnostics, once per second of wall time."""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node
from rclpy.serialization import serialize_message

from fluid_sim_ros.errors import listed
from fluid_sim_ros.loop.autopilot_port import Bridge
from fluid_sim_ros.loop.energy_watch import energy_period
from fluid_sim_ros.loop.pacing import Lockstep, RealTime
from fluid_sim_ros.loop.recorder_port import RecorderPort
from fluid_sim_ros.loop.runner import Runner
from fluid_sim_ros.loop.watchdogs import Watchdogs
from fluid_sim_ros.messages.topic import STATE
from fluid_sim_ros.physics.reynolds import reynolds_number
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.ros.health.graph_monitor import GraphMonitor
from fluid_sim_ros.ros.health.speed_watch import SpeedWatch
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.ros.outputs import Outputs
from fluid_sim_ros.ros.raw import RawPublisher
from fluid_sim_ros.simulation import Simulation

DIAGNOSTICS = 'diagnostic_msgs/msg/DiagnosticArray'
_OK, _WARN, _ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
_LEVELS = {'ok': _OK, 'warn': _WARN, 'error': _ERROR}
#: MuJoCo warnings that leave the state alone but mean that something was cut short.
_LIMIT_WARNINGS = (
    mujoco.mjtWarning.mjWARN_INERTIA,
    mujoco.mjtWarning.mjWARN_CONTACTFULL,
    mujoco.mjtWarning.mjWARN_CNSTRFULL,
    mujoco.mjtWarning.mjWARN_BADCTRL,
)
#: Missing answers (at 10 Hz of wall time) after which holding counts as an error.
_PATIENT_MISSES = 10


class Diagnostics:
    """
    The /diagnostics publisher of a configured node; used by the stepping thread only.

    Parameters
    ----------
    node
        Owner of the publisher.
    simulation
        What is reported on.
    inputs, outputs
        The command topics and the state topics.
    graph
        What is known of other nodes.
    notes
        What the start found that may not be meant.

    Attributes
    ----------
    tap, bridges
        Recorder (or None) and autopilots, where there are some.
    record
        Place of /diagnostics in the log, or -1.
    publisher
        Of /diagnostics.
    watchdogs
        A sink of the runner; its lines are in the log, too.

    """

    def __init__(
        self,
        node: Node,
        simulation: Simulation,
        inputs: Inputs,
        outputs: Outputs,
        graph: GraphMonitor,
        notes: Sequence[str] = (),
    ) -> None:
        self._node = node
        self._simulation = simulation
        self._inputs = inputs
        self._graph = graph
        self._outputs = outputs
        self._notes = notes
        self.tap: RecorderPort | None = None
        self.bridges: Sequence[Bridge] = ()
        self.record = -1
        self.publisher = RawPublisher(node, DIAGNOSTICS, '/diagnostics', STATE)
        self._speed = SpeedWatch(simulation, inputs, outputs, node.get_logger().warning)
        self._misses = 0
        for name, terms in simulation.terms.items():
            node.get_logger().info(f'{name}: terms: {listed(terms)}')
        self.watchdogs = Watchdogs(
            simulation, node.get_logger().warning, energy_period(simulation.timestep)
        )

    def publish(self, runner: Runner, diverged: str) -> None:
        """
        Publish the present state of everything.

        Parameters
        ----------
        runner
            The loop, for its pacing and whether it is paused.
        diverged
            Why the run ended, or empty.

        """
        self._speed.measure(runner, diverged)
        message = DiagnosticArray()
        stamp, time_ns = message.header.stamp, self._simulation.time_ns
        stamp.sec, stamp.nanosec = divmod(time_ns, 1_000_000_000)
        message.status = [
            self._loop(runner, diverged), self._commands(), self._engine(), self._peers(),
        ]  # fmt: skip
        message.status += [
            self._vehicle(i, name) for i, name in enumerate(self._simulation.vehicles)
        ]
        if self._notes:
            message.status.append(self._status('start', _WARN, '; '.join(self._notes)))
        for bridge in self.bridges:
            status = bridge.status()
            part = 'autopilot' if len(self.bridges) == 1 else f'autopilot {bridge.vehicle}'
            message.status.append(
                self._status(part, _LEVELS[status.level], status.message, **status.values)
            )
        if self.tap is not None:
            message.status.append(self._recording(self.tap))
        data = serialize_message(message)
        self.publisher.publish(data)
        if self.tap is not None and self.record >= 0:
            self.tap.command(self.record, data)

    def destroy(self) -> None:
        """Remove the publisher from the node."""
        self.publisher.destroy()

    def _status(self, part: str, level: Any, message: str, **values: Any) -> DiagnosticStatus:
        return DiagnosticStatus(
            level=level,
            name=f'{self._node.get_name()}: {part}',
            message=message,
            hardware_id=self._simulation.scene.name,
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )

    def _loop(self, runner: Runner, diverged: str) -> DiagnosticStatus:
        pacing = runner.pacing
        values: dict[str, Any] = {
            'time_s': f'{self._simulation.time:.9f}',
            'step': self._simulation.step_count,
            'real_time_factor': f'{max(self._speed.factor, 0.0):.3f}',
            'paused': runner.paused,
            'publishing': self._outputs.publishing.way,
        }
        level, message = _OK, 'paused' if runner.paused else 'running'
        if isinstance(pacing, RealTime):
            values['overruns'] = pacing.overruns
            values |= self._speed.shares
            if self._speed.line:
                level, message = _WARN, self._speed.line
        if isinstance(pacing, Lockstep):
            waiting = self._inputs.awaited()
            values['lockstep_waits_for'] = ', '.join(waiting)
            values['lockstep_misses'] = pacing.misses
            if waiting and pacing.misses - self._misses >= _PATIENT_MISSES // 2:
                level, message = _ERROR, f'no answer on {", ".join(waiting)}'
            self._misses = pacing.misses
        if diverged:
            level, message = _ERROR, diverged
        return self._status('loop', level, message, **values)

    def _commands(self) -> DiagnosticStatus:
        inputs = self._inputs
        values: dict[str, Any] = {}
        for entry in inputs.inputs:
            values[f'{entry.topic} received'] = entry.received
            values[f'{entry.topic} rejected'] = entry.rejected
            if entry.last_error:
                values[f'{entry.topic} last error'] = entry.last_error
        values['saturated values'] = inputs.saturated
        values['ignored answers'] = inputs.ignored_answers
        stale = [name for name, freshness in inputs.stale.freshness.items() if freshness.stale]
        values['times stale'] = sum(f.times_stale for f in inputs.stale.freshness.values())
        if stale:
            return self._status('commands', _WARN, f'stale: {", ".join(stale)}', **values)
        rejected = sum(entry.rejected for entry in inputs.inputs)
        if rejected:
            return self._status('commands', _WARN, f'{rejected} rejected', **values)
        return self._status('commands', _OK, 'fresh', **values)

    def _engine(self) -> DiagnosticStatus:
        warnings = self._simulation.data.warning
        counts = {
            warning.name.removeprefix('mjWARN_').lower(): int(warnings[warning].number)
            for warning in _LIMIT_WARNINGS
        }
        balance = self._simulation.energy_balance()
        # the loop asks them at each boundary; a node that stands still speaks by this alone
        self.watchdogs.write(self._simulation)
        values = {
            'kinetic_energy_J': f'{balance.kinetic:.6g}',
            'integrator_feed_W': f'{balance.feed:.3g}',
            'dissipation_W': f'{balance.dissipation:.3g}',
            'flow_by': self._simulation.flow_source,
            'seed': self._simulation.seed,
            **counts,
        }
        raised = [name for name, count in counts.items() if count]
        message = f'warnings: {", ".join(raised)}' if raised else balance.warning
        notes = [note for note in (message, *self._simulation.warnings.lines) if note]
        if notes:
            return self._status('engine', _WARN, '; '.join(notes), **values)
        return self._status('engine', _OK, 'no warnings', **values)

    def _peers(self) -> DiagnosticStatus:
        faults, mismatches = self._graph.faults, self._graph.connections.mismatches
        level = _ERROR if faults else _WARN if mismatches else _OK
        return self._status('graph', level, '; '.join((*faults, *mismatches)) or 'alone')

    def _recording(self, tap: RecorderPort) -> DiagnosticStatus:
        values = {
            'file': tap.paths[-1], 'messages': tap.written, 'left out (disk too slow)': tap.dropped
        }  # fmt: skip
        if tap.fault:
            return self._status('recording', _ERROR, tap.fault, **values)
        if tap.dropped:
            return self._status('recording', _WARN, f'{tap.dropped} states left out', **values)
        return self._status('recording', _OK, 'recording', **values)

    def _vehicle(self, index: int, name: str) -> DiagnosticStatus:
        simulation = self._simulation
        row = simulation.observe(forces=False)[index]
        quat_bw = np.empty(4)
        mujoco.mju_negQuat(quat_bw, row[nat.QUATERNION])
        medium_b = np.empty(3)
        mujoco.mju_rotVecQuat(medium_b, row[nat.MEDIUM_VELOCITY], quat_bw)
        speed = float(np.linalg.norm(row[nat.LINEAR_VELOCITY] - medium_b))
        option = simulation.model.opt
        reynolds = float('nan')
        if option.density > 0 and option.viscosity > 0:
            length = self._length(simulation.vehicles[name].body_id)
            reynolds = float(reynolds_number(speed, length, option.density, option.viscosity))
        beyond = {
            s.config.kind: s.saturated for s in self._outputs.suites[name].sensors if s.saturated
        }
        return self._status(
            f'vehicle {name}', _OK, 'moving' if speed else 'at rest',
            terms=listed(simulation.terms[name]),
            speed_through_medium_m_s=f'{speed:.4f}', reynolds_number=f'{reynolds:.4g}',
            sensor_values_beyond_range=listed(f'{kind} {n}' for kind, n in beyond.items()),
        )  # fmt: skip

    def _length(self, body: int) -> float:
        """Return the largest extent of a body's geoms [m], the length of its Reynolds number."""
        model = self._simulation.model
        start, count = model.body_geomadr[body], model.body_geomnum[body]
        return 2 * max((float(model.geom_rbound[start + i]) for i in range(count)), default=0.0)
