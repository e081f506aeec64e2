# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The Crazyflie of the validation: recorded flights of a real one against the model."""

import re
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from benchmarks.vehicles.validation_row import Row
from fluid_sim_ros.flights.reader import read_flight
from test.support import vehicle_runs as runs
from test.support.paths import MODELS
from test.support.plugin_models import Array

#: Mass of the vehicle in these flights [kg] and standard gravity [m/s^2].
MASS, G = 0.037, 9.81
LOGS = tuple(f'crazyflie_figure8_{number}.usd' for number in ('00', '12', '20', '26'))
SOURCE = (
    'four flights of a Crazyflie 2.1 of 37 g, motion capture, measured rotors (TU Berlin, IMRC)'
)
FITTED = 'crazyflie_37g'  # the scene with the numbers of these flights
TILTS = (5.0, 10.0, 15.0)  # [deg]
BLOCK = 25  # samples of 500 Hz that are averaged
LITERATURE = 'the set of RotorPy (Folk et al. 2023); published identifications give 3.1 to 8.4 m/s'


def samples(path: Path) -> tuple[Array, Array, Array]:
    """Return specific force, velocity (body axes) and rotor speeds of a flight, in the air."""
    signals = read_flight(path).signals
    times, force = signals['specific_force'].times, signals['specific_force'].values
    velocity, position = signals['velocity'].between(times), signals['position'].between(times)
    w, x, y, z = signals['attitude'].between(times).T
    flying = (position[:, 2] > 0.2) & np.isfinite(force).all(axis=1)
    body = Rotation.from_quat(np.c_[x, y, z, w]).inv().apply(velocity)
    rotors = signals['rotor_speed'].between(times)
    count = flying.sum() // BLOCK * BLOCK
    rows = (array[flying][:count] for array in (force, body, rotors))
    force, body, rotors = (r.reshape(-1, BLOCK, r.shape[1]).mean(axis=1) for r in rows)
    return force, body, rotors


def identified(folder: Path) -> dict[str, list[float]]:
    """
    Return of each flight k of thrust [N/(rad/s)^2], k of rotor drag, and the sum of speeds.

    Least squares: specific force along z by the sum of squared rotor speeds; across by the
    velocity times the sum of speeds (Martin and Salaun 2010) and an offset of the accelerometer.
    """
    result: dict[str, list[float]] = {'thrust': [], 'drag': [], 'speeds': []}
    for name in LOGS:
        force, velocity, rotors = samples(folder / name)
        squares, total = (rotors**2).sum(axis=1), rotors.sum(axis=1)
        result['thrust'].append(float(MASS * (force[:, 2] @ squares) / (squares @ squares)))
        slopes = [
            np.linalg.lstsq(np.c_[velocity[:, i] * total, np.ones(len(total))], force[:, i])[0][0]
            for i in (0, 1)
        ]
        result['drag'].append(float(-MASS * np.mean(slopes)))
        result['speeds'].append(float(total.mean()))
    return result


def read_model(key: str) -> list[float]:
    """Return the numbers of a key of the model's first rotor."""
    text = (MODELS / 'crazyflie.xml').read_text(encoding='utf-8')
    found = re.search(rf'key="{key}" value="([^"]*)"', text)
    if found is None:
        raise ValueError(f'crazyflie.xml has no {key}')
    return [float(word) for word in found[1].split()]


def tilted(tilt: float, scene: str = 'crazyflie') -> float:
    """Return the speed of a model in level flight at a held tilt [deg]."""
    simulation = runs.start(scene, 500.0)
    weight = float(simulation.model.body_mass.sum()) * G
    angle = np.radians(tilt)
    velocity = runs.tilted(scene, angle, weight / (4 * np.cos(angle)), 40.0, 1.0)
    return float(np.hypot(velocity[-1, 0], velocity[-1, 1]))


def crazyflie(folder: Path | None) -> list[Row]:
    """Return the rows of the flights; without their folder those of the literature alone."""
    own = {tilt: tilted(tilt) for tilt in TILTS}
    rows = [
        Row('crazyflie', 'speed at 10 deg of tilt', 'm/s', 7.05, LITERATURE, own[10.0],
            'the rotor drag of another identification (Forster 2015)'),
    ]  # fmt: skip
    if folder is None:
        return rows
    found = identified(folder)
    thrust, drag, speeds = (float(np.mean(values)) for values in found.values())
    heavier = 'a vehicle of 37 g with other motors and decks; the model is the 27 g set'
    rows += [
        Row('crazyflie', 'thrust over squared rotor speed', 'N/(rad/s)^2', thrust, SOURCE,
            read_model('thrust_coefficient')[0], heavier),
        Row('crazyflie', 'rotor drag', 'N/((rad/s)(m/s))', drag, SOURCE,
            read_model('rotor_drag')[0],
            f'{min(found["drag"]):.3g} to {max(found["drag"]):.3g} in them; {heavier}'),
    ]  # fmt: skip
    for tilt, speed in own.items():
        measured = MASS * G * np.tan(np.radians(tilt)) / (drag * speeds)
        rows.append(
            Row('crazyflie', f'speed at {tilt:g} deg of tilt', 'm/s', float(measured),
                f'{SOURCE}: from their drag', speed, 'half the rotor drag',
                tilted(tilt, FITTED), f'scene {FITTED}')
        )  # fmt: skip
    return rows
