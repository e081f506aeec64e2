# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A standard excitation for scenes in which nothing moves until somebody commands something.

Doublets: a push on one axis after the other, as much backward as forward, so that the vehicle
stays near its place; and a wind and a current, the scene's own or nominal ones. All draws have
one seed, so a scene is always excited in the same way.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from fluid_sim_ros.errors import CommandError, ConfigError, listed
from fluid_sim_ros.lab.problems.problem import Problem, Rung
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.vehicle import Vehicle, weight_in_air
from fluid_sim_ros.schema.scene import BodyWrench, ScheduledEvent
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.thrust_matrix import thrust_matrix

SEED = 1
#: Nominal velocities of the media where the scene has none of its own [m/s].
NOMINAL = {'wind': 5.0, 'current': 0.5}
AXES = ('surge', 'sway', 'heave', 'roll', 'pitch', 'yaw')
#: Shares of what the thrusters can give that a doublet takes.
_SHARES = (0.3, 0.6)
#: A doublet may bring this speed [m/s] and this turn [rad], without any fluid.
_SPEED, _TURN = 2.0, 0.4
#: Longest half of a doublet [s].
_HALF = 1.0
#: Without thrusters: force as a share of the weight, at an arm of the vehicle's size.
_WEIGHT_SHARE = 0.1
#: An axis is one of the vehicle's when its thrusters can give this share of a wrench along it.
_GIVEN = 0.5


@dataclass(frozen=True)
class Excitation:
    """Timed changes of a scene, and what they are in words."""

    events: tuple[ScheduledEvent, ...]
    words: str


def excited(problem: Problem) -> tuple[Problem, str]:
    """
    Return a problem whose scenes are excited in the standard way, in place of what they command.

    Wind and current of the scene stay.

    Parameters
    ----------
    problem
        That a scene is; its rungs are models of one scene.

    Returns
    -------
    problem, words
        The changed problem, and the excitation in words.

    """
    rung = problem.rungs[problem.richest]
    found = excitation(rung.scene, problem.duration, problem.sample)
    rungs = {
        name: each._replace(scene=replace(each.scene, schedule=_for_rung(each, found.events)))
        for name, each in problem.rungs.items()
    }
    return replace(problem, rungs=rungs), found.words


def _for_rung(rung: Rung, events: Sequence[ScheduledEvent]) -> tuple[ScheduledEvent, ...]:
    """Return events without wind or current where a poorer model has no such medium."""
    streams = rung.scene.compile(RunSettings(fluid=rung.fluid)).streams
    missing = [name for name in NOMINAL if name not in streams]
    kept = [event.model_copy(update=dict.fromkeys(missing)) for event in events]
    return tuple(e for e in kept if e.wind or e.current or e.thrust or e.wrench)


def excitation(scene: Scene, duration: float, sample: float) -> Excitation:
    """
    Return the standard excitation of a scene.

    Parameters
    ----------
    scene
        At its start.
    duration
        Of the run [s].
    sample
        Events take place at multiples of it [s].

    Returns
    -------
    Excitation
        The scene's own events of the weather, and doublets.

    """
    rng = np.random.default_rng(SEED)
    simulation = Simulation(scene)
    events, words = _weather(simulation, rng)
    for vehicle in simulation.vehicles.values():
        push = _Push(simulation, vehicle)
        times = _groups(len(push.axes), duration, sample)
        order = rng.permutation(len(push.axes))
        for group, (at, half) in enumerate(times):
            chosen = order[group :: len(times)]
            amounts = rng.uniform(*_SHARES, len(chosen)) * rng.choice((-1.0, 1.0), len(chosen))
            for when, sign in ((at, 1.0), (at + half, -1.0), (at + 2 * half, 0.0)):
                if when < duration:
                    event = push.event(chosen.tolist(), sign * amounts, half)
                    events.append(event.model_copy(update={'at': float(f'{when:.9g}')}))
        if push.axes:
            kind = 'thrust' if push.by_thrust else 'force and torque'
            words.append(f'doublets of {kind} on {listed(push.names)} of {vehicle.name}')
    text = f'{", ".join(words) or "nothing to excite it by"} (seed {SEED})'
    return Excitation(tuple(sorted(events, key=lambda event: event.at)), text)


def _weather(
    simulation: Simulation, rng: np.random.Generator
) -> tuple[list[ScheduledEvent], list[str]]:
    """Return the events of wind and current: the scene's own, or nominal ones at its start."""
    own = [
        event.model_copy(update={'thrust': {}, 'wrench': {}})
        for event in simulation.scene.schedule
        if event.wind or event.current
    ]
    flow = simulation.observe(forces=False)[:, nat.MEDIUM_VELOCITY]
    models = simulation.scene.wind or simulation.scene.current
    if own or models or np.any(flow):
        return own, ["the scene's own wind and current"]
    angle = rng.uniform(0, 2 * np.pi)
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    events, words = [], []
    for name in simulation.streams:
        velocity = [float(f'{value:.3f}') for value in NOMINAL[name] * along]
        try:
            (simulation.set_wind if name == 'wind' else simulation.set_current)(velocity)
        except CommandError:  # nothing of the model feels it
            continue
        events.append(ScheduledEvent.model_validate({'at': 0.0, name: velocity}))
        words.append(f'a {name} of {NOMINAL[name]:g} m/s')
    return events, words


