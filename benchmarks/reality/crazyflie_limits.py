# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What limits crazyflie_37g on a flight: what is left of its accelerations, and what explains it.

``remainder_of``: angular acceleration and specific force that the model lacks, over time,
frequency and speed, beside the noise of gyro and accelerometer, and how far they go together: air
that moves pushes and turns the vehicle at once. ``trimmed``: the centre of mass, which moves from
flight to flight, taken from one half of a flight, the other half judged. ``with_air``: in the same
windows, errors once the air may move, constant in each: what a forecast would gain if it knew the
air; the windows themselves tell it, so this is no forecast.
"""

from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import butter, filtfilt, welch

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.mapping import FlightMap
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.airborne import airborne
from fluid_sim_ros.reality.compare import Part, compare, fly_windows
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.fit import Fitted, fit
from fluid_sim_ros.reality.fitting.shooting import error_vectors
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.parameters import edit_of, find_parameters
from fluid_sim_ros.reality.residual.residuals import accelerations
from fluid_sim_ros.reality.windows import ATTITUDE, VELOCITY, cut, state_at

#: The pose of motion capture in place of the estimate that the vehicle made of it.
MOCAP = FlightMap.model_validate({
    'signals': {
        'position': {'stream': 'estPose', 'columns': ['locSrv.x', 'locSrv.y', 'locSrv.z'],
                     'unit': 'm', 'axes': 'enu'},
        'attitude': {'stream': 'estPose', 'order': 'xyzw', 'axes': 'enu_flu',
                     'columns': ['locSrv.qx', 'locSrv.qy', 'locSrv.qz', 'locSrv.qw']},
    }
})  # fmt: skip
MODEL = 'crazyflie_37g'
#: Speed at which the moment of pitch by surge is half, fitted beside ``REFITTED`` [m/s].
FADE = 1.41
#: Fitted with smoothed states, where the moment of pitch by surge fades with speed.
REFITTED = {
    'thrust_coefficient.m1': 3.642e-8, 'thrust_coefficient.m2': 3.785e-8,
    'thrust_coefficient.m3': 3.563e-8, 'thrust_coefficient.m4': 3.810e-8,
    'torque_ratio.m1': 0.002812, 'torque_ratio.m2': 0.002705,
    'torque_ratio.m3': 0.002874, 'torque_ratio.m4': 0.002688,
    'com.x': -5e-5, 'com.y': -5e-5,
    'linear_damping.roll_sway': -4.99e-4, 'linear_damping.pitch_surge': 1.2016e-3,
}  # fmt: skip
TRIM = ('com.x', 'com.y')
KEYS = ('position_m', 'velocity_m_s', 'attitude_deg')
#: Below this a window of half a second feels an acceleration [Hz].
SLOW = 3.0
#: Where gyro and accelerometer see noise alone [Hz]: above the controller, below their filters.
_NOISE_BAND = (35.0, 60.0)
_STEP = 0.002
#: Horizons of which the air in a window is found [s]; air that is tried; its prior [m/s].
_FELT, _BLOW, _AIR = (0.25, 0.5), 0.01, 0.1


def write_refitted(path: Path) -> str:
    """Write the model with ``REFITTED`` and ``FADE`` as MJCF; return its path."""
    scene = comparable_scene(MODEL)
    chosen = find_parameters(scene, list(REFITTED))
    spec = scene.read_model()
    edit_of(chosen, list(REFITTED.values()))(spec)
    for plugin in spec.plugins:
        if 'linear_damping' in plugin.config:
            plugin.config = {**plugin.config, 'moment_fade': f'0 {FADE}'}
    spec.compile()
    path.write_text(spec.to_xml(), encoding='utf-8')
    return str(path)


def medians(numbers: dict[str, Any], horizon: str = '0.5') -> dict[str, float]:
    """Return medians of a comparison at one horizon."""
    return {key: numbers['horizons'][horizon][key]['median'] for key in KEYS}


def _fitted(
    flight: Flight, model: str, names: tuple[str, ...], begin: float, end: float
) -> Fitted:
    """Return parameters that fit a part of one flight, windows begun as measured."""
    return fit([flight], Task(model, names, begin=begin, end=end, start='measured'))


def trimmed(flight: Flight, model: str) -> dict[str, Any]:
    """Return medians at 0.5 s of half a flight, with the trim of the other half and without."""
    last = flight.signals['position'].times[-1]
    half = 0.5 * last
    rows: dict[str, list[dict[str, float]]] = {'as_it_is': [], 'trim_of_the_other_half': []}
    for judged, other in (((half, last), (0.0, half)), ((0.0, half), (half, last))):
        found = _fitted(flight, model, TRIM, *other)
        part = Part(*judged, horizons=(0.5,))
        edit = edit_of(found.parameters, found.values)
        rows['as_it_is'].append(medians(compare(flight, model, part=part).numbers))
        rows['trim_of_the_other_half'].append(
            medians(compare(flight, model, part=part, edit=edit).numbers)
        )
    return {
        name: {key: float(np.mean([row[key] for row in both])) for key in KEYS}
        for name, both in rows.items()
    }


def with_air(flight: Flight, model: str) -> dict[str, Any]:
    """
    Return medians at 0.5 s with this flight's own trim, and with air that moves, too.

    The air is constant within each window, found of its errors at 0.25 and 0.5 s (linear, with a
    prior of ``_AIR``); the accelerometer, which is no part of that, says what it was, too.
    """
    last = flight.signals['position'].times[-1]
    own = _fitted(flight, model, TRIM, 0.0, last)
    scene = comparable_scene(model)
    flown = []
    for blows in ((0.0, 0.0), (_BLOW, 0.0), (0.0, _BLOW)):
        names = [*own.parameters, *find_parameters(scene, ['wind.x', 'wind.y'])]
        edit = edit_of(names, [*own.values, *blows])
        flyer = Flyer(drive(scene, flight, edit=edit))
        if not flown:
            windows, _ = airborne(cut(flight, 1.0), flyer)
            measured = windows.measured(np.array(_FELT))
        flown.append(error_vectors(fly_windows(flyer, windows, _FELT), measured))
    off = flown[0]
    by = np.stack([(each - off) / _BLOW for each in flown[1:]], axis=-1)
    weights = 1.0 / np.repeat((0.03, np.radians(5.0), 0.1, np.inf), 3)
    jacobian = (by * weights[:, None]).reshape(len(off), -1, 2)
    residual = (off * weights).reshape(len(off), -1)
    inner = np.einsum('wni,wnj->wij', jacobian, jacobian) + np.eye(2) / _AIR**2
    slope = np.einsum('wni,wn->wi', jacobian, residual)
    air = -np.linalg.solve(inner, slope[..., None])[..., 0]
    left = off + np.einsum('wmki,wi->wmk', by, air)
    felt = _by_accelerometer(flight, Flyer(drive(scene, flight)), windows.begins)
    return {
        'own_trim': _sizes(off), 'own_trim_and_air': _sizes(left),
        'air_rms_m_s': np.sqrt((air**2).mean(axis=0)).tolist(),
        'by_accelerometer_rms_m_s': np.sqrt((felt**2).mean(axis=0)).tolist(),
        'correlation_with_accelerometer': [
            float(np.corrcoef(air[:, i], felt[:, i])[0, 1]) for i in range(2)
        ],
        'com_m': own.values.tolist(),
    }  # fmt: skip


def _sizes(off: Array) -> dict[str, float]:
    last = off[:, -1]
    sizes = (last[:, :3], last[:, 6:9], np.degrees(last[:, 3:6]))
    return {
        key: float(np.median(np.linalg.norm(part, axis=1)))
        for key, part in zip(KEYS, sizes, strict=True)
    }


def _by_accelerometer(flight: Flight, flyer: Flyer, begins: Array) -> Array:
    """Return what the accelerometer says of the air in windows of 0.5 s, [m/s] world, (w, 2)."""
    times = np.arange(begins[0], begins[-1] + 0.5, 0.004)
    force = flight.signals['specific_force'].between(times)
    states = state_at(flight, times)
    facing = rotations(states[:, ATTITUDE])
    across = facing.inv().apply(states[:, VELOCITY])
    air = np.zeros((len(times), 3))
    for i in range(2):  # specific force = -c (velocity - air) + bias
        drag, bias = np.polyfit(across[:, i], force[:, i], 1)
        air[:, i] = across[:, i] - (force[:, i] - bias) / drag
    world = facing.apply(air)[:, :2]
    rows = [world[(times >= t) & (times < t + 0.5)].mean(axis=0) for t in begins]
    return np.array(rows)


def remainder_of(flight: Flight, model_name: str) -> tuple[dict[str, Any], dict[str, Array]]:
    """Return what is left of the accelerations of a flight: numbers, and curves for a picture."""
    driven = drive(comparable_scene(model_name), flight)
    flyer = Flyer(driven)
    signals = flight.signals
    names = ('position', 'velocity', 'rates', 'specific_force', 'rotor_speed')
    first = max(signals[name].times[0] for name in names) + 0.05
    last = min(signals[name].times[-1] for name in names) - 0.05
    times = np.arange(first, last, _STEP)
    model = accelerations(flyer, flight, times)
    turn = np.gradient(signals['rates'].between(times), _STEP, axis=0)
    force = signals['specific_force'].between(times)
    states = state_at(flight, times)
    speed = np.linalg.norm(states[:, VELOCITY], axis=1)
    low = butter(3, 2 * SLOW * _STEP)
    off_turn, off_force = (
        filtfilt(*low, each - each.mean(axis=0), axis=0)
        for each in (turn - model.turn, force - model.force)
    )
    # air along x turns the vehicle in pitch and pushes it along x; along y in roll
    together = {}
    for name, axis, along in (('roll', 0, 1), ('pitch', 1, 0)):
        a, b = off_turn[:, axis], off_force[:, along]
        together[name] = {
            'correlation': float(np.corrcoef(a, b)[0, 1]), 'slope': float(a @ b / (b @ b)),
        }  # fmt: skip
    spectra = {}
    curves = {'times': times, 'off_turn': off_turn, 'off_force': off_force, 'speed': speed,
              'attitude': states[:, ATTITUDE]}  # fmt: skip
    for name, measured, lacks, square in (
        ('turn', turn, turn - model.turn, True), ('force', force, force - model.force, False),
    ):  # fmt: skip
        f, power = welch(measured, 1 / _STEP, nperseg=1024, axis=0)
        rest = welch(lacks, 1 / _STEP, nperseg=1024, axis=0)[1]
        raw = welch(signals['rates'].between(times), 1 / _STEP, nperseg=1024, axis=0)[1]
        band = (f > _NOISE_BAND[0]) & (f < _NOISE_BAND[1])
        floor = np.median((raw if square else power)[band], axis=0)
        noise = floor * (2 * np.pi * f[:, None]) ** 2 if square else np.tile(floor, (len(f), 1))
        slow = (f > 0) & (f < SLOW)
        spectra[name] = {
            'remainder_rms': np.sqrt(rest[slow].sum(axis=0) * f[1]).tolist(),
            'measured_rms': np.sqrt(power[slow].sum(axis=0) * f[1]).tolist(),
            'sensor_noise_rms': np.sqrt(noise[slow].sum(axis=0) * f[1]).tolist(),
        }
        curves |= {'f': f, f'{name}_measured': power, f'{name}_rest': rest, f'{name}_noise': noise}
    order = np.argsort(speed)
    by_speed = [
        {'speed_m_s': float(speed[part].mean()),
         'turn_rad_s2': np.sqrt((off_turn[part] ** 2).mean(axis=0)).tolist(),
         'force_m_s2': np.sqrt((off_force[part] ** 2).mean(axis=0)).tolist()}
        for part in np.array_split(order, 5)
    ]  # fmt: skip
    inertia = driven.model.body_inertia[driven.vehicle.body_id]
    return {
        'below_hz': SLOW, 'turn': spectra['turn'], 'force': spectra['force'],
        'moment_and_force': together, 'by_speed': by_speed,
        'inertia': inertia.tolist(),
    }, curves  # fmt: skip


def draw(found: dict[str, Any], curves: dict[str, Array], path: Any) -> None:
    """Draw what is left over time, frequency and speed."""
    import matplotlib as mpl

    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(2, 3, figsize=(13, 6.4), layout='constrained')
    times, f = curves['times'], curves['f']
    for axis, name, turn, along, letter in (
        (axes[0, 0], 'pitch', 1, 0, 'x'), (axes[1, 0], 'roll', 0, 1, 'y'),
    ):  # fmt: skip
        slope = found['moment_and_force'][name]['slope']
        axis.plot(times, curves['off_turn'][:, turn], label=f'{name}: measured less model')
        axis.plot(times, slope * curves['off_force'][:, along], '--',
                  label=f'specific force {letter}, the same, x {slope:.0f}')  # fmt: skip
        axis.set_title(
            f'{name} below {SLOW:g} Hz; correlation '
            f'{found["moment_and_force"][name]["correlation"]:+.2f}', fontsize=9,
        )  # fmt: skip
        axis.set_xlabel('time [s]')
        axis.set_ylabel('angular acceleration [rad/s²]')
    for axis, name, unit, lines in (
        (axes[0, 1], 'turn', 'rad/s²', ((0, 'roll', 'tab:blue'), (1, 'pitch', 'tab:orange'))),
        (axes[1, 1], 'force', 'm/s²', ((0, 'x', 'tab:blue'), (2, 'z', 'tab:orange'))),
    ):  # fmt: skip
        for i, label, colour in lines:
            axis.loglog(f[1:], curves[f'{name}_measured'][1:, i] ** 0.5, ':', color=colour,
                        label=f'{label}: measured')  # fmt: skip
            axis.loglog(f[1:], curves[f'{name}_rest'][1:, i] ** 0.5, color=colour,
                        label=f'{label}: measured less model')  # fmt: skip
            axis.loglog(f[1:], curves[f'{name}_noise'][1:, i] ** 0.5, '--', color=colour, lw=0.8,
                        label=f'{label}: noise of the sensor')  # fmt: skip
        axis.set_xlim(0.5, 60)
        axis.set_title('angular acceleration' if name == 'turn' else 'specific force', fontsize=9)
        axis.set_xlabel('frequency [Hz]')
        axis.set_ylabel(f'[{unit}/√Hz]')
    speeds = [row['speed_m_s'] for row in found['by_speed']]
    for axis, key, labels, unit in (
        (axes[0, 2], 'turn_rad_s2', ('roll', 'pitch', 'yaw'), 'rad/s²'),
        (axes[1, 2], 'force_m_s2', ('x', 'y', 'z'), 'm/s²'),
    ):
        for i, label in enumerate(labels):
            axis.plot(speeds, [row[key][i] for row in found['by_speed']], 'o-', label=label)
        axis.set_title(f'left over below {SLOW:g} Hz, against speed', fontsize=9)
        axis.set_xlabel('speed [m/s]')
        axis.set_ylabel(f'rms [{unit}]')
        axis.set_ylim(0)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=6)
    figure.savefig(path, dpi=100)
