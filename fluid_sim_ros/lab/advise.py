"""The advisor: the cheapest rung x integrator x timestep that is accurate enough for a scene."""

import math
import statistics
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.lab.measure import Report, Setting, conditions, cpu_per_second
from fluid_sim_ros.lab.metrics import METRICS, metric
from fluid_sim_ros.lab.pareto import SAME_TIME
from fluid_sim_ros.lab.problem import Problem, fits, fly, of_scene
from fluid_sim_ros.lab.search import (
    LADDER,
    Candidate,
    Reference,
    find_reference,
    search,
    with_limit,
)
from fluid_sim_ros.scene import Scene

#: How far below the model's own timestep the search goes.
_FINEST_SHARE = 0.1
_REPEATS = 3
#: What the choice is compared with: everything on, RK4.
_BASELINE = 1e-3  # [s]


def advise(
    scene: str | Scene,
    tolerance: float,
    *,
    duration: float | None = None,
    metric_name: str = 'pose',
    rate: float = 100.0,
    report: Report = lambda what, done, total: None,
) -> dict[str, Any]:
    """
    Return the advice for a scene as data, ready for JSON.

    Parameters
    ----------
    scene
        Name, path, or ``Scene``; its own manoeuvre is run.
    tolerance
        Largest relative error against the richest model's converged run, see ``metrics``.
    duration
        Simulated time [s]; default: the scene's.
    metric_name
        One of METRICS; a chaotic motion is judged by ``regime`` whatever this says.
    rate
        The timestep must divide its period: of control and outputs [Hz].

    Raises
    ------
    ConfigError
        For wrong input, or a scene of which no run lasts.

    """
    if not 0 < tolerance < 1:
        raise ConfigError(f'tolerance {tolerance:g}: must be above 0 and below 1 (0.01 is 1 %)')
    if metric_name not in METRICS:
        raise ConfigError(f"metric '{metric_name}' is not known; allowed: {listed(METRICS)}")
    problem = _problem(scene, duration, rate)
    reference = find_reference(problem, tolerance, metric_name, report)
    named = scene.name if isinstance(scene, Scene) else scene
    candidates, refused = search(problem, reference, tolerance, report)
    if reference.within > tolerance:
        candidates = []  # what they are compared with is not known well enough
    baseline = _baseline(problem, candidates)
    costs = _timed(problem, [each.setting for each in candidates] + [baseline], report)
    ranked = _ranked(candidates, costs, list(problem.rungs))
    ranked[:2] = [with_limit(problem, reference, each) for each in ranked[:2]]
    return {
        'scene': problem.name,
        'command': f'fluid_sim advise {named} --tolerance {tolerance:g}'
        + (f' --duration {duration:g}' if duration is not None else ''),
        'tolerance': tolerance,
        'metric': reference.metric_name,
        'duration_s': problem.duration,
        'rate_hz': rate,
        'reference': {
            'integrator': reference.integrator,
            'timestep_s': reference.timestep,
            'within': reference.within,
            **reference.sensitivity.as_dict(),
        },
        'choice': _described(ranked[0], costs, problem) if ranked else None,
        'runner_up': _described(ranked[1], costs, problem) if len(ranked) > 1 else None,
        'candidates': [_described(each, costs, problem) for each in ranked],
        'refused': refused,
        'baseline': {**baseline._asdict(), 'cpu_us_per_s': costs[baseline]},
        'cheaper_than_baseline': costs[baseline] / costs[ranked[0].setting] if ranked else None,
        'missing': '' if ranked else _missing(refused, reference, tolerance),
        'conditions': conditions(),
    }


def verify(scene: str | Scene, advice: dict[str, Any]) -> dict[str, Any]:
    """Compare the choice with a run of a fourth of its step and the next richer rung."""
    choice = advice['choice']
    problem = _problem(scene, advice['duration_s'], advice['rate_hz'])
    rungs = list(problem.rungs)
    richer = rungs[min(rungs.index(choice['rung']) + 1, len(rungs) - 1)]
    chosen = fly(problem, problem.rungs[choice['rung']], choice['integrator'], choice['timestep'])
    finer = fly(problem, problem.rungs[richer], choice['integrator'], choice['timestep'] / 4)
    lost = chosen.fault or finer.fault
    error = math.inf
    if not lost:
        error = metric(advice['metric'], problem, finer.states)(chosen.states, finer.states)
    return {'rung': richer, 'error': error, 'within': error <= advice['tolerance'], 'fault': lost}


