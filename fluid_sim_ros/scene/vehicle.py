# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle of a compiled scene: its base body and actuators as ids."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import ConfigError, ModelError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.plugins.config import THRUSTER, plugin_of_actuator
from fluid_sim_ros.scene.newtons import newton_scales
from fluid_sim_ros.schema.base import NAME_PATTERN
from fluid_sim_ros.schema.scene import VehicleFile
from fluid_sim_ros.schema.sensors import SensorsFile


@dataclass(frozen=True)
class Vehicle:
    """
    One vehicle of a compiled scene.

    Attributes
    ----------
    name
        Topic prefix and key of commands.
    kind
        By which mappings of autopilots go: the name of its model in a fleet, or else its own.
    prefix
        What its names begin with in the model: '' but in a fleet.
    body_id
        Id of the base body; its frame is ``<name>/base_link``.
    qpos_address, dof_address
        Start of the free joint in qpos and qvel, or -1 for a base without one.
    thrusters, thruster_ids
        Actuator names (without the prefix) in command order, and their ids, shape (n,).
    thrust_range
        Allowed commands [N], shape (n, 2); infinite where the model sets no limit.
    thrust_scale, effort_scale
        Force at a control of 1, and at an ``actuator_force`` of 1 [N], shape (n,): a motor of
        gear 50 gives 50 N for both; 1 where MuJoCo's numbers are newtons already.
    joints, joint_ids
        Actuators that ``cmd/joints`` sets by name, and their ids.
    joint_range
        Allowed commands, shape (m, 2).
    sensors
        Its sensors as its file states them.

    """

    name: str
    kind: str
    prefix: str
    body_id: int
    qpos_address: int
    dof_address: int
    thrusters: tuple[str, ...]
    thruster_ids: NDArray[np.int64]
    thrust_range: Array
    thrust_scale: Array
    effort_scale: Array
    joints: tuple[str, ...]
    joint_ids: NDArray[np.int64]
    joint_range: Array
    sensors: SensorsFile


def weight_in_air(model: mujoco.MjModel, body_id: int) -> float:
    """
    Return the weight of a body and all below it, without buoyancy [N].

    Parameters
    ----------
    model
        The compiled model.
    body_id
        Of the base.

    """
    return float(model.body_subtreemass[body_id]) * GRAVITY


def free_bodies(model: mujoco.MjModel, path: Path) -> dict[str, VehicleFile]:
    """
    Return a vehicle for every body with a free joint, under a name fit for topics.

    Parameters
    ----------
    model
        The compiled model.
    path
        Its file, for errors.

    Returns
    -------
    dict
        Name -> what its vehicle file would say.

    Raises
    ------
    ModelError
        If there is no such body, its name is no topic name, or two names become the same.

    """
    found: dict[str, VehicleFile] = {}
    free = np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)
    for joint in free:
        body = model.body(model.jnt_bodyid[joint]).name
        if not body:  # scenery; load_warnings says so
            continue
        name = re.sub(r'[^A-Za-z0-9_]', '_', body)
        if not re.match(NAME_PATTERN, name):
            raise ModelError(
                f'{path}: a body with a free joint has the name {body!r}, which is no topic '
                'name; give it a name that starts with a letter'
            )
        if name in found:
            raise ModelError(
                f'{path}: the bodies {found[name].body!r} and {body!r} both become the vehicle '
                f'{name!r}; rename one, or name the vehicles and their bodies in a scene YAML file'
            )
        found[name] = VehicleFile(body=body)
    if not found:
        what = (
            'the bodies with a free joint have no names'
            if len(free)
            else ('the model has no body with a free joint')
        )
        raise ModelError(
            f'{path}: {what}, so there is no vehicle; add a <freejoint/> to a body with a name, '
            'or name the vehicles and their bodies in a scene YAML file'
        )
    return found


