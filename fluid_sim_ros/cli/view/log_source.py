# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log as a source of the view: scrubbed, and beside the same flight with a change."""

import threading
import time
from collections.abc import Callable, Sequence

import numpy as np

from fluid_sim_ros.errors import CommandError, FluidSimError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.recording.damage import LogError, reading
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.pictures.poses import LogPoses, latest, medium_of
from fluid_sim_ros.recording.pictures.tracks import Track, track_of
from fluid_sim_ros.recording.replay.resimulate import parse_changes, resimulate
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.source import Source

#: Wall time between two looks at the clock [s], and simulated time of one step [s].
_TURN, _STEP = 0.01, 0.02
_ODOMETRY = '/odom'


class LogSource(Source):
    """
    Shows a recorded flight; see ``view.source.Source``.

    Parameters
    ----------
    log
        What is shown.
    changes
        Texts ``KEY=VALUE`` (see ``recording.replay``): the flight with this change is shown beside
        the recorded one, as soon as it is flown; none: only the recorded one.
    pace, paused
        How it begins.
    say
        Takes lines for the user.

    """

    takes = frozenset({orders.Pause, orders.Step, orders.Reset, orders.Pace, orders.Seek})
    rungs: Sequence[str] = ()
    generation = 0

    def __init__(
        self,
        log: Log,
        changes: Sequence[str] = (),
        pace: float = 1.0,
        paused: bool = False,
        say: Callable[[str], None] = lambda line: None,
    ) -> None:
        self._log, self._say, self._changes = log, say, list(changes)
        parse_changes(self._changes)  # a wrong one is refused before anything is opened
        with reading(log.path):
            self._poses = poses = LogPoses(log)
            simulation = poses.simulation
            self._medium = {
                name: {s: medium_of(log, track, s) for s in simulation.streams}
                for name, track in poses.tracks.items()
            }
        self.title = log.path.name
        self.model, self.vehicles = simulation.model, simulation.vehicles
        self.terms, self.streams = simulation.terms, simulation.streams
        self.span = (float(poses.times[0]), float(poses.times[-1]))
        self.pace, self._paused, self._time = pace, paused, self.span[0]
        self._changed: dict[str, Track] = {}
        self._lock = threading.Lock()
        self._ended = threading.Event()

    def frame(self) -> Frame:
        """Return the frame of the present time."""
        with self._lock:
            at, paused = self._time, self._paused
        rows = np.full((len(self.vehicles), nat.ROW_WIDTH), np.nan)
        control = np.full(self.model.nu, np.nan)
        force = np.full(self.model.nu, np.nan)
        for number, name in enumerate(self.vehicles):
            if name in self._poses.tracks:
                self._fill(rows[number], control, name, at)
        ghost = self._poses.qpos(at, self._changed) if self._changed else None
        return Frame(at, self._poses.qpos(at), rows, control, force, paused=paused, ghost=ghost)

    def take(self, order: orders.Order) -> None:
        """
        Do what is asked, at once.

        Parameters
        ----------
        order
            Of a kind that ``takes`` holds.

        Raises
        ------
        CommandError
            If a log cannot do it.

        """
        begin, end = self.span
        with self._lock:
            match order:
                case orders.Pause(paused):
                    self._paused = paused
                    if not paused and self._time >= end:
                        self._time = begin
                case orders.Step():
                    self._paused, self._time = True, min(self._time + _STEP, end)
                case orders.Reset():
                    self._time = begin
                case orders.Pace(factor):
                    self.pace = factor
                case orders.Seek(time):
                    self._time = min(max(time, begin), end)
                case _:
                    raise CommandError(f'a log takes no order {type(order).__name__}')

    def run(self) -> None:
        """Let time pass until ``stop``."""
        flown = threading.Thread(target=self._fly_again, daemon=True)
        if self._changes:
            flown.start()
        before = time.monotonic()
        while not self._ended.wait(_TURN):
            now = time.monotonic()
            with self._lock:
                if not self._paused:
                    self._time += (now - before) * (self.pace or orders.FASTEST)
                    if self._time >= self.span[1]:
                        self._time, self._paused = self.span[1], True
            before = now

    def stop(self) -> None:
        """End ``run``."""
        self._ended.set()

    def _fill(self, row: Array, control: Array, name: str, at: float) -> None:
        """Write what the log says of a vehicle at a time."""
        track, vehicle = self._poses.tracks[name], self.vehicles[name]
        i = latest(track.times, at)
        row[nat.POSITION], row[nat.QUATERNION] = track.position_w[i], track.quat_wb_wxyz[i]
        row[nat.LINEAR_VELOCITY], row[nat.ANGULAR_VELOCITY] = track.velocity_b[i], track.omega_b[i]
        for term, table in track.wrenches.items():
            where = {'total': nat.TOTAL, 'thrust': nat.THRUST}.get(term)
            if where is None:
                where = nat.term_columns(term) if term in nat.TERMS else None
            if where is not None:
                row[where] = table[latest(table[:, 0], at), 1:]
        for table in self._medium[name].values():
            if len(table) and np.any(table[:, 1:]):
                row[nat.MEDIUM_VELOCITY] = table[latest(table[:, 0], at), 1:]
        commands = track.commands.get('thrust')
        if commands is None or commands.shape[1] != 1 + len(vehicle.thruster_ids):
            return
        if at >= commands[0, 0]:
            values = commands[latest(commands[:, 0], at), 1:]
            control[vehicle.thruster_ids] = values / vehicle.thrust_scale

    def _fly_again(self) -> None:
        """Fly the log with the changes, in a thread of its own."""
        change = ', '.join(self._changes)
        try:
            outcome = resimulate(
                self._log, changes=parse_changes(self._changes), keep=(_ODOMETRY,)
            )
            changed = {}
            for topic, pairs in outcome.pairs.items():
                times = np.array([time_ns for time_ns, _, _ in pairs]) / 1e9
                full = topic.strip('/').removesuffix(_ODOMETRY)
                definition = self._log.topic(topic).definition
                with reading(self._log.path, f"topic '{topic}'"):
                    track = track_of(full, times, definition, [new for _, _, new in pairs])
                name = next(
                    (n for n, recorded in self._poses.tracks.items() if recorded.name == full), ''
                )
                if name:
                    changed[name] = track
            if not changed:
                raise LogError(f'{self._log.path}: no odometry in it, nothing to compare')
        except FluidSimError as error:
            self._say(f'--with {change}: {error}')
            return
        self._changed = changed
        for note in outcome.notes:
            self._say(f'--with {change}: {note}')
        self._say(f'the pale vehicle is the flight with {change}')