def _ranked(
    candidates: Sequence[Candidate], costs: dict[Setting, float], rungs: Sequence[str]
) -> list[Candidate]:
    """Return the candidates, cheapest first; of equal costs, the poorest model, then the best."""
    left, out = list(candidates), []
    while left:
        limit = SAME_TIME * min(costs[each.setting] for each in left)
        equal = [each for each in left if costs[each.setting] <= limit]
        out.append(min(equal, key=lambda each: (rungs.index(each.setting.rung), each.error)))
        left.remove(out[-1])
    return out


def _baseline(problem: Problem, candidates: Sequence[Candidate]) -> Setting:
    """Return RK4 with everything on, at 1 ms or the largest step below at which it lasts."""
    fails = [
        each.fails_at
        for each in candidates
        if each.fails_at and each.setting[:2] == (problem.richest, 'RK4')
    ]
    limit = min([_BASELINE, *(0.99 * step for step in fails)])
    return Setting(problem.richest, 'RK4', max(h for h in (*LADDER, 1e-7) if h <= limit))


def settings(advice: dict[str, Any]) -> dict[str, Any]:
    """Return the keys of a scene file that hold the choice."""
    choice = advice['choice']
    found = {'timestep': choice['timestep'], 'integrator': choice['integrator']}
    return found if choice['rung'] == 'scene' else found | {'fluid': choice['rung']}


def snippet(advice: dict[str, Any]) -> str:
    """Return the lines for the scene's YAML file."""
    choice = advice['choice']
    head = f'# {advice["command"]}: error {choice["error"]:.2g} ({advice["metric"]})\n'
    return head + ''.join(f'{key}: {value}\n' for key, value in settings(advice).items())


def _problem(scene: str | Scene, duration: float | None, rate: float) -> Problem:
    """Return the scene's problem with the timesteps that fit the rate, its events and gaits."""
    problem = of_scene(scene, duration)
    richest = problem.rungs[problem.richest]
    own = float(richest.scene.compile().model.opt.timestep)
    steps = tuple(h for h in LADDER if h >= own * _FINEST_SHARE and fits(richest, h, 1 / rate))
    if not steps:
        raise ConfigError(f'{problem.name}: no timestep of 1, 2, 5 times a power of ten fits it')
    return replace(problem, timesteps=steps)


def _timed(problem: Problem, settings: Sequence[Setting], report: Report) -> dict[Setting, float]:
    """Return the median processor time per simulated second [us/s], repeats interleaved."""
    rows: dict[Setting, list[float]] = {setting: [] for setting in settings}
    for repeat in range(_REPEATS):
        for done, setting in enumerate(rows):
            report(
                f'{problem.name}: processor time', repeat * len(rows) + done, _REPEATS * len(rows)
            )
            rows[setting].append(cpu_per_second(problem, setting))
    report(f'{problem.name}: processor time', 1, 1)
    return {setting: statistics.median(times) for setting, times in rows.items()}


def _described(
    candidate: Candidate, costs: dict[Setting, float], problem: Problem
) -> dict[str, Any]:
    timestep, fails_at = candidate.setting.timestep, candidate.fails_at
    return {
        **candidate.setting._asdict(),
        'error': candidate.error,
        'cpu_us_per_s': costs[candidate.setting],
        'fails_at_s': fails_at,
        'margin': (fails_at or LADDER[0]) / timestep,
        'margin_is_a_bound': fails_at is None,
    }


def _missing(refused: Sequence[dict[str, Any]], reference: Reference, tolerance: float) -> str:
    """Return one line on what stands between the scene and the tolerance."""
    if reference.within > tolerance:
        return (
            f'the richest model is known to {reference.within:.2g} only '
            f'(RK4, {reference.timestep:g} s); give a larger tolerance or a shorter --duration'
        )
    best = min(refused, key=lambda row: float(row['error']))
    return (
        f'the closest is {best["rung"]} by {best["integrator"]} at {best["timestep"]:g} s with '
        f'{best["error"]:.2g}: a smaller timestep than {reference.timestep:g} s is needed'
    )
