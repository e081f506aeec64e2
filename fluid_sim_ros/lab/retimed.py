# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Runs of a scene at any timestep, also at one that does not divide its events and samples.

For the search of a limit: between two timesteps that fit a scene there may be a factor of 2.5.
Events take place at their times, by a shorter step before them; states are compared at theirs, by
a shorter step on the side; the angles of a gait change at the next step boundary.
"""

from dataclasses import replace
from fractions import Fraction

import numpy as np

from fluid_sim_ros.control.gait import JointWave
from fluid_sim_ros.errors import DivergedError
from fluid_sim_ros.lab.problems.body_watch import BodyWatch
from fluid_sim_ros.lab.problems.problem import Problem, Rung, Trajectory, fits
from fluid_sim_ros.simulation import Simulation

#: Timesteps that a scene is compiled with, largest first [s]; a run's own is at most as large.
_COMPILED = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)
#: Share of a step within which two times are the same [-].
_SAME = 1e-9


def largest_timestep(problem: Problem, rung: Rung) -> float:
    """
    Return the largest timestep at which a model can be run here.

    Parameters
    ----------
    problem
        Whose model it is.
    rung
        The model.

    Returns
    -------
    float
        [s]: it divides the scene's events, and neither a sample nor a gait's period is shorter.

    """
    still = _without_gait(rung)
    periods = [1 / gait.rate for gait in rung.scene.gait.values()]
    most = min([problem.sample, *periods]) * (1 + 1e-9)
    return next((h for h in _COMPILED if h <= most and fits(still, h, h)), _COMPILED[-1])


def run_retimed(
    problem: Problem, rung: Rung, integrator: str, timestep: float, compiled: float
) -> Trajectory:
    """
    Run one model over the problem's duration at any timestep.

    Parameters
    ----------
    problem
        Says for how long, and at which times states are kept.
    rung
        The model.
    integrator
        Name of the integrator.
    timestep
        [s], at most ``compiled``.
    compiled
        As ``largest_timestep`` returns it [s].

    Returns
    -------
    Trajectory
        The run, its states at the problem's times.

    """
    simulation = _without_gait(rung).simulation(integrator, compiled)
    step = Fraction(timestep).limit_denominator(10**12)
    simulation.set_timestep(step)
    watch, states = BodyWatch(simulation), []
    stops: list[tuple[float, str, list[float]]] = [
        (event.at, '', []) for event in rung.scene.schedule if event.at < problem.duration
    ]
    stops += _waves(rung, problem.duration)
    waiting = iter(sorted(stops, key=lambda stop: stop[0]))
    due = next(waiting, None)
    try:
        for time in problem.times:
            while due is not None and due[0] <= time:
                at, vehicle, angles = due
                _go_on(simulation, at, step)
                if vehicle:
                    simulation.set_joints(vehicle, angles)
                else:
                    _land(simulation, at, step)
                due = next(waiting, None)
            _go_on(simulation, time, step)
            here = simulation.save_state()
            beyond = _land(simulation, time, step)
            states.append(watch.states())
            if beyond:
                simulation.load_state(here)
    except DivergedError as error:
        return Trajectory(np.array(states), str(error), error.time)
    return Trajectory(np.array(states))


def _without_gait(rung: Rung) -> Rung:
    return rung._replace(scene=replace(rung.scene, gait={}))


def _go_on(simulation: Simulation, time: float, step: Fraction) -> None:
    """Take whole steps up to a time, or to less than one before it."""
    simulation.step(max(0, int((time - simulation.time) / step + _SAME)))


def _land(simulation: Simulation, time: float, step: Fraction) -> bool:
    """Take one shorter step to a time, if it is not reached; return whether it was taken."""
    rest = time - simulation.time
    if rest <= _SAME * step:
        return False
    simulation.set_timestep(Fraction(rest).limit_denominator(10**15))
    simulation.step()
    simulation.set_timestep(step)
    return True


def _waves(rung: Rung, duration: float) -> list[tuple[float, str, list[float]]]:
    """Return time [s], vehicle and joint angles [rad] of the scene's gaits."""
    moves = []
    for name, gait in rung.scene.gait.items():
        wave = JointWave(
            gait.frequency, tuple(gait.amplitudes), tuple(gait.phases), tuple(gait.offsets),
            gait.ramp,
        )  # fmt: skip
        count = int(duration * gait.rate) + 1
        moves += [(k / gait.rate, name, wave.angles(k / gait.rate)) for k in range(count)]
    return moves
