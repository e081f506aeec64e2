# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flights that our own simulator flew, as tables: what is true of them is known."""

from dataclasses import replace

import mujoco
import numpy as np

from fluid_sim_ros.scene import Scene
from fluid_sim_ros.simulation import Simulation
from test.support.flight_logs import csv_text


def x500_table(seconds=4.0, every=5, seed=3, noise=None, wind=None):
    """
    Return the columns of a flight of the x500.

    ``noise``: standard deviation by block; ``wind``: of a time [s], east, north and up [m/s].
    """
    scene = Scene.load('x500')
    scene = replace(scene, schedule=())
    simulation = Simulation(scene)
    data = simulation.data
    rng = np.random.default_rng(seed)
    vehicle = simulation.vehicles['x500']
    hover = data.ctrl[vehicle.thruster_ids].copy()
    rows = []
    steps = round(seconds / simulation.timestep)
    data.qpos[2] = 30.0  # far from the ground
    phase = rng.uniform(0, 2 * np.pi, 6)
    for step in range(steps):
        time = step * simulation.timestep
        if wind is not None:
            simulation.set_wind(wind(time))
        wave = np.sin(2 * np.pi * np.array([0.7, 1.1, 0.3, 0.5, 0.9, 0.4]) * time + phase)
        climb = 1 + 0.1 * wave[0] - 0.05 * (data.qpos[2] - 30) - 0.05 * data.qvel[2]
        thrust = hover * climb + _held(data, 0.5 * wave[2:4], wave[1])
        simulation.set_thrust('x500', thrust)
        if step % every == 0:
            q, v = data.qpos[:7].copy(), data.qvel[:6].copy()
            force = simulation.observe(forces=True)[0].copy()
            rows.append((time, q, v, force, data.act[::2].copy()))
        simulation.step()
    return _columns(rows, rng, noise or {})


def _held(data, tilt, yaw):
    """Return thrusts that turn the x500 to a roll and a pitch [rad], and damp it [N]."""
    w, x, y, z = data.qpos[3:7]
    off = np.array([tilt[0] - 2 * w * x, tilt[1] - 2 * w * y, 0.5 * yaw - 2 * w * z])
    want = 3.0 * off - 0.6 * data.qvel[3:6]
    front, left = np.array([1, -1, 1, -1]), np.array([-1, 1, 1, -1])
    turns = np.array([1, 1, -1, -1])  # m1, m2 turn counter-clockwise, and the hull the other way
    return want[0] * left - want[1] * front - 0.5 * want[2] * turns


def _columns(rows, rng, noise):
    from fluid_sim_ros.plugins import native as nat

    columns = {'time': np.array([row[0] for row in rows])}
    pose, speed = np.array([row[1] for row in rows]), np.array([row[2] for row in rows])
    force = np.array([row[3][nat.SPECIFIC_FORCE] for row in rows])
    blocks = {
        'position': ('xyz', pose[:, :3]), 'attitude': ('wxyz', pose[:, 3:]),
        'velocity': ('xyz', speed[:, :3]), 'rates': ('xyz', speed[:, 3:]),
        'specific_force': ('xyz', force),
        'rotor_speed': ('1234', np.array([row[4] for row in rows])),
    }  # fmt: skip
    for name, (endings, values) in blocks.items():
        values = values + rng.normal(0, noise.get(name, 0.0), values.shape)
        for ending, column in zip(endings, values.T, strict=True):
            columns[f'{name}_{ending}'] = column
    return columns


def write_x500(path, **how):
    """Write a flight of the x500 as CSV."""
    path.write_text(csv_text(x500_table(**how)))
    return path


def thrust_scaled(factor):
    """Return an edit that scales the thrust of every rotor."""

    def edit(spec: mujoco.MjSpec) -> None:
        for plugin in spec.plugins:
            if 'thrust_coefficient' in plugin.config:
                value = float(plugin.config['thrust_coefficient']) * factor
                plugin.config = {**plugin.config, 'thrust_coefficient': f'{value:.9g}'}

    return edit
