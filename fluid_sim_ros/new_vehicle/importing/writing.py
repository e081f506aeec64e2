# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Writes the folder of an imported vehicle, after a trial."""

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.report import write_report
from fluid_sim_ros.interruption import owns
from fluid_sim_ros.new_vehicle.files import TRIAL, drift_of
from fluid_sim_ros.new_vehicle.importing.document import ASSETS
from fluid_sim_ros.new_vehicle.importing.report import report_of
from fluid_sim_ros.new_vehicle.importing.vehicle import Imported
from fluid_sim_ros.new_vehicle.sensors import sensor_entries, sensor_lines
from fluid_sim_ros.schema.base import validated
from fluid_sim_ros.schema.sensors import SensorsFile

__all__ = ['TRIAL', 'Written', 'write_imported']
_SCENE = """model: {name}.xml
description: {name}, imported from {file}
medium: {medium}
vehicles: {{{name}: {name}_vehicle.yaml}}
duration: 10.0  # [s]
keyframe: start
"""


@dataclass(frozen=True)
class Written:
    """The files of a vehicle, scene first, and its drift in the trial [m]."""

    scene: Path
    files: tuple[Path, ...]
    drift: float


def write_imported(vehicle: Imported, folder: Path, *, overwrite: bool = False) -> Written:
    """
    Load the files of a vehicle, run them for ``TRIAL`` seconds, and write them into a folder.

    Parameters
    ----------
    vehicle
        Decided in every number.
    folder
        Where to; made where it is not there.
    overwrite
        Whether files that exist are replaced.

    Returns
    -------
    Written
        The files.

    Raises
    ------
    ConfigError
        If a file exists (unless ``overwrite``), cannot be written, or a sensor is not known.

    """
    source = vehicle.contents.skeleton.source
    name = source.name
    contents: dict[str, bytes] = {
        f'{name}.yaml': _SCENE.format(
            name=name, file=source.path.name, medium=vehicle.contents.medium
        ).encode(),
        f'{name}_vehicle.yaml': _vehicle_file(vehicle).encode(),
        f'{name}.xml': vehicle.mjcf.encode(),
    }
    contents |= {f'{ASSETS}/{file}': content for file, content in source.assets.items()}
    reports = [f'{name}_report.md'] + ([f'{name}_hydro.md'] if vehicle.hydro else [])
    for file in [*contents, *reports]:
        if (folder / file).exists() and not overwrite:
            raise ConfigError(
                f'{folder / file}: exists; give another --out, or --force to replace it'
            )
    owns()
    with tempfile.TemporaryDirectory() as trial:  # what does not load is not left behind
        drift = drift_of(_write(contents, Path(trial))[0])
    paths = _write(contents, folder)
    if vehicle.hydro is not None:
        page = folder / f'{name}_hydro.md'
        write_report(vehicle.hydro, page, page.with_suffix('.png'))
        paths = (*paths, page, page.with_suffix('.png'))
    report = report_of(vehicle, drift)
    paths = (*paths, *_write({f'{name}_report.md': report.encode()}, folder))
    return Written(paths[0], paths, drift)


def _write(contents: dict[str, bytes], folder: Path) -> tuple[Path, ...]:
    try:
        for name, content in contents.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
    except OSError as error:
        raise ConfigError(f'{folder}: cannot be written ({error.strerror})') from None
    return tuple(folder / name for name in contents)


def _vehicle_file(vehicle: Imported) -> str:
    contents = vehicle.contents
    skeleton, source = contents.skeleton, contents.skeleton.source
    thrusters = ', '.join(thruster.name for thruster in contents.thrusters)
    joints = ', '.join(skeleton.servos)
    return (
        f'body: {source.base}\n'
        f'thrusters: [{thrusters}]  # [N], in the order of commands\n'
        f'joints: [{joints}]\n'
        + sensor_lines(_sensors(vehicle))
        + f'source: fluid_sim import {source.path.name}; see {source.name}_report.md\n'
    )


def _sensors(vehicle: Imported) -> dict[str, Any]:
    stated = vehicle.answers.sensors
    if isinstance(stated, list):
        return sensor_entries(list(stated))
    entries = {}
    for kind, entry in stated.items():
        values = dict(entry) if isinstance(entry, dict) else entry
        if isinstance(values, dict) and 'link' in values:
            values['site'] = values.pop('link')
        entries[kind] = values
    validated(SensorsFile, entries, where='sensors: ')
    return entries


def hover_share(vehicle: Imported) -> float:
    """
    Return the largest share of its thrust that a rotor needs to hover.

    Parameters
    ----------
    vehicle
        In air.

    Returns
    -------
    float
        0 where it does not hover.

    """
    contents = vehicle.contents
    limits = [thruster.limits[1] for thruster in contents.thrusters]
    return float(np.max(contents.hover / limits)) if limits else 0.0
