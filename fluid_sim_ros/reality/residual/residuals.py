# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a model's accelerations lack at the measured states: by axis, and against what."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.reality.carried import with_parts
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.spinning import first_speeds
from fluid_sim_ros.reality.windows import ATTITUDE, VELOCITY, Windows, state_at
from fluid_sim_ros.simulation.engine import Engine

#: Accelerations are averaged over this time, in the log and in the model [s]: what shakes faster
#: is vibration.
AVERAGE = 0.05
#: Distance of the looks [s], and most of them.
_APART, _MOST = 0.004, 8000


@dataclass(frozen=True)
class Residuals:
    """
    Accelerations along a flight, averaged, measured and by the model.

    Attributes
    ----------
    times
        [s], shape (n,).
    force, force_model
        Specific force, body axes [m/s^2], shape (n, 3); empty without an accelerometer.
    turn, turn_model
        Angular acceleration, body axes [rad/s^2], shape (n, 3).
    speed
        Velocity relative to the medium as far as it is known, body axes [m/s], shape (n, 3).
    tilt
        [rad], shape (n,).
    controls
        Of the thrusters, in the unit of the model, shape (n, m).
    speeds
        Of the rotors that have a lag [rad/s], shape (n, k); None where none has.

    """

    times: Array
    force: Array
    force_model: Array
    turn: Array
    turn_model: Array
    speed: Array
    tilt: Array
    controls: Array
    speeds: Array | None

    @property
    def drive(self) -> Array:
        """Mean of the controls' sizes, shape (n,)."""
        mean: Array = np.abs(self.controls).mean(axis=1)
        return mean


@dataclass(frozen=True)
class Accelerations:
    """What a model has at measured states, body axes, and what its thrusters ran at."""

    force: Array
    turn: Array
    controls: Array
    speeds: Array | None


def residuals(flyer: Flyer, windows: Windows) -> Residuals:
    """
    Evaluate a model's accelerations at the measured states of a flight.

    Parameters
    ----------
    flyer
        Of the driven model.
    windows
        Where the flight is whole.

    Returns
    -------
    Residuals
        Inside of the windows.

    """
    flight = windows.flight
    times = _times(windows)
    states = state_at(flight, times)
    model = accelerations(flyer, flight, times)
    force = np.zeros((0, 3))
    if 'specific_force' in flight.signals:
        force = averaged(times, flight.signals['specific_force'].between(times))
    rates = flight.signals['rates'].between(times)
    turn = np.gradient(averaged(times, rates), times, axis=0)
    attitude = rotations(states[:, ATTITUDE])
    wind = flight.signals.get('wind')
    relative = states[:, VELOCITY] - (0.0 if wind is None else wind.between(times))
    up = attitude.apply(np.tile([0.0, 0.0, 1.0], (len(times), 1)))[:, 2]
    return Residuals(
        times, force, averaged(times, model.force), turn, averaged(times, model.turn),
        attitude.inv().apply(relative), np.arccos(np.clip(up, -1, 1)),
        model.controls, model.speeds,
    )  # fmt: skip


def accelerations(flyer: Flyer, flight: Flight, times: Array) -> Accelerations:
    """
    Return a model's specific force and angular acceleration at measured states.

    Parameters
    ----------
    flyer
        Of the driven model.
    flight
        That drives it.
    times
        [s], shape (n,).

    Returns
    -------
    Accelerations
        [m/s^2] and [rad/s^2], shape (n, 3) each.

    """
    driven, signal = flyer.driven, flight.actuators
    assert signal is not None
    states = state_at(flight, times)
    taken = signal.between if driven.kind == 'rotor_speed' else signal.held
    controls = driven.controls(taken(times)[:, list(driven.columns)])
    looks = with_parts(Windows(flight, times, 0.0, {}), driven)
    speeds = first_speeds(flyer, looks, states)
    force, turn = _model(driven, states, looks, controls, speeds)
    return Accelerations(force, turn, controls, speeds)


