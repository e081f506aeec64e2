"""Runs of settings within a budget of time, each kept and recorded."""

import math
import time
from typing import Any, NamedTuple

from fluid_sim_ros.lab.problems.problem import Flight, Problem, fly


class Setting(NamedTuple):
    """One way to run a problem."""

    rung: str
    integrator: str
    timestep: float  # [s]

    @property
    def evaluations(self) -> float:
        """How often the forces are evaluated per simulated second [1/s]."""
        return (4 if self.integrator == 'RK4' else 1) / self.timestep


class Trials:
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
        self._flights: dict[Setting, Flight] = {}
        self._end = time.perf_counter() + budget
        self._pace = 0.0  # slowest evaluation yet [s]

    def fly(self, setting: Setting, share: float = 1.0) -> Flight | None:
        """
        Run a setting; None where that would take more than ``share`` of the time left.

        The first run is always made: how long one takes is not known before.
        """
        if setting in self._flights:
            return self._flights[setting]
        work = setting.evaluations * self.problem.duration
        begin = time.perf_counter()
        if self._pace and self._pace * work > share * (self._end - begin):
            return None
        flight = fly(self.problem, self.problem.rungs[setting.rung], *setting[1:])
        if not flight.fault:
            self._pace = max(self._pace, (time.perf_counter() - begin) / work)
        self._flights[setting] = flight
        return flight

    def note(self, setting: Setting, flight: Flight, error: float) -> None:
        """Record what became of a run; ``error`` is inf where it was lost."""
        row = setting._asdict() | {
            'error': error if math.isfinite(error) else None,
            'fault': flight.fault,
        }
        if row not in self.tried:
            self.tried.append(row)

    def leave_out(self, rung: str, integrator: str, timestep: float | None, why: str) -> None:
        """Record what is not run: a rung, its integrators ('' for all), from a timestep down."""
        self.not_tried.append(
            {'rung': rung, 'integrator': integrator, 'from_timestep': timestep, 'why': why}
        )
