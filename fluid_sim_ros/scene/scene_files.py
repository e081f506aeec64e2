# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Finds the scenes that there are, and reads their YAML files."""

from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import ConfigError, printable
from fluid_sim_ros.resources import config_folder, models_folder
from fluid_sim_ros.scene.fleet.files import fleet_fields, is_fleet
from fluid_sim_ros.scene.vehicle_files import model_file, vehicle_file
from fluid_sim_ros.scene.weather_files import with_files
from fluid_sim_ros.schema.base import parse
from fluid_sim_ros.schema.fleet import FleetFile
from fluid_sim_ros.schema.scene import SceneFile, SceneKeys
from fluid_sim_ros.schema.yaml_file import read_yaml


def scene_names() -> list[str]:
    """Return the names that ``Scene.load`` knows, sorted."""
    names = {path.stem for path in (config_folder() / 'scenes').glob('*.yaml')}
    names |= {path.stem for path in models_folder().glob('*.xml')}
    return sorted(names)


def scene_fields(path: Path) -> dict[str, Any]:
    """
    Return what a scene's YAML file states, as the fields of a ``Scene``.

    Parameters
    ----------
    path
        The file; what it refers to is relative to it.

    Returns
    -------
    dict
        Field -> value; the files that its weather and vehicles name are read.

    Raises
    ------
    ConfigError
        For a fault of any of the files (file, key, value, what is allowed).

    """
    raw = read_yaml(path)
    if is_fleet(raw):
        fleet = parse(FleetFile, raw, path)
        return _common(fleet, path) | fleet_fields(fleet, path)
    _check_kind(raw, path)
    content = parse(SceneFile, raw, path)
    vehicles = None
    if content.vehicles is not None:
        vehicles = {
            name: vehicle_file(value, path) if isinstance(value, str) else value
            for name, value in content.vehicles.items()
        }
    return _common(content, path) | {
        'model_path': model_file(content.model, path, f"{path}: key 'model'"),
        'keyframe': content.keyframe,
        'vehicles': vehicles,
    }


def _check_kind(raw: Any, path: Path) -> None:
    """Refuse what is neither a scene of one model nor a fleet; say which is which."""
    if not isinstance(raw, dict) or not isinstance(raw.get('vehicles'), dict):
        return
    if 'model' not in raw and not raw['vehicles']:
        raise ConfigError(
            f"{path}: missing key 'model', or vehicles with a model each: "
            'vehicles: {one: {model: x500}}'
        )
    own = [
        str(name) for name, value in raw['vehicles'].items()
        if isinstance(value, dict) and 'model' in value
    ]  # fmt: skip
    if 'model' in raw and own:
        raise ConfigError(
            f"{path}: key 'vehicles.{printable(own[0])}.model': the scene has a model of its own; "
            "leave out 'model' at the top for a fleet, or here for vehicles of that model"
        )


def _common(content: SceneKeys, path: Path) -> dict[str, Any]:
    """Return what every scene file may state, and the scene's name."""
    return {key: getattr(content, key) for key in SceneKeys.model_fields} | {
        'name': path.stem,
        'wind': with_files(content.wind, path.parent),
        'current': with_files(content.current, path.parent),
        'schedule': tuple(content.schedule),
    }
