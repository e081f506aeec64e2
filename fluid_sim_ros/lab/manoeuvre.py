# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
How much of a scene's own manoeuvre can be judged, and what is judged where nothing happens.

An impact decides what comes after it, not the fluid or its integration: a manoeuvre is judged
until a vehicle touches the ground or two bodies meet. A manoeuvre in which nothing moves tells
nothing of the fluid: every setting gives the same, even without one. Then a standard excitation
takes its place.
"""

from dataclasses import replace
from typing import NamedTuple

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, DivergedError
from fluid_sim_ros.lab.excitation import excited
from fluid_sim_ros.lab.metrics import vehicle_size
from fluid_sim_ros.lab.motion_errors import attitude_error, position_error
from fluid_sim_ros.lab.problems.body_watch import BodyWatch
from fluid_sim_ros.lab.problems.problem import Problem
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene import Scene, scene_names
from fluid_sim_ros.step_clock import whole_steps

#: Contacts are looked for so often [s]; MuJoCo's own contacts last at least twice as long.
_LOOK = 0.005
#: What moves less than this share of its size, and turns less than this [rad], rests.
_AT_REST = 0.01


def first_timestep(problem: Problem) -> float:
    """
    Return the timestep to begin with.

    Parameters
    ----------
    problem
        Whose richest model it is.

    Returns
    -------
    float
        The largest one that is not above the model's own [s].

    """
    own = float(problem.rungs[problem.richest].scene.compile().model.opt.timestep)
    return max((h for h in problem.timesteps if h <= own), default=problem.timesteps[-1])


def judged(problem: Problem) -> Problem:
    """
    Return a problem that says something about its settings, with ``note`` on what was changed.

    A vehicle that stands on the ground at the start may leave it and is judged until it touches
    down; a run that is lost at the model's own timestep is judged in full.

    Parameters
    ----------
    problem
        That a scene is; its richest model is run by RK4.

    Returns
    -------
    Problem
        The problem, shorter where an impact ends what can be judged, and excited where nothing
        would move.

    Raises
    ------
    ConfigError
        Where nothing is left to judge.

    """
    timestep = first_timestep(problem)
    seen = _run(problem, timestep)
    if not seen.rests:
        return _shortened(problem, seen)
    if seen.on_ground:
        _refuse_ground(problem)
    problem, words = excited(problem)
    seen = _run(problem, timestep)
    if seen.rests:
        raise ConfigError(
            f'{problem.name}: nothing moves in the scene, and {words} does not change that; give '
            'it a schedule or a keyframe with a velocity'
        )
    shorter = _shortened(problem, seen)
    note = (
        "nothing moves in the scene's own manoeuvre: judged by a standard excitation in its "
        f'place, {words}'
    )
    note = f'{note}; {shorter.note}' if shorter.note else note
    return replace(shorter, note=note, excitation=words)


def envelope(problem: Problem) -> Problem | None:
    """
    Return a scene's problem in its envelope: the standard excitation.

    Parameters
    ----------
    problem
        That a scene is.

    Returns
    -------
    Problem or None
        The excited problem, up to a first impact; None where there is none to judge.

    """
    moved, words = excited(problem)
    seen = _run(moved, first_timestep(problem))
    if seen.rests or seen.sample == 0:
        return None
    return replace(_shortened(moved, seen), excitation=words)


class _Seen(NamedTuple):
    """What a run shows: whether anything moves, and its first impact."""

    rests: bool
    on_ground: bool  # all along
    what: str = ''  # the impact
    at: float = 0.0  # its time [s]
    sample: int | None = None  # the last compared time before it; None: no impact


def _run(problem: Problem, timestep: float) -> _Seen:
    rung = problem.rungs[problem.richest]
    simulation = rung.simulation('RK4', timestep)
    between = whole_steps(problem.sample, timestep, f'{problem.name}: sample')
    look = max(1, round(_LOOK / timestep))
    watch, contacts = BodyWatch(simulation), _Contacts(simulation.model, simulation.data)
    states = [watch.states()]
    try:
        for sample in range(len(problem.times) - 1):
            for begin in range(0, between, look):
                simulation.step(min(look, between - begin))
                what = contacts.impact(at_start=sample == 0)
                if what:
                    return _Seen(False, False, what, simulation.time, sample)
            states.append(watch.states())
    except DivergedError:
        return _Seen(False, False)
    return _Seen(_rests(problem, np.array(states)), contacts.never_left)


def _rests(problem: Problem, states: Array) -> bool:
    moved = float(position_error(states, states[:1]).max())
    turned = float(attitude_error(states, states[:1]).max())
    size = vehicle_size(problem.rungs[problem.richest])
    return moved <= _AT_REST * size and turned <= _AT_REST


class _Contacts:
    """
    Looks for impacts: with what is fixed to the world, and between bodies that move.

    Bodies that touch each other from the start on (a load in a gripper) do not meet.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        self._stands = self._left = False
        self._together: set[tuple[int, int]] | None = None

    @property
    def never_left(self) -> bool:
        """Whether something stood on the ground all along."""
        return not self._left

    def impact(self, at_start: bool) -> str:
        """Return what meets at the present step, or nothing."""
        pairs = self._pairs()
        if self._together is None:
            self._together = {pair for pair in pairs if pair[0]}
        ground = any(first == 0 for first, _ in pairs)
        self._stands |= ground and not self._left and at_start
        self._left |= not ground
        if ground and (self._left or not self._stands):
            return 'a vehicle touches the ground'
        for first, second in sorted(pairs):
            if first and (first, second) not in self._together:
                names = [self._model.body(body).name or f'body {body}' for body in (first, second)]
                return f'{names[0]} and {names[1]} touch each other'
        return ''

    def _pairs(self) -> set[tuple[int, int]]:
        """Return the pairs of rigid bodies in contact; 0 is what is fixed to the world."""
        contact = self._data.contact
        if not self._data.ncon:
            return set()
        geoms = contact.geom[: self._data.ncon]
        geoms = geoms[contact.exclude[: self._data.ncon] == 0]
        bodies = np.sort(self._model.body_weldid[self._model.geom_bodyid[geoms]], axis=1)
        return {(int(first), int(second)) for first, second in bodies}


def _shortened(problem: Problem, seen: _Seen) -> Problem:
    """Return the part of a problem before its first impact."""
    if seen.sample is None:
        return problem
    duration = float(f'{problem.times[seen.sample]:.9g}')
    if seen.sample == 0:
        raise ConfigError(
            f'{problem.name}: {seen.what} {seen.at:.3g} s after the start, too soon to judge '
            'what came before; start it higher or farther apart, or on the ground'
        )
    note = f'{seen.what} at {seen.at:.4g} s: judged up to {duration:g} s'
    events = [event.at for event in problem.rungs[problem.richest].scene.schedule]
    later = [f'{at:g} s' for at in events if duration < at < problem.duration]
    if later:
        note += f', without what the schedule changes at {", ".join(later)}'
    return replace(problem, duration=duration, note=note)


def _refuse_ground(problem: Problem) -> None:
    scene = problem.rungs[problem.richest].scene
    others = {name: Scene.load(name) for name in scene_names() if name != scene.name}
    flying = [
        name for name, other in others.items()
        if other.model_path == scene.model_path and other.fleet is None
    ]  # fmt: skip
    tail = f', or advise another scene of this model: {", ".join(flying)}' if flying else ''
    raise ConfigError(
        f'{problem.name}: the vehicle rests on the ground throughout, so that every setting gives '
        f'the same; give the scene a schedule that lifts it{tail}'
    )
