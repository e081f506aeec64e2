# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Composes one model of a world and the vehicles in it."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, ModelError, listed
from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.scene.fleet.fluids import FluidOf, meet_medium
from fluid_sim_ros.scene.fleet.members import START, Fleet, Member, prefix_of
from fluid_sim_ros.scene.fleet.options import check_options, copy_values
from fluid_sim_ros.scene.fleet.parts import (
    moving_roots,
    name_plugins,
    take_vehicles_away,
    take_world_away,
)
from fluid_sim_ros.scene.fleet.poses import Begin, moved
from fluid_sim_ros.scene.read_spec import read_spec
from fluid_sim_ros.schema.scene import VehicleFile


@dataclass(frozen=True)
class Source:
    """
    A vehicle's model, compiled once for all that share it.

    Attributes
    ----------
    model
        As it stands in its own world, for keyframes and sizes.
    fluid
        That it states.

    """

    model: mujoco.MjModel
    fluid: FluidOf


def compose(
    world: mujoco.MjSpec,
    fleet: Fleet,
    files: Mapping[str, VehicleFile],
    stated: Collection[str],
    where: str,
) -> list[str]:
    """
    Put the vehicles of a fleet into a world.

    Parameters
    ----------
    world
        The model whose world it is, as it was read; changed.
    fleet
        The vehicles.
    files
        How commands map onto each: its base body is placed.
    stated
        Which of ``timestep`` and ``integrator`` the run states, whatever the models say.
    where
        What an error begins with.

    Returns
    -------
    list
        One line for each thing that a user must hear of.

    Raises
    ------
    ConfigError, ModelError
        For models that do not load or cannot stand together, or a base or keyframe that a model
        lacks.

    """
    own = FluidOf.of(world)
    take_vehicles_away(world, fleet.taken_out)
    sources: dict[tuple[Path, int], Source] = {}
    begins: dict[str, Begin] = {}
    lines: list[str] = []
    for name, member in fleet.members.items():
        base, of_vehicle = files[name].body, f'{where}: vehicle {name!r}'
        spec = read_spec(member.model_path, member.mjcf, member.assets)
        key = (member.model_path, id(member.assets) if member.mjcf else 0)
        if key not in sources:
            sources[key] = _source(spec, member)
            lines += check_options(
                world.option, spec.option, member.model_path.stem, stated, where
            )
        source = sources[key]
        take_world_away(spec)
        check_base(spec, base, of_vehicle)
        begins[name] = Begin.of(source.model, member, base, of_vehicle)
        _attach(world, spec, source.fluid, own, prefix_of(name), base, begins[name])
    world.dedup_assets()
    _add_keyframes(world, begins)
    return lines


def _source(spec: mujoco.MjSpec, member: Member) -> Source:
    fluid = FluidOf.of(spec)
    try:
        return Source(spec.compile(), fluid)
    except ValueError as error:
        raise ModelError(f'{member.model_path}: {load_error_line(error)}') from None


def _attach(
    world: mujoco.MjSpec,
    spec: mujoco.MjSpec,
    fluid: FluidOf,
    own: FluidOf,
    prefix: str,
    base: str,
    begin: Begin,
) -> None:
    if fluid.stock and not own.stock and own.medium is not None:
        meet_medium(spec)
    name_plugins(spec, prefix)
    for part in ('option', 'visual', 'stat'):  # MuJoCo warns where it keeps the world's
        copy_values(getattr(world, part), getattr(spec, part))
    after = begin.position, begin.quat
    for body in moving_roots(spec):  # all alike: equalities hold where the model stands
        body.pos, body.quat = moved(body.pos, body.quat, begin.before, after)
    world.attach(spec, prefix=prefix, frame=world.worldbody.add_frame())
    _add_plugins(world, spec, prefix)


def _add_plugins(world: mujoco.MjSpec, spec: mujoco.MjSpec, prefix: str) -> None:
    """Add the instances that no element refers to: a foil names its sites instead."""
    there = {plugin.name for plugin in world.plugins}
    for plugin in spec.plugins:
        if not plugin.name or prefix + plugin.name in there:
            continue
        world.activate_plugin(plugin.plugin_name)
        added = world.add_plugin(
            name=prefix + plugin.name, plugin_name=plugin.plugin_name, active=True
        )
        added.config = dict(plugin.config)


def _add_keyframes(world: mujoco.MjSpec, begins: Mapping[str, Begin]) -> None:
    """Add ``start``, and each keyframe of a vehicle's model with the others at their start."""
    names = dict.fromkeys(name for begin in begins.values() for name in begin.keyframes)
    for name in (START, *names):
        states = [begin.keyframes.get(name, begin.start) for begin in begins.values()]
        parts = {
            part: np.concatenate([getattr(state, part) for state in states]).tolist()
            for part in ('qpos', 'qvel', 'act', 'ctrl')
        }
        world.add_key(name=name, **parts)


def check_base(spec: mujoco.MjSpec, base: str, where: str) -> None:
    """
    Refuse a base that is no moving body of the world.

    Parameters
    ----------
    spec
        The vehicle's model.
    base
        Name of the body.
    where
        What an error begins with.

    Raises
    ------
    ConfigError
        If it is none, with those that there are.

    """
    roots = [body.name for body in moving_roots(spec)]
    if base not in roots:
        raise ConfigError(
            f"{where}: body '{base}' is none that moves in the world by itself; "
            f'the model has: {listed(roots)}'
        )
