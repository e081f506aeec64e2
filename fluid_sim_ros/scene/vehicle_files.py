# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Finds the models and the vehicle files that a scene file names."""

from pathlib import Path

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed, printable
from fluid_sim_ros.resources import config_folder, models_folder
from fluid_sim_ros.schema.base import parse
from fluid_sim_ros.schema.scene import VehicleFile
from fluid_sim_ros.schema.yaml_file import read_yaml


def model_file(name: str, scene_path: Path, where: str) -> Path:
    """
    Return the file of a model.

    Parameters
    ----------
    name
        Of a model, or the path of an MJCF file, relative to the scene file.
    scene_path
        The scene file.
    where
        What an error begins with.

    Returns
    -------
    Path
        Absolute.

    Raises
    ------
    ConfigError
        If there is none, with those that there are.

    """
    path = (scene_path.parent / name).resolve()
    if not name.endswith(('.xml', '.mjcf')):
        path = models_folder() / f'{name}.xml'
    if not _is_file(path):
        known = sorted(p.stem for p in models_folder().glob('*.xml'))
        raise ConfigError(
            f"{where}: no model '{printable(name)}'{did_you_mean(name, known)} "
            f'models: {listed(known)}; '
            'or give the path of an MJCF file, relative to this file'
        )
    return path


def vehicle_file(name: str, scene_path: Path) -> VehicleFile:
    """
    Read a vehicle file.

    Parameters
    ----------
    name
        Of a file in config/vehicles, or the path of one, relative to the scene file.
    scene_path
        The scene file.

    Returns
    -------
    VehicleFile
        What it says.

    Raises
    ------
    ConfigError
        If there is none, with those that there are, or it has a fault.

    """
    folder = config_folder() / 'vehicles'
    beside = scene_path.parent / name
    path = beside if name.endswith(('.yaml', '.yml')) else folder / f'{name}.yaml'
    if not _is_file(path):
        known = sorted(p.stem for p in folder.glob('*.yaml'))
        raise ConfigError(
            f"{scene_path}: vehicle file '{printable(name)}' is not known"
            f'{did_you_mean(name, known)} '
            f'vehicles: {listed(known)}'
        )
    return parse(VehicleFile, read_yaml(path), path)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name that no file can have
        return False
