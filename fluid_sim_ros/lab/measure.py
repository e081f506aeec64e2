"""Measures speed against accuracy: every rung x integrator x timestep of a problem."""

import itertools
import math
import os
import platform
import random
import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, NamedTuple

import mujoco

from fluid_sim_ros import __version__
from fluid_sim_ros.errors import ConfigError, DivergedError, listed
from fluid_sim_ros.lab.norms import (
    attitude_error,
    errors,
    position_error,
    regime,
    regime_error,
    sensitivity,
)
from fluid_sim_ros.lab.pareto import mark_front
from fluid_sim_ros.lab.problem import INTEGRATORS, Array, Flight, Problem, Rung, fits, fly
from fluid_sim_ros.runner import duration_steps
from fluid_sim_ros.schedule import whole_steps

#: A timed run takes at least and at most so many steps.
_FEWEST, _MOST = 2000, 8000
_ORDER_SEED = 1
#: Errors of the timestep alone are taken at this share of the run: later they fold back into
#: the size of the motion, and show no order.
EARLY = 0.2
#: A run is converged when half its step changes so little [m], [rad].
_CONVERGED = 1e-12
#: Errors within this factor of the converged run's own uncertainty say nothing about the order.
_CLEAR = 30.0
#: Larger discretisation errors are not yet asymptotic [m], [rad].
_ASYMPTOTIC = 0.1
_ORDER_POINTS = 3

Report = Callable[[str, int, int], None]  # what is being done, how far, of how many


class Setting(NamedTuple):
    """One way to run a problem."""

    rung: str
    integrator: str
    timestep: float  # [s]


class Converged(NamedTuple):
    """A run of a rung at a step so fine that only the model is left, and how sure that is."""

    states: Array | None  # None: no run of this rung lasts
    within: float  # early error against the run at twice the step [m] or [rad]


def measure(
    problem: Problem,
    *,
    integrators: Sequence[str] = INTEGRATORS,
    timesteps: Sequence[float] = (),
    repeats: int = 3,
    report: Report = lambda what, done, total: None,
) -> dict[str, Any]:
    """
    Return the whole chart of a problem as data, ready for JSON.

    Errors are the same to the bit at every call; processor times of stepping (on a free core
    the wall times, and not disturbed by other programs) are medians of ``repeats`` runs in
    interleaved order. A run that fails stays in the list, with the watchdog's line.

    Raises
    ------
    ConfigError
        For an unknown integrator, or a timestep that does not divide the problem's sample.

    """
    if timesteps:
        problem = replace(problem, timesteps=tuple(sorted(timesteps, reverse=True)))
    settings = _settings(problem, integrators)
    for timestep in problem.timesteps:
        whole_steps(problem.sample, timestep, f'{problem.name}: sample')
    converged = {
        name: _converged(problem, rung)
        for name, rung in _counted(problem.rungs.items(), f'{problem.name}: converged', report)
    }
    richest = converged[problem.richest]
    reference = problem.reference(problem.times) if problem.reference else richest.states
    if reference is None:
        raise ConfigError(f'{problem.name}: no run of the richest model lasts; nothing to compare')
    finest = fly(problem, problem.rungs[problem.richest], 'RK4', problem.timesteps[-1])
    chaos = sensitivity(problem, 'RK4', problem.timesteps[-1], finest)
    points = []
    for setting in _counted(settings, f'{problem.name}: errors', report):
        flight = fly(problem, problem.rungs[setting.rung], setting.integrator, setting.timestep)
        own = converged[setting.rung].states
        points.append(
            _point(setting, flight)
            | _errors(problem, flight, reference, own, chaotic=chaos.chaotic)
        )
    for point, cost in zip(points, _costs(problem, settings, repeats, report), strict=True):
        point |= cost
    judged = 'regime' if chaos.chaotic else problem.judged_by
    mark_front(points, judged)
    return {
        'problem': problem.name,
        'title': problem.title,
        'stands_for': problem.stands_for,
        'duration_s': problem.duration,
        'discretisation_at_s': float(problem.times[early(problem)]),
        'reference': problem.reference_kind,
        'judged_by': judged,
        'sensitivity': chaos.as_dict(),
        'rungs': {
            name: _rung(problem, run, reference, chaotic=chaos.chaotic)
            for name, run in converged.items()
        },
        'orders': orders(points, {name: run.within for name, run in converged.items()}),
        'repeats': repeats,
        'conditions': conditions(),
        'points': points,
    }


def conditions() -> dict[str, Any]:
    """Return what processor times depend on."""
    return {
        'fluid_sim_ros': __version__,
        'mujoco': mujoco.__version__,
        'python': platform.python_version(),
        'architecture': platform.machine(),
        'cores': os.cpu_count(),
    }


def _settings(problem: Problem, integrators: Sequence[str]) -> list[Setting]:
    known = {name.lower(): name for name in INTEGRATORS}
    for name in integrators:
        if name.lower() not in known:
            raise ConfigError(f"integrator '{name}' is not known; allowed: {listed(INTEGRATORS)}")
    names = [known[name.lower()] for name in integrators]
    return [Setting(*row) for row in itertools.product(problem.rungs, names, problem.timesteps)]


