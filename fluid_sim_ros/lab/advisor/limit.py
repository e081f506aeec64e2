# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The timestep at which a setting fails: a limit of stability, found by bisection."""

from dataclasses import replace

from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.advisor.reference import Reference, outcome_of
from fluid_sim_ros.lab.advisor.search import Candidate
from fluid_sim_ros.lab.retimed import largest_timestep, run_retimed
from fluid_sim_ros.lab.stability.limits import bisect


class _NoTimeError(Exception):
    """The budget is spent."""


def with_limit(budgeted: BudgetedRuns, reference: Reference, candidate: Candidate) -> Candidate:
    """
    Return a candidate with the timestep from which on it fails.

    A run fails when it is not ``stable``, see ``reference.OUTCOMES``.

    Parameters
    ----------
    budgeted
        Whose problem and time it is.
    reference
        What runs are compared with.
    candidate
        Whose limit is wanted.

    Returns
    -------
    Candidate
        With ``fails_at`` [s], or how far was tried [s] where nothing fails.

    """
    problem, setting = budgeted.problem, candidate.setting
    rung = problem.rungs[setting.rung]
    most = largest_timestep(problem, rung)
    tried_to = setting.timestep

    def lasts(timestep: float) -> bool:
        nonlocal tried_to
        if timestep <= setting.timestep:  # it is a candidate because it does
            return True
        if not budgeted.left:
            raise _NoTimeError
        run = run_retimed(problem, rung, setting.integrator, timestep, most)
        good = outcome_of(reference, run) == 'stable'
        tried_to = max(tried_to, timestep) if good else tried_to
        return good

    if most <= setting.timestep:
        return replace(candidate, tried_to=tried_to)
    try:
        limit = bisect(lasts, setting.timestep, most)
    except _NoTimeError:
        return replace(candidate, tried_to=tried_to)
    if limit is None or limit >= most:
        return replace(candidate, tried_to=most)
    return replace(candidate, fails_at=limit)
