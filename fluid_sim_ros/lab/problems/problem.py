# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A problem: something that moves in a fluid, what is known of its motion, and its models."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fluid_sim_ros.errors import ConfigError, DivergedError
from fluid_sim_ros.lab.problems.body_watch import BodyWatch
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact, whole_steps

#: Every integrator of MuJoCo 4.0.0.
INTEGRATORS = ('Euler', 'RK4', 'implicit', 'implicitfast', 'discrete')
#: Three decades of timesteps [s]; each divides a tenth of a second.
TIMESTEPS = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001, 0.00005)


class Rung(NamedTuple):
    """One model of a problem: a scene, and a fluid rung that it is forced on (None: its own)."""

    scene: Scene
    fluid: str | None = None

    def simulation(self, integrator: str, timestep: float) -> Simulation:
        """
        Return the model at its start.

        Parameters
        ----------
        integrator
            Name of the integrator.
        timestep
            [s].

        Returns
        -------
        Simulation
            At time 0.

        """
        return Simulation(self.scene, integrator=integrator, timestep=timestep, fluid=self.fluid)


@dataclass(frozen=True)
class Problem:
    """
    Something that moves, with its models from the poorest to the richest.

    Attributes
    ----------
    name, title
        Key on the command line, and a few words.
    stands_for
        The experiment or textbook case behind it, with its source.
    duration, sample
        Simulated time, and between two compared states [s]; each timestep must divide ``sample``.
    rungs
        Models by name, poorest first; the last one is the richest.
    reference
        States (n, bodies, 13) at times (n,) [s] that no simulator made; None: the converged run
        of the richest rung.
    reference_kind
        ``closed form``, ``ODE (DOP853)`` or ``converged run``.
    discretised_by
        Error that shows the order of convergence; ``position_m`` or ``attitude_rad``.
    invariants
        What the motion keeps, by name, from times and states, shape (n,) or (n, k).
    timesteps
        [s], largest first.
    note
        What a reader must know of the motion, or empty.
    excitation
        What moves the scene in place of its own manoeuvre, in words, or empty.

    """

    name: str
    title: str
    stands_for: str
    duration: float
    rungs: Mapping[str, Rung]
    reference: Callable[[Array], Array] | None = None
    reference_kind: str = 'converged run'
    discretised_by: str = 'position_m'
    invariants: Callable[[Array, Array], dict[str, Array]] | None = None
    sample: float = 0.1
    timesteps: tuple[float, ...] = TIMESTEPS
    note: str = ''
    excitation: str = ''

    @property
    def times(self) -> Array:
        """Times of the compared states [s], the start included."""
        steps = whole_steps(self.duration, self.sample, self.name)
        return np.arange(steps + 1, dtype=np.float64) * self.sample

    @property
    def richest(self) -> str:
        """Name of the last rung."""
        return list(self.rungs)[-1]

    def rung(self, name: str) -> Rung:
        """
        Return a rung by name.

        Parameters
        ----------
        name
            Of the rung.

        Returns
        -------
        Rung
            The rung.

        Raises
        ------
        ConfigError
            For another name, with those that there are.

        """
        if name not in self.rungs:
            raise ConfigError(
                f"{self.name}: rung '{name}' is not known; it has: {', '.join(self.rungs)}"
            )
        return self.rungs[name]


class Setting(NamedTuple):
    """One way to run a problem."""

    rung: str
    integrator: str
    timestep: float  # [s]

    @property
    def evaluations(self) -> float:
        """How often the forces are evaluated per simulated second [1/s]."""
        return (4 if self.integrator == 'RK4' else 1) / self.timestep


class Trajectory(NamedTuple):
    """
    A run of one model.

    ``states`` has shape (n, bodies, 13), see ``BodyWatch``; a run that the watchdog ended has
    fewer times, and in ``fault`` its line.
    """

    states: Array
    fault: str = ''
    failed_at: float | None = None


def run_rung(
    problem: Problem, rung: Rung, integrator: str, timestep: float, nudge: float = 0.0
) -> Trajectory:
    """
    Run one model over the problem's duration, every step watched.

    Parameters
    ----------
    problem
        Says for how long, and at which times states are kept.
    rung
        The model.
    integrator
        Name of the integrator.
    timestep
        [s]; it must divide the problem's ``sample``.
    nudge
        Added to all velocities at the start [m/s], [rad/s]: a motion that is sensitive to its
        start shows it.

    Returns
    -------
    Trajectory
        The run; one that blows up ends early, with the watchdog's line.

    Raises
    ------
    ConfigError
        If the timestep does not divide the sample.

    """
    between = whole_steps(problem.sample, timestep, f'{problem.name}: sample')
    simulation = rung.simulation(integrator, timestep)
    simulation.data.qvel += nudge
    watch, states = BodyWatch(simulation), []
    try:
        for _ in problem.times[1:]:
            states.append(watch.states())
            simulation.step(between)
        states.append(watch.states())
    except DivergedError as error:
        return Trajectory(np.array(states), str(error), error.time)
    return Trajectory(np.array(states))


def known_integrators(names: Sequence[str]) -> list[str]:
    """
    Return integrators as ``INTEGRATORS`` writes them.

    Parameters
    ----------
    names
        In any case.

    Returns
    -------
    list
        The same names.

    Raises
    ------
    ConfigError
        For one that is not known.

    """
    written = {name.lower(): name for name in INTEGRATORS}
    checked = [RunSettings.checked(integrator=name).integrator or '' for name in names]
    return [written[name.lower()] for name in checked]


def fits(rung: Rung, timestep: float, sample: float) -> bool:
    """
    Return whether a timestep divides the sample and the scene's events and gaits.

    Parameters
    ----------
    rung
        Whose scene has the events and gaits.
    timestep
        [s].
    sample
        Time between two compared states [s].

    Returns
    -------
    bool
        Whether it divides all of them.

    """
    if (exact(sample) / exact(timestep)).denominator != 1:
        return False
    try:
        return not rung.scene.compile(RunSettings(timestep=timestep)).rounded
    except ConfigError:
        return False
