"""One run of a sweep: a scene with its numbers, flown to the end, as one row of results."""

import dataclasses
from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

import numpy as np

from fluid_sim_ros.errors import DivergedError, FluidSimError
from fluid_sim_ros.lab.sweep.holding import Holding, holding
from fluid_sim_ros.lab.sweep.sweep_file import Cases, SweepFile, Value
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schedule import whole_steps
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.vehicle_plant import plant_of

#: Compiled simulations that one thread keeps.
_KEPT = 4
#: Tries of a run that ends in an error that is none of ours.
_TRIES = 2
_UNEXPECTED = (RuntimeError, ArithmeticError, LookupError, ValueError, TypeError, MemoryError)
_STATE = (
    *(f'{axis}_m' for axis in 'xyz'), *(f'q{part}' for part in 'wxyz'),
    *(f'v{axis}_m_s' for axis in 'xyz'), *(f'w{axis}_rad_s' for axis in 'xyz'),
)  # fmt: skip
_LARGEST = ('largest_speed_m_s', 'largest_tilt_rad', 'farthest_m')

Row = dict[str, Any]


@dataclasses.dataclass
class _Ready:
    """A compiled simulation, its run in steps, and the controller in its loop."""

    simulation: Simulation
    steps: int
    period: int
    holding: Holding | None


class Flights:
    """
    Runs the cases of a sweep; each thread or process has its own.

    Parameters
    ----------
    sweep
        What is run.

    """

    def __init__(self, sweep: SweepFile) -> None:
        self._sweep = sweep
        self._scene = Scene.load(sweep.scene)
        self._ready: OrderedDict[tuple[Any, ...], _Ready] = OrderedDict()
        self._plant = plant_of(self._scene, sweep.hold.vehicle) if sweep.hold else None
        self.cases = Cases(sweep)

    def check(self) -> None:
        """
        Prepare the first case.

        Raises
        ------
        FluidSimError
            If the sweep asks for something that the scene does not have.

        """
        values = self.cases[0]
        ready = self._prepare(values)
        ready.simulation.reset()
        _apply(ready.simulation, values)
        if ready.holding is not None:
            ready.holding.begin(values)

    def rows(self, begin: int, end: int) -> list[Row]:
        """Return the rows of the runs from ``begin`` up to ``end``."""
        return [self.row(index) for index in range(begin, end)]

    def row(self, index: int) -> Row:
        """
        Fly one case.

        Whatever goes wrong stays in its row: ``status`` is ``ok``, ``diverged`` or ``failed``, and
        ``message`` says why.
        """
        values = self.cases[index]
        begin: Row = {'run': index, **values, 'status': 'ok', 'message': '', 'time_s': 0.0}
        row = begin
        for _ in range(_TRIES):
            try:
                return begin | self._fly(values)
            except FluidSimError as error:
                return begin | {'status': 'failed', 'message': str(error)}
            except _UNEXPECTED as error:  # isolated: the other runs go on
                row = begin | {'status': 'failed', 'message': f'{type(error).__name__}: {error}'}
                self._ready.clear()
        return row

    def _fly(self, values: Mapping[str, Value]) -> Row:
        ready = self._prepare(values)
        simulation, holds = ready.simulation, ready.holding
        simulation.reset()
        _apply(simulation, values)
        seen = _Seen(simulation)
        row: Row = {}
        if holds is not None:
            holds.begin(values)
        try:
            while simulation.step_count < ready.steps:
                if holds is not None:
                    holds.answer(simulation)
                left = ready.steps - simulation.step_count
                simulation.step(min(ready.period, left))
                seen.look()
        except DivergedError as error:
            row = {'status': 'diverged', 'message': str(error)}
        row |= {'time_s': simulation.time, **seen.columns()}
        return row if holds is None else row | holds.columns()

    def _prepare(self, values: Mapping[str, Value]) -> _Ready:
        """Return the simulation of a case, compiled at most once for equal settings."""
        masses = tuple((k, float(v)) for k, v in values.items() if k.startswith('mass.'))
        settings = {
            name: values.get(name, getattr(self._sweep, name))
            for name in ('timestep', 'integrator', 'fluid')
        }
        seed = int(values.get('seed', 0))
        key = (*settings.values(), seed, masses)
        ready = self._ready.get(key)
        if ready is None:
            ready = self._ready[key] = self._compile(settings, seed, dict(masses))
            if len(self._ready) > _KEPT:
                self._ready.popitem(last=False)
        return ready

    def _compile(
        self, settings: Mapping[str, Any], seed: int, masses: Mapping[str, float]
    ) -> _Ready:
        sweep = self._sweep
        factors = {key.removeprefix('mass.'): factor for key, factor in masses.items()}
        scene = dataclasses.replace(self._scene, masses=factors)
        simulation = Simulation(scene, seed=seed, **settings)
        timestep = simulation.timestep
        steps = whole_steps(sweep.duration or scene.duration, timestep, "key 'duration'")
        if sweep.hold is None or self._plant is None:
            period = max(1, round(1.0 / (sweep.sample_rate * timestep)))
            return _Ready(simulation, steps, period, None)
        plant, vehicle = self._plant
        holds = holding(sweep.hold, plant, vehicle.name, simulation)
        return _Ready(simulation, steps, holds.period, holds)


def _apply(simulation: Simulation, values: Mapping[str, Value]) -> None:
    """Set what a case changes at run time."""
    for stream, setter in (('wind', simulation.set_wind), ('current', simulation.set_current)):
        velocity = [float(values.get(f'{stream}.{axis}', 0.0)) for axis in 'xyz']
        if any(f'{stream}.{axis}' in values for axis in 'xyz'):
            setter(velocity)
    for key, value in values.items():
        kind, _, name = key.partition('.')
        if kind == 'thrust':
            vehicle = simulation.vehicle(name)
            simulation.set_thrust(name, float(value) * vehicle.thrust_range[:, 1])


class _Seen:
    """The largest values of a run, looked at between its steps."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._names = tuple(simulation.vehicles)
        self._rows = simulation.observe(forces=False)
        self._start = self._rows[:, nat.POSITION].copy()
        self._largest = np.zeros((3, len(self._names)))

    def look(self) -> None:
        """Look at the present state."""
        rows = self._simulation.observe(forces=False)
        velocity, quat = rows[:, nat.LINEAR_VELOCITY], rows[:, nat.QUATERNION]
        moved = rows[:, nat.POSITION] - self._start
        up = 1.0 - 2.0 * (quat[:, 1] ** 2 + quat[:, 2] ** 2)
        now = np.array([
            np.sqrt((velocity * velocity).sum(axis=1)),
            np.arccos(np.minimum(np.maximum(up, -1.0), 1.0)),
            np.sqrt((moved * moved).sum(axis=1)),
        ])  # fmt: skip
        np.fmax(self._largest, now, out=self._largest)

    def columns(self) -> Row:
        """Return the state at the end and the largest values, per vehicle."""
        rows = self._simulation.observe(forces=False)
        columns: Row = {}
        for i, name in enumerate(self._names):
            row = rows[i]
            state = np.concatenate([
                row[nat.POSITION], row[nat.QUATERNION], row[nat.LINEAR_VELOCITY],
                row[nat.ANGULAR_VELOCITY],
            ])  # fmt: skip
            columns |= {f'{name}.{k}': v for k, v in zip(_STATE, state.tolist(), strict=True)}
            largest = self._largest[:, i].tolist()
            columns |= {f'{name}.{k}': v for k, v in zip(_LARGEST, largest, strict=True)}
        return columns
