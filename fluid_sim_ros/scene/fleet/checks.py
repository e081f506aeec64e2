# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whether the vehicles of a fleet begin apart from each other, and clear of the world."""

from collections.abc import Mapping

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.scene.fleet.members import START
from fluid_sim_ros.scene.vehicle import Vehicle

#: Bases nearer than this stand at the same place, whether they collide or not [m].
_SAME_PLACE = 1e-3
#: A vehicle that begins deeper than this in the world is not just resting there [m].
_NOTABLE_DEPTH = 0.01


def check_apart(model: mujoco.MjModel, vehicles: Mapping[str, Vehicle], where: str) -> list[str]:
    """
    Look at the contacts that the vehicles begin with.

    Parameters
    ----------
    model
        The composed model.
    vehicles
        By name.
    where
        What an error begins with.

    Returns
    -------
    list
        A line for each vehicle that begins deep in the world.

    Raises
    ------
    ConfigError
        If two vehicles overlap, or stand at the same place.

    """
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(
        model, data, mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, START)
    )
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    _check_places(data, vehicles, where)
    owner = {vehicle.body_id: name for name, vehicle in vehicles.items()}
    deepest: dict[str, tuple[float, str]] = {}
    for i in range(data.ncon):
        contact = data.contact[i]
        first, second = (
            owner.get(int(model.body_rootid[model.geom_bodyid[geom]]), '') for geom in contact.geom
        )
        if first == second or contact.dist >= 0:
            continue
        if first and second:
            raise ConfigError(
                f"{where}: the vehicles '{first}' and '{second}' overlap by "
                f'{-contact.dist:.3g} m where they begin; move one of them'
            )
        scenery = model.geom(int(contact.geom[1 if first else 0])).name or 'the world'
        name = first or second
        if -contact.dist > max(_NOTABLE_DEPTH, deepest.get(name, (0.0, ''))[0]):
            deepest[name] = (-float(contact.dist), scenery)
    return [
        f"vehicle '{name}' begins {depth:.3g} m inside '{scenery}': it will be pushed out; "
        'move it, or choose another world'
        for name, (depth, scenery) in deepest.items()
    ]


def _check_places(data: mujoco.MjData, vehicles: Mapping[str, Vehicle], where: str) -> None:
    names = list(vehicles)
    places = data.xpos[[vehicle.body_id for vehicle in vehicles.values()]]
    for i, place in enumerate(places):
        apart = np.linalg.norm(places[i + 1 :] - place, axis=1)
        if (near := np.flatnonzero(apart < _SAME_PLACE)).size:
            raise ConfigError(
                f"{where}: the vehicles '{names[i]}' and '{names[i + 1 + int(near[0])]}' begin at "
                f'the same place {tuple(round(float(x), 3) for x in place)} m; move one of them'
            )
