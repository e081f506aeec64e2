# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the plugin's waves do, measured against closed forms, and what they cost."""

import time
from typing import Any

import mujoco
import numpy as np
from scipy.integrate import quad, solve_ivp

from fluid_sim_ros.physics.environment.wave_dispersion import dispersion_wavenumber
from fluid_sim_ros.physics.environment.wave_spectrum import (
    jonswap_shape,
    jonswap_waves,
)
from fluid_sim_ros.physics.environment.waves import (
    Sea,
    regular_waves,
    wave_flow,
)
from fluid_sim_ros.plugins.drawn_waves import surface_heights
from test.support.plugin_models import (
    Array,
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    world,
)

G = 9.81
HEIGHT, PERIOD = 2.0, 8.0  # of the sea: significant [m], of the peak [s]
RADIUS = 0.1
DISPLACED = 1000 * 4 / 3 * np.pi * RADIUS**3  # [kg]
VEHICLE = {
    'added_mass': 'auto', 'volume': 'auto',
    'linear_damping': [4, 6, 5, 0.1, 0.1, 0.1], 'quadratic_damping': [18, 21, 37, 1.5, 1.5, 1.5],
}  # fmt: skip
COUNTS = (0, 1, 16, 64, 256)
BLOCK = 60  # steps that are timed at once: less than a scheduler's slice


