# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
How far any model can come on a flight: the forecast of a perfect one from what was measured.

The model takes the place of the vehicle: windows of its own flight are flown again from states and
rotor speeds that are off as those of the log are. The errors of an estimate are slow: those of a
window's begin are taken to hold at its end, too, where they cancel in part. So what comes out is
the least that any model of this vehicle, unstable as it is, is off by.
"""

from typing import Any

import numpy as np
from scipy.signal import butter, filtfilt

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.smooth import Smoothed
from fluid_sim_ros.reality.compare import fly_windows
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.fitting.shooting import error_vectors, moved
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.windows import cut, errors, state_at

#: What is faster than this is noise, of a signal of the state and of a rotor's speed [Hz].
_STATE_BAND, _ROTOR_BAND = 8.0, 20.0
#: Assumption where nothing better is known: tilt by an estimate with motion capture [rad].
_TILT = np.radians(0.5) / np.sqrt(3)
#: Shares of each rotor's thrust that come and go unmeasured, constant within a window.
_SHARES = (0.005, 0.01)
#: Time over which the estimated velocity is held against the change of position [s].
_OVER = 0.5
KEYS = ('position_m', 'velocity_m_s', 'attitude_deg')


def _noise(values: np.ndarray, rate: float, band: float) -> float:
    smooth = filtfilt(*butter(3, 2 * band / rate), values, axis=0)
    return float(np.sqrt(((values - smooth) ** 2).mean()))


def measured_noise(flight: Flight, smooth: Smoothed | None = None) -> dict[str, float]:
    """
    Return the errors of the log: [m], [m/s], [rad], [rad/s], rotor speed [rad/s].

    With a smoothed state, position, velocity and attitude are held against that, less what is
    constant; else the velocity against the change of position, and the tilt is assumed.
    """
    signal = flight.signals
    position, velocity = signal['position'], signal['velocity']
    times = np.arange(1.0, position.times[-1] - 1.0, 0.05)
    change = position.between(times + _OVER) - position.between(times)
    inside = times[:, None] + np.linspace(0, _OVER, 51)
    mean = velocity.between(inside.ravel()).reshape(*inside.shape, 3).mean(axis=1)
    drift = change / _OVER - mean
    found = {
        'position': _noise(position.values, position.rate, _STATE_BAND),
        'velocity': float(np.sqrt(((drift - drift.mean(axis=0)) ** 2).mean())),
        'attitude': float(_TILT),
        'rates': _noise(signal['rates'].values, signal['rates'].rate, _STATE_BAND),
        'rotor_speed': _noise(
            signal['rotor_speed'].values, signal['rotor_speed'].rate, _ROTOR_BAND
        ),
    }
    if smooth is not None:
        times = np.arange(1.0, position.times[-1] - 1.0, 0.02)
        off = error_vectors(state_at(flight, times), state_at(smooth.flight, times))
        for i, name in enumerate(('position', 'attitude', 'velocity')):
            part = off[:, 3 * i : 3 * i + 3]
            found[name] = float(np.sqrt(((part - part.mean(axis=0)) ** 2).mean()))
    return found


def noise_of_smoothed(smooth: Smoothed) -> dict[str, float]:
    """Return the errors of a smoothed state, as the smoother states them."""
    position, velocity, attitude = smooth.sigmas
    raw = measured_noise(smooth.flight)
    return raw | {'position': position, 'velocity': velocity, 'attitude': attitude}


def bound_of(
    flight: Flight, model: str, horizons: tuple[float, ...], noise: dict[str, float]
) -> dict[str, Any]:
    """Return medians by horizon for each source of error, and for all that is measured."""
    driven = drive(comparable_scene(model), flight)
    flyer = Flyer(driven)
    windows = cut(flight, max(horizons), apart=0.1)
    truth = fly_windows(flyer, windows, horizons)
    step = flyer.timestep
    start = windows.measured(0.0)
    controls = windows.controls(driven, step)[:, : round(max(horizons) / step)]
    every = [round(h / step) for h in horizons]
    rng = np.random.default_rng(0)

    def apart(*sources: str, share: float = 0.0) -> dict[str, Any]:
        by = np.zeros((len(start), 12))
        for i, name in enumerate(('position', 'attitude', 'velocity', 'rates')):
            if name in sources:
                by[:, 3 * i : 3 * i + 3] = rng.normal(0, noise[name], (len(start), 3))
        given = controls.copy()
        if 'rotor_speed' in sources:
            given += rng.normal(0, noise['rotor_speed'], given.shape)
        # thrust goes with the square of the speed
        given *= 1 + 0.5 * share * rng.normal(0, 1, (len(given), 1, given.shape[2]))
        found = flyer.fly(flyer.states(moved(start, by), windows, None), given, every)
        seen = np.stack([moved(truth[:, i], by) for i in range(len(horizons))], axis=1)
        off = errors(found, seen)
        return {
            f'{h:g}': {key: float(np.median(off[key][:, i])) for key in KEYS}
            for i, h in enumerate(horizons)
        }

    sources = ('position', 'velocity', 'attitude', 'rates', 'rotor_speed')
    return {
        'noise': noise,
        'by_source': {name: apart(name) for name in sources},
        'all_that_is_measured': apart(*sources),
        'thrust_of_each_rotor': {f'{s:g}': apart(share=s) for s in _SHARES},
    }
