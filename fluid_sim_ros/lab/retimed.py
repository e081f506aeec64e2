"""
Runs of a scene at any timestep, also at one that does not divide its events and samples.

For the search of a limit: between two timesteps that fit a scene there may be a factor of 2.5.
Events, gaits and compared states keep their times to the next step boundary.
"""

from collections.abc import Iterator
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
        The run, its states at the step boundaries next to the problem's times.

    """
    simulation = _without_gait(rung).simulation(integrator, compiled)
    simulation.set_timestep(Fraction(timestep).limit_denominator(10**12))
    watch, states = BodyWatch(simulation), []
    waves = _waves(rung, simulation, problem.duration)
    due = next(waves, None)
    try:
        for time in problem.times:
            while due is not None and due[0] <= time:
                simulation.step(_steps(simulation, due[0], timestep))
                simulation.set_joints(due[1], due[2])
                due = next(waves, None)
            simulation.step(_steps(simulation, time, timestep))
            states.append(watch.states())
    except DivergedError as error:
        return Trajectory(np.array(states), str(error), error.time)
    return Trajectory(np.array(states))


def _without_gait(rung: Rung) -> Rung:
    return rung._replace(scene=replace(rung.scene, gait={}))


def _steps(simulation: Simulation, time: float, timestep: float) -> int:
    return max(0, round(time / timestep) - simulation.step_count)


def _waves(
    rung: Rung, simulation: Simulation, duration: float
) -> Iterator[tuple[float, str, list[float]]]:
    """Yield time [s], vehicle and joint angles [rad] of the scene's gaits, in order of time."""
    moves = []
    for name, gait in rung.scene.gait.items():
        wave = JointWave(
            gait.frequency, tuple(gait.amplitudes), tuple(gait.phases), tuple(gait.offsets),
            gait.ramp,
        )  # fmt: skip
        count = int(duration * gait.rate) + 1
        moves += [(k / gait.rate, name, wave.angles(k / gait.rate)) for k in range(count)]
    yield from sorted(moves, key=lambda move: move[0])
