# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Parts of a model that the log of a vehicle does not know: a load on a cord, a tether, a hinge.

The log has the motion of the vehicle alone. What hangs on it is carried along the measured motion
by the model itself: the vehicle goes where it was measured, whatever pulls on it, and its parts
follow. From the states that they then have, windows fly.
"""

import copy
from dataclasses import replace

import mujoco
import numpy as np

from fluid_sim_ros.flights.flight import STATE, Flight
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.flow import time_in_model
from fluid_sim_ros.reality.windows import Windows, state_at

#: Mass of the vehicle while it is carried, over its own: nothing that hangs on it moves it.
_HEAVY = 1e6
#: The parts hang so long at the first measured state before the flight begins, and are carried so
#: long before the first window [s]: a pendulum of a metre dies out or is in step by then.
_HANGS, _BEFORE = 3.0, 20.0


def with_parts(windows: Windows, driven: Driven) -> Windows:
    """
    Return windows with the states of the other parts at their begins.

    Parameters
    ----------
    windows
        Of a flight.
    driven
        The model that it drives.

    """
    if not driven.has_parts:
        return windows
    return replace(windows, parts=carried(driven, windows.flight, windows.begins))


def carried(driven: Driven, flight: Flight, times: Array) -> Array:
    """
    Return the states of the other parts at times of a flight, shape (n, size).

    Parameters
    ----------
    driven
        The model that the flight drives.
    flight
        It.
    times
        [s], shape (n,).

    Returns
    -------
    Array
        Generalised positions, then velocities, of all that is not the vehicle's own.

    """
    heavy = copy.copy(driven.model)
    mass = _make_heavy(heavy, driven)
    model, data, vehicle = heavy, mujoco.MjData(heavy), driven.vehicle
    step = model.opt.timestep
    first = max(max(flight.signals[name].times[0] for name in STATE), times.min() - _BEFORE)
    count = int(np.ceil((times.max() - first) / step)) + 1
    clock = first + step * np.arange(count + 1)
    states = state_at(flight, clock)
    signal = flight.actuators
    assert signal is not None
    taken = signal.between if driven.kind == 'rotor_speed' else signal.held
    controls = driven.controls(taken(clock)[:, list(driven.columns)])
    wanted = np.clip(np.rint((times - first) / step).astype(int), 0, count)
    _hang(driven, data, states[0])
    qpos, qvel = driven.other_positions, driven.other_velocities
    along = np.empty((count + 1, len(qpos) + len(qvel)))
    at, dof, base = vehicle.qpos_address, vehicle.dof_address, vehicle.body_id
    lead = round(_HANGS / step)
    still = states[0].copy()
    still[7:] = 0.0
    for i in range(-lead, count + 1):
        state = states[i] if i >= 0 else still
        data.time = float(time_in_model(flight, clock[max(i, 0)]))
        data.qpos[at : at + 7], data.qvel[dof : dof + 6] = state[:7], state[7:]
        if i >= 0:
            along[i, : len(qpos)], along[i, len(qpos) :] = data.qpos[qpos], data.qvel[qvel]
        data.ctrl[vehicle.thruster_ids] = controls[max(i, 0)]
        later = states[min(i + 1, count)] if i >= 0 else still
        # as the vehicle was measured to speed up, and against its weight
        data.xfrc_applied[base, :3] = mass * (
            (later[7:10] - state[7:10]) / step - model.opt.gravity
        )
        mujoco.mj_step(model, data)
    found: Array = along[wanted]
    return found


def _make_heavy(model: mujoco.MjModel, driven: Driven) -> float:
    base = driven.vehicle.body_id
    mass, size = float(model.body_mass[base]), float(model.body_inertia[base].max())
    model.body_mass[base], model.body_inertia[base] = _HEAVY * mass, _HEAVY * size
    model.body_ipos[base], model.body_iquat[base] = 0.0, (1.0, 0.0, 0.0, 0.0)
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return _HEAVY * mass


def _hang(driven: Driven, data: mujoco.MjData, state: Array) -> None:
    """Take what is free along with the vehicle, in place and heading."""
    model, vehicle = driven.model, driven.vehicle
    base = model.qpos0[vehicle.qpos_address : vehicle.qpos_address + 7]
    turn = _heading(state[3:7]) - _heading(base[3:7])
    about = np.array([np.cos(turn / 2), 0.0, 0.0, np.sin(turn / 2)])
    for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE):
        at = int(model.jnt_qposadr[joint])
        if at == vehicle.qpos_address:
            continue
        away, turned = np.zeros(3), np.zeros(4)
        mujoco.mju_rotVecQuat(away, model.qpos0[at : at + 3] - base[:3], about)
        mujoco.mju_mulQuat(turned, about, model.qpos0[at + 3 : at + 7])
        data.qpos[at : at + 3], data.qpos[at + 3 : at + 7] = state[:3] + away, turned


def _heading(wxyz: Array) -> float:
    w, x, y, z = wxyz
    return float(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
