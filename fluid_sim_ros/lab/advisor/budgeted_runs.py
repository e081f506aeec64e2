# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs of settings within a budget of time, each kept and recorded."""

import math
import time
from typing import Any

from fluid_sim_ros.lab.problems.problem import Problem, Setting, Trajectory, run_rung


class BudgetedRuns:
    """
    Runs settings of one problem, each once, as long as the time lasts.

    Parameters
    ----------
    problem
        What is run.
    budget
        Time for all runs [s] of wall time, from now on.

    Attributes
    ----------
    tried
        What was run, in order: setting, error as ``judge`` sees it, and the watchdog's line.
    not_tried
        What was left out, and why.

    """

    def __init__(self, problem: Problem, budget: float) -> None:
        self.problem = problem
        self.tried: list[dict[str, Any]] = []
        self.not_tried: list[dict[str, Any]] = []
        self._trajectories: dict[Setting, Trajectory] = {}
        self._end = time.perf_counter() + budget
        self._pace = 0.0  # slowest evaluation yet [s]

    @property
    def left(self) -> float:
        """What is left of the budget [s]."""
        return max(0.0, self._end - time.perf_counter())

    def run(self, setting: Setting, share: float = 1.0) -> Trajectory | None:
        """
        Return the run of a setting, made now or earlier.

        The first run is always made: how long one takes is not known before.

        Parameters
        ----------
        setting
            What is run.
        share
            Largest share of the time that is left that the run may take [-].

        Returns
        -------
        Trajectory or None
            The run; None where it would take longer.

        """
        if setting in self._trajectories:
            return self._trajectories[setting]
        work = setting.evaluations * self.problem.duration
        begin = time.perf_counter()
        if self._pace and self._pace * work > share * (self._end - begin):
            return None
        trajectory = run_rung(self.problem, self.problem.rungs[setting.rung], *setting[1:])
        if not trajectory.fault:
            self._pace = max(self._pace, (time.perf_counter() - begin) / work)
        self._trajectories[setting] = trajectory
        return trajectory

    def note(self, setting: Setting, trajectory: Trajectory, error: float) -> None:
        """
        Record what became of a run.

        Parameters
        ----------
        setting
            What was run.
        trajectory
            The run.
        error
            Its relative error, as it is judged [-]; inf where it was lost.

        """
        row = setting._asdict() | {
            'error': error if math.isfinite(error) else None,
            'fault': trajectory.fault,
        }
        if row not in self.tried:
            self.tried.append(row)

    def leave_out(self, rung: str, integrator: str, timestep: float | None, why: str) -> None:
        """
        Record what is not run.

        Parameters
        ----------
        rung
            Name of the rung.
        integrator
            Its integrator; empty for all of them.
        timestep
            From this timestep down [s]; None for all of them.
        why
            One line for a reader.

        """
        self.not_tried.append(
            {'rung': rung, 'integrator': integrator, 'from_timestep': timestep, 'why': why}
        )
