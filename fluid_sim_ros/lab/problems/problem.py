"""A problem: something that moves in a fluid, what is known of its motion, and its models."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from fluid_sim_ros.errors import ConfigError, DivergedError, ModelError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.fluid_models import has_body_plugins
from fluid_sim_ros.schema.settings import FLUID_RUNGS
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact, whole_steps

#: Every integrator of MuJoCo 4.0.0.
INTEGRATORS = ('Euler', 'RK4', 'implicit', 'implicitfast', 'discrete')
#: Three decades of timesteps [s]; each divides a tenth of a second.
TIMESTEPS = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001, 0.00005)
# Columns of a state: as in physics/kirchhoff.py and in the observed rows.
POSITION, QUATERNION, VELOCITY, OMEGA = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13)
STATE_WIDTH = 13


class Rung(NamedTuple):
    """One model of a problem: a scene, and a fluid rung that it is forced on (None: its own)."""

    scene: Scene
    fluid: str | None = None

    def simulation(self, integrator: str, timestep: float) -> Simulation:
        """Return the model at its start."""
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
        States (n, vehicles, 13) at times (n,) [s] that no simulator made; None: the converged run
        of the richest rung.
    reference_kind
        ``closed form``, ``ODE (DOP853)`` or ``converged run``.
    judged_by
        The error that the chart shows; ``position_m`` or ``attitude_rad``.
    invariants
        What the motion keeps, by name, from times and states, shape (n,) or (n, k).
    timesteps
        [s], largest first.

    """

    name: str
    title: str
    stands_for: str
    duration: float
    rungs: Mapping[str, Rung]
    reference: Callable[[Array], Array] | None = None
    reference_kind: str = 'converged run'
    judged_by: str = 'position_m'
    invariants: Callable[[Array, Array], dict[str, Array]] | None = None
    sample: float = 0.1
    timesteps: tuple[float, ...] = TIMESTEPS

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
        """Return a rung by name; ConfigError with the names that there are."""
        if name not in self.rungs:
            raise ConfigError(
                f"{self.name}: rung '{name}' is not known; it has: {', '.join(self.rungs)}"
            )
        return self.rungs[name]


class Trajectory(NamedTuple):
    """
    A run of one model.

    ``states`` has shape (n, vehicles, 13); a run that the watchdog ended has fewer, and in
    ``fault`` its line. ``warnings`` are the energy watchdog's, at the compared times.
    """

    states: Array
    fault: str = ''
    failed_at: float | None = None


def run_rung(
    problem: Problem, rung: Rung, integrator: str, timestep: float, nudge: float = 0.0
) -> Trajectory:
    """
    Run one model over the problem's duration, every step watched.

    ``nudge`` is added to all velocities at the start [m/s], [rad/s]: a motion that is sensitive
    to its start shows it.
    """
    between = whole_steps(problem.sample, timestep, f'{problem.name}: sample')
    simulation = rung.simulation(integrator, timestep)
    simulation.data.qvel += nudge
    states = []
    try:
        for _ in problem.times[1:]:
            states.append(observed(simulation))
            simulation.step(between)
        states.append(observed(simulation))
    except DivergedError as error:
        return Trajectory(np.array(states), str(error), error.time)
    return Trajectory(np.array(states))


def observed(simulation: Simulation) -> Array:
    """Return the state of every vehicle at this step boundary, shape (vehicles, 13)."""
    return simulation.observe(forces=False)[:, :STATE_WIDTH].copy()


def fits(rung: Rung, timestep: float, sample: float) -> bool:
    """Return whether a timestep divides the sample and the scene's events and gaits."""
    if (exact(sample) / exact(timestep)).denominator != 1:
        return False
    try:
        rung.scene.compile(timestep=timestep)
    except ConfigError:
        return False
    return True


def of_scene(scene: str | Scene, duration: float | None = None) -> Problem:
    """
    Return the problem that a scene is: its own manoeuvre, against its own converged run.

    The rungs are those of ``scene.fluid_models`` below the model's own, poorest first, and last
    ``scene``, the model's own; what the scene's file says of the settings does not count.
    Timesteps reach from 1/40 to 25 times the model's own.
    """
    loaded = replace(Scene.load(scene), fluid=None, timestep=None, integrator=None)
    rungs = {name: Rung(loaded, name) for name in _poorer(loaded)} | {'scene': Rung(loaded)}
    own = float(loaded.compile().model.opt.timestep)
    seconds = loaded.duration if duration is None else duration
    sample = 0.1 if seconds >= 1 else 0.01
    if seconds < sample:
        raise ConfigError(
            f'{loaded.name}: duration {seconds:g} s: at least {sample:g} s are needed to compare'
        )
    seconds = round(seconds / sample) * sample
    steps = tuple(
        h for h in (*TIMESTEPS, 2e-5, 1e-5, 5e-6, 2e-6)
        if own / 40.1 <= h <= own * 25.1 and fits(rungs['scene'], h, sample)
    )  # fmt: skip
    if not steps:
        raise ConfigError(f'{loaded.name}: no timestep of 1, 2, 5 times a power of ten fits it')
    return Problem(
        name=loaded.name,
        title=loaded.description or loaded.name,
        stands_for=f'the manoeuvre of the scene {loaded.name}',
        duration=float(f'{seconds:.9g}'),
        rungs=rungs,
        sample=sample,
        timesteps=steps,
    )


def _poorer(scene: Scene) -> list[str]:
    """Return the fluid rungs that lie below a scene's own model."""
    model = scene.compile().model
    stock = model.opt.density > 0 or model.opt.viscosity > 0
    if has_body_plugins(scene.read_model()):
        below = list(FLUID_RUNGS)
    elif stock and np.any(model.geom_fluid[:, 0] > 0):
        below = ['none', 'inertia']
    else:
        below = ['none']
    return [name for name in below if _rung_compiles(scene, name)]


def _rung_compiles(scene: Scene, fluid: str) -> bool:
    try:
        scene.compile(fluid=fluid)
    except (ConfigError, ModelError):
        return False
    return True
