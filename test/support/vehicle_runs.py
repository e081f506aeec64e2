# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs of the vehicle scenes that the tests and the benchmark compare with vehicle_equations."""

from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros import Scene, Simulation

Array = NDArray[np.float64]

#: Commands [N] of the four vectored thrusters for full speed ahead and to the left, 16 V.
AHEAD, LEFT = (-39.9, -39.9, 51.4, 51.4), (-39.9, 51.4, -39.9, 51.4)
#: Full-speed runs of a BlueROV2: axis and the sign of its vertical thrusters' full command.
TOP_SPEEDS = {'surge': 0, 'sway': 1, 'heave up': 2, 'heave down': 2}


def top_command(direction: str, thrusters: int) -> list[float]:
    """Return the command [N] of a BlueROV2 for full speed in a direction."""
    vertical = {'heave up': -39.9, 'heave down': 51.4}.get(direction, 0.0)
    vectored = {'surge': AHEAD, 'sway': LEFT}.get(direction, (0.0,) * 4)
    return [*vectored, *[vertical] * (thrusters - 4)]


def start(scene: str, height: float, *, thrust: ArrayLike | None = None) -> Simulation:
    """Return a simulation of a scene without its events, at a height [m] out of reach."""
    simulation = Simulation(replace(Scene.load(scene), schedule=()))
    simulation.data.qpos[2] = height
    simulation.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    if thrust is not None:
        set_all(simulation, scene, thrust)
    return simulation


def set_all(simulation: Simulation, vehicle: str, thrust: ArrayLike) -> None:
    """Command thrusts [N], one for all or each; none may saturate."""
    count = len(simulation.vehicles[vehicle].thrusters)
    if simulation.set_thrust(vehicle, np.broadcast_to(np.asarray(thrust, float), (count,))):
        raise ValueError(f'{vehicle}: a command saturates')


def held(simulation: Simulation, quat: Array, seconds: float) -> Array:
    """Run with the attitude held; return the velocity in world axes [m/s], one row per step."""
    velocity = np.empty((round(seconds / simulation.timestep), 3))
    model, data, qvel = simulation.model, simulation.data, simulation.data.qvel
    data.qpos[3:7] = quat
    mujoco.mj_forward(model, data)
    mass = np.empty((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    # stopping the turn is a torque: the momentum of body and water stays, no more
    of_turn = np.linalg.solve(mass[:3, :3], mass[:3, 3:6])
    for row in velocity:
        data.qpos[3:7] = quat
        qvel[:3] += of_turn @ qvel[3:6]
        qvel[3:6] = 0
        simulation.step()
        row[:] = qvel[:3]
    return velocity


def free(simulation: Simulation, vehicle: str, seconds: float, every: int) -> tuple[Array, Array]:
    """Run free; return times [s] and body velocities of base_link, shape (n, 6)."""
    times, rows = [], []
    for _ in range(round(seconds / simulation.timestep / every)):
        simulation.step(every)
        state = simulation.snapshot().vehicles[vehicle]
        times.append(simulation.time)
        rows.append(np.r_[state.velocity_b, state.omega_b])
    return np.array(times), np.array(rows)


def top_speed(scene: str, direction: str) -> float:
    """Return the speed [m/s] that a BlueROV2 reaches, held level."""
    count = len(Scene.load(scene).compile().vehicles[scene].thrusters)
    simulation = start(scene, -50, thrust=top_command(direction, count))
    velocity = held(simulation, np.array([1.0, 0, 0, 0]), 8.0)
    return float(velocity[-1, TOP_SPEEDS[direction]])


def decay(scene: str, axis: int, initial: float, seconds: float) -> tuple[Array, Array]:
    """Return times [s] and the velocity on one axis (0..5) that dies out from ``initial``."""
    simulation = start(scene, -50)
    for at_start in (simulation.data.qvel, simulation.data.act, simulation.data.ctrl):
        at_start[:] = 0  # a keyframe may be under way
    simulation.data.qvel[axis] = initial
    times, rows = free(simulation, scene, seconds, 10)
    return times, rows[:, axis]


def tilted(scene: str, tilt: float, thrust: float, seconds: float, forward: float) -> Array:
    """Return the velocity in world axes [m/s] at a held tilt [rad], from ``forward``, per step."""
    simulation = start(scene, 500, thrust=thrust)
    simulation.data.qvel[0] = forward
    return held(simulation, np.array([np.cos(tilt / 2), 0, np.sin(tilt / 2), 0]), seconds)
