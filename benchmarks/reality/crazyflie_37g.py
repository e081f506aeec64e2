# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The crazyflie models against flights of a real Crazyflie 2.1 of 37 g.

Errors of open-loop windows by horizon of ``crazyflie`` (numbers of the literature) and of
``crazyflie_37g`` (fitted to flights 00, 12, 20), beside two baselines, on each flight; what limits
them: the response to the rotors' moments by band of frequency, what is left of the moments, and
how far an unknown moment of 1 rad/s^2 turns the vehicle within a window; what a perfect model
would be off by from measurements with this noise (``forecast_bound``); the same from states that
are smoothed from motion capture, gyro and accelerometer, with the trim and the air of each flight,
and for the model as it comes out of them (``crazyflie_limits``). Two pictures in doc/img.

The recordings (figure eights in motion capture, crazyflie-data-collection of IMRC, TU Berlin) are
not part of this repository.
Run: ``python -m benchmarks.reality.crazyflie_37g [--quick] [--json PATH] [--only PART]
[--flights FOLDER]``.
"""

import argparse
import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from scipy.signal import butter, filtfilt

from benchmarks.common import ROOT, arguments, write
from benchmarks.reality import crazyflie_limits as limits
from benchmarks.reality.forecast_bound import bound_of, measured_noise, noise_of_smoothed
from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.flights.smooth import Smoothed, smoothed
from fluid_sim_ros.reality.compare import HORIZONS, Part, compare, fly_windows
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.parameters import all_parameters, edit_of
from fluid_sim_ros.reality.residual.residuals import residuals
from fluid_sim_ros.reality.windows import cut, errors

FLIGHTS = ROOT.parent / 'shared' / 'reference' / 'flights'
TRAINED, LEFT_OUT = ('00', '12', '20'), '26'
MODELS = ('crazyflie', 'crazyflie_37g')
PARTS = ('errors', 'limits', 'bound', 'smoothed')
KEYS = ('position_m', 'velocity_m_s', 'attitude_deg')
#: Bands in which the response to the rotors' moments is measured [Hz].
BANDS = ((0.3, 2.0), (2.0, 5.0), (5.0, 9.0))
#: Targets of the left-out flight, medians at 0.5 s; specific force along z, rms as a share of g.
TARGETS = {'position_m': 0.03, 'velocity_m_s': 0.1, 'attitude_deg': 5.0, 'z_rms_of_g': 0.02}


def medians(horizons: dict[str, Any]) -> dict[str, dict[str, float]]:
    """Return the medians of errors by horizon."""
    return {h: {key: errors[key]['median'] for key in KEYS} for h, errors in horizons.items()}


def errors_of(flight: Flight) -> dict[str, Any]:
    """Return the errors of models and baselines on one flight."""
    result: dict[str, Any] = {}
    for model in MODELS:
        numbers = compare(flight, model, part=Part(horizons=HORIZONS)).numbers
        result[model] = {
            'horizons': medians(numbers['horizons']),
            'rigid_body': medians(numbers['baselines']['rigid_body']['horizons']),
            'z_rms_of_g': numbers['residuals']['specific_force']['z_rms_of_g'],
            'words': numbers['words'],
        }
        result['hold_velocity'] = medians(numbers['baselines']['hold_velocity']['horizons'])
    return result


def bounds_of(flight: Flight, smooth: Smoothed) -> dict[str, Any]:
    """Return what a perfect model would be off by, from the log's state and the smoothed one."""
    return bound_of(flight, 'crazyflie_37g', HORIZONS, measured_noise(flight, smooth)) | {
        'smoothed': bound_of(smooth.flight, 'crazyflie_37g', HORIZONS, noise_of_smoothed(smooth))
    }


def smooth_of(smooth: Smoothed, flight: Flight, models: dict[str, str]) -> dict[str, Any]:
    """Return what smoothed states say of one flight: errors, trim, air, what is left over."""
    part = Part(horizons=HORIZONS)
    result: dict[str, Any] = {
        'sigmas': smooth.sigmas, 'point_m': smooth.point.tolist(),
        'turn_rad': smooth.turn.tolist(), 'surprise': smooth.surprise,
    }  # fmt: skip
    for name, model in models.items():
        numbers = compare(smooth.flight, model, part=part).numbers
        result[name] = {
            'horizons': medians(numbers['horizons']),
            'not_smoothed': medians(compare(flight, model, part=part).numbers['horizons']),
            'trimmed': limits.trimmed(smooth.flight, model),
            'air': limits.with_air(smooth.flight, model),
            'remainder': limits.remainder_of(smooth.flight, model)[0],
        }
    return result


