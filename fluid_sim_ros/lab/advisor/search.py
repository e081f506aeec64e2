# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The search for settings that keep a tolerance, against the richest model's converged run."""

import itertools
import math
from dataclasses import dataclass
from typing import Any

from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.advisor.envelope import Envelope
from fluid_sim_ros.lab.advisor.reference import Reference
from fluid_sim_ros.lab.problems.problem import Setting
from fluid_sim_ros.output.progress import Report

#: Timesteps tried: 1, 2, 5 times powers of ten [s].
LADDER = tuple(float(f'{digit}e{power}') for power in range(-2, -7, -1) for digit in (5, 2, 1))
#: RK4 first: where it does well, the others need not go to tiny steps.
_ORDER = ('RK4', 'implicitfast', 'discrete', 'implicit', 'Euler')
#: A candidate that needs so many times the evaluations of another one will not be chosen.
_DEARER = 2.0
_NO_TIME = 'the time budget ends before this run'


@dataclass(frozen=True)
class Candidate:
    """The largest timestep at which a rung and an integrator keep the tolerance."""

    setting: Setting
    error: float
    fails_at: float | None = None  # limit of stability [s]
    tried_to: float = 0.0  # largest timestep that is known to last [s]


def search(
    budgeted: BudgetedRuns, reference: Reference, tolerance: float, report: Report
) -> tuple[list[Candidate], list[dict[str, Any]]]:
    """
    Return the candidates that keep the tolerance, and the best of those that do not.

    From the largest timestep down on every rung by every integrator, the poorest rung first. A
    rung whose own error is beyond the tolerance is left out, and so is what needs clearly more
    evaluations of the forces than a setting that is found.

    Parameters
    ----------
    budgeted
        Makes the runs.
    reference
        What they are compared with.
    tolerance
        Relative error to keep [-].
    report
        Told how far it is.

    Returns
    -------
    candidates, refused
        One candidate per rung and integrator that keeps the tolerance; of the others the best
        setting, as rows.

    """
    problem = budgeted.problem
    found: list[Candidate] = []
    refused = []
    beside = Envelope(budgeted, reference)
    rungs = [
        rung for rung in problem.rungs if _worthwhile(budgeted, reference, beside, tolerance, rung)
    ]
    pairs = list(itertools.product(rungs, _ORDER))
    for done, (rung, integrator) in enumerate(pairs):
        report(f'{problem.name}: search', done, len(pairs))
        most = min((each.setting.evaluations for each in found), default=math.inf) * _DEARER
        candidate, best = _largest_step(budgeted, reference, tolerance, rung, integrator, most)
        if candidate is not None:
            found.append(candidate)
        elif best is not None:
            refused.append(best)
    report(f'{problem.name}: search', len(pairs), len(pairs))
    return found, refused


def _worthwhile(
    budgeted: BudgetedRuns,
    reference: Reference,
    beside: Envelope,
    tolerance: float,
    rung: str,
) -> bool:
    """Return whether a rung's own error, without that of the timestep, is within the tolerance."""
    if rung == budgeted.problem.richest:
        return True
    trajectory = budgeted.run(reference.setting._replace(rung=rung))
    if trajectory is None:
        budgeted.leave_out(rung, '', None, _NO_TIME)
        return False
    error = reference.error(trajectory)
    if error > tolerance:
        own = f'is {error:.2g}' if math.isfinite(error) else f'cannot be told: {trajectory.fault}'
        budgeted.leave_out(rung, '', None, f"the model's own error {own}")
        return False
    why = beside.fault(rung, tolerance)
    if why:
        budgeted.leave_out(rung, '', None, why)
    return not why


def _largest_step(
    budgeted: BudgetedRuns, reference: Reference, tolerance: float, rung: str, integrator: str,
    most: float,
) -> tuple[Candidate | None, dict[str, Any] | None]:  # fmt: skip
    """
    Return the largest timestep that keeps the tolerance, and the next smaller one keeps it too.

    Without one: the best error found. The search ends where a step would need more than ``most``
    evaluations.
    """
    timesteps = budgeted.problem.timesteps
    held: tuple[float, float] | None = None
    errors: list[tuple[float, float]] = []  # error, timestep
    for timestep in timesteps:
        setting = Setting(rung, integrator, timestep)
        if setting.evaluations > most and held is None:
            why = f'more than {_DEARER:g} times the evaluations of a setting that is found'
            budgeted.leave_out(*setting, why)
            break
        trajectory = budgeted.run(setting)
        if trajectory is None:
            budgeted.leave_out(*setting, _NO_TIME)
            break
        error = reference.error(trajectory)
        budgeted.note(setting, trajectory, error)
        errors.append((error, timestep))
        if error > tolerance - reference.within:
            held = None
        elif held is not None or timestep == timesteps[-1]:
            chosen, its_error = held or (timestep, error)
            return Candidate(Setting(rung, integrator, chosen), its_error), None
        else:
            held = (timestep, error)
    if not errors:
        return None, None
    error, timestep = min(errors)
    return None, {
        'rung': rung, 'integrator': integrator, 'timestep': timestep,
        'error': error if math.isfinite(error) else None,
    }  # fmt: skip
