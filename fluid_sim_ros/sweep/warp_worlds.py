# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The runs of a sweep as worlds of mujoco_warp: many at a time on one device."""

from collections.abc import Iterator, Mapping, Sequence

import mujoco
import numpy as np

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.step_clock import StepClock
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.compiled_run import CompiledRun, Row, columns, row_begun, start
from fluid_sim_ros.sweep.results import Portion
from fluid_sim_ros.sweep.sweep_file import SweepFile, Value
from fluid_sim_ros.sweep.warp_device import WarpDevice, WarpWorlds, state_fields
from fluid_sim_ros.sweep.warp_models import (
    batched_fields,
    check_stock,
    fields_of_masses,
    motion_of,
    with_masses,
)

#: Worlds at a time: enough to fill a GPU; on the processor more only take more memory.
_WORLDS_ON_GPU, _WORLDS_ON_CPU = 4096, 64
#: A coordinate or velocity beyond this has blown up (MuJoCo's mjMAXVAL).
_LARGEST_SOUND = 1e10


class WarpRuns:
    """
    Flies the cases of a sweep on a device.

    Parameters
    ----------
    sweep
        What is run.
    device
        Name of the device.
    most
        Worlds at a time; default: by the kind of device.

    Attributes
    ----------
    most
        Worlds at a time.
    device
        Where.

    Raises
    ------
    ConfigError, MissingExtraError
        If the sweep asks for more than mujoco_warp can fly, or the device is not there.

    """

    def __init__(self, sweep: SweepFile, device: str, most: int | None = None) -> None:
        self._sweep = sweep
        self._runner = CaseRunner(sweep)
        self._masses = [key.removeprefix('mass.') for key in sweep.vary if key.startswith('mass.')]
        ready = self._base(self._runner.cases[0])
        check_stock(sweep, ready.simulation, ready.steps, device)
        self.device = WarpDevice(device)
        self.most = most or (_WORLDS_ON_GPU if self.device.is_cuda else _WORLDS_ON_CPU)
        #: Fields of the model in which worlds differ.
        self._own_fields = fields_of_masses(
            ready.simulation.model, self._masses, batched_fields(self.device.mjw.Model)
        )
        #: The worlds that were flown last; another model or size takes their place.
        self._worlds: tuple[CompiledRun, int, WarpWorlds] | None = None
        self._prepare(ready, 1)

    def portions(self, left: Sequence[Portion]) -> Iterator[list[Row]]:
        """
        Fly what is left, and yield the rows of each portion.

        Parameters
        ----------
        left
            Portions of runs.

        Yields
        ------
        rows
            The rows of at most ``most`` runs.

        """
        for begin, end in left:
            for first in range(begin, end, self.most):
                yield self.rows(first, min(first + self.most, end))

    def rows(self, begin: int, end: int) -> list[Row]:
        """
        Return the rows of some runs.

        Parameters
        ----------
        begin, end
            From the first up to the second, at most ``most``.

        Returns
        -------
        list
            A row per run, in order.

        """
        groups: dict[RunSettings, list[int]] = {}
        for index in range(begin, end):
            values = self._runner.cases[index]
            groups.setdefault(self._sweep.settings(values), []).append(index)
        rows = [row for group in groups.values() for row in self._run(group)]
        for row in rows:
            row['device'] = self.device.description
        return sorted(rows, key=lambda row: int(row['run']))

    def _base(self, values: Mapping[str, Value]) -> CompiledRun:
        """Return the simulation of a case, with the masses of the scene."""
        return self._runner.prepare(
            {key: value for key, value in values.items() if not key.startswith('mass.')}
        )

    def _prepare(self, ready: CompiledRun, count: int) -> tuple[WarpWorlds, int]:
        """Return worlds of a model, as many as a power of two, and how many they are."""
        size = min(1 << (count - 1).bit_length(), max(self.most, count))
        last = self._worlds
        if last is not None and last[0] is ready and last[1] == size:
            return last[2], size
        worlds = WarpWorlds(self.device, ready.simulation, size, self._own_fields)
        self._worlds = (ready, size, worlds)
        return worlds, size

    def _run(self, indices: Sequence[int]) -> list[Row]:
        """Fly runs of one model."""
        ready = self._base(self._runner.cases[indices[0]])
        model, data = ready.simulation.model, ready.simulation.data
        failed: list[Row] = []
        flown: list[Row] = []
        starts: dict[str, list[Array]] = {name: [] for name in state_fields(model)}
        winds: list[Array] = []
        models: list[mujoco.MjModel] = []
        for index in indices:
            values = self._runner.cases[index]
            factors = {name: float(values[f'mass.{name}']) for name in self._masses}
            row = row_begun(index, values)
            try:
                models.append(with_masses(model, factors) if factors else model)
                start(ready.simulation, values)
            except FluidSimError as error:
                failed.append(row | {'status': 'failed', 'message': str(error)})
                models = models[: len(flown)]
                continue
            flown.append(row)
            winds.append(model.opt.wind.copy())
            for name, found in starts.items():
                found.append(getattr(data, name).copy())
        if not flown:
            return failed
        worlds, size = self._prepare(ready, len(flown))
        spare = [len(flown) - 1] * (size - len(flown))
        chosen = [*range(len(flown)), *spare]  # worlds beyond the runs fly the last one again
        own = {
            name: np.stack([getattr(models[i], name) for i in chosen]) for name in self._own_fields
        }
        worlds.begin(
            {name: np.stack(found)[chosen] for name, found in starts.items()},
            np.stack(winds)[chosen], own,
        )  # fmt: skip
        return failed + _watched(ready, worlds, flown, np.stack(starts['qpos']))


