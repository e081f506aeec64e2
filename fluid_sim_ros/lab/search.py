"""The search for settings that keep a tolerance, against the richest model's converged run."""

import itertools
import math
from dataclasses import dataclass, replace
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.measure import Report, Setting
from fluid_sim_ros.lab.metrics import Metric, metric
from fluid_sim_ros.lab.norms import Sensitivity, sensitivity
from fluid_sim_ros.lab.problem import Flight, Problem, fits, fly

#: The reference run must be known this much better than the tolerance.
_SURER = 5.0
_HALVINGS = 6
#: Timesteps tried: 1, 2, 5 times powers of ten [s].
LADDER = tuple(float(f'{digit}e{power}') for power in range(-2, -7, -1) for digit in (5, 2, 1))
#: RK4 first: where it does well, the others need not go to tiny steps.
_ORDER = ('RK4', 'implicitfast', 'discrete', 'implicit', 'Euler')
#: A candidate that needs so many times the evaluations of another one will not be chosen.
_DEARER = 2.0


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


def find_reference(
    problem: Problem, tolerance: float, metric_name: str, report: Report
) -> Reference:
    """Run the richest model by RK4, halving the step until the metric no longer changes."""
    richest = problem.rungs[problem.richest]
    within, chaos, coarse = math.inf, None, None
    own = float(richest.scene.compile().model.opt.timestep)
    first = max((h for h in problem.timesteps if h <= own), default=problem.timesteps[-1])
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


def search(
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


def with_limit(problem: Problem, reference: Reference, candidate: Candidate) -> Candidate:
    """Return a candidate with the timestep at which it fails, beyond those that fit the rate."""
    if candidate.fails_at is not None:
        return candidate
    setting = candidate.setting
    rung = problem.rungs[setting.rung]
    for timestep in reversed(LADDER):
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
