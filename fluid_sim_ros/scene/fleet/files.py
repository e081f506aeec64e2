# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads scene files of several vehicles."""

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.resources import config_folder, models_folder
from fluid_sim_ros.scene.fleet.fluids import FluidOf, leading
from fluid_sim_ros.scene.fleet.members import Fleet, Member
from fluid_sim_ros.scene.fleet.parts import moving_roots
from fluid_sim_ros.scene.read_spec import read_spec
from fluid_sim_ros.scene.vehicle_files import model_file, vehicle_file
from fluid_sim_ros.schema.fleet import FleetFile, FleetVehicle
from fluid_sim_ros.schema.limits import check_limit
from fluid_sim_ros.schema.scene import VehicleFile


def is_fleet(content: Any) -> bool:
    """
    Return whether a scene file has no model of its own, but vehicles that have.

    Parameters
    ----------
    content
        Of the file.

    """
    if not isinstance(content, dict) or 'model' in content:
        return False
    vehicles = content.get('vehicles')
    return isinstance(vehicles, dict) and any(
        isinstance(vehicle, dict) and 'model' in vehicle for vehicle in vehicles.values()
    )


def fleet_fields(content: FleetFile, path: Path) -> dict[str, Any]:
    """
    Return what a file's vehicles and world become in a ``Scene``.

    Parameters
    ----------
    content
        Of the file.
    path
        The file; what it refers to is relative to it.

    Returns
    -------
    dict
        The fields ``model_path``, ``fleet``, ``vehicles`` and ``keyframe``.

    Raises
    ------
    ConfigError, ModelError
        For an unknown model or vehicle file, names that clash, or models whose fluids contradict
        each other.

    """
    load_plugins()
    members: dict[str, Member] = {}
    files: dict[str, VehicleFile] = {}
    specs: dict[Path, mujoco.MjSpec] = {}
    for name, stated in content.vehicles.items():
        where = f"{path}: key 'vehicles.{name}"
        model = model_file(stated.model, path, f"{where}.model'")
        if model not in specs:
            specs[model] = read_spec(model, '', {})
        file, kind = _vehicle_of(stated, model, specs[model], path, f"{where}'")
        for vehicle, place in _places(name, stated):
            if vehicle in members:
                raise ConfigError(
                    f"{where}': the name '{vehicle}' stands twice; choose another name"
                )
            members[vehicle] = Member(
                model, place, stated.yaw, stated.keyframe, stated.autopilot, kind
            )
            files[vehicle] = file
    check_limit('fleet_vehicles', len(members), f'{path}: vehicles')
    world, taken_out = _world(content, path, members, specs, files)
    fleet = Fleet(_numbered(members, path), taken_out)
    return {'model_path': world, 'fleet': fleet, 'vehicles': files, 'keyframe': None}


def _places(name: str, stated: FleetVehicle) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Yield the name and place [m] of each vehicle that an entry stands for."""
    if stated.count is None or stated.spacing is None:
        yield name, tuple(stated.position)
        return
    check_limit('fleet_vehicles', stated.count, f"key 'vehicles.{name}.count'")
    x, y, *height = stated.position
    columns = math.ceil(math.sqrt(stated.count))
    for i in range(stated.count):
        row, column = divmod(i, columns)
        yield f'{name}_{i + 1}', (
            x + column * stated.spacing, y + row * stated.spacing, *height,
        )  # fmt: skip


def _vehicle_of(
    stated: FleetVehicle, model: Path, spec: mujoco.MjSpec, path: Path, where: str
) -> tuple[VehicleFile, str]:
    """Return how commands map onto a model, and the name by which mappings of autopilots go."""
    if isinstance(stated.vehicle, VehicleFile):
        return stated.vehicle, model.stem
    if stated.vehicle is not None:
        return vehicle_file(stated.vehicle, path), Path(stated.vehicle).stem
    if _has_file(model.stem):
        return vehicle_file(model.stem, path), model.stem
    moving = [body for body in moving_roots(spec) if body.name]
    driven = [body for body in moving if _is_driven(spec, body)]
    found = [body.name for body in (driven if len(moving) > 1 else moving)]
    if not moving:
        raise ConfigError(
            f"{where}: nothing with a name moves by itself in the model '{model.stem}'; give its "
            'base a name and a <freejoint/>'
        )
    if len(found) != 1:
        names = [body.name for body in moving]
        raise ConfigError(
            f"{where}: the model '{model.stem}' has {len(moving)} moving bodies with a name "
            f'({listed(names)}), {len(driven)} of them with actuators; say which is the base: '
            'vehicle: {body: NAME}'
        )
    base = found[0]
    if _has_file(base) and (file := vehicle_file(base, path)).body == base:
        return file, base
    return VehicleFile(body=base), model.stem


def _has_file(name: str) -> bool:
    return (config_folder() / 'vehicles' / f'{name}.yaml').is_file()


def _is_driven(spec: mujoco.MjSpec, root: mujoco.MjsBody) -> bool:
    """Return whether an actuator acts on a site or joint of a body or below it."""
    targets = {actuator.target for actuator in spec.actuators}
    bodies = [root, *root.find_all('body')]
    return any(e.name in targets for b in bodies for e in (*b.sites, *b.joints) if e.name)


def _world(
    content: FleetFile,
    path: Path,
    members: dict[str, Member],
    specs: dict[Path, mujoco.MjSpec],
    files: dict[str, VehicleFile],
) -> tuple[Path, tuple[str, ...]]:
    """Return the model whose world it is, and the bodies that are taken out of it."""
    bases = {member.model_path: files[name].body for name, member in members.items()}
    if content.world:
        world = model_file(content.world, path, f"{path}: key 'world'")
    else:
        found = leading({str(model): FluidOf.of(spec) for model, spec in specs.items()})
        if isinstance(found, tuple):
            one, two = (Path(model) for model in found)
            raise ConfigError(
                f"{path}: key 'vehicles': the models '{one.stem}' and '{two.stem}' are in "
                f'different fluids ({FluidOf.of(specs[one]).line()}; '
                f"{FluidOf.of(specs[two]).line()}); say in which one all are: 'world: {one.stem}'"
            )
        world = Path(found)
    if world in specs:
        return world, tuple(
            dict.fromkeys([bases[world], *(b.name for b in moving_roots(specs[world]) if b.name)])
        )
    own = config_folder() / 'vehicles' / f'{world.stem}.yaml'
    if world.parent == models_folder() and own.is_file():
        return world, (vehicle_file(world.stem, path).body,)
    return world, ()


def _numbered(members: dict[str, Member], path: Path) -> dict[str, Member]:
    """Give each autopilot without an instance the next of its protocol."""
    taken: dict[str, set[int]] = {}
    for name, member in members.items():
        if (pilot := member.autopilot) is not None and pilot.instance is not None:
            used = taken.setdefault(pilot.protocol, set())
            if pilot.instance in used:
                raise ConfigError(
                    f"{path}: key 'vehicles.{name}.autopilot.instance': {pilot.instance} of "
                    f'{pilot.protocol} stands twice; leave it out, and each gets one of its own'
                )
            used.add(pilot.instance)
    numbered: dict[str, Member] = {}
    for name, member in members.items():
        pilot = member.autopilot
        if pilot is not None and pilot.instance is None:
            used = taken.setdefault(pilot.protocol, set())
            number = next(i for i in range(len(used) + 1) if i not in used)
            used.add(number)
            pilot = pilot.model_copy(update={'instance': number})
        numbered[name] = replace(member, autopilot=pilot)
    return numbered
