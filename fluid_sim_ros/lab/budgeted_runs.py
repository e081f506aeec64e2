"""Runs of settings within a budget of time, each kept and recorded."""

import math
import time
from typing import Any, NamedTuple

from fluid_sim_ros.lab.problems.problem import Problem, Trajectory, run_rung


class Setting(NamedTuple):
    """One way to run a problem."""

    rung: str
    integrator: str
    timestep: float  # [s]

    @property
    def evaluations(self) -> float:
        """How often the forces are evaluated per simulated second [1/s]."""
        return (4 if self.integrator == 'RK4' else 1) / self.timestep


class BudgetedRuns:
    """
    Flies settings of one problem, each once, as long as the time lasts.

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

    def run(self, setting: Setting, share: float = 1.0) -> Trajectory | None:
        """
        Run a setting; None where that would take more than ``share`` of the time left.

        The first run is always made: how long one takes is not known before.
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
        """Record what became of a run; ``error`` is inf where it was lost."""
        row = setting._asdict() | {
            'error': error if math.isfinite(error) else None,
            'fault': trajectory.fault,
        }
        if row not in self.tried:
            self.tried.append(row)

    def leave_out(self, rung: str, integrator: str, timestep: float | None, why: str) -> None:
        """Record what is not run: a rung, its integrators ('' for all), from a timestep down."""
        self.not_tried.append(
            {'rung': rung, 'integrator': integrator, 'from_timestep': timestep, 'why': why}
        )
