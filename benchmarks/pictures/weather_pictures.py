# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of doc/weather.md: time series and profiles over the height."""

from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import ROOT
from fluid_sim_ros.physics.environment.medium import (
    logarithmic_profile,
    power_law_profile,
    table_profile,
)
from fluid_sim_ros.physics.environment.turbulence_scales import (
    turbulence_intensity,
    turbulence_length,
)
from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, world

mpl.use('Agg')
import matplotlib.pyplot as plt

FOLDER = ROOT / 'doc' / 'img'
WIND = [8.0, 0.0, 0.0]


def flow_series(keys: Mapping[str, Any], seconds: float) -> tuple[Array, Array]:
    """Return times and what a vehicle meets, 10 m over ground [s], [m/s]."""
    body = free_body(ellipsoid([0.1] * 3, 1.2) + body_plugin(volume='auto'))
    model, data = load(world(body, medium={'density': 1.2, **keys}, timestep=0.02))
    point, out = np.array([0.0, 0.0, 10.0]), np.zeros(9)
    times, rows = [], []
    while data.time < seconds:
        native().flow(model._address, data._address, 1, point.ctypes.data, out.ctypes.data)
        times.append(data.time)
        rows.append(out[:3].copy())
        mujoco.mj_step(model, data)
    return np.array(times), np.array(rows)


def draw_series() -> None:
    """Draw a minute of every kind of signal."""
    turbulent = {'wind': WIND, 'turbulence_wind_6m': [7.3], 'turbulence_height': [10],
                 'turbulence_airspeed': [8], 'seed': [1]}  # fmt: skip
    cases = {
        'Dryden, mean 8 m/s': turbulent | {'turbulence': 'dryden'},
        'von Karman, mean 8 m/s': turbulent | {'turbulence': 'von_karman'},
        'ramp, 1-cosine gust that falls again, sine across': {
            'wind': [2, 0, 0],
            'wind_signal': 'ramp 4 0 0 10 10 gust 4 0 0 35 3 4 sine 0 1.5 0 20 0',
        },
        'Gauss-Markov current, 60 s': {
            'current': [0.5, 0, 0], 'current_gauss_markov': [0.15, 0.15, 0.05, 60], 'seed': [4]
        },
    }  # fmt: skip
    figure, axes = plt.subplots(4, 1, figsize=(8, 8.5), sharex=True, layout='constrained')
    for axis, (title, keys) in zip(axes, cases.items(), strict=True):
        times, rows = flow_series(keys, 60.0)
        for i, name in enumerate(('east', 'north', 'up')):
            axis.plot(times, rows[:, i], lw=0.9, label=name)
        axis.set_title(title, fontsize=10, loc='left')
        axis.set_ylabel('velocity [m/s]')
        axis.grid(alpha=0.3)
    axes[0].legend(ncols=3, loc='upper right', fontsize=8)
    axes[-1].set_xlabel('time [s]')
    figure.savefig(FOLDER / 'weather_series.png', dpi=110)
    plt.close(figure)


def draw_profiles() -> None:
    """Draw mean profiles, intensity and length scales over the height."""
    figure, axes = plt.subplots(1, 4, figsize=(11, 4.2), layout='constrained')
    z = np.geomspace(0.05, 100, 300)
    axes[0].plot(8 * power_law_profile(z, 10, 1 / 7)[0], z, label='power law, 1/7')
    axes[0].plot(8 * logarithmic_profile(z, 10, 0.03)[0], z, label='logarithmic, grass')
    axes[0].plot(8 * logarithmic_profile(z, 10, 2e-4)[0], z, '--', label='logarithmic, sea')
    axes[0].set(xlabel='wind [m/s]', ylabel='height [m]', ylim=(0, 60))
    depth = np.linspace(0, 40, 200)
    factor = table_profile(-depth, [-40.0, -20.0, -12.0, 0.0], [0.1, 0.15, 0.8, 1.0])[0]
    axes[1].plot(0.6 * factor, depth)
    axes[1].set(xlabel='stratified current [m/s]', ylabel='depth [m]', ylim=(40, 0))
    height = np.linspace(3, 1200, 600)
    for name, style, column in (('u, v', '-', 0), ('w', '--', 2)):
        axes[2].plot(turbulence_intensity(height, 7.3)[0][:, column], height, style, label=name)
        axes[3].plot(turbulence_length(height)[:, column], height, style, label=name)
    axes[2].set(xlabel='intensity [m/s]', ylabel='height [m]', xlim=(0, None))
    axes[3].set(xlabel='length scale, Dryden [m]', ylabel='height [m]', xlim=(0, None))
    for axis in axes:
        axis.grid(alpha=0.3)
    for axis in (axes[0], axes[2], axes[3]):
        axis.legend(fontsize=8)
    figure.savefig(FOLDER / 'weather_profiles.png', dpi=110)
    plt.close(figure)


if __name__ == '__main__':
    draw_series()
    draw_profiles()
