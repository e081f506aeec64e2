# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Measures speed against accuracy: every rung x integrator x timestep of a problem."""

import copy
import itertools
import math
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.charts.convergence import (
    Converged,
    RunCache,
    converged_run,
    discretisation_error,
    early,
    orders,
)
from fluid_sim_ros.lab.charts.cost import ROUNDS, Curve, StepCost, step_costs
from fluid_sim_ros.lab.charts.pareto import mark_front
from fluid_sim_ros.lab.manoeuvre import judged
from fluid_sim_ros.lab.metrics import METRICS, Metric, check_metric, metric
from fluid_sim_ros.lab.motion_errors import Sensitivity, errors, sensitivity
from fluid_sim_ros.lab.parallel import run_parallel
from fluid_sim_ros.lab.problems.problem import (
    INTEGRATORS,
    Problem,
    Setting,
    Trajectory,
    known_integrators,
)
from fluid_sim_ros.lab.results import conditions
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.step_clock import whole_steps


def measure(
    problem: Problem,
    *,
    integrators: Sequence[str] = INTEGRATORS,
    timesteps: Sequence[float] = (),
    metric_name: str = 'pose',
    rounds: int = ROUNDS,
    report: Report = silent,
) -> dict[str, Any]:
    """
    Return the whole chart of a problem as data, ready for JSON.

    Errors are the same to the bit at every call. Times of stepping are those of ``step_costs``,
    medians of ``rounds`` bursts in interleaved order: processor time, which other programs
    disturb less, and by which the front is marked; and wall time. A run that fails stays in the
    list, with the watchdog's line.

    Parameters
    ----------
    problem
        What is charted.
    integrators
        Names of integrators, in any case.
    timesteps
        [s]; empty: the problem's own.
    metric_name
        One of METRICS, by which rungs and points are judged; a chaotic motion is judged by
        ``regime``.
    rounds
        Timed bursts of steps per curve.
    report
        Told how far the measurement is.

    Returns
    -------
    dict
        What the problem is, its reference and sensitivity, ``rungs`` with their model errors,
        ``orders`` of convergence, costs, and ``points``: one for each rung, integrator and
        timestep.

    Raises
    ------
    ConfigError
        For an unknown integrator or metric, or a timestep that is not above 0 or does not divide
        the problem's sample.

    """
    if timesteps:
        for timestep in timesteps:
            RunSettings.checked(timestep=timestep)
        problem = replace(problem, timesteps=tuple(sorted(timesteps, reverse=True)))
    check_metric(metric_name)
    settings = _settings(problem, integrators)
    for timestep in problem.timesteps:
        whole_steps(problem.sample, timestep, f'{problem.name}: sample')
    if problem.reference is None:
        problem = judged(problem)
    runs_of = RunCache(problem)
    runs = run_parallel(
        lambda rung: converged_run(runs_of, rung),
        problem.rungs,
        f'{problem.name}: converged',
        report,
    )  # fmt: skip
    converged = dict(zip(problem.rungs, runs, strict=True))
    richest = converged[problem.richest]
    reference = problem.reference(problem.times) if problem.reference else richest.states
    if reference is None:
        raise ConfigError(f'{problem.name}: no run of the richest model lasts; nothing to compare')
    finest = Setting(problem.richest, 'RK4', problem.timesteps[-1])
    # the longest runs first, so that no core is left with one at the end
    longest_first = sorted(settings, key=lambda setting: -setting.evaluations)
    what = f'{problem.name}: errors'
    with ThreadPoolExecutor(1) as beside:
        nudged = beside.submit(sensitivity, problem, 'RK4', finest.timestep, runs_of(finest))
        run_parallel(runs_of, longest_first, what, report)
        chaos = nudged.result()
    judge = _Judge(problem, reference, 'regime' if chaos.chaotic else metric_name)
    points = [
        _point(setting, runs_of(setting))
        | judge.errors(runs_of(setting), converged[setting.rung].states)
        for setting in settings
    ]
    result = _described(judge, converged, chaos)
    result |= {
        'orders': orders(points, {name: run.within for name, run in converged.items()}),
        'points': points,
    }
    return _timed(result, problem, rounds, report)


