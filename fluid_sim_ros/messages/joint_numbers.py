# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The numbers of ``joint_states``: the joints below a vehicle's base, then its thrusters."""

import mujoco
import numpy as np

from fluid_sim_ros.messages.topic import MadeNumber
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.robot.links import joint_name
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation import Simulation


class JointNumbers:
    """
    Position, velocity and effort of a vehicle's joints and thrusters.

    A thruster has its force as effort; a fluid_sim.thruster also has its rotor's speed [rad/s] as
    velocity.

    Parameters
    ----------
    simulation, vehicle
        Where the vehicle is, and which.

    Attributes
    ----------
    names
        Of the joints, then of the thrusters.
    numbers
        Rows position [rad or m], velocity and effort [N m or N], shape (3, n).

    """

    def __init__(self, simulation: Simulation, vehicle: Vehicle) -> None:
        model, self._data = simulation.model, simulation.observed
        joints = [j for j in range(model.njnt) if _is_single_joint(model, j, vehicle.body_id)]
        self.names = [joint_name(model, joint, vehicle) for joint in joints]
        self.names += vehicle.thrusters
        self.numbers = np.zeros((3, len(self.names)))
        self._places = model.jnt_qposadr[joints], model.jnt_dofadr[joints]
        self._count = count = len(joints)
        self._thrusters, self._efforts = vehicle.thruster_ids, vehicle.effort_scale
        self._rotor = np.zeros(len(nat.THRUSTER_VALUES))
        self._look, self._into = nat.native().thruster, self._rotor.ctypes.data
        self._addresses = (model._address, self._data._address)
        self._rotors = [
            (count + i, int(actuator))
            for i, actuator in enumerate(vehicle.thruster_ids)
            if self._look(*self._addresses, int(actuator), self._into)
        ]

    def prepare(self) -> None:
        """Take the numbers of the state whose forces were observed last."""
        data, numbers, count = self._data, self.numbers, self._count
        positions, velocities = self._places
        for place, actuator in self._rotors:
            self._look(*self._addresses, actuator, self._into)
            numbers[1, place] = self._rotor[0]
        numbers[0, :count] = data.qpos[positions]
        numbers[1, :count] = data.qvel[velocities]
        numbers[2, :count] = data.qfrc_actuator[velocities]
        numbers[2, count:] = self._efforts * data.actuator_force[self._thrusters]

    def made(self) -> list[MadeNumber]:
        """Return what ``prepare`` does, for the compiled tick."""
        data, numbers = self._data, self.numbers
        positions, velocities = self._places
        rows = (
            (data.qpos, positions), (data.qvel, velocities), (data.qfrc_actuator, velocities)
        )  # fmt: skip
        made = [
            MadeNumber(numbers[row, i : i + 1], values[place : place + 1])
            for row, (values, places) in enumerate(rows)
            for i, place in enumerate(places)
        ]
        for place, actuator in self._rotors:
            made.append(MadeNumber(numbers[1, place : place + 1], None, actuator=actuator))
        for i, actuator in enumerate(self._thrusters, self._count):
            force = data.actuator_force[actuator : actuator + 1]
            scale = float(self._efforts[i - self._count])
            made.append(MadeNumber(numbers[2, i : i + 1], force, scale))
        return made


def _is_single_joint(model: mujoco.MjModel, joint: int, base: int) -> bool:
    """Return whether a joint has one position and lies below a base body."""
    kind = int(model.jnt_type[joint])  # NumPy's own integers are in no tuple of MuJoCo's names
    if kind not in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
        return False
    body = model.jnt_bodyid[joint]
    while body > base:
        body = model.body_parentid[body]
    return bool(body == base)
