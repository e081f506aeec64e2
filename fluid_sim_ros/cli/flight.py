# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A run without ROS that autopilots fly: bridges, programs, reports, log."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli.home import turn_to
from fluid_sim_ros.errors import AutopilotError
from fluid_sim_ros.loop.autopilot_fleet import open_bridges
from fluid_sim_ros.loop.autopilot_pacing import AutopilotPacing
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Bridge, Surroundings
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.loop.shared_lockstep import joined
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER

if TYPE_CHECKING:
    from fluid_sim_ros.mavlink.program.program import Program
    from fluid_sim_ros.recording.sink import RecordingSink

#: Of the bridge's numbers, those that a summary names, in its order.
_COUNTS = ('missed', 'late', 'repeated', 'malformed', 'restarts')


@dataclass(frozen=True)
class AutopilotRun:
    """
    Which autopilot flies.

    Attributes
    ----------
    options
        What its bridge needs to know.
    program
        Command that starts its program; empty: the user does.
    home
        Latitude and longitude [deg], altitude [m] and heading [deg] of the start; empty: the
        scene's, and as it begins.

    """

    options: AutopilotOptions
    program: str = ''
    home: Sequence[float] = ()


class Flight:
    """
    Connects a runner with one autopilot, or with one for each of several vehicles.

    Parameters
    ----------
    simulation, clock
        What is flown, and how fast at most.
    runs
        By whom.
    log
        Takes the commands, and begins a new segment when the vehicle is put back; or None.
    say
        Shows a line to the user; called in any thread.

    Attributes
    ----------
    fault
        Why an autopilot ended the run, or empty.
    results
        By vehicle what its bridge counted, the fault, and how a program that was started ended by
        itself (``exit_code``; None: it did not), ready for JSON; empty before the end.

    """

    def __init__(
        self,
        simulation: Simulation,
        clock: Pacing,
        runs: Sequence[AutopilotRun],
        log: 'RecordingSink | None',
        say: Callable[[str], None],
    ) -> None:
        self._simulation, self._runs, self._log, self._say = simulation, runs, log, say
        self._report = ThrottledLog(say)
        self._runner: Runner | None = None
        self.fault = ''
        self._exit_codes: dict[str, int] = {}
        self.results: dict[str, dict[str, Any]] = {}
        surroundings = Surroundings(self._report, say, self._reset, log)
        options = [run.options for run in runs]
        self.bridges = open_bridges(simulation, options, surroundings)
        self.pacing = AutopilotPacing(joined(self.bridges, simulation, log), clock)
        for bridge in self.bridges:
            say(self._of(bridge, bridge.status().message))

    @contextmanager
    def of(self, runner: Runner) -> Iterator[None]:
        """
        Fly the runner in this block; end the program and close the socket behind it.

        An autopilot that dies or falls silent for good ends the block; ``fault`` then says so.

        Parameters
        ----------
        runner
            Whose pacing is the flight's.

        Returns
        -------
        context manager
            In which the runner is run.

        Raises
        ------
        ConfigError
            If the program cannot be started.

        """
        self._runner = runner
        before = runner.housekeeping

        def tell() -> None:
            before()
            self._report.flush()

        runner.housekeeping = tell
        with ExitStack() as stack:
            for bridge in self.bridges:
                stack.callback(bridge.close)
            for run, bridge in zip(self._runs, self.bridges, strict=True):
                if run.program:
                    self._start(run, bridge, runner, stack)
            try:
                yield
            except AutopilotError as error:
                self.fault = str(error)
            self.results = {bridge.vehicle: self._result(bridge) for bridge in self.bridges}
        for line in counts_lines(self.results):
            self._say(line)

    def _of(self, bridge: Bridge, line: str) -> str:
        """Return a line that names the vehicle where there are several autopilots."""
        return line if len(self.bridges) == 1 else f'{bridge.vehicle}: {line}'

    def _start(self, run: AutopilotRun, bridge: Bridge, runner: Runner, stack: ExitStack) -> None:
        from fluid_sim_ros.mavlink.mapping import load_mapping
        from fluid_sim_ros.mavlink.program.command_line import HEADING_EAST
        from fluid_sim_ros.mavlink.program.parameters import needed_parameters, parameters_line
        from fluid_sim_ros.mavlink.program.program import Program

        options, home = run.options, self._simulation.scene.home
        kind = self._simulation.vehicle(bridge.vehicle).kind
        file, _ = load_mapping(options.protocol, kind, options.mapping)
        parameters = needed_parameters(file, options.parameters)
        if parameters:
            given = f'parameters given to the program: {parameters_line(parameters)}'
            self._say(self._of(bridge, given))
        heading = run.home[3] if run.home else HEADING_EAST
        place = (home.latitude, home.longitude, home.altitude, heading)
        program = Program(
            run.program, options, file, place, parameters,
            lambda line: self._say(self._of(bridge, line)),
        )  # fmt: skip
        stack.callback(program.close)
        before = runner.housekeeping

        def look_after() -> None:
            before()
            self._end_with(program, bridge)

        runner.housekeeping = look_after

    def _reset(self) -> None:
        self._simulation.reset()
        if home := self._runs[0].home:
            turn_to(self._simulation, home[3])
        if self._log is not None:
            self._log.next_segment()
        if self._runner is not None:
            self._runner.restart()

    def _end_with(self, program: 'Program', bridge: Bridge) -> None:
        """End the run with its program; only one that has flown may end in order."""
        code = program.exit_code
        if code is None or self._runner is None:
            return
        from fluid_sim_ros.mavlink.program.program import ending

        program.wait_for_output()
        self._exit_codes[bridge.vehicle] = code
        answered = bridge.status().values['answered']
        line = f'the autopilot {ending(code)}'
        if answered and code == 0:
            self._say(self._of(bridge, line))
        else:
            line = line if answered else f'{line} before it answered'
            self.fault = self.fault or self._of(bridge, line)
        self._runner.stop()

    def _result(self, bridge: Bridge) -> dict[str, Any]:
        status = bridge.status()
        return {
            'vehicle': bridge.vehicle, 'state': f'{status.level}: {status.message}',
            **status.values, 'exit_code': self._exit_codes.get(bridge.vehicle),
            'fault': self.fault,
        }  # fmt: skip


