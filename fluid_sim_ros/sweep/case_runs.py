# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One run of a sweep: a scene with its numbers, flown to the end, as one row of results."""

import dataclasses
from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

from fluid_sim_ros.errors import DivergedError, FluidSimError
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.batch import BatchRuns
from fluid_sim_ros.simulation.plant import plant_of
from fluid_sim_ros.step_clock import whole_steps
from fluid_sim_ros.sweep.compiled_run import (
    COLUMNS,
    MOTION,
    CompiledRun,
    Row,
    columns,
    row_begun,
    start,
)
from fluid_sim_ros.sweep.hold_controller import hold_controller
from fluid_sim_ros.sweep.run_watch import RunWatch
from fluid_sim_ros.sweep.sweep_file import Cases, SweepFile, Value

#: Largest number of runs in a portion: what a worker that is killed loses.
LARGEST_PORTION = 128
#: Compiled simulations that one thread keeps.
_KEPT = 4
#: How often a run is tried that ends in an unexpected error.
_TRIES = 2
_UNEXPECTED = (RuntimeError, ArithmeticError, LookupError, ValueError, TypeError, MemoryError)


class CaseRunner:
    """
    Runs the cases of a sweep; each thread or process has its own.

    Parameters
    ----------
    sweep
        What is run.

    Attributes
    ----------
    cases
        The numbers of every run.
    load_warnings
        What ``check`` found at load.

    """

    def __init__(self, sweep: SweepFile) -> None:
        self._sweep = sweep
        self._scene = Scene.load(sweep.scene)
        self._ready: OrderedDict[tuple[Any, ...], CompiledRun] = OrderedDict()
        self._plant = plant_of(self._scene, sweep.hold.vehicle) if sweep.hold else None
        self.cases = Cases(sweep)
        self.load_warnings: tuple[str, ...] = ()

    def check(self) -> int:
        """
        Prepare the first case; return its steps.

        Returns
        -------
        int
            Steps of a run.

        Raises
        ------
        FluidSimError
            If the sweep asks for something that the scene does not have.

        """
        values = self.cases[0]
        ready = self.prepare(values)
        start(ready.simulation, values)
        if ready.controller is not None:
            ready.controller.begin(values)
        self.load_warnings = tuple(ready.simulation.warnings.lines)
        return ready.steps

    def rows(self, begin: int, end: int) -> list[Row]:
        """
        Return the rows of some runs.

        Runs that nothing disturbs on their way (no controller, event or gait) are flown together.

        Parameters
        ----------
        begin, end
            From the first up to the second.

        Returns
        -------
        list
            A row per run, in order.

        """
        rows: list[Row] = []
        batch = _Batch()
        for index in range(begin, end):
            values = self.cases[index]
            try:
                ready = self.prepare(values)
                if ready.many is None:
                    rows += [*self._end_batch(batch), self.row(index)]
                    continue
                if not batch.takes(ready):
                    rows += self._end_batch(batch)
                start(ready.simulation, values)
                batch.take(ready, row_begun(index, values))
            except (FluidSimError, *_UNEXPECTED):
                rows += [*self._end_batch(batch), self.row(index)]
        return rows + self._end_batch(batch)

    def _end_batch(self, batch: '_Batch') -> list[Row]:
        """Make the collected runs in one call; where that fails, one by one."""
        begun = [int(row['run']) for row in batch.begun]
        try:
            return batch.run()
        except _UNEXPECTED:
            return [self.row(index) for index in begun]

    def row(self, index: int) -> Row:
        """
        Fly one case.

        Whatever goes wrong stays in its row: ``status`` is ``ok``, ``diverged`` or ``failed``, and
        ``message`` says why.

        Parameters
        ----------
        index
            Of the case.

        Returns
        -------
        dict
            The row.

        """
        values = self.cases[index]
        row = begin = row_begun(index, values)
        for _ in range(_TRIES):
            try:
                return begin | self._run(values)
            except FluidSimError as error:
                return begin | {'status': 'failed', 'message': str(error)}
            except _UNEXPECTED as error:  # isolated: the other runs go on
                row = begin | {'status': 'failed', 'message': f'{type(error).__name__}: {error}'}
                self._ready.clear()
        return row

    def _run(self, values: Mapping[str, Value]) -> Row:
        ready = self.prepare(values)
        simulation, holds, largest = ready.simulation, ready.controller, ready.largest
        start(simulation, values)
        largest.begin()
        ready.watch.begin()
        row: Row = {}
        if holds is not None:
            holds.begin(values)
        try:
            self._go_through(ready)
        except DivergedError as error:
            row = {'status': 'diverged', 'message': str(error)}
        row['warnings'] = ready.watch.end(complete=not row)
        row['time_s'] = simulation.time
        motion = simulation.observe(forces=False)[:, MOTION]
        row |= columns(ready, motion, largest.values)
        return row if holds is None else row | holds.columns()

    @staticmethod
    def _go_through(ready: CompiledRun) -> None:
        """Step to the end of a run; controller, largest values and watchdogs at their steps."""
        simulation, holds, watch = ready.simulation, ready.controller, ready.watch
        while (now := simulation.step_count) < ready.steps:
            if holds is not None and holds.beat.due(now):
                holds.answer(simulation)
            look = (now // ready.period + 1) * ready.period
            simulation.step(min(look, watch.next_step, ready.steps) - now)
            if simulation.step_count in (look, ready.steps):
                ready.largest.update()
            watch.take()

    def prepare(self, values: Mapping[str, Value]) -> CompiledRun:
        """
        Return the simulation of a case, compiled at most once for equal settings.

        Parameters
        ----------
        values
            Of the case.

        Returns
        -------
        CompiledRun
            The simulation and what belongs to it.

        Raises
        ------
        FluidSimError
            If the case asks for something that the scene does not have.

        """
        masses = tuple((k, float(v)) for k, v in values.items() if k.startswith('mass.'))
        settings = self._sweep.settings(values)
        key = (settings, masses)
        ready = self._ready.get(key)
        if ready is None:
            ready = self._ready[key] = self._compile(settings, dict(masses))
            if len(self._ready) > _KEPT:
                self._ready.popitem(last=False)
        return ready

    def _compile(self, settings: RunSettings, masses: Mapping[str, float]) -> CompiledRun:
        sweep = self._sweep
        factors = {key.removeprefix('mass.'): factor for key, factor in masses.items()}
        scene = dataclasses.replace(self._scene, masses=factors)
        simulation = Simulation(scene, **settings.model_dump())
        timestep, watch = simulation.timestep, RunWatch(simulation)
        names = tuple(f'{name}.{key}' for name in simulation.vehicles for key in COLUMNS)
        steps = whole_steps(sweep.duration or scene.duration, timestep, "key 'duration'")
        if sweep.hold is None or self._plant is None:
            period = max(1, round(1.0 / (sweep.sample_rate * timestep)))
            alone = simulation.next_change < steps or watch.has_grid
            many = None
            if not alone:
                many = BatchRuns(simulation, steps, period, LARGEST_PORTION, watch.period)
            return CompiledRun(
                simulation, steps, period, None, simulation.largest(), watch, names, many
            )
        plant, vehicle = self._plant
        holds = hold_controller(sweep.hold, plant, vehicle.name, simulation)
        largest = simulation.largest()
        return CompiledRun(
            simulation, steps, holds.beat.period, holds, largest, watch, names, None
        )


class _Batch:
    """Undisturbed runs of one model, collected and then made in one call."""

    def __init__(self) -> None:
        self._ready: CompiledRun | None = None
        self.begun: list[Row] = []

    def takes(self, ready: CompiledRun) -> bool:
        """Return whether one more run of this model can join."""
        fits = self._ready is None or self._ready is ready
        return fits and len(self.begun) < LARGEST_PORTION

    def take(self, ready: CompiledRun, begun: Row) -> None:
        """Add the run whose start is the present state of the simulation."""
        assert ready.many is not None
        ready.many.take()
        self._ready = ready
        self.begun.append(begun)

    def run(self) -> list[Row]:
        """Run all of them in one call; return their rows, and begin anew."""
        ready, begun = self._ready, self.begun
        self._ready, self.begun = None, []
        if ready is None or ready.many is None:
            return []
        many = ready.many
        many.run()
        for i, row in enumerate(begun):
            error = many.divergence(i)
            if error is not None:
                row |= {'status': 'diverged', 'message': str(error)}
            row['time_s'] = many.times[i]
            row['warnings'] = ready.watch.text(
                many.times[i], many.energy[i], many.warned[i].tolist(), many.limits[i]
            )
            row |= columns(ready, many.rows[i][:, MOTION], many.largest[i])
        return begun
