# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The effects of a model one after the other: from bare thrust to all that it has."""

from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.plugins.config import BODY, THRUSTER
from fluid_sim_ros.reality.driven import Edit
from fluid_sim_ros.scene import Scene

_DAMPING = (
    'linear_damping', 'quadratic_damping', 'cross_damping', 'cross_damping_total', 'moment_fade',
    'drag_blunt', 'drag_slender', 'drag_angular', 'rotational_damping',
)  # fmt: skip


@dataclass(frozen=True)
class Effect:
    """
    One effect of a model, and how it is taken away.

    Attributes
    ----------
    name, what
        Of the rung that adds it, and in words.
    has
        Whether a spec has it.
    without
        Takes it away.

    """

    name: str
    what: str
    has: Callable[[mujoco.MjSpec], bool]
    without: Edit


def _keys(plugin_name: str, *keys: str) -> tuple[Callable[[mujoco.MjSpec], bool], Edit]:
    def mine(spec: mujoco.MjSpec) -> list[object]:
        # a plugin on a body has no name of its own in the list
        return [p for p in spec.plugins if p.plugin_name in (plugin_name, '')]

    def has(spec: mujoco.MjSpec) -> bool:
        return any(key in p.config for p in mine(spec) for key in keys)  # type: ignore[attr-defined]

    def without(spec: mujoco.MjSpec) -> None:
        for plugin in mine(spec):
            kept = {k: v for k, v in plugin.config.items() if k not in keys}  # type: ignore[attr-defined]
            plugin.config = kept  # type: ignore[attr-defined]

    return has, without


def _without_lag(spec: mujoco.MjSpec) -> None:
    lagged = {p.name for p in spec.plugins if p.plugin_name == THRUSTER}
    _keys(THRUSTER, 'time_constant')[1](spec)
    for actuator in spec.actuators:
        if actuator.plugin.name in lagged:
            actuator.actdim = 0
    for key in spec.keys:
        key.act = np.zeros(0)


def _without_damping(spec: mujoco.MjSpec) -> None:
    for plugin in spec.plugins:
        if plugin.plugin_name not in (BODY, ''):
            continue
        config = {k: v for k, v in plugin.config.items() if k not in _DAMPING[2:]}
        # zeros, not nothing: a body plugin must have something switched on
        plugin.config = config | {k: '0 0 0 0 0 0' for k in _DAMPING[:2] if k in config}


def _without_added_mass(spec: mujoco.MjSpec) -> None:
    for plugin in spec.plugins:
        if 'added_mass' in plugin.config:
            plugin.config = {**plugin.config, 'added_mass': '0 0 0 0 0 0'}


def _has_stock(spec: mujoco.MjSpec) -> bool:
    return bool(spec.option.density > 0 or spec.option.viscosity > 0)


def _without_stock(spec: mujoco.MjSpec) -> None:
    spec.option.density = 0.0
    spec.option.viscosity = 0.0


EFFECTS = (
    Effect('lag', 'rotors follow commands with a lag', _keys(THRUSTER, 'time_constant')[0],
           _without_lag),
    Effect('rotor drag', 'drag and rolling moment by rotor speed',
           *_keys(THRUSTER, 'rotor_drag', 'rolling_moment')),
    Effect('inflow', 'thrust falls with the flow through the rotors',
           *_keys(THRUSTER, 'inflow', 'inflow_law', 'zero_thrust_advance', 'measured_advance')),
    Effect('ground effect', 'more thrust near the ground',
           *_keys(THRUSTER, 'ground_effect', 'ground')),
    Effect('airframe drag', "MuJoCo's own fluid model on the body", _has_stock, _without_stock),
    Effect('damping', 'linear and quadratic resistance of the body', _keys(BODY, *_DAMPING)[0],
           _without_damping),
    Effect('added inertia', 'inertia of the fluid that is moved', _keys(BODY, 'added_mass')[0],
           _without_added_mass),
)  # fmt: skip


def ladder(scene: Scene) -> dict[str, tuple[str, Edit]]:
    """
    Return the rungs of a scene's model, each with all before it: name -> what it adds, and edit.

    The first, ``none``, is mass, inertia, buoyancy and static thrust; the last is all of it.

    Parameters
    ----------
    scene
        Whose model it is.

    """
    load_plugins()
    spec = scene.read_model()
    having = [effect for effect in EFFECTS if effect.has(spec)]

    def without(lacking: list[Effect]) -> Edit:
        def edit(spec: mujoco.MjSpec) -> None:
            for effect in lacking:
                effect.without(spec)
            if 'inflow' in {each.name for each in lacking}:
                _drop_density(spec)

        return edit

    rungs = {'none': ('mass, inertia, buoyancy and static thrust', without(having))}
    for i, effect in enumerate(having):
        rungs[effect.name] = (effect.what, without(having[i + 1 :]))
    return rungs


def _drop_density(spec: mujoco.MjSpec) -> None:
    """Take away a density that no key of a thruster needs any more."""
    for plugin in spec.plugins:
        config = plugin.config
        if plugin.plugin_name != THRUSTER or config.get('curve') == 'coefficients':
            continue
        if config.get('fluid') != 'local' and 'density' in config:
            plugin.config = {k: v for k, v in config.items() if k != 'density'}
