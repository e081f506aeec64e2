# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the vehicles of a fleet begin: poses, joints, rotors and controls of their keyframes."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.fleet.members import Member

Pose = tuple[Array, Array]


@dataclass(frozen=True)
class State:
    """Positions, velocities, activations and controls of a vehicle's model, in its order."""

    qpos: Array
    qvel: Array
    act: Array
    ctrl: Array


@dataclass(frozen=True)
class Begin:
    """
    How a vehicle begins.

    Attributes
    ----------
    position, quat
        Of its base in the world [m], scalar first.
    before
        The same of its keyframe, before it was put there.
    start
        Its state.
    keyframes
        By the name of a keyframe of its model: its state there, at its own place and heading.

    """

    position: Array
    quat: Array
    before: Pose
    start: State
    keyframes: dict[str, State]

    @classmethod
    def of(cls, model: mujoco.MjModel, member: Member, base: str, where: str) -> 'Begin':
        """
        Return how a vehicle begins.

        Parameters
        ----------
        model
            Its model in its own world.
        member
            Its place, heading and keyframe.
        base
            Name of its base body.
        where
            What an error begins with.

        Raises
        ------
        ConfigError
            If the model lacks the keyframe.

        """
        names = [model.key(i).name for i in range(model.nkey)]
        if member.keyframe and member.keyframe not in names:
            raise ConfigError(
                f"{where}: keyframe '{member.keyframe}' is not in its model"
                f'{did_you_mean(member.keyframe, names)} it has: {listed(names)}'
            )
        as_it_stands = State(
            model.qpos0.copy(), np.zeros(model.nv), np.zeros(model.na), np.zeros(model.nu)
        )
        keyframes = {name: _of_key(model, i) for i, name in enumerate(names) if name}
        start = keyframes.get(member.keyframe, as_it_stands)
        body = model.body(base)
        joint = int(model.body_jntadr[body.id])
        free = joint >= 0 and int(model.jnt_type[joint]) == mujoco.mjtJoint.mjJNT_FREE
        turn = _turn(member.yaw)
        stands = (body.pos.copy(), body.quat.copy())
        if not free:
            position = _at(member.position, stands[0])
            return cls(position, _turned(stands[1], turn), stands, start, keyframes)
        placed = _placed(model, joint, start, member.position, turn)
        q = int(model.jnt_qposadr[joint])
        return cls(
            placed.qpos[q : q + 3], placed.qpos[q + 3 : q + 7],
            (start.qpos[q : q + 3], start.qpos[q + 3 : q + 7]), placed,
            {
                name: _placed(model, joint, state, member.position[:2], turn)
                for name, state in keyframes.items()
            },
        )  # fmt: skip


def _of_key(model: mujoco.MjModel, key: int) -> State:
    return State(
        model.key_qpos[key].copy(), model.key_qvel[key].copy(),
        model.key_act[key].copy(), model.key_ctrl[key].copy(),
    )  # fmt: skip


def _at(place: tuple[float, ...], stands: Array) -> Array:
    return np.array([*place, *stands[len(place) :]])


def _turn(yaw: float) -> Array | None:
    """Return a turn about the vertical [deg], scalar first; None: none."""
    half = 0.5 * math.radians(yaw)
    return np.array([math.cos(half), 0.0, 0.0, math.sin(half)]) if yaw else None


def _turned(quat: Array, turn: Array | None) -> Array:
    if turn is None:
        return quat.copy()
    result = np.empty(4)
    mujoco.mju_mulQuat(result, turn, quat)
    return result


def _placed(
    model: mujoco.MjModel, base: int, state: State, place: tuple[float, ...], turn: Array | None
) -> State:
    """Return a state with its base's free joint elsewhere; what moves beside it comes along."""
    qpos, qvel = state.qpos.copy(), state.qvel.copy()
    q = int(model.jnt_qposadr[base])
    before = state.qpos[q : q + 3], state.qpos[q + 3 : q + 7]
    after = _at(place, before[0]), _turned(before[1], turn)
    for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE):
        q, v = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        pose = state.qpos[q : q + 3], state.qpos[q + 3 : q + 7]
        qpos[q : q + 3], qpos[q + 3 : q + 7] = moved(*pose, before, after)
        if turn is not None:  # the angular velocity has axes of the body
            mujoco.mju_rotVecQuat(qvel[v : v + 3], state.qvel[v : v + 3], turn)
    return State(qpos, qvel, state.act, state.ctrl)


def moved(position: Array, quat: Array, before: Pose, after: Pose) -> Pose:
    """
    Return where a body comes to that is carried along when another one is moved.

    Parameters
    ----------
    position, quat
        Of the body in the world [m], scalar first.
    before, after
        Pose of the other one.

    Returns
    -------
    tuple
        Its position [m] and attitude.

    """
    if np.array_equal(position, before[0]) and np.array_equal(quat, before[1]):
        return after
    back, turn, rotated, attitude = np.empty(4), np.empty(4), np.empty(3), np.empty(4)
    mujoco.mju_negQuat(back, before[1])
    mujoco.mju_mulQuat(turn, after[1], back)
    mujoco.mju_rotVecQuat(rotated, position - before[0], turn)
    mujoco.mju_mulQuat(attitude, turn, quat)
    return after[0] + rotated, attitude
