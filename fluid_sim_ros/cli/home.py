# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where on the Earth a run takes place, and which way its vehicles look."""

import math
from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.base import validated
from fluid_sim_ros.schema.scene import Home
from fluid_sim_ros.simulation import Simulation


def scene_at(scene: Scene, home: Sequence[float]) -> Scene:
    """
    Return a scene with its origin at a place.

    Parameters
    ----------
    scene
        As its file says.
    home
        Latitude and longitude [deg] (WGS 84), altitude [m]; more is left alone.

    Returns
    -------
    Scene
        The same, elsewhere.

    Raises
    ------
    ConfigError
        If a number is beyond its range.

    """
    given = dict(zip(('latitude', 'longitude', 'altitude'), home, strict=False))
    place = validated(Home, {**scene.home.model_dump(), **given}, where='--home: ')
    return replace(scene, home=place)


def turn_to(simulation: Simulation, heading: float) -> None:
    """
    Have every vehicle look a way, about its own place; its velocity turns with it.

    Parameters
    ----------
    simulation
        At its start.
    heading
        Clockwise from north [deg].

    Raises
    ------
    ConfigError
        If it is not finite, or a vehicle does not move freely.

    """
    if not math.isfinite(heading):
        raise ConfigError(f'--home: heading {heading}: must be finite')
    model, data = simulation.model, simulation.data
    for vehicle in simulation.vehicles.values():
        joint = int(model.body_jntadr[vehicle.body_id])
        if joint < 0 or model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE:
            raise ConfigError(f"--home: vehicle '{vehicle.name}' cannot be turned: no free joint")
        place, speed = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
        quat = data.qpos[place + 3 : place + 7]
        w, x, y, z = quat
        yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        half = 0.5 * (math.radians(90.0 - heading) - yaw)
        turn = np.array([math.cos(half), 0.0, 0.0, math.sin(half)])
        mujoco.mju_mulQuat(quat, turn, quat.copy())
        velocity = data.qvel[speed : speed + 3]
        mujoco.mju_rotVecQuat(velocity, velocity.copy(), turn)
