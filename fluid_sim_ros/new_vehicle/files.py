# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Writes the model, vehicle file and scene of a new vehicle, and tries them."""

import re
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.interruption import owns
from fluid_sim_ros.new_vehicle.design import GRAVITY, Design, check_body, hover_thrusts
from fluid_sim_ros.new_vehicle.fins import JOINTS
from fluid_sim_ros.new_vehicle.layout import Medium, thrusters_of
from fluid_sim_ros.new_vehicle.mappings import mappings_of
from fluid_sim_ros.new_vehicle.mjcf import mjcf_of
from fluid_sim_ros.new_vehicle.sensors import KINDS, sensor_entries, sensor_lines
from fluid_sim_ros.schema.base import NAME_PATTERN
from fluid_sim_ros.simulation import Simulation

#: Sensors of a new vehicle by its medium: what its autopilots need, and the depth under water.
SENSORS: dict[Medium, tuple[str, ...]] = {
    'air': ('imu', 'magnetometer', 'barometer', 'gnss'),
    'water': ('imu', 'magnetometer', 'pressure'),
}
#: How long the trial of a new vehicle runs [s].
TRIAL = 2.0
_VEHICLE = """body: {name}
thrusters: [{thrusters}]  # [N], in the order of commands
joints: [{joints}]
{sensors}source: fluid_sim new-vehicle (mass, size and thrusters as given, the rest guessed)
"""
_SCENE = """model: {name}.xml
description: {description}
medium: {medium}
vehicles: {{{name}: {name}_vehicle.yaml}}
duration: 10.0  # [s]
keyframe: {keyframe}
# schedule:
#   - {{at: 2.0, {stream}: [0.3, 0, 0]}}  # [s], [m/s] ENU
"""


@dataclass(frozen=True)
class NewVehicle:
    """What was made: the design, its files (scene first), and its drift in the trial [m]."""

    design: Design
    scene: Path
    files: tuple[Path, ...]
    drift: float


def design_vehicle(
    name: str,
    medium: Medium,
    mass: float,
    size: tuple[float, float, float],
    thrusters: str,
    *,
    buoyancy: float = 0.0,
    max_thrust: float | None = None,
    sensors: Sequence[str] | None = None,
) -> Design:
    """
    Return a checked design.

    Parameters
    ----------
    name
        Of the vehicle: letters, digits and _, a letter first.
    medium, mass, size
        ``air`` or ``water``; [kg]; length, width, height [m].
    thrusters
        Preset or YAML file (new_vehicle.layout).
    buoyancy
        Net force upward under water [N].
    max_thrust
        Of each thruster of a preset [N].
    sensors
        Kinds of sensors; None: those of its medium (`SENSORS`).

    Raises
    ------
    ConfigError
        If a number is impossible, the list is malformed, or hover is out of reach.

    """
    if not re.match(NAME_PATTERN, name) or name == 'world':
        raise ConfigError(
            f"name '{name}': must be letters, digits and _, a letter first, and not world"
        )
    if max_thrust is not None and not (np.isfinite(max_thrust) and max_thrust > 0):
        raise ConfigError(f'--max-thrust {max_thrust:g}: must be above 0 [N]')
    box, weight = np.array(size, dtype=float), mass * GRAVITY
    check_body(medium, mass, box, buoyancy)
    placed = thrusters_of(thrusters, medium, box, weight, max_thrust)
    hover = hover_thrusts(placed, weight) if medium == 'air' else np.zeros(len(placed))
    kinds = SENSORS[medium] if sensors is None else tuple(dict.fromkeys(sensors))
    for kind in kinds:
        if kind not in KINDS:
            raise ConfigError(
                f"--sensors '{kind}' is none{did_you_mean(kind, KINDS)} allowed: {listed(KINDS)}"
            )
    return Design(name, medium, mass, box, buoyancy, placed, hover, kinds, thrusters)


def write_vehicle(design: Design, folder: Path, *, overwrite: bool = False) -> NewVehicle:
    """
    Load the files of a design, run them for ``TRIAL`` seconds, and write them into a folder.

    Parameters
    ----------
    design
        What to write.
    folder
        Where to; made where it is not there.
    overwrite
        Whether files that exist are replaced.

    Returns
    -------
    NewVehicle
        The files, and the drift in the trial.

    Raises
    ------
    ConfigError
        If a file exists (unless ``overwrite``) or cannot be written.

    """
    air = design.medium == 'air'
    texts = {
        f'{design.name}.yaml': _SCENE.format(
            name=design.name, medium=design.medium, stream='wind' if air else 'current',
            keyframe='hover' if air else 'start',
            description=f'{design.name} hovers' if air else f'{design.name} under water',
        ),
        f'{design.name}_vehicle.yaml': _VEHICLE.format(
            name=design.name, thrusters=', '.join(t.name for t in design.thrusters),
            joints=', '.join(JOINTS) if design.fins else '',
            sensors=sensor_lines(sensor_entries(list(design.sensors))),
        ),
        f'{design.name}.xml': mjcf_of(design),
        **mappings_of(design),
    }  # fmt: skip
    for name in texts:
        if (folder / name).exists() and not overwrite:
            raise ConfigError(
                f'{folder / name}: exists; give another --out, or --force to replace it'
            )
    owns()
    with tempfile.TemporaryDirectory() as trial:  # what does not load is not left behind
        drift = drift_of(_write(texts, Path(trial))[0])
    paths = _write(texts, folder)
    return NewVehicle(design, paths[0], paths, drift)


def _write(texts: dict[str, str], folder: Path) -> tuple[Path, ...]:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding='utf-8')
    except OSError as error:
        raise ConfigError(f'{folder}: cannot be written ({error.strerror})') from None
    return tuple(folder / name for name in texts)


def drift_of(scene: Path) -> float:
    """
    Return how far a scene's vehicle is from its start after the trial.

    Parameters
    ----------
    scene
        Its file.

    Returns
    -------
    float
        [m].

    """
    simulation = Simulation(scene)
    start = simulation.data.qpos[:3].copy()
    simulation.step(round(TRIAL / simulation.timestep))
    return float(np.linalg.norm(simulation.data.qpos[:3] - start))