def counts_lines(results: Mapping[str, dict[str, Any]]) -> list[str]:
    """
    Return how the exchanges with all autopilots went, a line for each.

    Parameters
    ----------
    results
        As of ``Flight``; where there are several, each line begins with the vehicle.

    """
    lines = {name: counts_line(result) for name, result in results.items()}
    return [line if len(lines) == 1 else f'{name}: {line}' for name, line in lines.items()]


def counts_line(result: dict[str, Any]) -> str:
    """
    Return in one line how the exchanges with an autopilot went.

    Parameters
    ----------
    result
        Of one vehicle, as of ``Flight``.

    Returns
    -------
    str
        Such as ``px4: 750 of 765 states were answered; missed 0, late 0, ...``.

    """
    counts = ', '.join(f'{name} {result[name]}' for name in _COUNTS)
    answered = f'{result["answered"]} of {result["sent"]} states were answered'
    return f'{result["protocol"]}: {answered}; {counts}'


def listen_to_autopilot(run: AutopilotRun, scene: str, seconds: float) -> dict[str, Any]:
    """
    Listen for an autopilot for a while and return what was seen of it.

    Parameters
    ----------
    run
        Which one.
    scene
        What it flies meanwhile.
    seconds
        Wall time.

    Returns
    -------
    dict
        Status and numbers of the bridge, ready for JSON. ``fault`` is empty where it answered,
        and ``reasons`` are what may be wrong where it did not.

    Raises
    ------
    FluidSimError
        If the port is in use, or an option is wrong.

    """
    lines: list[str] = []
    simulation = Simulation(scene)
    flight = Flight(simulation, Pacing(), [run], None, lines.append)
    end = time.monotonic() + seconds

    def stop_in_time() -> None:
        if time.monotonic() >= end:
            runner.stop()

    runner = Runner(simulation, NoSource(), [], flight.pacing, housekeeping=stop_in_time)
    with flight.of(runner):
        runner.run(NEVER)
    (seen,), (bridge,) = flight.results.values(), flight.bridges
    seen |= {'simulated_s': simulation.time, 'reasons': [], 'reports': lines}
    if not seen['answered']:
        seen['fault'] = seen['fault'] or f'nothing was heard within {seconds:g} s'
        seen['reasons'] = bridge.reasons()
    return seen
