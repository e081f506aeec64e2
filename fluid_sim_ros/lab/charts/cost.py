# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What a step costs, per curve (rung and integrator), so that charts and choices can be repeated.

The cost of a step hardly depends on the timestep, so one number per curve does for all of its
timesteps: cost per simulated second is that number over the timestep, and within a curve the
order is exact. Between curves it is a ratio: every curve is stepped for some milliseconds in turn,
in a new order each round, and compared with its own round, so that a processor that slows down
for a while slows down all of them.
"""

import random
import time
from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from fluid_sim_ros.errors import ConfigError, DivergedError
from fluid_sim_ros.lab.problems.problem import Problem
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import duration_steps

#: Bursts per curve, one a round.
ROUNDS = 60
_ORDER_SEED = 1
#: Aimed length of a burst [s]: far above what the clock and a cold cache add.
_BURST = 2e-3
_FEWEST, _MOST = 20, 500  # steps of a burst
#: Simulations are rebuilt this many times, because their speed depends on where their memory lies.
_BUILDS = 3


class Curve(NamedTuple):
    """One model and integrator: the points of a chart that differ by their timestep only."""

    rung: str
    integrator: str


class StepCost(NamedTuple):
    """Time of one step [us]: processor and wall, medians, and the quartiles of the bursts."""

    cpu: float
    cpu_low: float
    cpu_high: float
    wall: float
    wall_low: float
    wall_high: float

    def per_second(self, timestep: float) -> dict[str, float]:
        """
        Return the cost of a simulated second [us/s].

        Parameters
        ----------
        timestep
            [s].

        Returns
        -------
        dict
            Medians and quartiles of processor and wall time [us per simulated second], by name.

        """
        names = (
            'cpu_us_per_s', 'cpu_quartile_low_us_per_s', 'cpu_quartile_high_us_per_s',
            'wall_us_per_s', 'wall_quartile_low_us_per_s', 'wall_quartile_high_us_per_s',
        )  # fmt: skip
        return {name: value / timestep for name, value in zip(names, self, strict=True)}


def step_costs(
    problem: Problem,
    curves: Mapping[Curve, float],
    rounds: int = ROUNDS,
    report: Report = silent,
) -> dict[Curve, StepCost]:
    """
    Return the cost of a step of each curve.

    A curve is stepped through the problem's whole duration, again and again; one that is lost
    starts anew.

    Parameters
    ----------
    problem
        What is stepped.
    curves
        Curves, each with the timestep at which it is measured [s].
    rounds
        Timed bursts of each curve.
    report
        Told how far the measurement is.

    Returns
    -------
    dict
        Cost of a step by curve.

    Raises
    ------
    ConfigError
        For less than one round.

    """
    if rounds < 1:
        raise ConfigError(f'{rounds} timed bursts per curve: must be at least 1')
    keys = list(curves)
    shuffled = random.Random(_ORDER_SEED)
    times = np.empty((2, len(keys), rounds))  # processor, wall [s per step]
    what = f'{problem.name}: cost of a step'
    stepper: dict[Curve, _Stepper] = {}
    for done in range(rounds):
        report(what, done, rounds)
        if done % max(1, rounds // _BUILDS) == 0:
            stepper = {key: _Stepper(problem, key, curves[key]) for key in keys}
            burst = _burst(stepper.values())
        for place in shuffled.sample(range(len(keys)), len(keys)):
            times[:, place, done] = stepper[keys[place]].run(burst)
    report(what, rounds, rounds)
    cpu, wall = _medians(times[0]), _medians(times[1])
    return {
        key: StepCost(*(1e6 * cpu[place]).tolist(), *(1e6 * wall[place]).tolist())
        for place, key in enumerate(keys)
    }


def _medians(times: Any) -> Any:
    """
    Return median and quartiles of every curve's times, shape (curves, 3).

    Of times over the median of their own round, so that all curves have the same good and bad
    moments; then scaled by the median of all rounds.
    """
    logs = np.log(times)
    of_round = np.median(logs, axis=0)
    apart = np.percentile(logs - of_round, (50, 25, 75), axis=1).T
    return np.exp(apart + np.median(of_round))


def _burst(steppers: Iterable['_Stepper']) -> int:
    """Return how many steps take about ``_BURST`` of a typical curve; the first few warm up."""
    spent = [stepper.run(_FEWEST)[0] for stepper in steppers]
    return int(np.clip(_BURST / np.median(spent), _FEWEST, _MOST))


class _Stepper:
    """A simulation that runs through the problem's duration again and again."""

    def __init__(self, problem: Problem, curve: Curve, timestep: float) -> None:
        self._simulation: Simulation = problem.rungs[curve.rung].simulation(
            curve.integrator, timestep
        )
        self._end = duration_steps(problem.duration, timestep)

    def run(self, steps: int) -> tuple[float, float]:
        """Take so many steps; return processor and wall time of one [s]."""
        simulation, cpu, wall, taken = self._simulation, 0.0, 0.0, 0
        while taken < steps:
            if simulation.step_count >= self._end:
                simulation.reset()
            before = simulation.step_count
            chunk = min(steps - taken, self._end - before)
            wall_begin, cpu_begin = time.perf_counter(), time.thread_time()
            with suppress(DivergedError):
                simulation.step(chunk)
            cpu += time.thread_time() - cpu_begin
            wall += time.perf_counter() - wall_begin
            done = simulation.step_count - before
            taken += max(done, 1)
            if done < chunk:  # lost: from the start again
                simulation.reset()
        return cpu / taken, wall / taken
