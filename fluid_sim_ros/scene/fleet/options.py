# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Options of MuJoCo, of which a scene has one set: what follows where models differ in them."""

from collections.abc import Collection
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError

#: What a scene file can state itself.
_STATABLE = ('timestep', 'integrator')
#: Of the fluid, which has rules of its own (``fluids``).
_FLUID = ('density', 'viscosity', 'wind')


def check_options(
    world: Any, vehicle: Any, kind: str, stated: Collection[str], where: str
) -> list[str]:
    """
    Compare the options of a vehicle's model with those of the world.

    Parameters
    ----------
    world, vehicle
        ``MjSpec.option`` of both.
    kind
        Name of the vehicle's model.
    stated
        What the run states itself.
    where
        What an error begins with.

    Returns
    -------
    list
        A line where the vehicle's options give way to the world's; else nothing.

    Raises
    ------
    ConfigError
        Where timestep, integrator or gravity differ and the scene does not say which it is.

    """
    differing = [
        name
        for name in dir(world)
        if not name.startswith('_')
        and name not in _FLUID
        and not np.array_equal(getattr(world, name), getattr(vehicle, name))
    ]
    for name in _STATABLE:
        if name in differing and name not in stated:
            raise ConfigError(
                f"{where}: the model '{kind}' has the {name} {_shown(name, vehicle)}, the world "
                f"{_shown(name, world)}; state '{name}' in the scene file"
            )
    if 'gravity' in differing:
        raise ConfigError(
            f"{where}: the model '{kind}' has another gravity than the world: "
            f'{vehicle.gravity.tolist()} and {world.gravity.tolist()} m/s^2; make them equal'
        )
    others = [name for name in differing if name not in _STATABLE]
    if not others:
        return []
    return [f"options of the model '{kind}' give way to those of the world: {', '.join(others)}"]


def copy_values(source: Any, target: Any) -> None:
    """
    Give one part of a spec the values of another's.

    Parameters
    ----------
    source, target
        Such as ``MjSpec.option`` of both; parts within parts are followed.

    """
    for name in dir(source):
        if name.startswith('_'):
            continue
        value = getattr(source, name)
        if isinstance(value, int | float | np.ndarray | np.generic):
            setattr(target, name, value)
        elif not callable(value):
            copy_values(value, getattr(target, name))


def _shown(name: str, option: Any) -> str:
    if name == 'timestep':
        return f'{option.timestep:g} s'
    name = mujoco.mjtIntegrator(option.integrator).name
    return str(name).removeprefix('mjINT_').lower()
