# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of doc/waves.md: surface over time, spectrum, orbits."""

from typing import Any

import matplotlib as mpl
import numpy as np

from benchmarks.common import ROOT
from benchmarks.weather.wave_measures import (
    HEIGHT,
    PERIOD,
    bin_edges,
    elevation,
    model_in,
    orbit,
    sphere,
)
from fluid_sim_ros import Simulation
from fluid_sim_ros.physics.environment.wave_spectrum import (
    jonswap_spectrum,
    jonswap_waves,
)
from fluid_sim_ros.plugins.drawn_waves import surface_heights


def draw_elevation(axis: Any) -> None:
    """Draw surface and heave at the buoy of the scene wave_buoy."""
    simulation = Simulation('wave_buoy', seed=3)
    rows = []
    while simulation.time < 90:
        simulation.step(20)
        place = simulation.snapshot().vehicles['buoy'].position_w
        surface = surface_heights(simulation.model, simulation.data, place[np.newaxis, :2])
        assert surface is not None
        rows.append([simulation.time, surface[0], place[2]])
    times, surface, heave = np.array(rows).T
    axis.plot(times, surface, color='tab:blue', label='surface over the buoy')
    axis.plot(times, heave, color='tab:orange', linestyle='--', label="buoy's centre")
    axis.set(xlabel='time [s]', ylabel='height [m]', xlim=(0, 90))
    axis.set_title('scene wave_buoy: JONSWAP, $H_s$ = 1.5 m, $T_p$ = 6 s, seed 3')
    axis.legend(loc='upper right', ncols=2)
    axis.margins(y=0.2)
    axis.grid(alpha=0.3)


def draw_spectrum(axis: Any) -> None:
    """Draw the components' energy over their bins, and the spectrum estimated from the surface."""
    sea = jonswap_waves(HEIGHT, PERIOD, seed=1)
    omega_p = 2 * np.pi / PERIOD
    edges = bin_edges(sea) * omega_p
    density = sea.amplitude**2 / 2 / np.diff(edges)
    axis.stairs(density, edges, fill=True, color='tab:blue', alpha=0.3, label='bins, $a^2$/(2 Δω)')
    samples = []
    for seed in range(40):
        model, data = model_in(
            {'waves': f'jonswap {HEIGHT} {PERIOD}', 'wave_seed': seed}, sphere(volume='auto')
        )
        samples.append(np.abs(np.fft.rfft(elevation(model, data, np.arange(2000) * 0.8))) ** 2)
    step = 2 * np.pi / 1600
    periodogram = 2 * np.mean(samples, axis=0) / 2000**2 / step
    block = 4
    smooth = periodogram[1 : 1 + len(periodogram) // block * block].reshape(-1, block).mean(axis=1)
    at = step * (1 + block * np.arange(len(smooth)) + (block - 1) / 2)
    axis.plot(at, smooth, '.', color='tab:orange', ms=4, label='of the surface, 40 seeds')
    omega = np.linspace(0.3, 2.6, 400)
    axis.plot(omega, jonswap_spectrum(omega, HEIGHT, PERIOD), 'k', lw=1, label='JONSWAP, γ = 3.3')
    axis.set(xlabel='ω [rad/s]', ylabel='S(ω) [m² s/rad]', xlim=(0.3, 2.6))
    axis.set_title(f'$H_s$ = {HEIGHT:g} m, $T_p$ = {PERIOD:g} s, 64 components')
    axis.legend()
    axis.grid(alpha=0.3)


def draw_orbits(axes: Any) -> None:
    """Draw paths of neutral spheres in deep and in shallow water."""
    for axis, depth in zip(axes, (np.inf, 3.0), strict=True):
        for column, x in enumerate((0.0, 1.5, 3.0)):
            for z in (-0.3, -1.0, -1.7, -2.4, -2.9):
                path = orbit(z, depth, 0.2 * (column + 1))['path']
                axis.plot(x + path[:, 0], path[:, 2], color=f'C{column}', lw=1.2)
            axis.text(x, 0.42, f'{0.2 * (column + 1):.1f} m', ha='center', color=f'C{column}')
        axis.axhline(0, color='tab:blue', lw=0.8)
        if np.isfinite(depth):
            axis.axhspan(-3.3, -3, color='0.6')
        title = 'deep water' if np.isinf(depth) else f'{depth:g} m deep'
        axis.set(title=f'{title}, T = 5 s', xlabel='x [m]', xlim=(-0.8, 4.0), ylim=(-3.3, 0.7))
        axis.set_aspect('equal')
    axes[0].set_ylabel('z [m]')


def draw() -> None:
    """Write the pictures of doc/waves.md."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    folder = ROOT / 'doc' / 'img'
    for name, size, panels, painter in (
        ('waves_elevation', (8, 3), 1, draw_elevation),
        ('waves_spectrum', (6.5, 4), 1, draw_spectrum),
        ('waves_orbits', (9, 4), 2, draw_orbits),
    ):
        figure, axes = plt.subplots(1, panels, figsize=size, layout='constrained')
        painter(axes)
        figure.savefig(folder / f'{name}.png', dpi=90)
        plt.close(figure)