def model_in(
    waves: dict[str, Any], bodies: str, *, weight: bool = True, **options: Any
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a model in water of 1000 kg/m^3 with the surface at z = 0."""
    medium = {'density': 1000, 'surface': 0, **waves}
    flag = '' if weight else 'gravity="disable"'
    return load(world(bodies, medium=medium, gravity=(0, 0, -G), flag=flag, **options))


def sphere(density: float = 1000, **plugin: Any) -> str:
    """Return a free sphere with a fluid_sim.body."""
    return free_body(ellipsoid([RADIUS] * 3, density) + body_plugin(**plugin))


def elevation(model: mujoco.MjModel, data: mujoco.MjData, times: Array) -> Array:
    """Return the surface over the origin [m] at times, from the plugin."""
    heights = np.empty(len(times))
    for i, data.time in enumerate(times):
        found = surface_heights(model, data, np.zeros((1, 2)))
        assert found is not None
        heights[i] = found[0]
    return heights


def dispersion() -> float:
    """Return the largest relative error of g k tanh(k h) against omega^2."""
    worst = 0.0
    for depth in np.geomspace(0.01, 1e4, 25):
        omega = np.geomspace(1e-3, 1e3, 200)
        k = dispersion_wavenumber(omega, float(depth), G)
        worst = max(worst, float(np.max(np.abs(G * k * np.tanh(k * depth) / omega**2 - 1))))
    return worst


def spectrum(seeds: int) -> dict[str, Any]:
    """Return relative errors of the energy and of H_s over one repeat, worst of the seeds."""
    energy, height = [], []
    whole = quad(lambda r: jonswap_shape(r, 3.3), 0.5, 4, points=[1], epsrel=1e-11)[0]
    bins = []
    for seed in range(seeds):
        spreading = 10.0 * (seed % 2)
        sea = jonswap_waves(HEIGHT, PERIOD, seed=seed, spreading=spreading)
        energy.append(abs(np.sum(sea.amplitude**2 / 2) / (HEIGHT**2 / 16) - 1))
        waves = {
            'waves': f'jonswap {HEIGHT} {PERIOD}', 'wave_seed': seed, 'wave_spreading': spreading,
        }  # fmt: skip
        model, data = model_in(waves, sphere(volume='auto'))
        heights = elevation(model, data, np.arange(0, sea.repeat, 0.8))
        height.append(abs(4 * heights.std() / HEIGHT - 1))
    edges = bin_edges(sea)
    for low, high, amplitude in zip(edges[:-1], edges[1:], sea.amplitude, strict=True):
        part = quad(lambda r: jonswap_shape(r, 3.3), low, high, epsrel=1e-11)[0] / whole
        bins.append(abs(amplitude**2 / 2 / (HEIGHT**2 / 16) - part))
    return {
        'seeds': seeds,
        'sum_a2_half_over_m0_error': max(energy),
        'significant_height_over_one_repeat_error': max(height),
        'energy_of_a_bin_error_of_m0': max(bins),
        'repeat_s': sea.repeat,
    }


def bin_edges(sea: Sea) -> Array:
    """Return the edges of the bins of a default sea as frequency ratios."""
    count, multiples = len(sea.omega), sea.repeat / PERIOD
    edges = np.floor(0.5 * multiples * 8.0 ** (np.arange(count + 1) / count) + 0.5)
    ratios: Array = (edges - 0.5) / multiples
    return ratios


def orbit(z: float, depth: float, height: float = 0.4) -> dict[str, Any]:
    """Return the path of a neutral sphere over a period beside that of the water there."""
    sea = regular_waves(height, 5.0, depth=depth, gravity=G)
    waves: dict[str, Any] = {'waves': f'regular {height} 5'}
    if np.isfinite(depth):
        waves['water_depth'] = depth
    model, data = model_in(
        waves, sphere(volume='auto', added_mass='auto'), weight=False, timestep=0.02
    )
    start = np.array([0.0, 0.0, z])
    data.qpos[:3], data.qvel[:3] = start, wave_flow(sea, start, 0.0).velocity
    path = [start]
    for _ in range(250):
        mujoco.mj_step(model, data)
        path.append(data.qpos[:3].copy())
    water = solve_ivp(
        lambda t, x: wave_flow(sea, x, t).velocity, (0, 5), start,
        method='DOP853', rtol=1e-11, atol=1e-12,
    ).y[:, -1]  # fmt: skip
    return {'path': np.array(path), 'off': float(np.linalg.norm(path[-1] - water))}


def orbits() -> dict[str, Any]:
    """Return radius against a e^kz and distance from the water's path after one period."""
    k = (2 * np.pi / 5) ** 2 / G
    rows = []
    for z in (-0.5, -2.0, -6.0):
        small, steep = orbit(z, np.inf, 0.002), orbit(z, np.inf)
        radius = np.ptp(small['path'][:, 2]) / 2
        rows.append(
            {
                'z': z,
                'radius_error': float(abs(radius / (0.001 * np.exp(k * z)) - 1)),
                'off_the_water_m': steep['off'],
            }
        )
    return {'k_a_of_the_radius': 0.001 * k, 'rows': rows}


def held_sphere() -> float:
    """Return the largest error of the force, in amplitudes 3/2 rho V a omega^2 e^kz."""
    model, data = model_in(
        {'waves': 'regular 1.2 5'}, sphere(volume='auto', added_mass='auto'), weight=False
    )
    omega, k = 2 * np.pi / 5, (2 * np.pi / 5) ** 2 / G
    amplitude, worst = 1.5 * DISPLACED * 0.6 * omega**2 * np.exp(-3 * k), 0.0
    lift = 1.5 * DISPLACED * k * (0.6 * omega * np.exp(-3 * k)) ** 2
    data.qpos[2] = -3
    for data.time in np.linspace(0, 5, 33):
        angle = -omega * data.time
        wanted = [amplitude * np.sin(angle), 0, lift - amplitude * np.cos(angle)]
        worst = max(worst, float(np.max(np.abs(explicit_force(model, data)[:3] - wanted))))
    return worst / amplitude


def floating_box() -> dict[str, float]:
    """Return heave and pitch of a 1 m box against surface and slope, waves of 39 to 350 m."""
    box = '<geom type="box" size=".5 .5 .1" density="500"/>'
    plugin = body_plugin(
        volume='auto', added_mass=[10, 10, 80, 3, 3, 1], linear_damping=[0, 0, 300, 60, 60, 5]
    )
    out = {}
    for period in (5.0, 10.0, 15.0):
        sea = regular_waves(0.2, period, gravity=G)
        model, data = model_in({'waves': f'regular .2 {period}'}, free_body(box + plugin))
        data.qpos[2], data.qvel[:3] = 0.1, wave_flow(sea, [0, 0, 0.1], 0.0).velocity
        rows = []
        for _ in range(round(4 * period / 0.01)):
            mujoco.mj_step(model, data)
            rows.append([data.qpos[2], -data.xmat[1][2] / data.xmat[1][8]])
        last = np.array(rows[-round(period / 0.01) :])
        out[f'heave_over_surface_{period:g}s'] = float(np.ptp(last[:, 0]) / 0.2)
        slope = 0.1 * sea.wavenumber[0]
        out[f'pitch_over_slope_{period:g}s'] = float(np.ptp(last[:, 1]) / 2 / slope)
    return out


def cost(rounds: int) -> dict[str, Any]:
    """Return microseconds per step over the number of components, and ratios to still water."""
    result: dict[str, Any] = {}
    for place, z, density in (('deep, 8 m down', -8, 1000), ('floating', 0, 500)):
        setups = {}
        for count in COUNTS:
            waves = {'waves': 'jonswap 1 6', 'wave_components': count, 'wave_repeat': 20000}
            hull = ellipsoid((0.25, 0.2, 0.15), density) + body_plugin(**VEHICLE)
            setups[count] = model_in(
                waves if count else {}, free_body(hull, position=(0, 0, z)),
                integrator='implicitfast', timestep=0.002,
            )  # fmt: skip
        best = dict.fromkeys(COUNTS, np.inf)
        for _ in range(rounds):
            for count, (model, data) in setups.items():
                mujoco.mj_resetData(model, data)
                if z == 0 and count:
                    data.qpos[2] = elevation(model, data, np.zeros(1))[0]
                start = time.perf_counter()
                mujoco.mj_step(model, data, BLOCK)
                best[count] = min(best[count], (time.perf_counter() - start) / BLOCK * 1e6)
        result[place] = {
            'microseconds': best,
            'ratio_to_still_water': {count: value / best[0] for count, value in best.items()},
            'nanoseconds_per_component': (best[256] - best[1]) / 255 * 1e3,
        }
    return result
