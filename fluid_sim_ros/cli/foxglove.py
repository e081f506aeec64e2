# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim run --foxglove``: what a live viewer may do to a run."""

import struct
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import mujoco

from fluid_sim_ros.errors import CommandError, ConfigError
from fluid_sim_ros.loop.foxglove_port import LiveControl, LivePort, open_foxglove
from fluid_sim_ros.loop.pacing import RealTime
from fluid_sim_ros.loop.runner import Runner
from fluid_sim_ros.messages.commands import TWIST
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.actuation import finite

#: A viewer's wish that is not granted within this time is given up [s].
_PATIENCE = 5.0


class LiveRun:
    """
    Connects a run with live viewers.

    Parameters
    ----------
    simulation
        What is run.
    port
        To listen on.
    log
        Gets every command, too; or None.
    may_not_reset
        Empty, or why a viewer may not put the run back.
    settings
        Of the run, that change the topics.

    Attributes
    ----------
    sink
        For the runner.
    runner
        Set it before it runs.

    """

    def __init__(
        self,
        simulation: Simulation,
        port: int,
        log: Any = None,
        may_not_reset: str = '',
        settings: Mapping[str, Any] | None = None,
    ) -> None:
        self._simulation, self._log, self._may_not_reset = simulation, log, may_not_reset
        self.runner: Runner | None = None
        control = LiveControl(
            self._act, self._parameters, self._change, ('realtime.factor', *simulation.streams)
        )
        self.sink: LivePort = open_foxglove(simulation, settings or {}, port, control)

    def command(self, name: str, data: bytes) -> None:
        """
        Hand a command message on to the log and to the viewers, before it is applied.

        Parameters
        ----------
        name
            Relative topic name.
        data
            CDR bytes.

        """
        if self._log is not None:
            self._log.command(name, data)
        self.sink.command(name, data)

    def event(self, **change: Any) -> None:
        """
        Hand a change that no message made on to the log.

        Parameters
        ----------
        **change
            Its fields, which JSON can hold.

        """
        if self._log is not None:
            self._log.event(**change)

    def _call(self, work: Callable[[Runner], str]) -> str:
        runner = self.runner
        if runner is None:
            raise CommandError('the run has not begun')
        return runner.requests.call(lambda: work(runner), _PATIENCE)

    def _act(self, name: str, value: bool) -> str:
        return self._call({'reset': self._reset, 'step': self._step}.get(
            name, lambda runner: self._pause(runner, value)
        ))  # fmt: skip

    def _reset(self, runner: Runner) -> str:
        if self._may_not_reset:
            raise CommandError(self._may_not_reset)
        self._simulation.reset()
        if self._log is not None:
            self._log.next_segment()
        self.sink.restart()
        runner.restart()
        return self._time()

    def _pause(self, runner: Runner, paused: bool) -> str:
        runner.paused = paused
        return self._time()

    def _step(self, runner: Runner) -> str:
        if not runner.paused:
            raise CommandError('not paused; call pause with true first')
        runner.advance_paused(1)
        return self._time()

    def _time(self) -> str:
        return f'time {self._simulation.time:.9f} s, step {self._simulation.step_count}'

    def _parameters(self) -> dict[str, Any]:
        simulation, runner = self._simulation, self.runner
        pacing = None if runner is None else runner.pacing
        saved = simulation.save_state().streams
        flows = {'wind': saved.wind_w.tolist(), 'current': saved.current_w.tolist()}
        integrator = mujoco.mjtIntegrator(simulation.model.opt.integrator).name
        return {
            'scene': simulation.scene.name,
            'seed': simulation.seed,
            'timestep': simulation.timestep,
            'integrator': integrator.removeprefix('mjINT_').lower(),
            'fluid': simulation.settings.fluid or '',
            'realtime.factor': float(pacing.factor) if isinstance(pacing, RealTime) else 0.0,
            **{name: flows[name] for name in simulation.streams},
        }

    def _change(self, values: Mapping[str, Any]) -> None:
        def work(runner: Runner) -> str:
            for name, value in values.items():
                if name == 'realtime.factor':
                    self._set_pace(runner, float(value))
                else:
                    self._set_flow(name, value)
            return ''

        self._call(work)

    @staticmethod
    def _set_pace(runner: Runner, factor: float) -> None:
        if not isinstance(runner.pacing, RealTime):
            raise ConfigError('realtime.factor: the run is not in real time')
        runner.pacing = RealTime(factor=factor, tick=runner.pacing.tick)
        runner.pacing.begin(runner.simulation)

    def _set_flow(self, name: str, value: Sequence[float]) -> None:
        setter = {'wind': self._simulation.set_wind, 'current': self._simulation.set_current}
        velocity = finite(name, value, 3)
        template = Template.of(TWIST, {'header.frame_id': 'map'}, ['twist.linear'])
        struct.pack_into('<3d', template.blocks[0], 0, *velocity)
        self.command(name, template.bytes())
        setter[name](velocity)


@contextmanager
def served(
    simulation: Simulation,
    port: int | None,
    log: Any,
    flown: bool,
    say: Callable[[str], None],
) -> Iterator[LiveRun | None]:
    """
    Serve viewers in this block.

    Parameters
    ----------
    simulation
        What is run.
    port
        To listen on; None: there are no viewers.
    log
        Gets every command, too; or None.
    flown
        Whether an autopilot flies it, whose time must not go back.
    say
        Takes the line with the address.

    Returns
    -------
    context manager
        Gives the connection, or None.

    """
    if port is None:
        yield None
        return
    settings = {'fluid': simulation.settings.fluid or ''}
    refusal = 'an autopilot flies it: its time cannot go back' if flown else ''
    live = LiveRun(simulation, port, log, refusal, settings)
    say(f'Foxglove, Lichtblick: open the connection ws://127.0.0.1:{live.sink.port}')
    try:
        yield live
    finally:
        live.sink.close()
