# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Turbulence of the medium against theory: spectra, variance and covariance of many seeds.

64 seeds of 20 minutes for each kind: power in sixth-decade bands from 0.1 to 10 corner frequencies
against the spectrum of MIL-F-8785C, mean squares against sigma^2 in units of their own sampling
error. The samples are those of the plugin (its state after each tick), the cubic between them
included. Run: ``python -m benchmarks.weather.weather_spectra [--quick] [--json PATH]``.
"""

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from mujoco import rollout
from scipy.signal import welch

from benchmarks.common import ROOT, arguments, write
from fluid_sim_ros.physics.environment.turbulence import (
    angular_rate_spectra,
    dryden_covariance,
    dryden_spectra,
    turbulence_modes,
    von_karman_spectra,
)
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, world

mpl.use('Agg')

SEEDS, MINUTES = 64, 20.0
TICK = 0.01
LENGTH, AIRSPEED, SPAN = np.array([60.0, 60.0, 30.0]), 15.0, 2.0
TITLES = {'dryden': 'Dryden', 'von_karman': 'von Karman'}
NAMES = ('u', 'v', 'w', 'p', 'q', 'r')
# what stands in plugin_state before the turbulence, and how many samples it holds (medium.h)
HEAD, HELD = 16, 6


def medium(kind: str, seed: int) -> dict[str, Any]:
    """Return the keys of fluid_sim.medium for turbulence of unit intensity."""
    return {
        'density': 1.2, 'turbulence': kind, 'turbulence_sigma': [1, 1, 1],
        'turbulence_length': LENGTH, 'turbulence_airspeed': [AIRSPEED],
        'turbulence_span': [SPAN], 'seed': [seed],
    }  # fmt: skip


def samples(kind: str, seed: int, minutes: float) -> Array:
    """Return what a vehicle meets at ticks and half-way between them, shape (time, 6)."""
    body = free_body(ellipsoid([0.1] * 3, 1000) + body_plugin(volume='auto'), name='')
    model, data = load(world(body, medium=medium(kind, seed), timestep=TICK, integrator='Euler'))
    spec = mujoco.mjtState.mjSTATE_FULLPHYSICS
    start = np.empty(mujoco.mj_stateSize(model, spec))
    mujoco.mj_getState(model, data, start, spec)
    states, _ = rollout.rollout(model, data, start, nstep=round(minutes * 60 / TICK))
    newest: Array = states[0, :, -6:]  # the last samples close the state
    middle = (-newest[:-3] + 9 * newest[1:-2] + 9 * newest[2:-1] - newest[3:]) / 16
    both = np.empty((2 * len(middle), 6))
    both[::2], both[1::2] = newest[1:-2], middle
    return both


def theory(kind: str, omega: Array) -> dict[str, Array]:
    """Return the one-sided spectra of u, v, w and, for Dryden, p, q, r at sigma = 1."""
    spectra = dryden_spectra if kind == 'dryden' else von_karman_spectra
    out = {
        name: spectra(omega, length, AIRSPEED)[0 if name == 'u' else 1]
        for name, length in zip('uvw', LENGTH, strict=True)
    }
    if kind == 'dryden':
        rates = angular_rate_spectra(omega, out['v'], out['w'], LENGTH[2], AIRSPEED, SPAN)
        out |= dict(zip('pqr', rates, strict=True))
    return out


def corner(kind: str, name: str) -> float:
    """Return where a spectrum bends [rad/s]."""
    length = LENGTH[2] if name in 'wpq' else LENGTH[0]
    return AIRSPEED / length / (1.0 if kind == 'dryden' else 1.339)


def bands(omega: Array, power: Array, expected: Array, at: float) -> Array:
    """Return measured over expected power [dB] in sixth-decade bands, 0.1 to 10 corners."""
    edges = at * 10 ** np.arange(-1, 1 + 1e-9, 1 / 6)
    found = []
    for low, high in pairwise(edges):
        inside = (omega >= low) & (omega < high)
        found.append(10 * np.log10(power[inside].sum() / expected[inside].sum()))
    return np.array(found)


def mean_square_error(kind: str, name: str, total_s: float) -> float:
    """Return the standard error of the mean square of so many seconds, 2/T integral of 2 R^2."""
    lag = np.linspace(0, 400, 400_001)
    variance, factor = turbulence_modes(kind)
    covariance = np.zeros_like(lag)
    length = LENGTH['uvw'.index(name)]
    for share, scale in zip(variance, factor, strict=True):
        covariance += share * dryden_covariance(lag, length * scale, AIRSPEED)[name != 'u']
    return float(np.sqrt(4 * np.trapezoid(covariance**2, lag) / total_s))


def measure(kind: str, seeds: int, minutes: float) -> dict[str, Any]:
    """Return band errors, mean squares and the mean spectra of a kind."""
    power: Array | None = None
    square = np.zeros(6)
    frequency = np.empty(0)
    for seed in range(seeds):
        rows = samples(kind, seed, minutes)
        square += (rows[::2] ** 2).mean(axis=0) / seeds
        # one window over the whole record: the lowest band needs its resolution
        frequency, density = welch(
            rows, fs=2 / TICK, window='hann', nperseg=len(rows), detrend=False, axis=0
        )
        power = density if power is None else power + density
    assert power is not None
    omega, power = 2 * np.pi * frequency[1:], power[1:] / seeds / (2 * np.pi)
    expected = theory(kind, omega)
    result: dict[str, Any] = {'bands_db': {}, 'mean_square': {}, 'sigmas_off': {}}
    for i, name in enumerate(NAMES):
        if name in expected:
            found = bands(omega, power[:, i], expected[name], corner(kind, name))
            result['bands_db'][name] = found.round(3).tolist()
    for i, name in enumerate('uvw'):
        error = mean_square_error(kind, name, seeds * minutes * 60)
        result['mean_square'][name] = float(square[i])
        result['sigmas_off'][name] = float((square[i] - 1) / error)
    result['worst_band_db'] = max(max(map(abs, row)) for row in result['bands_db'].values())
    result['worst_sigmas_off'] = max(map(abs, result['sigmas_off'].values()))
    return result | {'omega': omega, 'power': power}


def draw_spectra(found: Mapping[str, Mapping[str, Any]]) -> None:
    """Draw the mean spectra beside the theory."""
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 4.2), sharey=True, layout='constrained')
    for axis, (kind, row) in zip(axes, found.items(), strict=True):
        spectra = dryden_spectra if kind == 'dryden' else von_karman_spectra
        omega, edges = row['omega'], np.geomspace(0.02, 300, 120)
        inside = np.digitize(omega, edges)
        for i, name in enumerate('uvw'):
            mean = [
                (omega[inside == k].mean(), row['power'][inside == k, i].mean())
                for k in range(1, len(edges)) if np.any(inside == k)
            ]  # fmt: skip
            axis.loglog(*np.array(mean).T, lw=1.6, label=f'{name}, 64 seeds of 20 min')
            expected = spectra(omega, LENGTH[i], AIRSPEED)[0 if name == 'u' else 1]
            axis.loglog(omega, expected, 'k--', lw=0.8, label='theory' if name == 'w' else None)
        axis.axvspan(0.1 * corner(kind, 'u'), 10 * corner(kind, 'w'), color='0.92', zorder=0)
        axis.set(title=TITLES[kind], xlabel='angular frequency [rad/s]',
                 xlim=(0.02, 300), ylim=(1e-7, 8))  # fmt: skip
        axis.grid(alpha=0.3)
    axes[0].set_ylabel('power over sigma$^2$ [s/rad]')
    axes[0].legend(fontsize=8, loc='lower left')
    figure.savefig(ROOT / 'doc' / 'img' / 'weather_spectra.png', dpi=110)
    plt.close(figure)


def main() -> None:
    """Measure both kinds, draw the spectra and write the result."""
    args = arguments(__doc__, 'weather_spectra')
    seeds, minutes = (4, 10.0) if args.quick else (SEEDS, MINUTES)
    found = {kind: measure(kind, seeds, minutes) for kind in ('dryden', 'von_karman')}
    for kind, row in found.items():
        print(f'{kind}: {row["worst_band_db"]:.2f} dB, {row["worst_sigmas_off"]:.2f} sigma')
    if not args.quick:
        draw_spectra(found)
    for row in found.values():
        del row['omega'], row['power']
    write(args.json, {'seeds': seeds, 'minutes': minutes, 'tick_s': TICK, 'kinds': found})


if __name__ == '__main__':
    main()
