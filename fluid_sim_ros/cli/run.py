# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs a scene without ROS: the same simulation and loop as the node, with a progress bar."""

import time
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mujoco
from rich.markup import escape
from rich.table import Table

from fluid_sim_ros.cli.flight import AutopilotRun, Flight, counts_lines
from fluid_sim_ros.cli.foxglove import served
from fluid_sim_ros.cli.home import scene_at, turn_to
from fluid_sim_ros.cli.recorded import recorded, watch
from fluid_sim_ros.cli.shared import plain_lines
from fluid_sim_ros.cli.tables import table_of
from fluid_sim_ros.cli.watcher import SAMPLE_PERIOD, Watcher
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.interruption import stopped_by_signals
from fluid_sim_ros.loop.hold import Hold
from fluid_sim_ros.loop.pacing import KEPT_PACE, Pacing, RealTime
from fluid_sim_ros.loop.runner import NoSource, Runner, Sink
from fluid_sim_ros.loop.watchdogs import Watchdogs
from fluid_sim_ros.output.progress import progress_bar, status_line
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import rounded_duration

if TYPE_CHECKING:
    from fluid_sim_ros.recording.sink import RecordingSink

#: Wall time from which on the pace of a run is judged [s].
_SHORTEST = 0.5
#: A fluid force below it is rounding, and shown as none [N].
_LEAST_FORCE = 1e-12


def run_scene(
    scene: str | Path | Scene,
    *,
    duration: float | None = None,
    keyframe: str | None = None,
    settings: RunSettings | None = None,
    wind: Sequence[float] | None = None,
    current: Sequence[float] | None = None,
    realtime: bool = False,
    hold: bool = False,
    record: str | Path | None = None,
    record_topics: Sequence[str] = ('*',),
    allow_assets_from: Sequence[Path] = (),
    autopilot: AutopilotRun | Sequence[AutopilotRun] = (),
    foxglove: int | None = None,
) -> dict[str, Any]:
    """
    Run a scene to its end and return what came out, ready for JSON.

    Parameters
    ----------
    scene
        Name, path of an MJCF or scene file, or a scene.
    settings
        Timestep, integrator, fluid and seed; default: the scene's own.
    duration
        Simulated time [s]; default: the scene's, or with an autopilot until it is interrupted.
    keyframe
        Of the model, to start at; default: the scene's.
    wind, current
        Velocity of the medium from the start [m/s], world axes (ENU).
    hold
        Have every vehicle with thrusters held where it begins; see ``loop.hold``.
    realtime
        Keep pace with the clock instead of running free.
    record, record_topics
        MCAP file or bag folder to record to, and shell patterns of the topics.
    allow_assets_from
        Folders whose files the log may hold if the model names them; see ``RecorderOptions``.
    autopilot
        Who flies; several, each a vehicle of its own, share one lockstep and ``home``.
    foxglove
        Port for live viewers; None: there are none.

    Returns
    -------
    dict
        Settings, real-time factor, and per vehicle the final state and the largest fluid force,
        units in the keys. Forces are looked at every 0.01 s. ``warnings`` are the lines of the
        watchdogs, ``remarks`` how vehicles ended where that is worth a word. ``record_fault`` is
        what ended the recording before the run, such as a full disk, or empty; ``records`` are all
        its files, for a restarted autopilot begins another. ``interrupted`` is the signal that
        ended the run, or empty. ``autopilot`` holds what its bridge counted, and ``fault``, why it
        ended the run, or empty; with several autopilots ``autopilots`` holds that by vehicle.

    Raises
    ------
    FluidSimError
        Wrong input, or ``DivergedError``.

    """
    autopilots = [autopilot] if isinstance(autopilot, AutopilotRun) else list(autopilot)
    stated = Scene.load(scene)
    if keyframe is not None:
        stated = replace(stated, keyframe=keyframe)
    home = autopilots[0].home if autopilots else ()
    if home:
        stated = scene_at(stated, home)
    simulation = Simulation(stated, **(settings or RunSettings()).model_dump())
    if home:
        turn_to(simulation, home[3])
    seconds = duration
    if seconds is None and not autopilots:
        seconds = simulation.scene.duration
    if seconds is not None and not 0 < seconds < float('inf'):
        raise ConfigError(f'duration {seconds:g} s: must be finite and above 0')
    steps, rounded = rounded_duration(seconds or 0.0, simulation.timestep)
    if rounded:
        simulation.warnings.add(rounded)
    if wind is not None:
        simulation.set_wind(wind)
    if current is not None:
        simulation.set_current(current)

    pacing = Pacing()
    if realtime:
        pacing = RealTime(tick=max(1, round(SAMPLE_PERIOD / simulation.timestep)))
    live = realtime or bool(autopilots)
    with status_line() if live else progress_bar('{task.completed:.1f} s') as progress:
        progress.add_task(simulation.scene.name, total=seconds)
        say = plain_lines(progress.console)
        watcher = Watcher(simulation, progress, live)
        sinks: list[Sink] = [watcher]
        recording = recorded(simulation, record, record_topics, allow_assets_from, sinks)
        # from the making of the log to its end: a signal ends the flight, and nothing else
        with stopped_by_signals() as interruption, recording as (files, log):
            watchdogs = Watchdogs(simulation, lambda line: _warn(line, say, log))
            sinks.append(watchdogs)
            begin = time.perf_counter()
            flight = None
            if autopilots:
                flight = Flight(simulation, pacing, autopilots, log, say)
                pacing = flight.pacing
            viewers = served(simulation, foxglove, log, bool(autopilots), say)
            with viewers as viewed:
                if viewed is not None:
                    sinks.append(viewed.sink)
                if hold:
                    sinks.append(Hold(simulation, log if viewed is None else viewed))
                looked = watch(log, say)
                runner = Runner(simulation, NoSource(), sinks, pacing, housekeeping=looked)
                if viewed is not None:
                    viewed.runner = runner
                interruption.stops(runner.stop)
                with nullcontext() if flight is None else flight.of(runner):
                    runner.run(until=steps)
            wall = time.perf_counter() - begin
            if realtime and wall > _SHORTEST and simulation.time / wall < KEPT_PACE:
                simulation.warnings.add(
                    f'real-time factor {simulation.time / wall:.2f} instead of 1; a larger '
                    'timestep or a cheaper fluid model (fluid_sim advise) would help'
                )
            remarks = watchdogs.finish()
        for line in remarks:
            say(line)
    result = _summary(simulation, watcher, wall) | files | {
        'remarks': remarks, 'interrupted': interruption.name
    }  # fmt: skip
    if flight is None:
        return result
    several = {'autopilots': flight.results}
    only = {'autopilot': next(iter(flight.results.values()))}
    return result | (several if len(flight.results) > 1 else only)


