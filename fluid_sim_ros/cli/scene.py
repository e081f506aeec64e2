# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the command line says of a scene: whether it loads, its flow, its advised settings."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli.doctor import Row
from fluid_sim_ros.errors import ConfigError, FluidSimError, listed
from fluid_sim_ros.plugins.config import MEDIUM
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.media import OPTION
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation

_SOURCES = {
    OPTION: 'one velocity for the whole scene',
    MEDIUM: 'each body meets the flow of its place and time',
}


def examine_scene(scene: str | Path) -> list[Row]:
    """
    Load a scene and say what its flow is made of.

    Parameters
    ----------
    scene
        Name, or path of an MJCF or scene file.

    Returns
    -------
    rows
        As of ``doctor.examine``.

    """
    try:
        simulation = Simulation(scene)
    except FluidSimError as error:
        return [Row('scene', 'broken', str(error), 'mend the named file')]
    source = simulation.flow_source
    stated = simulation.scene
    return [
        Row('scene', 'ok', f'{stated.name}, {_source(stated)}'),
        Row('model', 'ok', str(stated.model_path)),
        Row('vehicles', 'ok', listed(simulation.vehicles)),
        Row('flow', 'ok', f'{source}: {_SOURCES[source]}'),
        Row('stages', 'ok', simulation.stages().words()),
        *(
            Row(f'{name}: terms', 'ok' if terms else 'absent', listed(terms))
            for name, terms in simulation.terms.items()
        ),
        *(
            Row(f'{name}: thrusters', 'ok', _thrusters(vehicle))
            for name, vehicle in simulation.vehicles.items()
            if vehicle.thrusters
        ),
        *(Row('warning', 'absent', line) for line in simulation.warnings.lines),
        *(
            Row(name, 'ok', _models(getattr(stated, name)))
            for name in simulation.streams
        ),
    ]  # fmt: skip


def advised_settings(scene: str | Path) -> RunSettings:
    """
    Return the settings that a scene is advised to use.

    Parameters
    ----------
    scene
        Name, or path of a scene file.

    Returns
    -------
    RunSettings
        Timestep, integrator and fluid; None for the scene's own fluid.

    Raises
    ------
    ConfigError
        If its file holds no advice.

    """
    loaded = Scene.load(scene)
    if loaded.advised is None:
        raise ConfigError(
            f'{loaded.name}: the scene has no advised settings; '
            f'fluid_sim advise {scene} --tolerance 0.01 --keep writes them into its YAML file'
        )
    return loaded.advised.settings


def _source(scene: Scene) -> str:
    world = scene.model_path.name
    if scene.fleet is None:
        return world
    kinds = dict.fromkeys(member.model_path.stem for member in scene.fleet.members.values())
    return f'{listed(kinds)} in the world of {world}'


def _thrusters(vehicle: Vehicle) -> str:
    """Return the thrusters in the order of a command, with their ranges [N]."""
    ranges = [f'{low:.4g} to {high:.4g} N' for low, high in vehicle.thrust_range.tolist()]
    if len(ranges) > 1 and len(set(ranges)) == 1:
        return f'in this order: {", ".join(vehicle.thrusters)} ({ranges[0]} each)'
    named = zip(vehicle.thrusters, ranges, strict=True)
    return 'in this order: ' + ', '.join(f'{name} ({span})' for name, span in named)


def _models(models: Sequence[Any]) -> str:
    names = ' + '.join(model.model for model in models)
    if any(getattr(model, 'follow_vehicle', False) for model in models):
        names += ' (follows the vehicle: gusts depend on the flight)'
    return names or 'as the model states, or by topic'
