"""A run without ROS that an autopilot flies: bridge, program, reports, log."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.loop.autopilot_pacing import AutopilotPacing
from fluid_sim_ros.loop.autopilot_port import (
    AutopilotOptions,
    Surroundings,
    open_bridge,
)
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER

if TYPE_CHECKING:
    from fluid_sim_ros.recording.sink import RecordingSink

#: Wall time between two lines about the same thing [s].
_LINE_PERIOD = 1.0


@dataclass(frozen=True)
class AutopilotRun:
    """Which autopilot flies, and the command that starts its program (empty: the user does)."""

    options: AutopilotOptions
    program: str = ''


class Flight:
    """
    Connects a runner with an autopilot.

    Parameters
    ----------
    simulation, clock
        What is flown, and how fast at most.
    run
        By whom.
    log
        Takes the commands, and begins a new segment when the vehicle is put back; or None.
    say
        Shows a line to the user; called in any thread.

    """

    def __init__(
        self,
        simulation: Simulation,
        clock: Pacing,
        run: AutopilotRun,
        log: 'RecordingSink | None',
        say: Callable[[str], None],
    ) -> None:
        self._simulation, self._log, self._say = simulation, log, say
        self._said_at: dict[str, float] = {}
        self._runner: Runner | None = None
        surroundings = Surroundings(self._report, self._reset, log)
        self.bridge = open_bridge(simulation, run.options, surroundings)
        self.pacing = AutopilotPacing(self.bridge, clock)
        say(self.bridge.status().message)

    @contextmanager
    def of(self, runner: Runner, run: AutopilotRun) -> Iterator[None]:
        """
        Fly the runner in this block; end the program and close the socket behind it.

        Parameters
        ----------
        runner
            Steps the simulation with this flight's pacing.
        run
            By whom.

        Returns
        -------
        context manager
            In which the runner is run.

        """
        self._runner = runner
        with ExitStack() as stack:
            stack.callback(self.bridge.close)
            if run.program:
                from fluid_sim_ros.mavlink.mapping import load_mapping
                from fluid_sim_ros.mavlink.program.program import Program

                options, home = run.options, self._simulation.scene.home
                file, _ = load_mapping(options.protocol, self.bridge.vehicle, options.mapping)
                program = Program(run.program, options, file, home, self._say)
                stack.callback(program.close)
                runner.housekeeping = partial(self._end_with, program)
            yield
        status = self.bridge.status()
        self._say(f'{status.values["answered"]} of {status.values["sent"]} states were answered')

    def _reset(self) -> None:
        self._simulation.reset()
        if self._log is not None:
            self._log.next_segment()
        if self._runner is not None:
            self._runner.restart()

    def _end_with(self, program: Any) -> None:
        if program.exit_code is not None and self._runner is not None:
            self._say(f'the autopilot has ended with code {program.exit_code}')
            self._runner.stop()

    def _report(self, key: str, line: str) -> None:
        now = time.monotonic()
        if now - self._said_at.get(key, -_LINE_PERIOD) >= _LINE_PERIOD:
            self._said_at[key] = now
            self._say(line)


def listen_to_autopilot(run: AutopilotRun, scene: str, seconds: float) -> dict[str, Any]:
    """
    Listen for an autopilot for a while and return what was seen of it.

    Parameters
    ----------
    run
        Who is listened for.
    scene
        Name or file.
    seconds
        Wall time to listen [s].

    Returns
    -------
    dict
        State of the bridge, its counters, simulated time [s] and the lines of its reports.

    Raises
    ------
    FluidSimError
        If the port is in use, or an option is wrong.

    """
    lines: list[str] = []
    simulation = Simulation(scene)
    flight = Flight(simulation, Pacing(), run, None, lines.append)
    runner = Runner(simulation, NoSource(), [], flight.pacing)
    end = time.monotonic() + seconds

    def stop_in_time() -> None:
        if time.monotonic() >= end:
            runner.stop()

    with flight.of(runner, run):
        runner.housekeeping = stop_in_time
        runner.run(NEVER)
        status = flight.bridge.status()
    state = f'{status.level}: {status.message}'
    return {'state': state, **status.values, 'simulated_s': simulation.time, 'reports': lines}
