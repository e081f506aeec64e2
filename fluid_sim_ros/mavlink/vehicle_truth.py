# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The true state of a vehicle in the axes of autopilots."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.mavlink.ned import Quaternion, Vector3, attitude_to_ned, enu_to_ned, flu_to_frd
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation


@dataclass(frozen=True)
class Truth:
    """
    State of base_link.

    Attributes
    ----------
    position_ned
        From the world's origin [m].
    attitude
        Rotation FRD to NED, scalar first.
    velocity_ned, velocity_frd
        Over ground [m/s].
    rates
        Angular velocity [rad/s], FRD.
    specific_force
        [m/s^2], FRD; zeros unless asked for.
    acceleration_ned
        Derivative of ``velocity_ned`` [m/s^2]; without meaning unless forces were asked for.
    air_ned
        Velocity of the medium at the vehicle [m/s], the direction that it moves to.
    airspeed
        Speed through the medium [m/s].

    """

    position_ned: Vector3
    attitude: Quaternion
    velocity_ned: Vector3
    velocity_frd: Vector3
    rates: Vector3
    specific_force: Vector3
    acceleration_ned: Vector3
    air_ned: Vector3
    airspeed: float


class TruthReader:
    """
    Reads the true state of one vehicle at a step boundary.

    Parameters
    ----------
    simulation, vehicle
        Where the vehicle is, and its name.

    """

    def __init__(self, simulation: Simulation, vehicle: str) -> None:
        self._simulation = simulation
        self._index = list(simulation.vehicles).index(vehicle)
        self._velocity_w, self._force_w = np.zeros(3), np.zeros(3)

    def read(self, forces: bool) -> Truth:
        """
        Return the state; with ``forces`` also the specific force at this very state.

        Parameters
        ----------
        forces
            Whether the specific force is wanted, which costs an evaluation of all forces.

        Returns
        -------
        Truth
            NED and FRD axes.

        """
        row = self._simulation.observe(forces, wrenches=False)[self._index]
        mujoco.mju_rotVecQuat(self._velocity_w, row[nat.LINEAR_VELOCITY], row[nat.QUATERNION])
        mujoco.mju_rotVecQuat(self._force_w, row[nat.SPECIFIC_FORCE], row[nat.QUATERNION])
        numbers = row.tolist()
        velocity_b = numbers[nat.LINEAR_VELOCITY]
        velocity_w, medium_w = self._velocity_w.tolist(), numbers[nat.MEDIUM_VELOCITY]
        east, north, up = (v - m for v, m in zip(velocity_w, medium_w, strict=True))
        return Truth(
            enu_to_ned(numbers[nat.POSITION]),
            attitude_to_ned(numbers[nat.QUATERNION]),
            enu_to_ned(velocity_w),
            flu_to_frd(velocity_b),
            flu_to_frd(numbers[nat.ANGULAR_VELOCITY]),
            flu_to_frd(numbers[nat.SPECIFIC_FORCE]),
            enu_to_ned((self._force_w + self._simulation.model.opt.gravity).tolist()),
            enu_to_ned(medium_w),
            math.sqrt(east * east + north * north + up * up),
        )
