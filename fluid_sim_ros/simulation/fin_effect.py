# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How the joint actuators of a vehicle turn it at speed, measured on the compiled scene."""

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation.simulation import Simulation

#: Deflections for the difference quotient [rad] and speed ahead [m/s].
_STEP, _SPEED = 0.05, 1.5


def fin_effect(scene: str | Scene, vehicle: Vehicle) -> Array:
    """
    Return the angular acceleration that each joint actuator gives the vehicle at speed.

    Level at the scene's keyframe, straight ahead in still fluid; a central difference over the
    joint's position, with its command at the same value, so that a servo adds no torque.

    Parameters
    ----------
    scene
        Name or path, as for the node, or a scene.
    vehicle
        The vehicle, with a free joint.

    Returns
    -------
    Array
        Per deflection and squared speed [1/m^2], base_link axes, shape (3, number of joints).

    """
    simulation = Simulation(scene)
    simulation.enable_wind(False)
    model, data = simulation.model, simulation.data
    at, dof = vehicle.qpos_address, vehicle.dof_address
    data.qpos[at + 3 : at + 7] = (1.0, 0.0, 0.0, 0.0)
    data.qvel[:] = 0.0
    data.qvel[dof] = _SPEED
    data.ctrl[:] = 0.0
    effect = np.zeros((3, len(vehicle.joints)))
    for column, actuator in enumerate(vehicle.joint_ids):
        place = model.jnt_qposadr[model.actuator_trnid[actuator, 0]]
        before = float(data.qpos[place])
        for sign in (1, -1):
            data.qpos[place] = before + sign * _STEP
            data.ctrl[actuator] = before + sign * _STEP
            mujoco.mj_forward(model, data)
            effect[:, column] += sign * data.qacc[dof + 3 : dof + 6]
        data.qpos[place], data.ctrl[actuator] = before, 0.0
    return effect / (2.0 * _STEP * _SPEED**2)
