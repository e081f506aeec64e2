"""Finds the scenes that there are, and reads their YAML files."""

from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.resources import config_folder, models_folder
from fluid_sim_ros.scene.weather_files import with_files
from fluid_sim_ros.schema.base import parse
from fluid_sim_ros.schema.scene import SceneFile, VehicleFile
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
    content = parse(SceneFile, read_yaml(path), path)
    model_path = (path.parent / content.model).resolve()
    if not content.model.endswith(('.xml', '.mjcf')):
        model_path = models_folder() / f'{content.model}.xml'
    if not model_path.is_file():
        known = sorted(p.stem for p in models_folder().glob('*.xml'))
        raise ConfigError(
            f"{path}: key 'model': no model '{content.model}'{did_you_mean(content.model, known)} "
            f'models: {listed(known)}; '
            'or give the path of an MJCF file, relative to this file'
        )
    vehicles = None
    if content.vehicles is not None:
        vehicles = {
            name: _vehicle_file(value, path) if isinstance(value, str) else value
            for name, value in content.vehicles.items()
        }
    stated = {key: getattr(content, key) for key in SceneFile.model_fields if key != 'model'}
    return stated | {
        'name': path.stem,
        'model_path': model_path,
        'wind': with_files(content.wind, path.parent),
        'current': with_files(content.current, path.parent),
        'schedule': tuple(content.schedule),
        'vehicles': vehicles,
    }


def _vehicle_file(name: str, scene_path: Path) -> VehicleFile:
    folder = config_folder() / 'vehicles'
    beside = scene_path.parent / name
    path = beside if name.endswith(('.yaml', '.yml')) else folder / f'{name}.yaml'
    if not path.is_file():
        known = sorted(p.stem for p in folder.glob('*.yaml'))
        raise ConfigError(
            f"{scene_path}: vehicle file '{name}' is not known{did_you_mean(name, known)} "
            f'vehicles: {listed(known)}'
        )
    return parse(VehicleFile, read_yaml(path), path)
