# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Thrust in newton, whatever the gear and the gain of the actuator."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import THRUSTER, plugin_of_actuator

#: A gear written with four digits, such as .7071 .7071 0, counts as one of unit length.
_ROUNDED = 1e-3


def newton_scales(model: mujoco.MjModel, actuators: NDArray[np.int64]) -> tuple[Array, Array]:
    """
    Return what turns controls and actuator forces of thrusters into newtons.

    MuJoCo applies gear * force at a site, where force = gain * control of a motor. A thruster that
    only turns (a gear without a force) is in newton metres in the same way. A fluid_sim.thruster
    has a gear of unit length and its own unit of command; an actuator whose force is not
    proportional to its control is commanded as it is.

    Parameters
    ----------
    model
        The compiled model.
    actuators
        Ids of the thrusters, shape (n,).

    Returns
    -------
    thrust_scale, effort_scale
        Force at a control of 1, and at an ``actuator_force`` of 1 [N], shape (n,) each, above 0.

    """
    effort = np.array([_gear(model, int(actuator)) for actuator in actuators])
    gains = np.array([_gain(model, int(actuator)) for actuator in actuators])
    return gains * effort, effort


def _gear(model: mujoco.MjModel, actuator: int) -> float:
    if model.actuator_trntype[actuator] != mujoco.mjtTrn.mjTRN_SITE:
        return 1.0
    gear = model.actuator_gear[actuator]
    length = float(np.linalg.norm(gear[:3]) or np.linalg.norm(gear[3:]))
    return length if length and abs(length - 1.0) > _ROUNDED else 1.0


def _gain(model: mujoco.MjModel, actuator: int) -> float:
    if plugin_of_actuator(model, actuator, THRUSTER) is not None:
        return 1.0
    fixed = model.actuator_gaintype[actuator] == mujoco.mjtGain.mjGAIN_FIXED
    if not fixed or model.actuator_biastype[actuator] != mujoco.mjtBias.mjBIAS_NONE:
        return 1.0
    return abs(float(model.actuator_gainprm[actuator, 0])) or 1.0
