# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The links of a vehicle: its bodies as ROS has them, a tree of frames with one joint each."""

from collections.abc import Collection
from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.vehicle import Vehicle

#: Frames that each vehicle has, after REP-105.
ODOM, BASE_LINK = 'odom', 'base_link'
_SLIDE, _BALL = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_BALL


@dataclass(frozen=True)
class Link:
    """
    A frame of a vehicle and the joint that carries it.

    A link's origin lies on its joint, as URDF has it; MuJoCo allows a body's elsewhere. A body
    with several joints is the last of as many links, and the others have no mass and no shape.

    Attributes
    ----------
    name
        Unique in the vehicle, without its name before it.
    parent
        Name of the link that carries it; '' for the base.
    body_id
        Body whose mass and geoms belong to it; -1: none.
    joint_id
        Joint between it and its parent; -1: fixed.
    position_p, quat_pl_wxyz
        Pose in the parent's frame with the joint at 0 [m], shape (3,) and (4,).
    shift_b
        Origin in the body's frame [m], shape (3,); the axes are the body's.

    """

    name: str
    parent: str
    body_id: int
    joint_id: int
    position_p: Array
    quat_pl_wxyz: Array
    shift_b: Array


def vehicle_links(
    model: mujoco.MjModel, vehicle: Vehicle, taken: Collection[str] = ()
) -> tuple[Link, ...]:
    """
    Return the links of a vehicle, parents before children and ``base_link`` first.

    Parameters
    ----------
    model
        The compiled model.
    vehicle
        One of its vehicles.
    taken
        Names of other frames of the vehicle; a body of such a name gets ``_link`` behind it.

    Returns
    -------
    tuple of Link
        In the order of the model's bodies.

    """
    names = {ODOM, BASE_LINK, *taken}

    def unique(name: str) -> str:
        while name in names:
            name += '_link'
        names.add(name)
        return name

    base = vehicle.body_id
    still, no_turn = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])
    found = [Link(BASE_LINK, '', base, -1, still, no_turn, still)]
    last = {base: found[0]}  # of each body
    for body in range(base + 1, model.nbody):
        parent = last.get(int(model.body_parentid[body]))
        if parent is None:
            continue
        label = model.body(body).name.removeprefix(vehicle.prefix) or f'body{body - base}'
        first = int(model.body_jntadr[body])
        joints = range(first, first + int(model.body_jntnum[body])) if first >= 0 else range(0)
        position, quat = model.body_pos[body] - parent.shift_b, model.body_quat[body].copy()
        for joint in joints:
            turned, anchor = np.empty(3), model.jnt_pos[joint]
            mujoco.mju_rotVecQuat(turned, anchor, quat)
            if joint > first:
                turned = anchor - parent.shift_b
                position, quat = np.zeros(3), no_turn
            is_last = joint == joints[-1]
            name = label if is_last else joint_name(model, joint, vehicle)
            place = _at_zero(model, joint, position + turned, quat)
            shift = anchor.copy()
            parent = Link(
                unique(name), parent.name,
                body if is_last else -1, joint, *place, shift,
            )  # fmt: skip
            found.append(parent)
        if not joints:
            parent = Link(unique(label), parent.name, body, -1, position, quat, still)
            found.append(parent)
        last[body] = parent
    return tuple(found)


def link_pose(model: mujoco.MjModel, link: Link, qpos: Array) -> tuple[Array, Array]:
    """
    Return the pose of a link in its parent's frame.

    Parameters
    ----------
    model
        The compiled model.
    link
        One of its vehicles' links; not the base.
    qpos
        Positions of all joints as MuJoCo has them, shape (nq,).

    Returns
    -------
    position_p, quat_pl_wxyz
        [m], shape (3,) and (4,).

    """
    if link.joint_id < 0:
        return link.position_p, link.quat_pl_wxyz
    start = int(model.jnt_qposadr[link.joint_id])
    if model.jnt_type[link.joint_id] == _BALL:
        turn = qpos[start : start + 4] / np.linalg.norm(qpos[start : start + 4])
        quat = np.empty(4)
        mujoco.mju_mulQuat(quat, link.quat_pl_wxyz, turn)
        return link.position_p, quat
    return _moved(model, link.joint_id, link.position_p, link.quat_pl_wxyz, float(qpos[start]))


def joint_name(model: mujoco.MjModel, joint: int, vehicle: Vehicle) -> str:
    """
    Return the name of a joint in ``joint_states`` and in the URDF.

    Parameters
    ----------
    model
        The compiled model.
    joint
        Its id.
    vehicle
        Whose it is.

    Returns
    -------
    str
        Without the vehicle's prefix; ``joint`` and a number where the model names none.

    """
    return model.joint(joint).name.removeprefix(vehicle.prefix) or f'joint{joint}'


def _at_zero(
    model: mujoco.MjModel, joint: int, position: Array, quat: Array
) -> tuple[Array, Array]:
    """Return the pose at the joint's 0: the model's own is that at its reference."""
    if model.jnt_type[joint] == _BALL:
        return position, quat
    reference = float(model.qpos0[model.jnt_qposadr[joint]])
    return _moved(model, joint, position, quat, -reference)


def _moved(
    model: mujoco.MjModel, joint: int, position: Array, quat: Array, by: float
) -> tuple[Array, Array]:
    """Return a pose turned about or moved along a joint's axis by [rad] or [m]."""
    axis = model.jnt_axis[joint]
    if model.jnt_type[joint] == _SLIDE:
        along = np.empty(3)
        mujoco.mju_rotVecQuat(along, axis, quat)
        return position + along * by, quat
    turn, product = np.empty(4), np.empty(4)
    mujoco.mju_axisAngle2Quat(turn, axis, by)
    mujoco.mju_mulQuat(product, quat, turn)
    return position, product
