"""The advisor: the cheapest rung x integrator x timestep that is accurate enough for a scene."""

import itertools
import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.lab.measure import Report, Setting, conditions, cpu_per_second
from fluid_sim_ros.lab.metrics import METRICS, Metric, metric
from fluid_sim_ros.lab.norms import Sensitivity, sensitivity
from fluid_sim_ros.lab.problem import Flight, Problem, fits, fly, of_scene
from fluid_sim_ros.scene import Scene

#: The reference run must be known this much better than the tolerance.
_SURER = 5.0
_HALVINGS = 6
#: Timesteps tried: 1, 2, 5 times powers of ten [s].
_LADDER = tuple(float(f'{digit}e{power}') for power in range(-2, -7, -1) for digit in (5, 2, 1))
#: How far below the model's own timestep the search goes.
_FINEST_SHARE = 0.1
#: RK4 first: where it does well, the others need not go to tiny steps.
_ORDER = ('RK4', 'implicitfast', 'discrete', 'implicit', 'Euler')
#: A candidate that needs so many times the evaluations of another one will not be chosen.
_DEARER = 2.0
_REPEATS = 3
#: What the choice is compared with: everything on, RK4.
_BASELINE = 1e-3  # [s]


@dataclass(frozen=True)
class Reference:
    """The richest model's converged run, and how sure it is."""

    flight: Flight
    within: float  # metric between the last two refinements
    integrator: str
    timestep: float  # [s]
    sensitivity: Sensitivity
    metric_name: str
    metric: Metric