def _groups(axes: int, duration: float, sample: float) -> list[tuple[float, float]]:
    """Return begin and half length [s] of each doublet; in a short run, axes share one."""
    steps = int(duration / sample + 1e-9)
    count = min(axes, max(1, steps // 2))
    if not count:
        return []
    half = max(1, min(steps // (2 * count), round(_HALF / sample)))
    return [(2 * half * sample * place, half * sample) for place in range(count)]


class _Push:
    """What pushes a vehicle along its axes: its thrusters, or a wrench where it has none."""

    def __init__(self, simulation: Simulation, vehicle: Vehicle) -> None:
        model = simulation.model
        self._vehicle = vehicle
        self._mass = float(model.body_subtreemass[vehicle.body_id])
        self._size = _reach(simulation, vehicle)
        self._weight = weight_in_air(model, vehicle.body_id)
        self._start = simulation.data.ctrl[vehicle.thruster_ids].copy()
        self._thrusts = _directions(simulation, vehicle)
        self.by_thrust = bool(self._thrusts)
        by_wrench = list(range(6)) if vehicle.qpos_address >= 0 else []
        self.axes = list(self._thrusts) if self.by_thrust else by_wrench
        self.names = [AXES[axis] for axis in self.axes]

    def event(self, chosen: Sequence[int], amounts: Array, half: float) -> ScheduledEvent:
        """Return an event at time 0 that pushes along some of the axes for a time [s]."""
        name = self._vehicle.name
        if not self.by_thrust:
            wrench = np.zeros(6)
            for place, amount in zip(chosen, amounts, strict=True):
                axis = self.axes[place]
                arm = 1.0 if axis < 3 else self._size
                by_weight = _WEIGHT_SHARE * self._weight * arm
                wrench[axis] = amount * min(by_weight, self._most(axis, half))
            pushed = BodyWrench(force=wrench[:3].tolist(), torque=wrench[3:].tolist())
            return ScheduledEvent(at=0.0, wrench={name: pushed})
        thrusts = self._start.copy()
        for place, amount in zip(chosen, amounts / max(1, len(chosen)), strict=True):
            axis = self.axes[place]
            direction = self._thrusts[axis]
            reach = _within(self._start, direction, self._vehicle.thrust_range)
            thrusts += amount * min(reach, self._most(axis, half)) * direction
        return ScheduledEvent(at=0.0, thrust={name: thrusts.tolist()})

    def _most(self, axis: int, half: float) -> float:
        """Return the force [N] or torque [N m] that brings the allowed speed or turn."""
        if axis < 3:
            return self._mass * _SPEED / half
        return self._mass * (0.3 * self._size) ** 2 * _TURN / half**2


def _directions(simulation: Simulation, vehicle: Vehicle) -> dict[int, Array]:
    """Return the thrusts that give 1 N or 1 N m along each axis that the vehicle has."""
    if not vehicle.thrusters:
        return {}
    model, start = simulation.model, mujoco.MjData(simulation.model)
    start.qpos[:] = simulation.data.qpos
    mujoco.mj_kinematics(model, start)
    try:
        matrix = thrust_matrix(model, start, vehicle)
    except ConfigError:  # commands that are no forces
        return {}
    inverse: Array = np.asarray(np.linalg.pinv(matrix, rcond=1e-6), dtype=np.float64)
    along = matrix @ inverse
    control = simulation.data.ctrl[vehicle.thruster_ids]
    return {
        axis: inverse[:, axis]
        for axis in range(6)
        if along[axis, axis] > _GIVEN
        and _within(control, inverse[:, axis], vehicle.thrust_range) > 0
    }


def _within(start: Array, direction: Array, limits: Array) -> float:
    """Return how far thrusts may go from a start along a direction, both ways, within limits."""
    low, high = limits.T
    with np.errstate(divide='ignore', invalid='ignore'):
        room = np.minimum(high - start, start - low) / np.abs(direction)
    return float(max(0.0, np.min(room[np.abs(direction) > 1e-12], initial=np.inf)))


def _reach(simulation: Simulation, vehicle: Vehicle) -> float:
    """Return how far the shapes of a vehicle's base reach from it [m]."""
    model = simulation.model
    of_base = np.flatnonzero(model.geom_bodyid == vehicle.body_id)
    reach = np.linalg.norm(model.geom_pos[of_base], axis=1) + model.geom_rbound[of_base]
    return float(max(reach, default=0.1))