def _counted(items: Iterable[Any], what: str, report: Report) -> Iterable[Any]:
    rows = list(items)
    for done, row in enumerate(rows):
        report(what, done, len(rows))
        yield row
    report(what, len(rows), len(rows))


def _converged(problem: Problem, rung: Rung) -> Converged:
    """Run a rung by RK4 with smaller and smaller timesteps, to half the finest at most."""
    finest = problem.timesteps[-1]
    first, *finer = [
        h for h in (4 * finest, 2 * finest, finest, finest / 2)
        if fits(rung, h, problem.sample)
    ]  # fmt: skip
    coarse = fly(problem, rung, 'RK4', first)
    found = Converged(None, math.inf)
    for timestep in finer:
        fine = fly(problem, rung, 'RK4', timestep)
        if not (fine.fault or coarse.fault):
            apart = _judged(problem, coarse.states, fine.states, early(problem))
            found = Converged(fine.states, apart)
            if apart < _CONVERGED:
                break
        coarse = fine
    return found


def early(problem: Problem) -> int:
    """Return the index of the time at which errors of the timestep are taken."""
    return max(1, round(EARLY * (len(problem.times) - 1)))


def _judged(problem: Problem, states: Array, reference: Array, index: int = -1) -> float:
    """Return the error that the problem is judged by, by default at the end."""
    norm = attitude_error if problem.judged_by == 'attitude_rad' else position_error
    return float(norm(states, reference)[index])


def _rung(problem: Problem, run: Converged, reference: Array, chaotic: bool) -> dict[str, Any]:
    """Return a rung's model error: what remains when the timestep is no matter."""
    if run.states is None:
        return {'model_error': None, 'converged_within': None}
    model = _judged(problem, run.states, reference)
    if chaotic:
        model = _regime_apart(problem, run.states, reference)
    return {'model_error': model, 'converged_within': run.within}


def _regime_apart(problem: Problem, states: Array, reference: Array) -> float:
    times = problem.times
    return regime_error(regime(times, states), regime(times, reference))


def _point(setting: Setting, flight: Flight) -> dict[str, Any]:
    return {
        'rung': setting.rung,
        'integrator': setting.integrator,
        'timestep_s': setting.timestep,
        'status': 'failed' if flight.fault else 'ok',
        'fault': flight.fault,
        'failed_at_s': flight.failed_at,
    }


def _errors(
    problem: Problem, flight: Flight, reference: Array, own: Array | None, chaotic: bool
) -> dict[str, Any]:
    """Return the errors against the reference, and those of the timestep alone."""
    if flight.fault:
        return {'error': None, 'discretisation': None}
    found = errors(problem, flight, reference)
    if chaotic:
        found['regime'] = _regime_apart(problem, flight.states, reference)
        return {'error': found, 'discretisation': None}
    alone = None if own is None else _judged(problem, flight.states, own, early(problem))
    return {'error': found, 'discretisation': alone}


def _costs(
    problem: Problem, settings: Sequence[Setting], repeats: int, report: Report
) -> list[dict[str, float]]:
    """Return processor times of every setting, each repeat in another order (fixed seed)."""
    shuffled = random.Random(_ORDER_SEED)
    measured: list[list[float]] = [[] for _ in settings]
    order = [
        index
        for _ in range(repeats)
        for index in shuffled.sample(range(len(settings)), len(settings))
    ]
    for index in _counted(order, f'{problem.name}: processor time', report):
        measured[index].append(cpu_per_second(problem, settings[index]))
    return [
        {
            'cpu_us_per_s': statistics.median(row),
            'cpu_lowest_us_per_s': min(row),
            'cpu_highest_us_per_s': max(row),
        }
        for row in measured
    ]


def cpu_per_second(problem: Problem, setting: Setting) -> float:
    """Return processor time per simulated second [us/s] of stepping alone, up to a failure."""
    rung, integrator, timestep = setting
    simulation = problem.rungs[rung].simulation(integrator, timestep)
    steps = min(duration_steps(problem.duration, timestep), _MOST)
    spent = simulated = 0.0
    for _ in range(max(1, _FEWEST // steps)):
        simulation.reset()
        begin = time.thread_time()
        with suppress(DivergedError):
            simulation.step(steps)
        spent += time.thread_time() - begin
        simulated += max(simulation.step_count, 1) * timestep
    return spent / simulated * 1e6


def orders(points: Sequence[dict[str, Any]], floors: dict[str, float]) -> dict[str, Any]:
    """
    Return the order of convergence per rung and integrator, None where too few points show it.

    Slope of log error over log timestep through the finest points that are clear of the converged
    run's own uncertainty.
    """
    out: dict[str, dict[str, float | None]] = {}
    for point in points:
        out.setdefault(point['rung'], {}).setdefault(point['integrator'], None)
    for rung, integrators in out.items():
        for integrator in integrators:
            rows = sorted(
                (math.log(p['timestep_s']), math.log(p['discretisation']))
                for p in points
                if (p['rung'], p['integrator']) == (rung, integrator)
                and p['discretisation'] is not None
                and _CLEAR * max(floors[rung], 1e-14) < p['discretisation'] < _ASYMPTOTIC
            )
            if len(rows) >= _ORDER_POINTS:
                steps, sizes = zip(*rows[:_ORDER_POINTS], strict=True)
                integrators[integrator] = statistics.linear_regression(steps, sizes).slope
    return out