def _watched(ready: CompiledRun, worlds: WarpWorlds, rows: list[Row], qpos: Array) -> list[Row]:
    """Step the worlds to the end; a world that blows up ends its own row only."""
    simulation, count = ready.simulation, len(rows)
    clock = StepClock(simulation.timestep)
    at_start = motion_of(simulation, qpos, np.zeros((count, simulation.model.nv)))
    begin = at_start[:, :, :3]
    largest = np.zeros((count, len(simulation.vehicles), 3))
    motion = np.zeros_like(at_start)
    flying = np.ones(count, dtype=bool)
    step = 0
    while step < ready.steps and flying.any():
        before, step = step, min(step + ready.period, ready.steps)
        worlds.step(step - before)
        qpos, qvel = (values[:count] for values in worlds.state())
        motion[flying] = motion_of(simulation, qpos, qvel)[flying]
        with np.errstate(invalid='ignore'):
            sound = np.all(np.abs(np.hstack((qpos, qvel))) < _LARGEST_SOUND, axis=1)
        for i in np.flatnonzero(flying & ~sound).tolist():
            rows[i] |= {
                'status': 'diverged', 'time_s': clock.time(before),
                'message': f'the simulation diverged between t = {clock.time(before):.6g} and '
                f'{clock.time(step):.6g} s; try a timestep below {simulation.timestep:g} s',
            }  # fmt: skip
        flying &= sound
        np.maximum(largest, _seen(motion, begin), out=largest, where=flying[:, None, None])
    for i in np.flatnonzero(flying).tolist():
        rows[i]['time_s'] = clock.time(step)
    for i, row in enumerate(rows):
        row |= columns(ready, motion[i], largest[i])
    for i in np.flatnonzero(worlds.overflowed()[:count] & flying).tolist():
        rows[i] |= {'status': 'failed', 'message': 'more contacts than mujoco_warp has room for'}
    return rows


def _seen(motion: Array, begin: Array) -> Array:
    """Return speed, tilt and distance from the start; see ``engine.Largest``."""
    quat = motion[:, :, 3:7]
    up = 1.0 - 2.0 * (quat[:, :, 1] ** 2 + quat[:, :, 2] ** 2)
    with np.errstate(invalid='ignore', over='ignore'):
        return np.stack(
            (
                np.linalg.norm(motion[:, :, 7:10], axis=2),
                np.arccos(np.clip(up, -1.0, 1.0)),
                np.linalg.norm(motion[:, :, :3] - begin, axis=2),
            ),
            axis=2,
        )
