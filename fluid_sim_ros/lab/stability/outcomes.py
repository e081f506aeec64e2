# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What becomes of a body that coasts: every run gets one word, found by the watchdogs."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from fluid_sim_ros.errors import DivergedError
from fluid_sim_ros.lab.problems.bodies import Body
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.simulation import Simulation

#: In the order of their gravity. ``underdamped`` and ``energy loss``: T is above or below its
#: converged course; ``energy gain``: T rises, which nothing passive does; ``reset``: MuJoCo found
#: a number that is not finite or above 1e10, set the state back and went on without a word.
OUTCOMES = ('stable', 'underdamped', 'energy loss', 'energy gain', 'blow-up', 'reset')
#: Share of the start's energy that T may be off, or rise, by.
TOLERANCE = 0.05
#: T of a passive body above so many times its start is a blow-up.
_BLOWN_UP = 10.0
_LOOKS, _COURSE_LOOKS = 50, 2000  # at the energy, over a run
_FEWEST_STEPS = 20
_FINEST = 1e-5  # timestep of a reference run [s]


class Run(NamedTuple):
    """The energy of a run."""

    times: Array  # [s]
    energy: Array  # T/T0 of body and flow
    reset_at: float | None  # [s], None: never
    alarm: str  # first line of the watchdogs, which know nothing of the converged course


class Outcome(NamedTuple):
    """How a run ended: a word of OUTCOMES, largest and last T/T0, when MuJoCo reset it, alarm."""

    word: str
    largest: float
    last: float
    reset_at: float | None = None
    alarm: str = ''


def coast(body: Body, integrator: str, timestep: float, looks: int = _LOOKS) -> Run:
    """
    Run a body to its end, or to where MuJoCo resets it.

    Parameters
    ----------
    body
        What coasts.
    integrator
        Name of the integrator.
    timestep
        [s].
    looks
        How often its energy is looked at, over the run.

    Returns
    -------
    Run
        Its energy over time.

    """
    simulation = Simulation(body.scene(), integrator=integrator, timestep=timestep)
    steps = max(round(body.duration / timestep), _FEWEST_STEPS)
    every = max(1, steps // looks)
    start = simulation.energy_balance()
    times, energy, alarm = [0.0], [1.0], start.warning
    reset_at = None
    try:
        while simulation.step_count < steps:
            simulation.step(min(every, steps - simulation.step_count))
            balance = simulation.energy_balance()
            times.append(simulation.time)
            energy.append(balance.kinetic / start.kinetic)
            alarm = alarm or balance.warning
    except DivergedError as error:
        reset_at, alarm = error.time, alarm or str(error)
    return Run(np.array(times), np.array(energy), reset_at, alarm)


@lru_cache(maxsize=256)
def _course(body: Body) -> Run:
    """Return the converged course: RK4, the step divided by 4 until the energy stays the same."""
    timestep = 1e-3
    coarse = coast(body, 'RK4', timestep, _COURSE_LOOKS)
    while timestep > _FINEST:
        timestep /= 4
        fine = coast(body, 'RK4', timestep, _COURSE_LOOKS)
        complete = coarse.reset_at is None and fine.reset_at is None
        if complete and np.abs(_above(fine, coarse)).max() < TOLERANCE / 50:
            break
        coarse = fine
    return fine


def _above(run: Run, course: Run) -> Array:
    """Return T/T0 of a run less that of its course, at the run's looks within the course."""
    within = run.times <= course.times[-1] * (1 + 1e-9)
    above: Array = run.energy[within] - np.interp(run.times[within], course.times, course.energy)
    return above


def outcome(body: Body, integrator: str, timestep: float) -> Outcome:
    """
    Return what becomes of a run, judged against the converged course of its energy.

    Parameters
    ----------
    body
        What coasts.
    integrator
        Name of the integrator.
    timestep
        [s].

    Returns
    -------
    Outcome
        The gravest word of OUTCOMES that fits.

    """
    run = coast(body, integrator, timestep)
    facts = (float(run.energy.max()), float(run.energy[-1]), run.reset_at, run.alarm)
    if run.reset_at is not None:
        return Outcome('reset', *facts)
    if run.energy.max() > _BLOWN_UP:
        return Outcome('blow-up', *facts)
    if (run.energy - np.minimum.accumulate(run.energy)).max() > TOLERANCE:
        return Outcome('energy gain', *facts)
    above = _above(run, _course(body))
    if above.min() < -TOLERANCE:
        return Outcome('energy loss', *facts)
    return Outcome('underdamped' if above.max() > TOLERANCE else 'stable', *facts)


def one_step(body: Body, integrator: str, timestep: float) -> float:
    """
    Return what one step makes of the velocity.

    Parameters
    ----------
    body
        What coasts.
    integrator
        Name of the integrator.
    timestep
        [s].

    Returns
    -------
    float
        v1/v0 along the motion [-]; nan where MuJoCo reset it.

    """
    simulation = Simulation(body.scene(), integrator=integrator, timestep=timestep)
    start = float(simulation.data.qvel[0])
    try:
        simulation.step()
    except DivergedError:
        return float('nan')
    return float(simulation.data.qvel[0]) / start
