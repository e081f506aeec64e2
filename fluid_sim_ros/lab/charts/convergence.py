# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Converged runs of a problem's models, and the order at which integrators come near them."""

import math
import statistics
from collections.abc import Sequence
from typing import Any, NamedTuple

from fluid_sim_ros.lab.motion_errors import attitude_error, position_error
from fluid_sim_ros.lab.problems.problem import Problem, Setting, Trajectory, fits, run_rung
from fluid_sim_ros.physics.arrays import Array

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


class RunCache:
    """
    The runs of a problem, each made once (two threads may make the same one: no harm).

    Parameters
    ----------
    problem
        What is run.

    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self._trajectories: dict[Setting, Trajectory] = {}

    def __call__(self, setting: Setting) -> Trajectory:
        """
        Return the run of a setting.

        Parameters
        ----------
        setting
            Which run.

        Returns
        -------
        Trajectory
            The run.

        """
        if setting not in self._trajectories:
            rung = self.problem.rungs[setting.rung]
            self._trajectories[setting] = run_rung(self.problem, rung, *setting[1:])
        return self._trajectories[setting]


def converged_run(runs_of: RunCache, rung: str) -> Converged:
    """
    Run a rung by RK4 with smaller and smaller timesteps until it no longer changes.

    From 4 times the problem's finest timestep to half of it, at most.

    Parameters
    ----------
    runs_of
        Makes the runs.
    rung
        Name of the rung.

    Returns
    -------
    Converged
        The finest run that lasts, and its distance from the one before it.

    """
    problem = runs_of.problem
    finest = problem.timesteps[-1]
    first, *finer = [
        h for h in (4 * finest, 2 * finest, finest, finest / 2)
        if fits(problem.rungs[rung], h, problem.sample)
    ]  # fmt: skip
    coarse = runs_of(Setting(rung, 'RK4', first))
    found = Converged(None, math.inf)
    for timestep in finer:
        fine = runs_of(Setting(rung, 'RK4', timestep))
        if not (fine.fault or coarse.fault):
            apart = discretisation_error(problem, coarse.states, fine.states, early(problem))
            found = Converged(fine.states, apart)
            if apart < _CONVERGED:
                break
        coarse = fine
    return found


def early(problem: Problem) -> int:
    """
    Return the index of the time at which errors of the timestep are taken.

    Parameters
    ----------
    problem
        Whose compared times are meant.

    Returns
    -------
    int
        Index in ``problem.times``: a fifth of the run.

    """
    return max(1, round(EARLY * (len(problem.times) - 1)))


def discretisation_error(
    problem: Problem, states: Array, reference: Array, index: int = -1
) -> float:
    """
    Return the error by which convergence is judged, by default at the end.

    Parameters
    ----------
    problem
        Says which error counts: ``position_m`` or ``attitude_rad``.
    states, reference
        Two motions at the problem's times, shape (n, bodies, 13).
    index
        Which of the times.

    Returns
    -------
    float
        Largest error over the bodies [m] or [rad].

    """
    norm = attitude_error if problem.discretised_by == 'attitude_rad' else position_error
    return float(norm(states, reference)[index])


def orders(points: Sequence[dict[str, Any]], floors: dict[str, float]) -> dict[str, Any]:
    """
    Return the order of convergence in the timestep, per rung and integrator.

    Slope of log error over log timestep through the finest points that are clear of the converged
    run's own uncertainty.

    Parameters
    ----------
    points
        Points of a chart, with ``rung``, ``integrator``, ``timestep_s`` and ``discretisation``.
    floors
        Uncertainty of each rung's converged run [m] or [rad], by the rung's name.

    Returns
    -------
    dict
        Rung -> integrator -> order [-], None where too few points show it.

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
