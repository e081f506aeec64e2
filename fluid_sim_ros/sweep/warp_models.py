# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which models mujoco_warp can fly, and the masses of many worlds of one model."""

import copy
import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import plugin_instances
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.sweep.sweep_file import SweepFile

#: Factor on the masses that vary, to see which constants of a model follow from them.
_PROBE = 2.0


def check_stock(sweep: SweepFile, simulation: Simulation, steps: int, device: str) -> None:
    """
    Refuse a sweep that is more than MuJoCo's own forces under constant commands.

    Parameters
    ----------
    sweep
        What is asked for.
    simulation
        Of its first case.
    steps
        Of a run.
    device
        Name of the device.

    Raises
    ------
    ConfigError
        Naming what stands in the way.

    """
    where = f"--device {device}: scene '{simulation.scene.name}'"
    if sweep.hold is not None:
        raise ConfigError(f"--device {device}: a controller in the loop (key 'hold') is Python")
    if simulation.model.nplugin:
        raise ConfigError(
            f'{where} uses {_plugins(simulation)}, which mujoco_warp does not have; '
            "the key 'fluid' (none, inertia, ellipsoid) takes fluid plugins away, not thrusters"
        )
    if simulation.scene.gait:
        raise ConfigError(f'{where} has a gait, which moves joints on the way')
    if simulation.next_change < steps:
        seconds = simulation.next_change * simulation.timestep
        raise ConfigError(
            f'{where} has a scheduled event at {seconds:g} s, before the end of the run; '
            'choose a shorter duration'
        )
    jointed = [v.name for v in simulation.vehicles.values() if v.qpos_address < 0]
    if jointed:
        raise ConfigError(f"{where}: the base of '{jointed[0]}' has no free joint")


def _plugins(simulation: Simulation) -> str:
    """Return the names of the plugins in a model."""
    return listed(sorted({instance.plugin for instance in plugin_instances(simulation.model)}))


def with_masses(model: mujoco.MjModel, factors: Mapping[str, float]) -> mujoco.MjModel:
    """
    Return a copy of a model whose bodies are heavier or lighter, with its derived constants.

    As ``mass_factors.scale_masses`` and a compilation would make it.

    Parameters
    ----------
    model
        The model.
    factors
        Factor [-] by name of a body.

    Returns
    -------
    mujoco.MjModel
        The copy.

    Raises
    ------
    ConfigError
        If a factor is not above 0.

    """
    changed = copy.copy(model)
    for name, factor in factors.items():
        if not (np.isfinite(factor) and factor > 0):
            raise ConfigError(f"mass of '{name}': factor {factor:g} must be above 0")
        body = changed.body(name).id
        changed.body_mass[body] *= factor
        changed.body_inertia[body] *= factor
    mujoco.mj_setConst(changed, mujoco.MjData(changed))
    return changed


def fields_of_masses(
    model: mujoco.MjModel, bodies: Iterable[str], batched: Sequence[str]
) -> list[str]:
    """
    Return which of the fields that may differ from world to world follow from these masses.

    Parameters
    ----------
    model
        The model.
    bodies
        Names of the bodies whose masses vary.
    batched
        Fields that may differ from world to world.

    Returns
    -------
    list
        Names of fields.

    """
    probe = with_masses(model, dict.fromkeys(bodies, _PROBE))
    return [
        name for name in batched
        if hasattr(model, name) and np.any(getattr(model, name) != getattr(probe, name))
    ]  # fmt: skip


def batched_fields(model_type: Any) -> list[str]:
    """
    Return the fields of a mujoco_warp.Model that may differ from world to world.

    Parameters
    ----------
    model_type
        The class ``mujoco_warp.Model``.

    Returns
    -------
    list
        Names of fields.

    """
    shapes = {f.name: getattr(f.type, 'shape', ()) for f in dataclasses.fields(model_type)}
    return [name for name, shape in shapes.items() if shape and shape[0] == '*']


def motion_of(simulation: Simulation, qpos: Array, qvel: Array) -> Array:
    """
    Return the motion of free bases, as the columns of ``plugins.native`` have it.

    Parameters
    ----------
    simulation
        Whose vehicles.
    qpos, qvel
        Shape (worlds, nq) and (worlds, nv).

    Returns
    -------
    array
        Position and quaternion of base_link in the world, velocity and rate in its axes; shape
        (worlds, vehicles, 13).

    """
    rows = []
    for vehicle in simulation.vehicles.values():
        at, dof = vehicle.qpos_address, vehicle.dof_address
        quat = qpos[:, at + 3 : at + 7]
        with np.errstate(invalid='ignore', over='ignore'):  # worlds that blew up
            quat = quat / np.linalg.norm(quat, axis=1, keepdims=True)
            velocity = _turned_back(quat, qvel[:, dof : dof + 3])
        rows.append(np.hstack((qpos[:, at : at + 3], quat, velocity, qvel[:, dof + 3 : dof + 6])))
    return np.stack(rows, axis=1)


def _turned_back(quat: Array, vector: Array) -> Array:
    """Return vectors of the world in the axes of bodies with these quaternions (wxyz)."""
    axis = quat[:, 1:]
    across = np.cross(axis, vector)
    result: Array = vector - 2.0 * quat[:, :1] * across + 2.0 * np.cross(axis, across)
    return result
