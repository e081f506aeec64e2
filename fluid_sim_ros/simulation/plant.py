# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a controller knows of its vehicle, measured on the compiled scene."""

import mujoco
import numpy as np

from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.thrust_matrix import thrust_matrix


def plant_of(scene: str | Scene, vehicle: str) -> tuple[Plant, Vehicle]:
    """
    Return mass, inertia and thrusters of a vehicle in a scene, and the vehicle.

    Parameters
    ----------
    scene
        Name or path, as for the node, or a scene.
    vehicle
        Vehicle name; empty means the scene's only vehicle with thrusters.

    Raises
    ------
    ConfigError
        If the vehicle is not in the scene, the choice is not unique, or it has no thrusters or
        no free joint.

    """
    simulation = Simulation(scene)
    chosen = _choose(simulation, vehicle)
    if chosen.dof_address < 0:
        raise ConfigError(f"vehicle '{chosen.name}': its base has no free joint")
    if not chosen.thrusters:
        raise ConfigError(f"vehicle '{chosen.name}' has no thrusters; a controller needs some")
    return _measure(simulation, chosen), chosen


def _choose(simulation: Simulation, vehicle: str) -> Vehicle:
    """
    Return the named vehicle, or the only one with thrusters when the name is empty.

    Raises
    ------
    ConfigError
        If there is no such vehicle, or the choice is not unique.

    """
    scene, vehicles = simulation.scene.name, simulation.vehicles
    if vehicle:
        if vehicle not in vehicles:
            raise ConfigError(
                f"vehicle '{vehicle}' is not in scene '{scene}'"
                f'{did_you_mean(vehicle, vehicles)} it has: {listed(vehicles)}'
            )
        return vehicles[vehicle]
    driven = [v for v in vehicles.values() if v.thrusters]
    if len(driven) != 1:
        raise ConfigError(
            f"scene '{scene}' has {len(driven)} vehicles with thrusters "
            f"({listed(v.name for v in driven)}); set the parameter 'vehicle' to one of them"
        )
    return driven[0]


def _measure(simulation: Simulation, vehicle: Vehicle) -> Plant:
    """
    Measure the plant on the compiled model, at rest and level at the scene's keyframe.

    Weight is what holds the vehicle at rest, so gravity compensation and buoyancy count, whatever
    provides them.
    """
    simulation.enable_wind(False)
    model, data = simulation.model, simulation.data
    at, dof, body = vehicle.qpos_address, vehicle.dof_address, vehicle.body_id
    data.qpos[at + 3 : at + 7] = (1.0, 0.0, 0.0, 0.0)
    data.qvel[:] = 0.0
    data.ctrl[:] = 0.0
    mujoco.mj_forward(model, data)
    # composite inertia about the centre of mass of the kinematic tree, axes of the world = body
    inertia = data.crb[body]
    center_b = data.subtree_com[body] - data.xpos[body]
    weight = float(data.qfrc_bias[dof + 2] - data.qfrc_passive[dof + 2])
    matrix = thrust_matrix(model, data, vehicle)
    matrix[3:] -= np.cross(center_b, matrix[:3], axisb=0, axisc=0)
    return Plant(
        mass=float(model.body_subtreemass[body]),
        inertia=(float(inertia[0]), float(inertia[1]), float(inertia[2])),
        weight=weight,
        thruster_matrix=matrix,
        thrust_limits=vehicle.thrust_range.copy(),
    )
