# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The amphibious quadrotor against SciPy: hover and level flight, sinking and rising, water entry.

The equations are written down once more from the numbers of doc/vehicles/amphibious.md; nothing
here reads the model. Draws doc/img/amphibious_validation.png.
Run: ``python -m benchmarks.vehicles.amphibious [--quick] [--json PATH]``.
"""

from dataclasses import replace
from typing import Any

import matplotlib as mpl
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.common import ROOT, arguments, write
from fluid_sim_ros import Scene, Simulation
from test.support import vehicle_runs as runs
from test.support.plugin_models import Array
from test.support.vehicle_equations import Equations, G, Rotors

NAME = 'amphibious'
WATER, AIR = 1000.0, 1.204  # [kg/m^3]
THIN = 1.81e-5 / 9e-4  # viscosity of air over that of water, by which linear damping goes
MASS, VOLUME, WIDTH = 2.8, 0.00295, 0.13  # [kg], [m^3], semi-axis of the hull [m]
HEIGHT = VOLUME / (4 / 3 * np.pi * WIDTH**2)  # other semi-axis of the hull [m]
LINEAR = np.array([0.5, 0.5, 2, 0.02, 0.02, 0.02])  # in water
QUADRATIC = np.array([18.5, 18.5, 37.5, 0.15, 0.15, 0.08])
INERTIA = np.array([0.0317, 0.0317, 0.062])
PLACES = 0.174 * np.array([[1, -1], [-1, 1], [1, 1], [-1, -1]])
SPIN = np.array([1.0, 1, -1, -1])
TILTS_DEG = (2.5, 5.0, 10.0, 15.0, 20.0)
ENTRY_STEPS = (0.001, 0.0005, 0.00025)  # [s]; the first is the model's
SCREWS = (-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0)  # [N] each, up


def _rotors(height: float, spin: Array, **values: Any) -> Rotors:
    places = np.c_[PLACES, np.full(4, height + 0.02)]  # from the centre of mass
    return Rotors(position=places, axis=np.tile([0.0, 0, 1], (4, 1)), spin=spin, **values)


def _in(density: float, thin: float, rotors: Rotors) -> Equations:
    share = density / WATER
    return Equations(
        mass=MASS, inertia=INERTIA, rotors=rotors, linear=thin * LINEAR,
        quadratic=share * QUADRATIC, buoyancy=density * VOLUME * G,
        center_of_buoyancy=np.array([0, 0, 0.02]), origin=np.array([0, 0, 0.02]),
    )  # fmt: skip


_K_SCREW = 0.3 * WATER * 0.06**4 / (2 * np.pi) ** 2
IN_AIR = _in(AIR, THIN, _rotors(
    0.08, SPIN, k=(8.54858e-6, 8.54858e-6), tau=(0.0125, 0.025), torque_ratio=0.016,
    drag=(8.06428e-5, 0),
))  # fmt: skip
IN_WATER = _in(WATER, 1.0, _rotors(
    -0.06, -SPIN, k=(_K_SCREW, _K_SCREW), tau=(0.029, 0.029), torque_ratio=0.007,
))  # fmt: skip


def heave_added_mass() -> float:
    """
    Return the added mass of the hull along its short axis in water [kg].

    Lamb (1932), art. 114, oblate spheroid of eccentricity e: rho V g/(2 - g) with
    g = 2/e^2 (1 - sqrt(1 - e^2) asin(e)/e).
    """
    e = np.sqrt(1 - (HEIGHT / WIDTH) ** 2)
    g = 2 / e**2 * (1 - np.sqrt(1 - e**2) * np.arcsin(e) / e)
    return float(WATER * VOLUME * g / (2 - g))


def wet_share(height: float) -> tuple[float, float]:
    """Return the share of the hull under water at a height [m], and its slope [1/m]."""
    p = float(np.clip(-height / HEIGHT, -1, 1))
    return (1 + p) ** 2 * (2 - p) / 4, -3 * (1 - p * p) / (4 * HEIGHT)


def entry(times: Array, height: float) -> Array:
    """Return height [m] and vertical velocity [m/s] of a drop at rest, shape (n, 2)."""
    added = heave_added_mass()

    def rates(_: float, y: Array) -> Array:
        z, v = y
        share, slope = wet_share(z)
        density = share + (1 - share) * AIR / WATER  # over that of water
        force = (WATER * density * VOLUME - MASS) * G
        linear = LINEAR[2] * (share + (1 - share) * THIN)
        force -= (linear + density * QUADRATIC[2] * abs(v)) * v
        if slope * v > 0:  # going in: the water takes momentum
            force -= added * (1 - AIR / WATER) * slope * v * v
        return np.array([v, force / (MASS + density * added)])

    return solve_ivp(
        rates, (0, times[-1]), (height, 0.0), t_eval=times, rtol=1e-9, atol=1e-11, max_step=1e-3
    ).y.T  # fmt: skip


def dropped(height: float, seconds: float, timestep: float = 0.001) -> tuple[Array, Array]:
    """Return times [s], and height [m] and velocity [m/s] of the model dropped at rest."""
    simulation = Simulation(replace(Scene.load(NAME), schedule=()), timestep=timestep)
    simulation.set_thrust(NAME, [0.0] * 8)
    simulation.data.qpos[2] = height
    simulation.data.act[:] = 0  # rotors at rest from the start
    rows = np.empty((round(seconds / simulation.timestep), 2))
    for row in rows:
        simulation.step()
        row[:] = simulation.data.qpos[2], simulation.data.qvel[2]
    return simulation.timestep * (1 + np.arange(len(rows))), rows


def level_flight(tilt_deg: float) -> tuple[float, float, float]:
    """Return thrust per rotor [N], and the speed [m/s] of the model and of SciPy, at a tilt."""
    tilt = float(np.deg2rad(tilt_deg))
    thrust, solved = IN_AIR.level_flight(tilt)
    command = np.r_[np.full(4, thrust), np.zeros(4)]
    return thrust, float(runs.tilted(NAME, tilt, command, 90.0, 0.8 * solved)[-1, 0]), solved


def vertical_speed(screw: float) -> tuple[float, float]:
    """Return the speed [m/s] under water with all screws at a thrust [N]: model, SciPy."""
    simulation = runs.start(NAME, -100, thrust=np.r_[np.zeros(4), np.full(4, screw)])
    velocity = runs.held(simulation, np.array([1.0, 0, 0, 0]), 20.0)
    return float(velocity[-1, 2]), float(IN_WATER.top_velocity(np.full(4, screw))[2])


def floating_height() -> tuple[float, float]:
    """Return the height [m] at which the model floats, and where the wet hull weighs as much."""
    from scipy.optimize import brentq

    def unbalanced(height: float) -> float:
        share = wet_share(height)[0]
        return VOLUME * (WATER * share + AIR * (1 - share)) - MASS

    simulation = runs.start(NAME, -0.03, thrust=0.0)
    simulation.data.act[:] = 0
    simulation.step(round(40 / simulation.timestep))
    return float(simulation.data.qpos[2]), float(brentq(unbalanced, -HEIGHT, HEIGHT))


def demonstration() -> tuple[Array, Array]:
    """Return times [s] and heights [m] of the scene as it is."""
    simulation = Simulation(NAME)
    count, every = round(simulation.scene.duration / 0.05), round(0.05 / simulation.timestep)
    heights = np.empty(count)
    for i in range(count):
        heights[i] = simulation.data.qpos[2]
        simulation.step(every)
    return 0.05 * np.arange(count), heights


def draw(result: dict[str, Any], drop: tuple[Array, Array, Array]) -> None:
    """Draw level flight, vertical speed, entry, and the scene; dots the model, lines SciPy."""
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(10, 7), layout='constrained')
    for axis, rows, x, label in (
        (axes[0, 0], result['level_flight'], 'tilt_deg', 'tilt in air [deg]'),
        (axes[0, 1], result['vertical_speed'], 'screw', 'thrust of each screw, up [N]'),
    ):
        at = [row[x] for row in rows]
        axis.plot(at, [row['solved'] for row in rows], lw=1.2, label='SciPy')
        axis.plot(at, [row['measured'] for row in rows], 'o', label='simulation')
        axis.set(xlabel=label)
    axes[0, 0].set(ylabel='speed [m/s]', title='level flight')
    axes[0, 1].set(ylabel='speed upward [m/s]', title='under water, held level')
    times, measured, solved = drop
    for column, label in ((0, 'height [m]'), (1, 'velocity [m/s]')):
        line = axes[1, 0].plot(times, solved[:, column], lw=1.2, label=f'{label}, SciPy')[0]
        axes[1, 0].plot(times[::60], measured[::60, column], '.', color=line.get_color(),
                        label='simulation')  # fmt: skip
    axes[1, 0].axhline(0, color='0.7', lw=0.8)
    axes[1, 0].set(xlabel='t [s]', title='dropped from 1.5 m, rotors off')
    axes[1, 1].plot(*demonstration(), lw=1.2)
    axes[1, 1].axhline(0, color='tab:cyan', lw=0.8)
    axes[1, 1].set(xlabel='t [s]', ylabel='height above the water [m]', title='the scene')
    for axis in axes.flat[:3]:
        axis.legend(fontsize=8)
    figure.savefig(ROOT / 'doc' / 'img' / f'{NAME}_validation.png', dpi=80)
    plt.close(figure)


def main() -> None:
    """Measure, print, write JSON and the picture."""
    options = arguments(__doc__ or '', NAME)
    mpl.use('Agg')
    level, vertical = [], []
    for tilt in TILTS_DEG[1:3] if options.quick else TILTS_DEG:
        _, measured, solved = level_flight(tilt)
        level.append({'tilt_deg': tilt, 'measured': measured, 'solved': solved,
                      'error': measured / solved - 1})  # fmt: skip
    for screw in SCREWS[::3] if options.quick else SCREWS:
        measured, solved = vertical_speed(screw)
        vertical.append({'screw': screw, 'measured': measured, 'solved': solved,
                         'error': measured / solved - 1})  # fmt: skip
    falls = []
    for timestep in ENTRY_STEPS:
        times, fallen = dropped(1.5, 2.0, timestep)
        expected = entry(times, 1.5)
        gap = np.abs(fallen - expected).max(axis=0) / np.abs(expected).max(axis=0)
        falls.append((times, fallen, expected, timestep, *map(float, gap)))
    floats, balance = floating_height()
    result: dict[str, Any] = {
        'hover_thrust': IN_AIR.level_flight(0.0)[0], 'level_flight': level,
        'vertical_speed': vertical,
        'entry': [
            {'timestep': timestep, 'error_height': height, 'error_velocity': velocity,
             'deepest_measured': float(fallen[:, 0].min()),
             'deepest_solved': float(expected[:, 0].min())}
            for _, fallen, expected, timestep, height, velocity in falls
        ],
        'floating_height': {'measured': floats, 'solved': balance},
    }  # fmt: skip
    for what in ('level_flight', 'vertical_speed'):
        print(f'{what}: worst {max(abs(row["error"]) for row in result[what]):.1e}')
    for *_, timestep, height, velocity in falls:
        print(
            f'entry at {timestep} s: height {height:.1e}, velocity {velocity:.1e} of the largest'
        )
    print(f'floats at {floats * 1e3:.2f} mm, balance {balance * 1e3:.2f} mm')
    if not options.quick:
        draw(result, falls[0][:3])
    write(options.json, result)


if __name__ == '__main__':
    main()
