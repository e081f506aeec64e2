"""How much of a scene's own manoeuvre can be judged: until a vehicle touches the ground."""

from typing import NamedTuple

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, DivergedError
from fluid_sim_ros.lab.metrics import vehicle_size
from fluid_sim_ros.lab.motion_errors import attitude_error, position_error
from fluid_sim_ros.lab.problems.problem import Problem, observed
from fluid_sim_ros.scene import Scene, scene_names
from fluid_sim_ros.step_clock import whole_steps

#: Contacts are looked for so often [s]; MuJoCo's own contacts last at least twice as long.
_LOOK = 0.005
#: What moves less than this share of its size, and turns less than this [rad], rests.
_AT_REST = 0.01


class Judged(NamedTuple):
    """How long the manoeuvre can be judged [s], and a line where that is not all of it."""

    duration: float
    note: str = ''


def judged_part(problem: Problem, timestep: float) -> Judged:
    """
    Return how much of a problem says something about its settings.

    From the first touch of the ground on, an impact decides what follows, not the fluid or its
    integration. A vehicle that stands on the ground at the start may leave it and is judged until
    it touches down; a run that is lost at this timestep is judged in full.

    Parameters
    ----------
    problem
        Whose manoeuvre it is; its richest model is run by RK4.
    timestep
        [s].

    Returns
    -------
    Judged
        For how long the manoeuvre can be judged, and why no longer.

    Raises
    ------
    ConfigError
        Where nothing is left to judge.

    """
    simulation = problem.rungs[problem.richest].simulation('RK4', timestep)
    between = whole_steps(problem.sample, timestep, f'{problem.name}: sample')
    look = max(1, round(_LOOK / timestep))
    states, flown, stands = [observed(simulation)], False, False
    try:
        for sample in range(len(problem.times) - 1):
            for begin in range(0, between, look):
                simulation.step(min(look, between - begin))
                touches = _touches_ground(simulation.model, simulation.data)
                stands |= touches and not flown and sample == 0
                flown |= not touches
                if touches and (flown or not stands):
                    return _until(problem, sample, simulation.time)
            states.append(observed(simulation))
    except DivergedError:
        return Judged(problem.duration)
    if not flown:
        _refuse_rest(problem, np.array(states))
    return Judged(problem.duration)


def _touches_ground(model: mujoco.MjModel, data: mujoco.MjData) -> bool:
    """Return whether anything touches a body that is fixed to the world."""
    geoms = data.contact.geom[: data.ncon]
    return bool(np.any(model.body_weldid[model.geom_bodyid[geoms]] == 0))


def _until(problem: Problem, sample: int, touched: float) -> Judged:
    duration = float(f'{problem.times[sample]:.9g}')
    if sample == 0:
        raise ConfigError(
            f'{problem.name}: a vehicle touches the ground {touched:.3g} s after the start, too '
            'soon to judge what came before; start it higher, or on the ground'
        )
    note = f'a vehicle touches the ground at {touched:.4g} s: judged up to {duration:g} s'
    events = [event.at for event in problem.rungs[problem.richest].scene.schedule]
    later = [f'{at:g} s' for at in events if duration < at < problem.duration]
    if later:
        note += f', without what the schedule changes at {", ".join(later)}'
    return Judged(duration, note)


def _refuse_rest(problem: Problem, states: np.ndarray) -> None:
    """Refuse a manoeuvre in which nothing happens: any setting would do, even without a fluid."""
    rung = problem.rungs[problem.richest]
    moved = float(position_error(states, states[:1]).max()) / vehicle_size(rung)
    turned = float(attitude_error(states, states[:1]).max())
    if moved > _AT_REST or turned > _AT_REST:
        return
    scene = rung.scene
    flying = [
        name
        for name in scene_names()
        if name != scene.name and Scene.load(name).model_path == scene.model_path
    ]
    other = f', or advise another scene of this model: {", ".join(flying)}' if flying else ''
    raise ConfigError(
        f'{problem.name}: the vehicle rests on the ground throughout, so that every setting gives '
        f'the same; give the scene a schedule that lifts it{other}'
    )
