# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flies an excitation with a vehicle's model under its control law, within limits."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import ConfigError, DivergedError
from fluid_sim_ros.flights.flight import Flight, RawLog, Signal
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.loop.helms import Helm, Move, helm_of
from fluid_sim_ros.loop.hold import state_of
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.exciting.excitation import Limits, Plan, plan
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.plant import plant_of

#: Commands a second [Hz]; digits that a command keeps [N].
RATE, DIGITS = 100.0, 5
#: A flight beyond its limits is flown again with so much less, so often.
_LESS, _AGAIN = 0.75, 12


@dataclass(frozen=True)
class Excited:
    """
    A manoeuvre as it was flown.

    Attributes
    ----------
    scene, vehicle
        Whose.
    plan
        Of the scale at which it keeps within the limits.
    scale
        Of the plan, 1: as the limits alone would allow.
    thrusts
        Commanded [N], shape (n, t).
    flight
        What a perfect log of it would hold.
    seen
        Largest distance from the begin along an axis [m], speed [m/s] and tilt [rad].

    """

    scene: Scene
    vehicle: str
    plan: Plan
    scale: float
    thrusts: Array
    flight: Flight
    seen: dict[str, float]


def excite(name: str, duration: float, seed: int, limits: Limits, vehicle: str = '') -> Excited:
    """
    Return a manoeuvre that keeps within limits, flown by the model.

    Parameters
    ----------
    name
        Of the scene, or a file.
    duration
        [s].
    seed
        Of all draws.
    limits
        That it keeps within.
    vehicle
        Of the scene; '' for its only one with thrusters.

    Returns
    -------
    Excited
        The first of ever smaller ones that keeps within the limits.

    Raises
    ------
    ConfigError
        If there is none, or nothing to excite.

    """
    limits = limits.checked()
    if not 5.0 <= duration <= 600.0:
        raise ConfigError(f'--duration: {duration:g} is not within 5 to 600 s')
    scene = replace(comparable_scene(name), keyframe=Scene.load(name).keyframe)
    scale, seen = 1.0, {}
    for _ in range(_AGAIN):
        try:
            found = _fly(scene, duration, seed, limits, scale, vehicle)
        except DivergedError:
            scale *= _LESS
            continue
        seen = found.seen
        if (
            not seen['touched']
            and seen['distance_m'] <= 0.5 * limits.space
            and seen['speed_m_s'] <= limits.speed
            and seen['tilt_rad'] <= limits.tilt
        ):
            return found
        scale *= _LESS
    raise ConfigError(
        f"'{scene.name}' does not keep within the limits, however little it is excited: it goes "
        f'{seen.get("distance_m", np.inf):.2g} m far at {seen.get("speed_m_s", np.inf):.2g} m/s '
        f'and {np.degrees(seen.get("tilt_rad", np.inf)):.2g} deg of tilt'
    )


