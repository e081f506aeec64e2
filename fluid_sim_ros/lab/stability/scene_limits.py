# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the integration of a scene fails: error over timestep, and the largest one that lasts."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.advisor.reference import Reference, find_reference, outcome_of
from fluid_sim_ros.lab.manoeuvre import first_timestep, judged
from fluid_sim_ros.lab.parallel import run_parallel
from fluid_sim_ros.lab.problems.problem import INTEGRATORS, Problem, known_integrators
from fluid_sim_ros.lab.results import conditions
from fluid_sim_ros.lab.retimed import largest_timestep, run_retimed
from fluid_sim_ros.lab.stability.limits import bisect
from fluid_sim_ros.output.progress import Report, silent

#: How well the reference should be known, as a tolerance of the advisor's.
_TOLERANCE = 0.05
#: Where no range is given, timesteps begin this factor below the largest one.
_DECADES = 100.0


def scene_limits(
    problem: Problem,
    *,
    timesteps: Sequence[float] = (),
    cells: int = 24,
    integrators: Sequence[str] = INTEGRATORS,
    metric_name: str = 'pose',
    report: Report = silent,
) -> dict[str, Any]:
    """
    Return what becomes of a scene's manoeuvre at each timestep, by each integrator.

    Parameters
    ----------
    problem
        That a scene is; its own model is run.
    timesteps
        Smallest and largest one [s]; empty: two decades up to the largest that the scene allows.
    cells
        Number of timesteps.
    integrators
        Names of integrators, in any case.
    metric_name
        One of METRICS, by which errors are measured.
    report
        Told how far it is.

    Returns
    -------
    dict
        ``map``: rows with ``integrator``, ``timestep_s``, ``outcome`` and relative ``error``;
        ``largest_steps``: rows with ``integrator`` and ``largest_s`` [s] (None: fails at all);
        and what they were compared with.

    Raises
    ------
    ConfigError
        For a range that is not rising or beyond what the scene allows, or a scene in which
        nothing can be judged.

    """
    names = known_integrators(integrators)
    if cells < 1:
        raise ConfigError(f'{cells} cells: must be at least 1')
    problem = judged(problem)
    rung = problem.rungs[problem.richest]
    most = largest_timestep(problem, rung)
    low, high = timesteps or (most / _DECADES, most)
    if not 0 < low < high <= most * (1 + 1e-9):
        raise ConfigError(
            f'range of timesteps: {low:g} {high:g}; allowed: 0 < low < high <= {most:g} s, which '
            "divides the scene's events and samples"
        )
    budgeted = BudgetedRuns(problem, math.inf)
    reference = find_reference(budgeted, first_timestep(problem), _TOLERANCE, metric_name, report)
    steps = [float(f'{step:.4g}') for step in np.geomspace(low, high, cells)]

    def cell(key: tuple[str, float]) -> dict[str, Any]:
        return _cell(problem, reference, *key, most)

    keys = [(name, step) for name in names for step in sorted(steps)]
    cheap_last = sorted(keys, key=lambda key: key[1])
    rows = run_parallel(cell, cheap_last, f'{problem.name}: map', report)
    rows.sort(key=lambda row: keys.index((row['integrator'], row['timestep_s'])))
    limits = run_parallel(
        lambda name: {'integrator': name, 'largest_s': _limit(
            problem, reference, name, [row for row in rows if row['integrator'] == name], most
        )},
        names, f'{problem.name}: bisection', report,
    )  # fmt: skip
    return {
        'problem': problem.name, 'title': problem.title, 'duration_s': problem.duration,
        'note': problem.note, 'metric': reference.metric_name, 'integrators': list(names),
        'reference': {
            'integrator': reference.setting.integrator,
            'timestep_s': reference.setting.timestep,
            'within': reference.within if math.isfinite(reference.within) else None,
        },
        'map': rows, 'largest_steps': limits, 'conditions': conditions(),
    }  # fmt: skip


def _cell(
    problem: Problem, reference: Reference, integrator: str, timestep: float, most: float
) -> dict[str, Any]:
    rung = problem.rungs[problem.richest]
    run = run_retimed(problem, rung, integrator, min(timestep, most), most)
    error = reference.error(run)
    word = outcome_of(reference, run)
    return {
        'integrator': integrator, 'timestep_s': timestep, 'outcome': word,
        'error': error if math.isfinite(error) else None, 'fault': run.fault,
    }  # fmt: skip


def _limit(
    problem: Problem,
    reference: Reference,
    integrator: str,
    rows: Sequence[Mapping[str, Any]],
    most: float,
) -> float | None:
    """Return the largest timestep up to which the runs of the map, and those between, last."""
    stable = [row['timestep_s'] for row in rows if row['outcome'] == 'stable']
    failed = [row['timestep_s'] for row in rows if row['outcome'] != 'stable']
    good = [step for step in stable if step < min(failed, default=math.inf)]
    if not good:
        return None
    if not failed:
        return float(max(good))

    def lasts(timestep: float) -> bool:
        known = timestep <= max(good)
        return known or bool(
            _cell(problem, reference, integrator, timestep, most)['outcome'] == 'stable'
        )

    return bisect(lasts, max(good), min(failed))
