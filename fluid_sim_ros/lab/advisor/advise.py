# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The advisor: the cheapest rung x integrator x timestep that is accurate enough for a scene."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.advisor.limit import with_limit
from fluid_sim_ros.lab.advisor.reference import Reference, find_reference
from fluid_sim_ros.lab.advisor.search import LADDER, Candidate, search
from fluid_sim_ros.lab.charts.cost import Curve, StepCost, step_costs
from fluid_sim_ros.lab.charts.pareto import tie
from fluid_sim_ros.lab.manoeuvre import first_timestep, judged
from fluid_sim_ros.lab.metrics import check_metric
from fluid_sim_ros.lab.problems.from_scene import of_scene
from fluid_sim_ros.lab.problems.problem import Problem, Setting, fits
from fluid_sim_ros.lab.results import conditions
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.scene import Scene

#: How far below the model's own timestep the search goes.
_FINEST_SHARE = 0.1
#: What the choice is compared with: everything on, RK4.
_BASELINE = 1e-3  # [s]
#: The tie factor of the choice lies in this range.
_TIE_RANGE = (1.05, 1.35)
#: Time for runs [s], without the seconds in which costs are measured.
BUDGET = 50.0

Costs = Mapping[Curve, StepCost]


def advise(
    scene: str | Scene,
    tolerance: float,
    *,
    duration: float | None = None,
    metric_name: str = 'pose',
    rate: float = 100.0,
    budget: float = BUDGET,
    report: Report = silent,
) -> dict[str, Any]:
    """
    Return the advice for a scene as data, ready for JSON.

    Parameters
    ----------
    scene
        Name, path, or ``Scene``; its own manoeuvre is run, until a vehicle touches the ground.
    tolerance
        Largest relative error against the richest model's converged run, see ``metrics``.
    duration
        Simulated time [s]; default: the scene's.
    metric_name
        One of METRICS; a chaotic motion of which refinements do not agree is judged by ``regime``.
    rate
        The timestep must divide its period: of control and outputs [Hz].
    budget
        Time for runs [s]; what it leaves out is said.
    report
        Told how far it is.

    Returns
    -------
    dict
        The choice and the other candidates, what was tried, refused and left out, the reference
        they are compared with, and what costs depend on.

    Raises
    ------
    ConfigError
        For wrong input, a scene in which nothing happens, or one of which no run lasts.

    """
    _check(tolerance, metric_name, rate, budget)
    problem = scene_problem(scene, duration, rate)
    report(f'{problem.name}: manoeuvre', 0, 1)
    problem = judged(problem)
    report(f'{problem.name}: manoeuvre', 1, 1)
    budgeted = BudgetedRuns(problem, budget)
    first = first_timestep(problem)
    reference = find_reference(budgeted, first, tolerance, metric_name, report)
    candidates: list[Candidate] = []
    refused: list[dict[str, Any]] = []
    if reference.known(tolerance):
        candidates, refused = search(budgeted, reference, tolerance, report)
    baseline = _baseline(problem, candidates)
    costs = _costs(problem, [each.setting for each in candidates] + [baseline], report)
    ranked = _ranked(candidates, costs, list(problem.rungs))
    for place, each in enumerate(ranked):
        report(f'{problem.name}: limits', place, len(ranked))
        ranked[place] = with_limit(budgeted, reference, each)
    report(f'{problem.name}: limits', len(ranked), len(ranked))
    described = [_described(each, costs) for each in ranked]
    its_cost = _cost(costs, baseline)
    return {
        'scene': problem.name,
        'command': _command(scene, tolerance, duration, metric_name, rate),
        'tolerance': tolerance,
        'metric': reference.metric_name,
        'duration_s': problem.duration,
        'asked_duration_s': duration,
        'note': problem.note,
        'excitation': problem.excitation,
        'rate_hz': rate,
        'reference': {
            'integrator': reference.setting.integrator,
            'timestep_s': reference.setting.timestep,
            'within': reference.within if math.isfinite(reference.within) else None,
            'refinements': reference.refinements,
            **reference.sensitivity.as_dict(),
        },
        'choice': described[0] if ranked else None,
        'runner_up': described[1] if len(ranked) > 1 else None,
        'candidates': described,
        'refused': refused,
        'tried': budgeted.tried,
        'not_tried': budgeted.not_tried,
        'baseline': {**baseline._asdict(), **its_cost},
        'cheaper_than_baseline': (
            its_cost['cpu_us_per_s'] / described[0]['cpu_us_per_s'] if ranked else None
        ),
        'missing': '' if ranked else _missing(budgeted, refused, reference, tolerance),
        'conditions': conditions(),
    }


def _check(tolerance: float, metric_name: str, rate: float, budget: float) -> None:
    if not 0 < tolerance < 1:
        raise ConfigError(f'tolerance {tolerance:g}: must be above 0 and below 1 (0.01 is 1 %)')
    check_metric(metric_name)
    for name, value, unit in (('rate', rate, 'Hz'), ('budget', budget, 's')):
        if not 0 < value < math.inf:
            raise ConfigError(f'{name} {value:g} {unit}: must be finite and above 0')