def flown_by(result: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """
    Return what the bridges of a run counted, by vehicle; nothing without an autopilot.

    Parameters
    ----------
    result
        Of ``run_scene``.

    """
    found: dict[str, dict[str, Any]] = result.get('autopilots', {})
    if only := result.get('autopilot'):
        found = {only['vehicle']: only}
    return found


def _warn(line: str, say: Callable[[str], None], log: 'RecordingSink | None') -> None:
    """Say a warning, and keep it in the log."""
    say(f'warning: {line}')
    if log is not None:
        log.event(warning=line)


def summary_table(result: dict[str, Any]) -> Table:
    """
    Return the table that ``fluid_sim run`` ends with.

    Parameters
    ----------
    result
        Of ``run_scene``.

    """
    caption = '\n'.join([
        'position in the world (ENU), velocity along base_link (FLU), largest force',
        *(
            escape(f'{name}: terms: {listed(vehicle["terms"])}')
            for name, vehicle in result['vehicles'].items()
        ),
    ])  # fmt: skip
    if flown := flown_by(result):
        caption = '\n'.join([*map(escape, counts_lines(flown)), caption])
    ended = f', ended by {result["interrupted"]}' if result['interrupted'] else ''
    rows = [
        (
            name,
            _vector(vehicle['position_w_m']),
            _vector(vehicle['velocity_b_m_s']),
            _force(vehicle['largest_fluid_force_n'], vehicle['largest_fluid_force_at_s']),
        )
        for name, vehicle in result['vehicles'].items()
    ]
    return table_of(
        ('vehicle', 'position [m]', 'velocity [m/s]', 'fluid force'),
        rows,
        title=f'{escape(result["scene"])}: {result["duration_s"]:g} s in '
        f'{result["wall_s"]:.2f} s, real-time factor {result["real_time_factor"]:.4g}{ended}',
        caption=caption,
    )


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


def _force(newtons: float, at: float) -> str:
    return f'{newtons:.4g} N at {at:.2f} s' if newtons > _LEAST_FORCE else 'none'


def _vector(values: Sequence[float]) -> str:
    return ' '.join(f'{value:.3f}' for value in values)
