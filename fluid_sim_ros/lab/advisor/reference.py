# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The converged run of a scene's richest model, which the advisor compares with."""

import math
from dataclasses import dataclass
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.metrics import Metric, metric
from fluid_sim_ros.lab.motion_errors import Sensitivity, runs_away, sensitivity
from fluid_sim_ros.lab.problems.problem import Problem, Setting, Trajectory
from fluid_sim_ros.output.progress import Report

#: What can become of a run, in the order of gravity. ``wrong``: its error is half as large as the
#: motion, or larger; ``blow-up``: a body moves or turns far faster than it should; ``lost``: the
#: watchdog ended it.
OUTCOMES = ('stable', 'wrong', 'blow-up', 'lost')
WRONG = 0.5
#: RK4 converges fastest; where it fails (stiff drag), a method that stays bounded.
_INTEGRATORS = ('RK4', 'implicitfast')
_HALVINGS = 6
#: Shares of the tolerance to which the reference should be known, and must be.
_WANTED, _ENOUGH = 0.1, 0.4
#: A run of so many steps is not refined further once it is known well enough.
_LONG = 50_000
#: The reference takes at most this share of the time left for its next run.
_SHARE = 0.4


@dataclass(frozen=True)
class Reference:
    """
    The richest model's converged run, and how sure it is.

    ``within`` is the metric between the last two refinements: a bound of the run's own error for
    every method that converges, which is why ``sure`` settings keep the tolerance less this.
    """

    trajectory: Trajectory
    within: float
    setting: Setting
    sensitivity: Sensitivity
    metric_name: str
    metric: Metric
    refinements: list[dict[str, Any]]

    def known(self, tolerance: float) -> bool:
        """
        Return whether the run is known well enough to judge by.

        Parameters
        ----------
        tolerance
            Relative error that settings are asked to keep [-].

        Returns
        -------
        bool
            Whether what the run does not know is a small part of that.

        """
        return self.within <= _ENOUGH * tolerance

    def error(self, trajectory: Trajectory) -> float:
        """
        Return the relative error of a run, inf where it was lost.

        Parameters
        ----------
        trajectory
            Another run of the problem.

        Returns
        -------
        float
            Its relative error [-]; inf where it was lost.

        """
        return (
            math.inf
            if trajectory.fault
            else self.metric(trajectory.states, self.trajectory.states)
        )


def outcome_of(reference: Reference, trajectory: Trajectory) -> str:
    """
    Return what becomes of a run, as one of OUTCOMES.

    Parameters
    ----------
    reference
        What it is compared with.
    trajectory
        The run.

    Returns
    -------
    str
        The gravest word that fits.

    """
    if trajectory.fault:
        return 'lost'
    if runs_away(trajectory.states, reference.trajectory.states):
        return 'blow-up'
    return 'wrong' if reference.error(trajectory) >= WRONG else 'stable'


def find_reference(
    budgeted: BudgetedRuns, first: float, tolerance: float, metric_name: str, report: Report
) -> Reference:
    """
    Run the richest model, halving the step from ``first`` [s] until the metric no longer changes.

    A motion that forgets its start (chaotic) is compared point by point as long as refinements
    agree to the tolerance, and else by its regime.

    Parameters
    ----------
    budgeted
        Makes the runs.
    first
        Largest timestep that is tried [s].
    tolerance
        Relative error that settings will be asked to keep [-].
    metric_name
        One of METRICS.
    report
        Told how far it is.

    Returns
    -------
    Reference
        The run, and how sure it is.

    Raises
    ------
    ConfigError
        Where no run lasts.

    """
    problem = budgeted.problem
    for integrator in _INTEGRATORS:
        found = _refined(budgeted, integrator, first, tolerance, metric_name, report)
        if found is not None:
            return found
    raise ConfigError(
        f'{problem.name}: the richest model fails by {" and ".join(_INTEGRATORS)} at every '
        f'timestep from {first:g} s to {first / 2**_HALVINGS:g} s; nothing to compare with '
        f'(fluid_sim run {problem.name} says where it diverges)'
    )


def _refined(
    budgeted: BudgetedRuns,
    integrator: str,
    first: float,
    tolerance: float,
    name: str,
    report: Report,
) -> Reference | None:
    problem, refinements = budgeted.problem, []
    runs: list[tuple[Setting, Trajectory]] = []
    within = math.inf
    what = f'{problem.name}: reference ({integrator})'
    for done in range(_HALVINGS + 1):
        report(what, done, _HALVINGS + 1)
        setting = Setting(problem.richest, integrator, first / 2**done)
        trajectory = budgeted.run(setting, _SHARE)
        if trajectory is None:
            budgeted.leave_out(*setting, 'the time budget ends before this run of the reference')
            break
        if trajectory.fault:
            runs.clear()
            within = math.inf
        else:
            runs.append((setting, trajectory))
            if len(runs) > 1:
                within = _apart(problem, name, runs)
        refinements.append({
            'integrator': integrator, 'timestep_s': setting.timestep, 'fault': trajectory.fault,
            'change': within if math.isfinite(within) else None,
        })  # fmt: skip
        long = problem.duration / setting.timestep >= _LONG
        if within <= (_ENOUGH if long else _WANTED) * tolerance:
            break
    report(what, 1, 1)
    if not runs:
        return None
    chaos = sensitivity(problem, integrator, runs[0][0].timestep, runs[0][1])
    if within > _ENOUGH * tolerance and chaos.chaotic:
        name = 'regime'
        within = _apart(problem, name, runs) if len(runs) > 1 else math.inf
    setting, trajectory = runs[-1]
    judge = metric(name, problem, trajectory.states)
    return Reference(trajectory, within, setting, chaos, name, judge, refinements)


def _apart(problem: Problem, name: str, runs: list[tuple[Setting, Trajectory]]) -> float:
    """Return how far the last two runs are apart."""
    (_, coarse), (_, fine) = runs[-2:]
    return metric(name, problem, fine.states)(coarse.states, fine.states)