def _command(
    scene: str | Scene, tolerance: float, duration: float | None, metric_name: str, rate: float
) -> str:
    named = scene.name if isinstance(scene, Scene) else scene
    command = f'fluid_sim advise {named} --tolerance {tolerance:g}'
    if duration is not None:
        command += f' --duration {duration:g}'
    if metric_name != 'pose':
        command += f' --metric {metric_name}'
    return command if rate == 100 else f'{command} --rate {rate:g}'


def scene_problem(scene: str | Scene, duration: float | None, rate: float) -> Problem:
    """
    Return the scene's problem with the timesteps that fit the rate, its events and gaits.

    Parameters
    ----------
    scene
        Name, path, or ``Scene``.
    duration
        Simulated time [s]; None: the scene's.
    rate
        The timestep must divide its period [Hz].

    Returns
    -------
    Problem
        The problem, with timesteps down to a tenth of the model's own.

    Raises
    ------
    ConfigError
        For a duration that is not finite and above 0, or if no timestep fits.

    """
    if duration is not None and not 0 < duration < math.inf:
        raise ConfigError(f'duration {duration:g} s: must be finite and above 0')
    problem = of_scene(scene, duration)
    richest = problem.rungs[problem.richest]
    own = float(richest.scene.compile().model.opt.timestep)
    steps = tuple(
        h for h in LADDER if h >= 0.999 * own * _FINEST_SHARE and fits(richest, h, 1 / rate)
    )
    if not steps:
        raise ConfigError(
            f'{problem.name}: no timestep of 1, 2, 5 times a power of ten fits it and a rate of '
            f'{rate:g} Hz'
        )
    return replace(problem, timesteps=steps)


def _baseline(problem: Problem, candidates: Sequence[Candidate]) -> Setting:
    """Return RK4 with everything on, at 1 ms or the largest step below that is good enough."""
    richest = problem.rungs[problem.richest]
    good = [
        each.setting.timestep
        for each in candidates
        if each.setting[:2] == (problem.richest, 'RK4')
    ]
    most = min([_BASELINE, *good])
    fitting = (h for h in (*LADDER, 1e-7) if h <= most and fits(richest, h, problem.sample))
    return Setting(problem.richest, 'RK4', max(fitting, default=problem.timesteps[-1]))


def _costs(problem: Problem, settings: Sequence[Setting], report: Report) -> Costs:
    at = {Curve(*setting[:2]): setting.timestep for setting in reversed(settings)}
    return step_costs(problem, at, report=report)


def _cost(costs: Costs, setting: Setting) -> dict[str, float]:
    found = costs[Curve(*setting[:2])].per_second(setting.timestep)
    return {key: found[key] for key in ('cpu_us_per_s', 'wall_us_per_s')}


def _ranked(
    candidates: Sequence[Candidate], costs: Costs, rungs: Sequence[str]
) -> list[Candidate]:
    """Return the candidates, cheapest first; of equal costs, the poorest model, then the best."""
    price = {each.setting: _cost(costs, each.setting)['cpu_us_per_s'] for each in candidates}
    left, out = list(candidates), []
    while left:
        least = min(price[each.setting] for each in left)
        over = {each.setting: price[each.setting] / least for each in left}
        same = tie(over.values(), _TIE_RANGE).factor
        equal = [each for each in left if over[each.setting] < same]
        out.append(min(equal, key=lambda each: (rungs.index(each.setting.rung), each.error)))
        left.remove(out[-1])
    return out


def _described(candidate: Candidate, costs: Costs) -> dict[str, Any]:
    timestep, fails_at = candidate.setting.timestep, candidate.fails_at
    return {
        **candidate.setting._asdict(),
        'error': candidate.error,
        **_cost(costs, candidate.setting),
        'fails_at_s': fails_at,
        'tried_to_s': candidate.tried_to,
        'margin': (fails_at or max(candidate.tried_to, timestep)) / timestep,
        'margin_is_a_bound': fails_at is None,
    }


def _missing(
    budgeted: BudgetedRuns,
    refused: Sequence[dict[str, Any]],
    reference: Reference,
    tolerance: float,
) -> str:
    """Return one line on what stands between the scene and the tolerance."""
    late = any('budget' in row['why'] for row in budgeted.not_tried)
    more = ', or a larger --budget' if late else ''
    setting = reference.setting
    if not reference.known(tolerance):
        within = f'to {reference.within:.2g} only' if math.isfinite(reference.within) else 'once'
        return (
            f'the richest model is known {within} ({setting.integrator}, {setting.timestep:g} s); '
            f'give a larger tolerance, or a shorter --duration{more}'
        )
    tried = [row for row in refused if row['error'] is not None]
    if not tried:
        return f'no run lasts on the timesteps tried; give a smaller --rate{more}'
    best = min(tried, key=lambda row: float(row['error']))
    return (
        f'the closest is {best["rung"]} by {best["integrator"]} at {best["timestep"]:g} s with '
        f'{best["error"]:.2g}: a timestep below {budgeted.problem.timesteps[-1]:g} s is '
        f'needed{more}'
    )