@dataclass(frozen=True)
class Candidate:
    """The largest timestep at which a rung and an integrator keep the tolerance."""

    setting: Setting
    error: float
    fails_at: float | None  # smallest timestep tried above at which the run is lost [s]


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
    reference = _reference(problem, tolerance, metric_name, report)
    candidates, refused = _search(problem, reference, tolerance, report)
    if reference.within > tolerance:
        candidates = []  # what they are compared with is not known well enough
    baseline = _baseline(problem, candidates)
    costs = _timed(problem, [each.setting for each in candidates] + [baseline], report)
    ranked = sorted(candidates, key=lambda each: costs[each.setting])
    ranked[:2] = [_with_limit(problem, reference, each) for each in ranked[:2]]
    return {
        'scene': problem.name,
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


def _baseline(problem: Problem, candidates: Sequence[Candidate]) -> Setting:
    """Return RK4 with everything on, at 1 ms or the largest step below at which it lasts."""
    fails = [
        each.fails_at
        for each in candidates
        if each.fails_at and each.setting[:2] == (problem.richest, 'RK4')
    ]
    limit = min([_BASELINE, *(0.99 * step for step in fails)])
    return Setting(problem.richest, 'RK4', max(h for h in (*_LADDER, 1e-7) if h <= limit))


def settings(advice: dict[str, Any]) -> dict[str, Any]:
    """Return the keys of a scene file that hold the choice."""
    choice = advice['choice']
    found = {'timestep': choice['timestep'], 'integrator': choice['integrator']}
    return found if choice['rung'] == 'scene' else found | {'fluid': choice['rung']}


def snippet(advice: dict[str, Any]) -> str:
    """Return the lines for the scene's YAML file."""
    choice = advice['choice']
    head = (
        f'# fluid_sim advise {advice["scene"]} --tolerance {advice["tolerance"]:g}: '
        f'error {choice["error"]:.2g} ({advice["metric"]})\n'
    )
    return head + ''.join(f'{key}: {value}\n' for key, value in settings(advice).items())


def _problem(scene: str | Scene, duration: float | None, rate: float) -> Problem:
    """Return the scene's problem with the timesteps that fit the rate, its events and gaits."""
    problem = of_scene(scene, duration)
    richest = problem.rungs[problem.richest]
    own = float(richest.scene.compile().model.opt.timestep)
    steps = tuple(h for h in _LADDER if h >= own * _FINEST_SHARE and fits(richest, h, 1 / rate))
    if not steps:
        raise ConfigError(f'{problem.name}: no timestep of 1, 2, 5 times a power of ten fits it')
    return replace(problem, timesteps=steps)


def _reference(problem: Problem, tolerance: float, metric_name: str, report: Report) -> Reference:
    """Run the richest model by RK4, halving the step until the metric no longer changes."""
    richest = problem.rungs[problem.richest]
    within, chaos, coarse = math.inf, None, None
    own = float(richest.scene.compile().model.opt.timestep)
    first = max(h for h in problem.timesteps if h <= own)
    for done, timestep in enumerate(first / 2**n for n in range(_HALVINGS + 1)):
        report(f'{problem.name}: reference', done, _HALVINGS + 1)
        fine = fly(problem, richest, 'RK4', timestep)
        if fine.fault:
            coarse = None
            continue
        if chaos is None:
            chaos = sensitivity(problem, 'RK4', timestep, fine)
            if chaos.chaotic:
                metric_name = 'regime'
        judge = metric(metric_name, problem, fine.states)
        if coarse is not None:
            within = judge(coarse.states, fine.states)
        coarse = fine
        if within < tolerance / _SURER:
            break
    report(f'{problem.name}: reference', 1, 1)
    if coarse is None or chaos is None:
        raise ConfigError(
            f'{problem.name}: the richest model by RK4 fails down to {timestep:g} s; '
            'nothing to compare with'
        )
    return Reference(coarse, within, 'RK4', timestep, chaos, metric_name, judge)


def _search(
    problem: Problem, reference: Reference, tolerance: float, report: Report
) -> tuple[list[Candidate], list[dict[str, Any]]]:
    """Return the candidates that keep the tolerance, and the best of those that do not."""
    found: list[Candidate] = []
    refused = []
    rungs = [rung for rung in problem.rungs if _worthwhile(problem, reference, tolerance, rung)]
    pairs = list(itertools.product(rungs, _ORDER))
    for done, (rung, integrator) in enumerate(pairs):
        report(f'{problem.name}: search', done, len(pairs))
        most = min((_evaluations(each.setting) for each in found), default=math.inf) * _DEARER
        candidate, best = _largest_step(problem, reference, tolerance, rung, integrator, most)
        if candidate is not None:
            found.append(candidate)
        elif best is not None:
            refused.append(best)
    report(f'{problem.name}: search', len(pairs), len(pairs))
    return found, refused


def _worthwhile(problem: Problem, reference: Reference, tolerance: float, rung: str) -> bool:
    """Return whether a rung's own error, without that of the timestep, is within the tolerance."""
    if rung == problem.richest:
        return True
    own = problem.timesteps[len(problem.timesteps) // 2]
    flight = fly(problem, problem.rungs[rung], reference.integrator, own)
    return _error(reference, flight) <= tolerance


def _evaluations(setting: Setting) -> float:
    """Return how often the forces are evaluated per simulated second."""
    return (4 if setting.integrator == 'RK4' else 1) / setting.timestep


def _largest_step(
    problem: Problem, reference: Reference, tolerance: float, rung: str, integrator: str,
    most: float,
) -> tuple[Candidate | None, dict[str, Any] | None]:  # fmt: skip
    """
    Return the largest timestep that keeps the tolerance, and the next smaller one keeps it too.

    Without one: the best error found. The search ends where a step would need more than ``most``
    evaluations.
    """
    fails_at: float | None = None
    held: tuple[float, float] | None = None
    errors: list[tuple[float, float]] = []  # error, timestep
    for timestep in problem.timesteps:
        setting = Setting(rung, integrator, timestep)
        if _evaluations(setting) > most:
            break
        error = _error(reference, fly(problem, problem.rungs[rung], integrator, timestep))
        errors.append((error, timestep))
        if error > tolerance:
            held = None
            fails_at = timestep if error >= 1 else fails_at
        elif held is not None or timestep == problem.timesteps[-1]:
            chosen, its_error = held or (timestep, error)
            return Candidate(Setting(rung, integrator, chosen), its_error, fails_at), None
        else:
            held = (timestep, error)
    if not errors:
        return None, None
    error, timestep = min(errors)
    return None, {
        'rung': rung, 'integrator': integrator, 'timestep': timestep, 'error': min(error, 1e300),
    }  # fmt: skip


def _with_limit(problem: Problem, reference: Reference, candidate: Candidate) -> Candidate:
    """Return a candidate with the timestep at which it fails, beyond those that fit the rate."""
    if candidate.fails_at is not None:
        return candidate
    setting = candidate.setting
    rung = problem.rungs[setting.rung]
    for timestep in reversed(_LADDER):
        if timestep <= problem.timesteps[0] or not fits(rung, timestep, problem.sample):
            continue
        if _error(reference, fly(problem, rung, setting.integrator, timestep)) >= 1:
            return replace(candidate, fails_at=timestep)
    return candidate


def _error(reference: Reference, flight: Flight) -> float:
    """Return the relative error of a run, inf where it was lost."""
    if flight.fault:
        return math.inf
    return reference.metric(flight.states, reference.flight.states)


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
        'margin': (fails_at or _LADDER[0]) / timestep,
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
