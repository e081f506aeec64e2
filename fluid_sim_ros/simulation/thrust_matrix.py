# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The wrench of each thruster of a vehicle, and thrusts for a wanted wrench."""

from collections.abc import Sequence

import mujoco
import numpy as np

from fluid_sim_ros.control.allocation import Allocator
from fluid_sim_ros.errors import CommandError, ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import THRUSTER, plugin_of_actuator
from fluid_sim_ros.scene.vehicle import Vehicle, is_reaction_torque

#: A wrench is met when it is off by less than this share of what was asked.
_MET = 1e-6


def thrust_matrix(model: mujoco.MjModel, data: mujoco.MjData, vehicle: Vehicle) -> Array:
    """
    Return the wrench of each thruster at a command of 1 N, shape (6, n).

    Force [N] and torque [N m] in base_link axes about the base_link origin, at rest, with the
    reaction torque of a fluid_sim.thruster. Thrusters on moving links: as they stand in ``data``,
    whose positions must have been evaluated.

    Parameters
    ----------
    model
        The compiled model.
    data
        Its state.
    vehicle
        Whose thrusters.

    Returns
    -------
    Array
        Shape (6, n).

    Raises
    ------
    ConfigError
        If a thruster is not at a site, or its command is not in newton.

    """
    frame = data.xmat[vehicle.body_id].reshape(3, 3)
    columns = [
        _column(model, data, name, int(actuator), frame, data.xpos[vehicle.body_id])
        for name, actuator in zip(vehicle.thrusters, vehicle.thruster_ids, strict=True)
    ]
    return np.array(columns).T.reshape(6, -1) / vehicle.thrust_scale


def _column(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    name: str,
    actuator: int,
    frame: Array,
    origin: Array,
) -> Array:
    if model.actuator_trntype[actuator] != mujoco.mjtTrn.mjTRN_SITE:
        raise ConfigError(f"thruster '{name}' does not act at a site; its wrench is not known")
    site = model.actuator_trnid[actuator, 0]
    to_base = frame.T @ data.site_xmat[site].reshape(3, 3)
    arm = frame.T @ (data.site_xpos[site] - origin)
    gear = model.actuator_gear[actuator]
    force = _gain(model, name, actuator) * (to_base @ gear[:3])
    torque = _gain(model, name, actuator) * (to_base @ gear[3:]) + np.cross(arm, force)
    column: Array = np.r_[force, torque - _reaction(model, actuator) * force]
    return column


def _gain(model: mujoco.MjModel, name: str, actuator: int) -> float:
    """Return the force at a control of 1."""
    thruster = plugin_of_actuator(model, actuator, THRUSTER)
    if thruster:
        unit = thruster.text('command')
        if unit not in ('', 'newton'):
            raise ConfigError(
                f"thruster '{name}' is commanded in {unit}; allowed for an allocated wrench: "
                'newton'
            )
        return 1.0
    fixed = model.actuator_gaintype[actuator] == mujoco.mjtGain.mjGAIN_FIXED
    if not fixed or model.actuator_biastype[actuator] != mujoco.mjtBias.mjBIAS_NONE:
        raise ConfigError(
            f"thruster '{name}': its force is not proportional to its control; allowed for an "
            'allocated wrench: a motor, or a fluid_sim.thruster in newton'
        )
    return float(model.actuator_gainprm[actuator, 0])


def _reaction(model: mujoco.MjModel, actuator: int) -> float:
    """Return spin times torque over thrust at rest [m] of a fluid_sim.thruster with a reaction."""
    thruster = plugin_of_actuator(model, actuator, THRUSTER)
    if not thruster or not any(
        model.actuator_plugin[i] == thruster.index and is_reaction_torque(model, i)
        for i in range(model.nactuator)
    ):
        return 0.0
    ratio, at_rest = thruster.number('torque_ratio'), thruster.number('thrust_coefficients')
    if at_rest:  # at rest Q/T = D c_Q0 / c_T0
        ratio = thruster.number('diameter') * thruster.number('torque_coefficients') / at_rest
    return -ratio if thruster.text('spin') == 'cw' else ratio


class WrenchAllocation:
    """
    Thrusts for a wanted wrench on a vehicle, within the limits of its thrusters.

    By the pseudo-inverse; beyond the limits the whole wrench is scaled down and keeps its
    direction (control.allocation).

    Parameters
    ----------
    model
        The compiled model.
    vehicle
        Whose thrusters.

    Raises
    ------
    ConfigError
        As ``thrust_matrix``; also for a thruster whose limits exclude 0 N.

    """

    def __init__(self, model: mujoco.MjModel, vehicle: Vehicle) -> None:
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        self._name = vehicle.name
        self._allocator = Allocator(thrust_matrix(model, data, vehicle), vehicle.thrust_range)

    def thrusts(self, force_b: Sequence[float], torque_b: Sequence[float]) -> tuple[Array, str]:
        """
        Return the thrusts [N], and what they fall short of or ''.

        Parameters
        ----------
        force_b, torque_b
            [N], [N m], base_link axes, about the base_link origin.

        Raises
        ------
        CommandError
            If a number is not finite.

        """
        wanted = np.r_[force_b, torque_b].astype(float)
        if not np.isfinite(wanted).all():
            raise CommandError(f"wrench of '{self._name}' holds a value that is not finite")
        thrusts = np.array(self._allocator.allocate(wanted.tolist()))
        given = self._allocator.matrix @ thrusts
        if np.abs(given - wanted).max() <= _MET * np.abs(wanted).max():
            return thrusts, ''
        cause = 'the limits of the thrusters' if self._allocator.scale < 1 else 'their layout'
        return thrusts, (
            f"wrench_allocated of '{self._name}': {_numbers(given)} of {_numbers(wanted)} "
            f'[N, N m], because of {cause}'
        )


def _numbers(wrench: Array) -> str:
    noise = _MET * np.abs(wrench).max()  # of rounding
    return '(' + ', '.join(f'{v:.3g}' if abs(v) > noise else '0' for v in wrench) + ')'
