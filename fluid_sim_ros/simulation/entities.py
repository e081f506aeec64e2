# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Bodies of a scene that move freely: their states read, and set between two steps."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np

from fluid_sim_ros.errors import CommandError, did_you_mean, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.simulation.simulation import Simulation


class UnknownEntityError(CommandError):
    """There is no entity of this name."""


class EntityState(NamedTuple):
    """
    Pose and twist of a body, in world axes.

    Attributes
    ----------
    position_w, quat_wb_wxyz
        [m], shape (3,), and attitude, scalar first, shape (4,).
    velocity_w, omega_w
        [m/s] of its origin, and [rad/s], shape (3,) each.

    """

    position_w: Array
    quat_wb_wxyz: Array
    velocity_w: Array
    omega_w: Array


class Entities:
    """
    The entities of a simulation: each vehicle, and each other body with a name and a free joint.

    Parameters
    ----------
    simulation
        Whose bodies.

    Attributes
    ----------
    names
        Vehicles by their names, other bodies by those of the model.

    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        model = simulation.model
        self._bodies = {name: v.body_id for name, v in simulation.vehicles.items()}
        known = set(self._bodies.values())
        for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE):
            body = int(model.jnt_bodyid[joint])
            name = model.body(body).name
            if body not in known and name and name not in self._bodies:
                self._bodies[name] = body
        self.names = tuple(self._bodies)

    def state(self, name: str) -> EntityState:
        """
        Return the state of an entity at the present step boundary.

        Parameters
        ----------
        name
            Of ``names``.

        Returns
        -------
        EntityState
            World axes.

        Raises
        ------
        UnknownEntityError
            If there is no such entity.

        """
        model, now, body = self._simulation.model, mujoco.MjData, self._body(name)
        data = now(model)  # the simulation's own may be a step behind its positions
        data.qpos[:], data.qvel[:] = self._simulation.data.qpos, self._simulation.data.qvel
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        twist = np.empty(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, twist, 0)
        return EntityState(
            data.xpos[body].copy(), data.xquat[body].copy(), twist[3:], twist[:3].copy()
        )

    def place(
        self,
        name: str,
        pose: Sequence[float] | None = None,
        twist: Sequence[float] | None = None,
    ) -> None:
        """
        Set the pose, the twist or both of an entity at once.

        Parameters
        ----------
        name
            Of ``names``.
        pose
            Position [m], world axes, and quaternion, scalar first, shape (7,); None: as it is.
        twist
            Velocity of its origin [m/s] and angular velocity [rad/s], world axes, shape (6,);
            None: as it is.

        Raises
        ------
        CommandError
            If there is no such entity, it has no free joint, or a number is not finite.

        """
        model, data = self._simulation.model, self._simulation.data
        body = self._body(name)
        joint = int(model.body_jntadr[body])
        if joint < 0 or model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE:
            raise CommandError(f"entity '{name}' cannot be placed: it has no free joint")
        numbers = [*(pose or ()), *(twist or ())]
        if not all(map(math.isfinite, numbers)):
            raise CommandError(f"entity '{name}': every number must be finite")
        start, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        place = data.qpos[start : start + 7].copy()
        omega_w = np.empty(3)
        mujoco.mju_rotVecQuat(omega_w, data.qvel[dof + 3 : dof + 6], place[3:])
        if pose is not None:
            length = math.sqrt(sum(value * value for value in pose[3:]))
            if length < 1e-6:
                raise CommandError(f"entity '{name}': the quaternion must not be zero")
            place[:3], place[3:] = pose[:3], np.array(pose[3:]) / length
        if twist is not None:
            data.qvel[dof : dof + 3], omega_w[:] = twist[:3], twist[3:]
        back, omega_b = np.empty(4), np.empty(3)
        mujoco.mju_negQuat(back, place[3:])
        mujoco.mju_rotVecQuat(omega_b, omega_w, back)
        data.qpos[start : start + 7], data.qvel[dof + 3 : dof + 6] = place, omega_b

    def _body(self, name: str) -> int:
        if name not in self._bodies:
            hint = did_you_mean(name, self.names)
            raise UnknownEntityError(
                f"entity '{name}' is not known{hint} entities: {listed(self.names)}"
            )
        return self._bodies[name]