def _fly(
    scene: Scene, duration: float, seed: int, limits: Limits, scale: float, wanted: str
) -> Excited:
    simulation = Simulation(scene)
    names = [n for n, v in simulation.vehicles.items() if v.thrusters and v.qpos_address >= 0]
    name = wanted or (names[0] if len(names) == 1 else '')
    if name not in names:
        raise ConfigError(
            f"scene '{scene.name}' has no single vehicle with thrusters to excite"
            + (f'; it has: {", ".join(names)} (--vehicle NAME)' if names else '')
        )
    vehicle, row = simulation.vehicles[name], list(simulation.vehicles).index(name)
    if vehicle.joints:
        raise ConfigError(f"'{name}' is steered by joints: excite knows thrusters alone")
    plant, _ = plant_of(simulation.scene, name)
    first = simulation.observe(forces=False)[row].copy()
    helm = helm_of(plant, vehicle, state_of(simulation, first))
    floats = plant.weight < 0.05 * plant.mass * 9.8
    every = max(1, round(1 / RATE / simulation.timestep))
    count = round(duration / simulation.timestep / every)
    times = np.arange(count, dtype=np.float64) * (every * simulation.timestep)
    todo = plan(seed, times, len(vehicle.thrusters), limits, floats)
    low, high = vehicle.thrust_range.T
    thrusts, rows, speeds = np.empty((len(times), len(vehicle.thrusters))), [], []
    before, touched = np.zeros(4), False
    for i in range(len(times)):
        seen = simulation.observe(forces=False)[row].copy()
        before = _move(helm, scale * todo.targets[i], before)
        held = np.asarray(helm(state_of(simulation, seen)).thrusts)
        reach = np.minimum(high - held, held - low).clip(0)
        given = 0.0 * held if todo.free[i] else held + scale * todo.thrusts[i] * reach
        thrusts[i] = np.round(np.clip(given, low, high), DIGITS)
        simulation.set_thrust(name, thrusts[i])
        rows.append(seen)
        speeds.append(_speeds(simulation, vehicle.thruster_ids))
        simulation.step(every)
        touched = touched or simulation.data.ncon > 0
    table = np.array(rows)
    flight = _flight(scene, name, times, table, thrusts, np.array(speeds), vehicle.thrusters)
    simulation.close()
    far = np.abs(table[:, nat.POSITION] - first[nat.POSITION]).max()
    _, x, y, _ = table[:, nat.QUATERNION].T
    seen_most = {
        'touched': float(touched),  # the ground, which windows of a comparison do not have
        'distance_m': float(far),
        'speed_m_s': float(np.linalg.norm(table[:, nat.LINEAR_VELOCITY], axis=1).max()),
        'tilt_rad': float(np.arccos(np.clip(1 - 2 * (x**2 + y**2), -1, 1)).max()),
    }
    return Excited(scene, name, todo, scale, thrusts, flight, seen_most)


def _move(helm: Helm, to: Array, before: Array) -> Array:
    """Move a target, in the axes of its heading; return where it now is."""
    by = to - before
    cos, sin = np.cos(before[3]), np.sin(before[3])
    helm.move(Move(float(cos * by[0] + sin * by[1]), float(-sin * by[0] + cos * by[1]),
                   float(by[2]), float(by[3])))  # fmt: skip
    return to


def _speeds(simulation: Simulation, thrusters: Iterable[int]) -> list[float]:
    out = np.zeros(len(nat.THRUSTER_VALUES))
    found = []
    for actuator in thrusters:
        nat.native().thruster(
            simulation.model._address, simulation.data._address, int(actuator), out.ctypes.data
        )
        found.append(float(out[0]))
    return found


def _flight(
    scene: Scene, vehicle: str, times: Array, rows: Array, thrusts: Array, speeds: Array,
    names: tuple[str, ...],
) -> Flight:  # fmt: skip
    """Return what a perfect log would hold, driven by the commands."""
    attitude = rows[:, nat.QUATERNION]
    velocity = rotations(attitude).apply(rows[:, nat.LINEAR_VELOCITY])
    none = np.zeros(len(times), dtype=np.bool_)

    def signal(quantity: str, values: Array, *, command: bool = False) -> Signal:
        return Signal(quantity, times, values, 'simulated', names if values.shape[1] > 4 or command
                      else (), 'stated', truth=True, command=command, outliers=none)  # fmt: skip

    signals = {
        'position': signal('position', rows[:, nat.POSITION]),
        'attitude': signal('attitude', attitude),
        'velocity': signal('velocity', velocity),
        'rates': signal('rates', rows[:, nat.ANGULAR_VELOCITY]),
        'thrust': signal('thrust', thrusts, command=True),
    }
    if np.any(speeds):
        signals['rotor_speed'] = replace(signal('rotor_speed', speeds), names=names)
    raw = RawLog(Path(f'{scene.name} excited'), 'simulated flight', 'fluid_sim', {})
    return Flight(raw, signals, vehicle=vehicle)