def limits_of(flight: Flight) -> dict[str, Any]:
    """Return what limits a model on one flight."""
    driven = drive(comparable_scene('crazyflie_37g'), flight)
    flyer = Flyer(driven)
    along = residuals(flyer, cut(flight, 0.5))
    off = along.turn - along.turn_model
    apart = float(np.median(np.diff(along.times)))
    slow = butter(4, 2.0 * 2 * apart)
    unknown = next(p for p in all_parameters(comparable_scene('crazyflie_37g'))
                   if p.name == 'com.y')  # fmt: skip
    inertia, weight = driven.model.body_inertia[driven.vehicle.body_id, 0], 0.037 * 9.81
    shift = edit_of([unknown], [unknown.value - inertia / weight])  # a moment of 1 rad/s^2
    part = Part(horizons=(0.5,))
    plain = compare(flight, 'crazyflie_37g', part=part).windows
    moved = drive(comparable_scene('crazyflie_37g'), flight, edit=shift)
    apart_by = errors(
        fly_windows(Flyer(moved), plain, (0.5,)), fly_windows(flyer, plain, (0.5,))
    )  # fmt: skip
    return {
        'moment_left_over_rad_s2': np.sqrt((filtfilt(*slow, off, axis=0) ** 2).mean(0)).tolist(),
        'unknown_moment_of_1_rad_s2': {
            key: float(np.median(apart_by[key])) for key in KEYS
        },
        'response': {f'{a:g} to {b:g} Hz': _response(flight, a, b) for a, b in BANDS},
    }  # fmt: skip


def _response(flight: Flight, low: float, high: float) -> dict[str, float]:
    """Return roll and pitch acceleration for each unit of the rotors' difference, 1e-6 rad/s^2."""
    times = np.arange(flight.signals['rates'].times[0], flight.signals['rates'].times[-1], 0.002)
    rates = flight.signals['rates'].between(times)
    squares = flight.signals['rotor_speed'].between(times - 0.004) ** 2  # gyro: low pass of 80 Hz
    band = butter(3, (low * 0.004, high * 0.004), btype='band')
    turn = filtfilt(*band, np.gradient(rates, 0.002, axis=0), axis=0)
    found = {}
    for axis, (name, signs) in enumerate((('roll', (-1, -1, 1, 1)), ('pitch', (-1, 1, 1, -1)))):
        given = filtfilt(*band, squares @ np.array(signs), axis=0)
        found[name] = float(1e6 * (given @ turn[:, axis]) / (given @ given))
        found[f'{name}_coherent'] = float(np.corrcoef(given, turn[:, axis])[0, 1] ** 2)
    return found


