# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The ladder of fluid models, from a scene's own plugins down to nothing."""

from pathlib import Path

import mujoco

from fluid_sim_ros.errors import ConfigError, ModelError, printable
from fluid_sim_ros.plugins.config import BODY, FOIL, THRUSTER, medium_of, plugin_of_body
from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.scene.finite import check_numbers

#: Passive plugins that stand on a body.
_ON_BODIES = (BODY, FOIL)


def compile_spec(spec: mujoco.MjSpec, path: Path) -> mujoco.MjModel:
    """
    Return the model of a spec.

    Parameters
    ----------
    spec
        What to compile.
    path
        File of the model, for errors.

    Returns
    -------
    mujoco.MjModel
        Compiled.

    Raises
    ------
    ModelError
        For a spec that does not compile, whose numbers are none, or whose names are no UTF-8: one
        line that names the file.

    """
    try:
        model = spec.compile()
    except ValueError as error:
        raise ModelError(f'{path}: {load_error_line(error)}') from None
    check_numbers(model, path)
    _check_names(model, path)
    return model


def _check_names(model: mujoco.MjModel, path: Path) -> None:
    """Refuse names that MuJoCo takes and that its bindings cannot tell."""
    for name in model.names.split(b'\0'):
        try:
            name.decode()
        except UnicodeDecodeError:
            shown = printable(name.decode('utf-8', 'backslashreplace'), 100)
            raise ModelError(f"{path}: name '{shown}': allowed is UTF-8") from None


def force_fluid(spec: mujoco.MjSpec, fluid: str, path: Path) -> None:
    """
    Put the model on one rung of the ladder.

    No fluid, inertia boxes, or stock ellipsoids: what plugins add (buoyancy, added mass, damping,
    a medium) is taken away with them; a body that they kept afloat gets gravcomp instead, so that
    a scene stays what it is. ``no_added_mass``: all that the scene has, but without the inertia of
    the added mass. ``inflow``: all that the scene has, and thrusters that lose thrust by the
    inflow where the model states at which advance ratio none is left (``zero_thrust_advance``).

    Parameters
    ----------
    spec
        The model; changed.
    fluid
        One of ``FLUID_RUNGS``.
    path
        File of the model, for errors.

    Raises
    ------
    ConfigError
        If the model has nothing that the rung could be made of.

    """
    if fluid == 'no_added_mass':
        _take_added_mass_away(spec, path)
        return
    if fluid == 'inflow':
        _let_inflow_act(spec, path)
        return
    _take_plugins_away(spec, path)
    if fluid == 'none':
        spec.option.density = 0.0
        spec.option.viscosity = 0.0
        return
    if spec.option.density <= 0 and spec.option.viscosity <= 0:
        raise ConfigError(
            f"fluid '{fluid}': {path} sets neither density nor viscosity, in <option> or in "
            'fluid_sim.medium; set one'
        )
    if fluid == 'inertia':
        for geom in spec.geoms:
            geom.fluid_ellipsoid = 0.0
    elif not any(geom.fluid_ellipsoid > 0 for geom in spec.geoms):
        # visual geoms (no contact) stay dry, as a model's author would have it
        for geom in spec.geoms:
            if geom.parent.name != 'world' and (geom.contype or geom.conaffinity):
                geom.fluid_ellipsoid = 1.0


def has_body_plugins(spec: mujoco.MjSpec) -> bool:
    """
    Return whether bodies have fluid forces by our plugins.

    Parameters
    ----------
    spec
        The model.

    """
    names = {plugin.plugin_name for plugin in spec.plugins}
    names |= {body.plugin.plugin_name for body in spec.bodies if body.plugin.active}
    return not names.isdisjoint(_ON_BODIES)


def _take_added_mass_away(spec: mujoco.MjSpec, path: Path) -> None:
    """Set every stated added mass to zero; refuse a model that states none."""
    stated = [plugin for plugin in spec.plugins if 'added_mass' in plugin.config]
    if not stated:
        raise ConfigError(f"fluid 'no_added_mass': {path} states no added_mass to leave out")
    for plugin in stated:
        plugin.config = {**plugin.config, 'added_mass': '0 0 0 0 0 0'}


def _let_inflow_act(spec: mujoco.MjSpec, path: Path) -> None:
    """Switch on the loss by inflow where a thruster states it; refuse a model that states none."""
    stated = [plugin for plugin in spec.plugins if 'zero_thrust_advance' in plugin.config]
    if not stated:
        raise ConfigError(
            f"fluid 'inflow': no thruster of {path} states zero_thrust_advance, at which its "
            'thrust vanishes'
        )
    for plugin in stated:
        plugin.config = {**plugin.config, 'inflow': 'true'}


def _take_plugins_away(spec: mujoco.MjSpec, path: Path) -> None:
    """
    Remove what models a fluid; opt takes over the medium's lower fluid.

    A fluid_sim.thruster stays: it is the vehicle's drive (one that goes with the density of the
    fluid gives nothing where there is none).
    """
    full = compile_spec(spec, path)
    implicit = []
    if medium := medium_of(full):
        spec.option.density = medium.number('density', spec.option.density)
        spec.option.viscosity = medium.number('viscosity', spec.option.viscosity)
    ours = {plugin.name for plugin in spec.plugins if plugin.plugin_name in _ON_BODIES}
    for body in spec.bodies:
        reference = body.plugin
        if reference.active and (
            reference.plugin_name in _ON_BODIES or reference.name in ours - {''}
        ):
            instance = plugin_of_body(full, body.id, BODY)
            if instance and instance.text('volume'):
                body.gravcomp = 1.0
            if reference.id >= 0:  # configured on the body itself, not a named instance
                implicit.append(reference.id)
            reference.name = ''
            reference.active = False
    for number, plugin in enumerate(list(spec.plugins)):
        name = plugin.plugin_name
        fluid = name.startswith('fluid_sim.') and name != THRUSTER
        if number in implicit or fluid:
            spec.delete(plugin)