def time_again(
    result: dict[str, Any], problem: Problem, *, rounds: int = ROUNDS, report: Report = silent
) -> dict[str, Any]:
    """
    Return a chart with its times measured anew, on this machine; its errors stay.

    So does the factor within which costs are equal, unless a ratio has come near it.

    Parameters
    ----------
    result
        A chart, as ``measure`` returns it.
    problem
        The problem that the chart is of.
    rounds
        Timed bursts of steps per curve.
    report
        Told how far the measurement is.

    Returns
    -------
    dict
        The chart with new times; ``result`` is not changed.

    Raises
    ------
    ConfigError
        If the chart has rungs that the problem does not have.

    """
    steps = sorted({point['timestep_s'] for point in result['points']}, reverse=True)
    problem = replace(problem, timesteps=tuple(steps))
    for point in result['points']:
        problem.rung(point['rung'])
    if problem.reference is None:
        problem = judged(problem)
    return _timed(copy.deepcopy(result), problem, rounds, report)


def _timed(
    result: dict[str, Any], problem: Problem, rounds: int, report: Report
) -> dict[str, Any]:
    """Give every point its cost, and mark the front."""
    points = result.pop('points')
    costs = _costs(problem, points, rounds, report)
    for point in points:
        cost = costs[Curve(point['rung'], point['integrator'])]
        point |= cost.per_second(point['timestep_s'])
    before = result.get('same_cost', {}).get('factor')
    same_cost = mark_front(points, result['judged_by'], before)
    return result | {
        'rounds': rounds,
        'step_us': [{**curve._asdict(), **cost._asdict()} for curve, cost in costs.items()],
        'same_cost': same_cost._asdict(),
        'conditions': conditions(),
        'points': points,
    }


class _Judge:
    """Compares runs with a problem's reference."""

    def __init__(self, problem: Problem, reference: Array, name: str) -> None:
        self.problem = problem
        self.name = name
        self._reference = reference
        names = ('regime',) if name == 'regime' else METRICS[:-1]
        self._metrics: dict[str, Metric] = {
            each: metric(each, problem, reference) for each in names
        }

    def model_error(self, run: Converged) -> float | None:
        """Return a rung's own error: what remains when the timestep is no matter."""
        if run.states is None:
            return None
        return self._metrics[self.name](run.states, self._reference)

    def errors(self, trajectory: Trajectory, own: Array | None) -> dict[str, Any]:
        """Return the errors against the reference, and that of the timestep alone."""
        if trajectory.fault:
            return {'error': None, 'discretisation': None}
        found = errors(self.problem, trajectory, self._reference)
        for name, judge in self._metrics.items():
            found[name] = judge(trajectory.states, self._reference)
        alone = None
        if own is not None and self.name != 'regime':
            index = early(self.problem)
            alone = discretisation_error(self.problem, trajectory.states, own, index)
        return {'error': found, 'discretisation': alone}


def _described(
    judge: _Judge, converged: dict[str, Converged], chaos: Sensitivity
) -> dict[str, Any]:
    """Return what a chart says of its problem."""
    problem = judge.problem
    return {
        'problem': problem.name,
        'title': problem.title,
        'stands_for': problem.stands_for,
        'duration_s': problem.duration,
        'discretisation_at_s': float(problem.times[early(problem)]),
        'discretised_by': problem.discretised_by,
        'reference': problem.reference_kind,
        'note': problem.note,
        'judged_by': judge.name,
        'sensitivity': chaos.as_dict(),
        'rungs': {
            name: {
                'model_error': judge.model_error(run),
                'converged_within': None if run.states is None else run.within,
            }
            for name, run in converged.items()
        },
    }


def _settings(problem: Problem, integrators: Sequence[str]) -> list[Setting]:
    names = known_integrators(integrators)
    return [Setting(*row) for row in itertools.product(problem.rungs, names, problem.timesteps)]


def _point(setting: Setting, trajectory: Trajectory) -> dict[str, Any]:
    at = trajectory.failed_at
    return {
        'rung': setting.rung,
        'integrator': setting.integrator,
        'timestep_s': setting.timestep,
        'status': 'failed' if trajectory.fault else 'ok',
        'fault': trajectory.fault,
        'failed_at_s': None if at is None else float(f'{at:.12g}'),
    }


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
