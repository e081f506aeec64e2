# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Takes the two parts of a model from each other: what moves, and the world that it stands in."""

from collections.abc import Iterable

import mujoco

from fluid_sim_ros.plugins.config import BODY, FOIL, MEDIUM, THRUSTER

#: Keys of a plugin that name elements of the model: plugin -> key -> kind of element.
_NAMES = {BODY: ('geoms',), FOIL: ('site',)}
#: First words of values of fluid_sim.foil that name an element behind them.
_KINDS = ('joint', 'actuator')


def moving_roots(spec: mujoco.MjSpec) -> list[mujoco.MjsBody]:
    """
    Return the bodies of the world that can move, with all below them.

    Parameters
    ----------
    spec
        A model.

    """
    return [body for body in spec.worldbody.bodies if body.name != 'world' and _moves(body)]


def _moves(body: mujoco.MjsBody) -> bool:
    return bool(body.joints) or bool(body.mocap) or any(_moves(child) for child in body.bodies)


def take_world_away(spec: mujoco.MjSpec) -> None:
    """
    Leave only what moves of a model: no ground, light, sky, medium and keyframe.

    Parameters
    ----------
    spec
        The model; changed.

    """
    world = spec.worldbody
    moving = {body.name for body in moving_roots(spec)}
    scenery = [geom.material for geom in world.geoms]
    own: list[list[mujoco.MjsElement]] = [
        [e for e in elements if e.parent == world]
        for elements in (world.geoms, world.sites, world.cameras, world.lights)
    ]
    own.append([b for b in world.bodies if b.name not in moving])
    own.append(list(spec.keys))
    own.append([p for p in spec.plugins if p.plugin_name == MEDIUM])
    for elements in own:
        for element in elements:
            spec.delete(element)
    _delete_unused_looks(spec, set(scenery))


def _delete_unused_looks(spec: mujoco.MjSpec, scenery: set[str]) -> None:
    """Delete the sky, and materials and textures that only the scenery had."""
    used = {geom.material for geom in spec.geoms} | {site.material for site in spec.sites}
    for material in list(spec.materials):
        if material.name in scenery - used:
            spec.delete(material)
    textures = {name for material in spec.materials for name in material.textures if name}
    for texture in list(spec.textures):
        if texture.name not in textures:
            spec.delete(texture)


def take_vehicles_away(spec: mujoco.MjSpec, bodies: Iterable[str]) -> None:
    """
    Leave only the world of a model.

    Parameters
    ----------
    spec
        The model; changed.
    bodies
        What is no part of the world; those that it lacks are passed over.

    """
    for name in bodies:
        body = spec.body(name)
        if body is not None:
            spec.delete(body)
    for key in list(spec.keys):
        spec.delete(key)
    used = {body.plugin.name for body in spec.bodies if body.plugin.active}
    used |= {actuator.plugin.name for actuator in spec.actuators if actuator.plugin.active}
    for plugin in list(spec.plugins):
        if plugin.plugin_name in (BODY, THRUSTER, FOIL) and plugin.name not in used:
            spec.delete(plugin)


def name_plugins(spec: mujoco.MjSpec, prefix: str) -> None:
    """
    Make a model's plugins fit to be attached under a prefix.

    Those that are configured in a body become named instances, since attaching would drop them;
    names within configurations get the prefix that attaching puts before the names themselves.

    Parameters
    ----------
    spec
        The model; changed.
    prefix
        What every name will begin with.

    """
    instances = {plugin.id: plugin for plugin in spec.plugins}
    taken = {plugin.name for plugin in spec.plugins}
    for number, body in enumerate(spec.bodies):
        reference = body.plugin
        if not reference.active or reference.name:
            continue
        instance = instances[reference.id]
        name = f'plugin_of_body_{number}'
        while name in taken:
            name += '_'
        taken.add(name)
        instance.name, instance.plugin_name = name, reference.plugin_name
        reference.name = name
    for plugin in spec.plugins:
        named = _with_prefix(plugin.plugin_name, dict(plugin.config), prefix)
        if named != dict(plugin.config):
            plugin.config = named


def _with_prefix(plugin: str, config: dict[str, str], prefix: str) -> dict[str, str]:
    found = dict(config)
    for key, value in config.items():
        words = value.split()
        if key in _NAMES.get(plugin, ()):
            found[key] = ' '.join(prefix + word for word in words)
        elif plugin == FOIL and len(words) > 1 and words[0] in _KINDS:
            found[key] = ' '.join([words[0], prefix + words[1], *words[2:]])
    return found