def responses(found: Residuals, flyer: Flyer, flight: Flight) -> Array | None:
    """
    Return what each thruster alone changes of a model's accelerations, half way through a flight.

    Parameters
    ----------
    found
        Along the flight.
    flyer, flight
        They are of.

    Returns
    -------
    Array
        Angular acceleration and specific force [rad/s^2, m/s^2], shape (m, 6), for one more of
        its control, or of its rotor's speed squared [(rad/s)^2]; None where only some of the
        rotors lag.

    """
    count = found.controls.shape[1]
    runs = found.controls if found.speeds is None else found.speeds
    if runs.shape[1] != count:
        return None
    usual = runs.mean(axis=0)
    step = 0.01 * np.maximum(np.abs(usual), 0.1 * np.abs(runs).max(initial=1e-6))
    tried = np.vstack([usual, usual + np.diag(step)])
    times = np.full(count + 1, found.times[len(found.times) // 2])
    states, looks = state_at(flight, times), Windows(flight, times, 0.0, {})
    looks = with_parts(looks, flyer.driven)
    controls = (
        tried if found.speeds is None else np.tile(found.controls.mean(axis=0), (count + 1, 1))
    )
    force, turn = _model(
        flyer.driven, states, looks, controls, None if found.speeds is None else tried
    )
    both = np.hstack([turn, force])
    given = driving(tried, found.speeds is not None or flyer.driven.kind == 'rotor_speed')
    change: Array = (both[1:] - both[0]) / np.diag(given[1:] - given[0])[:, None]
    return change


def driving(runs: Array, squared: bool) -> Array:
    """
    Return what forces are proportional to: controls, or rotor speeds squared.

    Parameters
    ----------
    runs
        Controls or speeds.
    squared
        Whether they are speeds.

    """
    return runs * np.abs(runs) if squared else runs


def _times(windows: Windows) -> Array:
    begin, end = windows.begins[0], windows.begins[-1] + windows.length
    times = np.arange(begin, end, max(_APART, (end - begin) / _MOST))
    inside = np.zeros(len(times), dtype=np.bool_)
    for start in windows.begins:
        first, last = np.searchsorted(times, (start, start + windows.length))
        inside[first:last] = True
    return times[inside]


def _model(
    driven: Driven, states: Array, looks: Windows, controls: Array, spun: Array | None
) -> tuple[Array, Array]:
    engine = Engine(driven.model, [driven.vehicle.body_id])
    model, data, vehicle = engine.model, engine.data, driven.vehicle
    at, dof = vehicle.qpos_address, vehicle.dof_address
    has = model.actuator_actnum[vehicle.thruster_ids] > 0
    qpos, qvel = driven.other_positions, driven.other_velocities
    acts = model.actuator_actadr[vehicle.thruster_ids][has]
    force, turn = np.empty((len(states), 3)), np.empty((len(states), 3))
    clock = looks.clock
    for i, state in enumerate(states):
        data.time = clock[i]
        data.qpos[at : at + 7], data.qvel[dof : dof + 6] = state[:7], state[7:]
        if looks.parts is not None:
            data.qpos[qpos] = looks.parts[i, : len(qpos)]
            data.qvel[qvel] = looks.parts[i, len(qpos) :]
        data.ctrl[vehicle.thruster_ids] = controls[i]
        if spun is not None:
            data.act[acts] = spun[i]
        row = engine.observe(forces=True, wrenches=False)[0]
        force[i], turn[i] = row[nat.SPECIFIC_FORCE], row[nat.ANGULAR_ACCELERATION]
    return force, turn


def averaged(times: Array, values: Array) -> Array:
    """
    Return a running mean over ``AVERAGE``; the ends are averaged over what is there.

    Parameters
    ----------
    times
        [s], shape (n,).
    values
        Shape (n, m).

    """
    if len(times) < 3 or not len(values):
        return values
    half = max(1, round(0.5 * AVERAGE / float(np.median(np.diff(times)))))
    total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
    index = np.arange(len(values))
    low: Any = np.maximum(index - half, 0)
    high: Any = np.minimum(index + half + 1, len(values))
    counts: Any = high - low
    mean: Array = (total[high] - total[low]) / counts[:, None]
    return mean
