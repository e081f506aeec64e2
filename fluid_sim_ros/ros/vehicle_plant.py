"""What the example controllers know of their vehicle, read from the same scene as the node's."""

import mujoco
import numpy as np

from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.scene import CompiledScene, Scene
from fluid_sim_ros.vehicle import Vehicle


def plant_of(scene: str, vehicle: str) -> tuple[Plant, Vehicle]:
    """
    Return mass, inertia and thrusters of a vehicle in a scene.

    Parameters
    ----------
    scene
        Name or path, as for the node.
    vehicle
        Vehicle name; empty means the scene's only vehicle with thrusters.

    Raises
    ------
    ConfigError
        If the vehicle is not in the scene, or the choice is not unique.

    """
    compiled = Scene.load(scene).compile()
    return plant_from_model(compiled, choose_vehicle(compiled, scene, vehicle))


def choose_vehicle(compiled: CompiledScene, scene: str, vehicle: str) -> Vehicle:
    """Return the named vehicle, or the only one with thrusters when the name is empty."""
    if vehicle:
        if vehicle not in compiled.vehicles:
            raise ConfigError(
                f"vehicle '{vehicle}' is not in scene '{scene}'; "
                f'it has: {listed(compiled.vehicles)}'
            )
        return compiled.vehicles[vehicle]
    driven = [v for v in compiled.vehicles.values() if v.thrusters]
    if len(driven) != 1:
        raise ConfigError(
            f"scene '{scene}' has {len(driven)} vehicles with thrusters "
            f"({listed(v.name for v in driven)}); set the parameter 'vehicle' to one of them"
        )
    return driven[0]


def plant_from_model(compiled: CompiledScene, vehicle: Vehicle) -> tuple[Plant, Vehicle]:
    """
    Return the plant of a vehicle, measured on its compiled model at rest and level.

    Weight is what holds the vehicle at rest, so gravity compensation and buoyancy count, whatever
    provides them. Each column of the thruster matrix is the wrench at 1 N of that thruster.
    """
    model = compiled.model
    if vehicle.dof_address < 0:
        raise ConfigError(f"vehicle '{vehicle.name}': its base has no free joint")
    if not vehicle.thrusters:
        raise ConfigError(f"vehicle '{vehicle.name}' has no thrusters; a controller needs some")
    data = mujoco.MjData(model)
    if compiled.keyframe_id >= 0:
        mujoco.mj_resetDataKeyframe(model, data, compiled.keyframe_id)
    at, dof = vehicle.qpos_address, vehicle.dof_address
    data.qpos[at + 3 : at + 7] = (1.0, 0.0, 0.0, 0.0)
    data.qvel[:] = 0.0
    data.ctrl[:] = 0.0
    wind, model.opt.wind = model.opt.wind.copy(), 0.0
    mujoco.mj_forward(model, data)
    model.opt.wind = wind

    # composite inertia about the centre of mass of the kinematic tree, axes of the world = body
    inertia = data.crb[vehicle.body_id]
    center_b = data.subtree_com[vehicle.body_id] - data.xpos[vehicle.body_id]
    weight = float(data.qfrc_bias[dof + 2] - data.qfrc_passive[dof + 2])
    matrix = np.empty((6, len(vehicle.thrusters)))
    for column, actuator in enumerate(vehicle.thruster_ids):
        data.ctrl[:] = 0.0
        data.ctrl[actuator] = 1.0
        mujoco.mj_fwdActuation(model, data)
        wrench = data.qfrc_actuator[dof : dof + 6]
        matrix[:3, column] = wrench[:3]
        matrix[3:, column] = wrench[3:] - np.cross(center_b, wrench[:3])
    plant = Plant(
        mass=float(model.body_subtreemass[vehicle.body_id]),
        inertia=(float(inertia[0]), float(inertia[1]), float(inertia[2])),
        weight=weight,
        thruster_matrix=matrix,
        thrust_limits=vehicle.thrust_range.copy(),
    )
    return plant, vehicle