def draw(found: dict[str, Any], bound: dict[str, Any], path: Path) -> None:
    """Draw the errors of the left-out flight by horizon, and what a perfect model would have."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(10, 4.0), layout='constrained')
    rows = found[LEFT_OUT]
    lines = [
        ('crazyflie (literature)', rows['crazyflie']['horizons'], 's--', 'tab:gray'),
        ('hold velocity and rates', rows['hold_velocity'], '^:', 'tab:orange'),
        ('rigid body', rows['crazyflie_37g']['rigid_body'], 'v:', 'tab:red'),
        ('crazyflie_37g (fitted)', rows['crazyflie_37g']['horizons'], 'o-', 'tab:blue'),
        ('perfect model, noise of the log', bound['all_that_is_measured'], '.--', 'tab:green'),
        ('perfect model, smoothed state', bound['smoothed']['all_that_is_measured'], '.:',
         'tab:cyan'),
        ('perfect model, 1 % of each thrust unknown', bound['thrust_of_each_rotor']['0.01'],
         '.-.', 'tab:olive'),
    ]  # fmt: skip
    labels = ('position [m]', 'velocity [m/s]', 'attitude [deg]')
    for axis, key, label in zip(axes, KEYS, labels, strict=True):
        for name, horizons, style, colour in lines:
            axis.loglog([float(h) for h in horizons], [e[key] for e in horizons.values()], style,
                        color=colour, label=name, markersize=4)  # fmt: skip
        axis.plot(0.5, TARGETS[key], 'k*', label='target')
        axis.set_xlabel('horizon [s]')
        axis.set_title(f'median error of {label}', fontsize=9)
        axis.set_xticks(HORIZONS, [f'{h:g}' for h in HORIZONS])
        axis.minorticks_off()
        axis.grid(alpha=0.3)
    shown, names = axes[0].get_legend_handles_labels()
    figure.legend(shown, names, loc='outside lower center', ncols=4, fontsize=7)
    figure.savefig(path, dpi=110)


def summary(found: dict[str, Any]) -> dict[str, Any]:
    """Return what the errors of the left-out flight come to."""
    left = found[LEFT_OUT]
    here = left['crazyflie_37g']['horizons']
    baselines = (left['hold_velocity'], left['crazyflie_37g']['rigid_body'])
    return {
        'at_half_a_second': here['0.5'] | {'z_rms_of_g': left['crazyflie_37g']['z_rms_of_g']},
        'times_better_than_literature': min(
            left['crazyflie']['horizons'][h][k] / here[h][k] for h in here for k in KEYS
        ),
        'times_better_than_literature_at_half_a_second': {
            k: left['crazyflie']['horizons']['0.5'][k] / here['0.5'][k] for k in KEYS
        },
        'worse_than_a_baseline': [
            f'{key} at {h} s' for h in here for key in KEYS
            if any(here[h][key] >= rows[h][key] for rows in baselines)
        ],
    }  # fmt: skip


def recordings(chosen: argparse.Namespace) -> dict[str, Path]:
    """Return the recordings by number; end where they are not there."""
    folder = Path(chosen.flights) if chosen.flights else FLIGHTS
    paths = {n: folder / f'crazyflie_figure8_{n}.usd' for n in (*TRAINED, LEFT_OUT)}
    lost = [path.name for path in paths.values() if not path.exists()]
    if lost:
        print(
            f'crazyflie_37g: the recordings {", ".join(lost)} are not in {folder.name}/ (they are '
            'not part of this repository; --flights FOLDER): nothing to measure'
        )
        sys.exit(0)
    return {LEFT_OUT: paths[LEFT_OUT]} if chosen.quick else paths


def main() -> None:
    """Compare, and write result and pictures."""
    chosen = arguments(__doc__, 'crazyflie_37g', PARTS,
                       more={'flights': 'folder of the recordings'})  # fmt: skip
    paths = recordings(chosen)
    flights = {number: read_flight(path) for number, path in paths.items()}
    smooth = {n: smoothed(read_flight(path, limits.MOCAP)) for n, path in paths.items()}
    result: dict[str, Any] = {'trained': TRAINED, 'left_out': LEFT_OUT, 'targets': TARGETS}
    if chosen.only and chosen.json.exists():
        result |= json.loads(chosen.json.read_text(encoding='utf-8'))
    with tempfile.TemporaryDirectory() as folder:
        models = {
            'crazyflie_37g': 'crazyflie_37g',
            'refitted': limits.write_refitted(Path(folder) / 'refitted.xml'),
        }
        measures: dict[str, Callable[[str], dict[str, Any]]] = {
            'errors': lambda n: errors_of(flights[n]),
            'limits': lambda n: limits_of(flights[n]),
            'bound': lambda n: bounds_of(flights[n], smooth[n]),
            'smoothed': lambda n: smooth_of(smooth[n], flights[n], models),
        }
        for part in chosen.only or PARTS:
            result[part] = result.get(part, {}) | {n: measures[part](n) for n in flights}
    result |= summary(result['errors'])
    write(chosen.json, result)
    numbers, curves = limits.remainder_of(smooth[LEFT_OUT].flight, 'crazyflie_37g')
    limits.draw(numbers, curves, ROOT / 'doc' / 'img' / 'crazyflie_37g_remainder.png')
    draw(result['errors'], result['bound'][LEFT_OUT],
         ROOT / 'doc' / 'img' / 'crazyflie_37g_reality.png')  # fmt: skip


if __name__ == '__main__':
    main()
