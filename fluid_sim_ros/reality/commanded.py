# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The speed that a thrust command asks for: by the model as it is written, not as it is fitted."""

from collections.abc import Callable

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import THRUSTER, plugin_of_actuator
from fluid_sim_ros.scene.vehicle import Vehicle


def commanded_coefficients(model: mujoco.MjModel, vehicle: Vehicle) -> Array:
    """
    Return by what a commanded thrust became a commanded speed, shape (n, 2).

    A controller reckons with the model as it is written: a fit that changes the coefficient of a
    rotor changes its thrust at the commanded speed, not the speed.

    Parameters
    ----------
    model
        As it is written.
    vehicle
        That is driven.

    Returns
    -------
    Array
        Coefficients ahead and in reverse [N/(rad/s)^2]; empty where a rotor's curve is another.

    """
    found = []
    for actuator in vehicle.thruster_ids:
        rotor = plugin_of_actuator(model, int(actuator), THRUSTER)
        words = rotor.text('thrust_coefficient').split() if rotor else []
        if rotor is None or rotor.text('curve') != 'quadratic' or not words:
            return np.zeros((0, 2))
        found.append([float(words[0]), float(words[-1])])
    plain = np.all(vehicle.thrust_scale == 1.0)
    return np.array(found) if plain else np.zeros((0, 2))


def speed_for_thrust(vehicle: Vehicle, coefficients: Array) -> Callable[[Array], Array]:
    """
    Return what turns commanded thrusts [N], shape (..., n), into commanded speeds [rad/s].

    Parameters
    ----------
    vehicle
        That is driven; thrusts are clipped to its range, as in a simulation.
    coefficients
        As ``commanded_coefficients`` returns them.

    """
    low, high = vehicle.thrust_range.T

    def controls(values: Array) -> Array:
        thrust = np.clip(values, low, high)
        by = np.where(thrust < 0, coefficients[:, 1], coefficients[:, 0])
        speed: Array = np.sign(thrust) * np.sqrt(np.abs(thrust) / by)
        return speed

    return controls
