"""The advisor: the cheapest rung x integrator x timestep that is accurate enough for a scene."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.lab.budgeted_runs import BudgetedRuns, Setting
from fluid_sim_ros.lab.cost import Curve, Report, StepCost, step_costs
from fluid_sim_ros.lab.manoeuvre import judged_part
from fluid_sim_ros.lab.measure import conditions
from fluid_sim_ros.lab.metrics import METRICS, metric
from fluid_sim_ros.lab.pareto import tie
from fluid_sim_ros.lab.problems.problem import Problem, fits, of_scene, run_rung
from fluid_sim_ros.lab.reference import Reference, find_reference
from fluid_sim_ros.lab.search import LADDER, Candidate, search, with_limit
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
    report: Report = lambda what, done, total: None,
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

    Raises
    ------
    ConfigError
        For wrong input, a scene in which nothing happens, or one of which no run lasts.

    """
    _check(tolerance, metric_name, rate, budget)
    problem = _problem(scene, duration, rate)
    own = float(problem.rungs[problem.richest].scene.compile().model.opt.timestep)
    first = max((h for h in problem.timesteps if h <= own), default=problem.timesteps[-1])
    judged = judged_part(problem, first)
    problem = replace(problem, duration=judged.duration)
    budgeted = BudgetedRuns(problem, budget)
    reference = find_reference(budgeted, first, tolerance, metric_name, report)
    candidates: list[Candidate] = []
    refused: list[dict[str, Any]] = []
    if reference.known(tolerance):
        candidates, refused = search(budgeted, reference, tolerance, report)
    baseline = _baseline(problem, candidates)
    costs = _costs(problem, [each.setting for each in candidates] + [baseline], report)
    ranked = _ranked(candidates, costs, list(problem.rungs))
    ranked[:2] = [with_limit(budgeted, reference, each) for each in ranked[:2]]
    described = [_described(each, costs) for each in ranked]
    its_cost = _cost(costs, baseline)
    return {
        'scene': problem.name,
        'command': _command(scene, tolerance, duration, metric_name, rate),
        'tolerance': tolerance,
        'metric': reference.metric_name,
        'duration_s': problem.duration,
        'note': judged.note,
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


def verify(scene: str | Scene, advice: dict[str, Any]) -> dict[str, Any]:
    """Compare the choice with a run of a fourth of its step and the next richer rung."""
    choice = advice['choice']
    problem = _problem(scene, advice['duration_s'], advice['rate_hz'])
    rungs = list(problem.rungs)
    richer = rungs[min(rungs.index(choice['rung']) + 1, len(rungs) - 1)]
    chosen = run_rung(
        problem, problem.rungs[choice['rung']], choice['integrator'], choice['timestep']
    )
    finer = run_rung(problem, problem.rungs[richer], choice['integrator'], choice['timestep'] / 4)
    lost = chosen.fault or finer.fault
    error = math.inf
    if not lost:
        error = metric(advice['metric'], problem, finer.states)(chosen.states, finer.states)
    return {
        'rung': richer, 'timestep': choice['timestep'] / 4, 'fault': lost,
        'error': error if math.isfinite(error) else None, 'within': error <= advice['tolerance'],
    }  # fmt: skip


def settings(advice: dict[str, Any]) -> dict[str, Any]:
    """Return the keys of a scene file that hold the choice."""
    choice = advice['choice']
    found = {'timestep': choice['timestep'], 'integrator': choice['integrator']}
    return found if choice['rung'] == 'scene' else found | {'fluid': choice['rung']}


def comment(advice: dict[str, Any]) -> str:
    """
    Return one line on where the choice comes from.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    str
        The command, and the relative error of what it chose.

    """
    return f'{advice["command"]}: error {advice["choice"]["error"]:.2g} ({advice["metric"]})'


def snippet(advice: dict[str, Any]) -> str:
    """
    Return the lines that put the choice in force in the scene's YAML file.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    str
        A comment and the keys of ``settings``.

    """
    lines = [f'{key}: {value}\n' for key, value in settings(advice).items()]
    return ''.join([f'# {comment(advice)}\n', *lines])


def advised(advice: dict[str, Any]) -> dict[str, Any]:
    """
    Return the advised settings that the scene's YAML file can keep.

    Parameters
    ----------
    advice
        As ``advise`` returns it, with a choice.

    Returns
    -------
    dict
        The fields of ``schema.advised.Advised``.

    """
    return {
        'command': advice['command'],
        'tolerance': advice['tolerance'],
        'metric': advice['metric'],
        'error': float(f'{advice["choice"]["error"]:.2g}'),
        **settings(advice),
    }


def _check(tolerance: float, metric_name: str, rate: float, budget: float) -> None:
    if not 0 < tolerance < 1:
        raise ConfigError(f'tolerance {tolerance:g}: must be above 0 and below 1 (0.01 is 1 %)')
    if metric_name not in METRICS:
        raise ConfigError(f"metric '{metric_name}' is not known; allowed: {listed(METRICS)}")
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


def _problem(scene: str | Scene, duration: float | None, rate: float) -> Problem:
    """Return the scene's problem with the timesteps that fit the rate, its events and gaits."""
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