def resolve(
    name: str,
    file: VehicleFile,
    model: mujoco.MjModel,
    where: str,
    prefix: str = '',
    kind: str = '',
) -> Vehicle:
    """
    Return a vehicle with its names as ids of the model.

    Parameters
    ----------
    name
        Of the vehicle.
    file
        How its commands map onto the model.
    model
        The compiled model.
    where
        What an error begins with.
    prefix
        What its names begin with in the model.
    kind
        By which mappings of autopilots go; '': its name.

    Returns
    -------
    Vehicle
        With ids.

    Raises
    ------
    ConfigError
        If the model lacks a body or an actuator that the file names; starts with ``where``.

    """
    body_id = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, prefix + file.body)
    if body_id < 0:
        names = listed(_own(prefix, (model.body(i).name for i in range(1, model.nbody))))
        raise ConfigError(f"{where}: body '{file.body}' is not in the model; it has: {names}")
    joint = model.body_jntadr[body_id]
    free = joint >= 0 and model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
    thrusters = file.thrusters
    if thrusters is None:
        thrusters = _own(prefix, _actuators(model, body_id, mujoco.mjtTrn.mjTRN_SITE))
    joints = file.joints
    if joints is None:
        joints = _own(prefix, _actuators(model, body_id, mujoco.mjtTrn.mjTRN_JOINT))
    thruster_ids = _actuator_ids(model, thrusters, where, prefix)
    for actuator, identity in zip(thrusters, thruster_ids, strict=True):
        if is_reaction_torque(model, int(identity)):
            raise ConfigError(
                f"{where}: thruster '{actuator}' is the reaction torque of a fluid_sim.thruster, "
                'which takes no command; name the actuator of its thrust'
            )
    joint_ids = _actuator_ids(model, joints, where, prefix)
    thrust_scale, effort_scale = newton_scales(model, thruster_ids)
    return Vehicle(
        name=name,
        kind=kind or name,
        prefix=prefix,
        body_id=int(body_id),
        qpos_address=int(model.jnt_qposadr[joint]) if free else -1,
        dof_address=int(model.jnt_dofadr[joint]) if free else -1,
        thrusters=tuple(thrusters),
        thruster_ids=thruster_ids,
        thrust_range=_control_range(model, thruster_ids) * thrust_scale[:, None],
        thrust_scale=thrust_scale,
        effort_scale=effort_scale,
        joints=tuple(joints),
        joint_ids=joint_ids,
        joint_range=_control_range(model, joint_ids),
        sensors=file.sensors,
    )


def _actuators(model: mujoco.MjModel, root: int, transmission: int) -> list[str]:
    """
    Return the actuators that act on a body's subtree through one kind of transmission.

    Without the reaction torques of fluid_sim.thruster: their rotors have a command already.
    """
    found = []
    for i in range(model.nu):
        if model.actuator_trntype[i] != transmission or is_reaction_torque(model, i):
            continue
        target = model.actuator_trnid[i, 0]
        body = (
            model.site_bodyid[target]
            if transmission == mujoco.mjtTrn.mjTRN_SITE
            else model.jnt_bodyid[target]
        )
        if _is_below(model, body, root):
            found.append(model.actuator(i).name)
    return found


def is_reaction_torque(model: mujoco.MjModel, actuator: int) -> bool:
    """
    Return whether an actuator is the torque of a fluid_sim.thruster; its control is unread.

    Parameters
    ----------
    model
        The compiled model.
    actuator
        Its id.

    """
    thruster = plugin_of_actuator(model, actuator, THRUSTER)
    return thruster is not None and not model.actuator_gear[actuator, :3].any()


def _is_below(model: mujoco.MjModel, body: int, root: int) -> bool:
    while body > root:
        body = model.body_parentid[body]
    return bool(body == root)


def _own(prefix: str, names: Iterable[str]) -> list[str]:
    """Return names of a vehicle as its own model has them."""
    return [name.removeprefix(prefix) for name in names if name.startswith(prefix)]


def _actuator_ids(
    model: mujoco.MjModel, names: Sequence[str], where: str, prefix: str
) -> NDArray[np.int64]:
    actuator = mujoco.mjtObj.mjOBJ_ACTUATOR
    ids = [mujoco.mj_name2id(model, actuator, prefix + name) for name in names]
    for name, identity in zip(names, ids, strict=True):
        if not name:
            raise ConfigError(
                f'{where}: one of its actuators has no name in the model, by which a command '
                'could choose it; give it one: name="..."'
            )
        if identity < 0:
            names = _own(prefix, (model.actuator(i).name for i in range(model.nu)))
            has = listed(filter(None, names))
            raise ConfigError(f"{where}: actuator '{name}' is not in the model; it has: {has}")
    if len(set(ids)) != len(ids):
        raise ConfigError(f'{where}: an actuator stands twice in: {listed(names)}')
    return np.array(ids, dtype=np.int64)


def _control_range(model: mujoco.MjModel, ids: NDArray[np.int64]) -> Array:
    limits: Array = model.actuator_ctrlrange[ids].astype(float).reshape(-1, 2)
    limits[model.actuator_ctrllimited[ids] == 0] = (-np.inf, np.inf)
    return limits
