"""Measures speed against accuracy: every rung x integrator x timestep of a problem."""

import itertools
import math
import os
import platform
import statistics
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import mujoco

from fluid_sim_ros import __version__
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.lab.cost import ROUNDS, Curve, Report, StepCost, step_costs
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
from fluid_sim_ros.lab.side_by_side import side_by_side
from fluid_sim_ros.lab.trials import Setting
from fluid_sim_ros.schedule import whole_steps

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


class Converged(NamedTuple):
    """A run of a rung at a step so fine that only the model is left, and how sure that is."""

    states: Array | None  # None: no run of this rung lasts
    within: float  # early error against the run at twice the step [m] or [rad]


def measure(
    problem: Problem,
    *,
    integrators: Sequence[str] = INTEGRATORS,
    timesteps: Sequence[float] = (),
    rounds: int = ROUNDS,
    report: Report = lambda what, done, total: None,
) -> dict[str, Any]:
    """
    Return the whole chart of a problem as data, ready for JSON.

    Errors are the same to the bit at every call. Times of stepping are those of ``step_costs``,
    medians of ``rounds`` bursts in interleaved order: processor time, which other programs
    disturb less, and by which the front is marked; and wall time. A run that fails stays in the
    list, with the watchdog's line.

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
    runs = side_by_side(
        lambda rung: _converged(problem, rung), problem.rungs.values(),
        f'{problem.name}: converged', report,
    )  # fmt: skip
    converged = dict(zip(problem.rungs, runs, strict=True))
    richest = converged[problem.richest]
    reference = problem.reference(problem.times) if problem.reference else richest.states
    if reference is None:
        raise ConfigError(f'{problem.name}: no run of the richest model lasts; nothing to compare')
    finest = fly(problem, problem.rungs[problem.richest], 'RK4', problem.timesteps[-1])
    chaos = sensitivity(problem, 'RK4', problem.timesteps[-1], finest)

    def point_of(setting: Setting) -> dict[str, Any]:
        flight = fly(problem, problem.rungs[setting.rung], setting.integrator, setting.timestep)
        own = converged[setting.rung].states
        return _point(setting, flight) | _errors(
            problem, flight, reference, own, chaotic=chaos.chaotic
        )

    points = side_by_side(point_of, settings, f'{problem.name}: errors', report)
    costs = _costs(problem, points, rounds, report)
    for point in points:
        cost = costs[Curve(point['rung'], point['integrator'])]
        point |= cost.per_second(point['timestep_s'])
    judged = 'regime' if chaos.chaotic else problem.judged_by
    same_cost = mark_front(points, judged)
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
        'rounds': rounds,
        'step_us': [{**curve._asdict(), **cost._asdict()} for curve, cost in costs.items()],
        'same_cost': same_cost._asdict(),
        'conditions': conditions(),
        'points': points,
    }


def conditions() -> dict[str, Any]:
    """Return what times depend on."""
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
    problem: Problem, points: Sequence[dict[str, Any]], rounds: int, report: Report
) -> dict[Curve, StepCost]:
    """Return what a step costs on every curve, measured at a timestep at which it lasts."""
    settings: dict[Curve, list[float]] = {}
    lasting: dict[Curve, list[float]] = {}
    for point in points:
        curve = Curve(point['rung'], point['integrator'])
        settings.setdefault(curve, []).append(point['timestep_s'])
        if point['status'] == 'ok':
            lasting.setdefault(curve, []).append(point['timestep_s'])
    at = {curve: _timed_at(problem, lasting.get(curve) or steps[-1:])
          for curve, steps in settings.items()}  # fmt: skip
    return step_costs(problem, at, rounds, report)


def _timed_at(problem: Problem, lasting: Sequence[float]) -> float:
    """Return the timestep at which a curve is timed [s]."""
    if problem.rungs[problem.richest].scene.gait:
        return min(lasting)  # the wave of the joints is part of a second, not of a step
    middle = problem.timesteps[len(problem.timesteps) // 2]
    return min(lasting, key=lambda step: abs(math.log(step / middle)))


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
