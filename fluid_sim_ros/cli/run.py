"""Runs a scene without ROS: the same simulation and loop as the node, with a progress bar."""

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np
from rich.markup import escape
from rich.progress import Progress
from rich.table import Table

from fluid_sim_ros.cli.flight import AutopilotRun, Flight, counts_line
from fluid_sim_ros.cli.shared import plain_lines, progress_bar
from fluid_sim_ros.cli.signals import stopped_by_signals
from fluid_sim_ros.errors import ConfigError, listed, needed_for
from fluid_sim_ros.loop.pacing import Pacing, RealTime
from fluid_sim_ros.loop.runner import NoSource, Runner, Sink
from fluid_sim_ros.loop.watchdogs import Watchdogs
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import duration_steps

if TYPE_CHECKING:
    from fluid_sim_ros.recording.sink import RecordingSink

#: Simulated time between two looks at the forces [s].
_SAMPLE_PERIOD = 0.01
#: Wall time between two updates of the progress bar [s].
_SHOW_PERIOD = 0.1


class Watcher:
    """
    A sink that keeps the largest fluid force on each vehicle, and shows the progress.

    Parameters
    ----------
    simulation
        What is watched.
    progress
        Where the progress is shown.

    Attributes
    ----------
    period
        Steps between two looks.
    largest, largest_at
        Largest fluid force per vehicle [N] in scene order, and its time [s], shape (n,).

    """

    def __init__(self, simulation: Simulation, progress: Progress) -> None:
        self.period = max(1, round(_SAMPLE_PERIOD / simulation.timestep))
        self.largest = np.zeros(len(simulation.vehicles))
        self.largest_at = np.zeros(len(simulation.vehicles))
        self._progress = progress
        self._shown_at = 0.0

    def write(self, simulation: Simulation) -> None:
        """
        Look at the forces at this step boundary.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        rows = simulation.observe(forces=True)
        force = np.linalg.norm(rows[:, nat.TOTAL][:, :3], axis=1)
        self.largest_at[force > self.largest] = simulation.time
        np.maximum(self.largest, force, out=self.largest)
        now = time.perf_counter()
        if now - self._shown_at > _SHOW_PERIOD:
            self._shown_at = now
            for task in self._progress.task_ids:
                self._progress.update(task, completed=simulation.time)


def run_scene(
    scene: str | Path,
    *,
    duration: float | None = None,
    settings: RunSettings | None = None,
    wind: Sequence[float] | None = None,
    current: Sequence[float] | None = None,
    realtime: bool = False,
    record: str | Path | None = None,
    record_topics: Sequence[str] = ('*',),
    allow_assets_from: Sequence[Path] = (),
    autopilot: AutopilotRun | None = None,
) -> dict[str, Any]:
    """
    Run a scene to its end and return what came out, ready for JSON.

    Parameters
    ----------
    scene
        Name, or path of an MJCF or scene file.
    settings
        Timestep, integrator, fluid and seed; default: the scene's own.
    duration
        Simulated time [s]; default: the scene's, or with an autopilot until it is interrupted.
    wind, current
        Velocity of the medium from the start [m/s], world axes (ENU).
    realtime
        Keep pace with the clock instead of running free.
    record, record_topics
        MCAP file or bag folder to record to, and shell patterns of the topics.
    allow_assets_from
        Folders whose files the log may hold if the model names them; see ``RecorderOptions``.
    autopilot
        Who flies.

    Returns
    -------
    dict
        Settings, real-time factor, and per vehicle the final state and the largest fluid force,
        units in the keys. Forces are looked at every 0.01 s. ``warnings`` are the lines of the
        watchdogs, ``remarks`` how vehicles ended where that is worth a word. ``record_fault`` is
        what ended the recording before the run, such as a full disk, or empty; ``records`` are all
        its files, for a restarted autopilot begins another. ``interrupted`` is the signal that
        ended the run, or empty. ``autopilot`` holds what its bridge counted, and ``fault``, why it
        ended the run, or empty.

    Raises
    ------
    FluidSimError
        Wrong input, or ``DivergedError``.

    """
    simulation = Simulation(scene, **(settings or RunSettings()).model_dump())
    seconds = duration
    if seconds is None and autopilot is None:
        seconds = simulation.scene.duration
    if seconds is not None and not 0 < seconds < float('inf'):
        raise ConfigError(f'duration {seconds:g} s: must be finite and above 0')
    steps = duration_steps(seconds or 0.0, simulation.timestep)
    if wind is not None:
        simulation.set_wind(wind)
    if current is not None:
        simulation.set_current(current)

    pacing = Pacing()
    if realtime:
        pacing = RealTime(tick=max(1, round(_SAMPLE_PERIOD / simulation.timestep)))
    with progress_bar('{task.completed:.1f} s') as progress:
        progress.add_task(simulation.scene.name, total=seconds)
        say = plain_lines(progress.console)
        watcher = Watcher(simulation, progress)
        watchdogs = Watchdogs(simulation, lambda line: say(f'warning: {line}'))
        sinks: list[Sink] = [watcher, watchdogs]
        recording = _recording(simulation, record, record_topics, allow_assets_from, sinks)
        with recording as (files, log):
            begin = time.perf_counter()
            flight = None
            if autopilot is not None:
                flight = Flight(simulation, pacing, autopilot, log, say)
                pacing = flight.pacing
            runner = Runner(simulation, NoSource(), sinks, pacing)
            connected = nullcontext() if flight is None else flight.of(runner)
            with stopped_by_signals(runner.stop) as interruption, connected:
                runner.run(until=steps)
            wall = time.perf_counter() - begin
        remarks = watchdogs.finish()
        for line in remarks:
            say(line)
    result = _summary(simulation, watcher, wall) | files | {
        'remarks': remarks, 'interrupted': interruption.name
    }  # fmt: skip
    return result if flight is None else result | {'autopilot': flight.result}


@contextmanager
def _recording(
    simulation: Simulation,
    path: str | Path | None,
    topics: Sequence[str],
    folders: Sequence[Path],
    sinks: list[Sink],
) -> Iterator[tuple[dict[str, Any], 'RecordingSink | None']]:
    """Add a recording sink where one is asked for; give what the result says of it, and it."""
    if path is None:
        yield {}, None
        return
    with needed_for('--record'):
        from fluid_sim_ros.recording.sink import RecordingSink
    settings = {'fluid': simulation.settings.fluid or ''}
    sink = RecordingSink(simulation, Path(path), settings, topics, folders)
    sinks.append(sink)
    files: dict[str, Any] = {'record': str(sink.recorder.paths[0])}
    try:
        yield files, sink
    finally:
        sink.close()
        files['records'] = [str(path) for path in sink.recorder.paths]
        files['record_fault'] = sink.recorder.fault


def summary_table(result: dict[str, Any]) -> Table:
    """
    Return the table that ``fluid_sim run`` ends with.

    Parameters
    ----------
    result
        Of ``run_scene``.

    """
    caption = '\n'.join([
        'position in the world (ENU), velocity along base_link (FLU)',
        *(
            escape(f'{name}: terms: {listed(vehicle["terms"])}')
            for name, vehicle in result['vehicles'].items()
        ),
    ])  # fmt: skip
    if 'autopilot' in result:
        caption = f'{counts_line(result["autopilot"])}\n{caption}'
    table = Table(
        'vehicle', r'position \[m]', r'velocity \[m/s]', 'largest fluid force',
        title=(
            f'{escape(result["scene"])}: {result["duration_s"]:g} s in {result["wall_s"]:.2f} s, '
            f'real-time factor {result["real_time_factor"]:.4g}'
        ),
        caption=caption,
    )  # fmt: skip
    for name, vehicle in result['vehicles'].items():
        force, at = vehicle['largest_fluid_force_n'], vehicle['largest_fluid_force_at_s']
        table.add_row(
            name,
            _vector(vehicle['position_w_m']),
            _vector(vehicle['velocity_b_m_s']),
            f'{force:.4g} N at {at:.2f} s',
        )
    return table


def _summary(simulation: Simulation, watcher: Watcher, wall: float) -> dict[str, Any]:
    snapshot = simulation.snapshot()
    integrator = mujoco.mjtIntegrator(simulation.model.opt.integrator).name
    vehicles = {
        name: {
            'terms': list(simulation.terms[name]),
            'position_w_m': state.position_w.tolist(),
            'quat_wb_wxyz': state.quat_wb_wxyz.tolist(),
            'velocity_b_m_s': state.velocity_b.tolist(),
            'omega_b_rad_s': state.omega_b.tolist(),
            'largest_fluid_force_n': float(watcher.largest[i]),
            'largest_fluid_force_at_s': float(watcher.largest_at[i]),
        }
        for i, (name, state) in enumerate(snapshot.vehicles.items())
    }
    return {
        'scene': simulation.scene.name,
        'seed': simulation.seed,
        'timestep_s': simulation.timestep,
        'integrator': integrator.removeprefix('mjINT_').lower(),
        'streams': list(simulation.streams),
        'duration_s': snapshot.time,
        'steps': snapshot.step,
        'wall_s': wall,
        'real_time_factor': snapshot.time / wall,
        'warnings': simulation.warnings.lines,
        'vehicles': vehicles,
    }


def _vector(values: Sequence[float]) -> str:
    return ' '.join(f'{value:.3f}' for value in values)
