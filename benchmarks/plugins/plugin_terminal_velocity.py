# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Terminal velocity of spheres over Re .1 to 1e5: own formula and the standard drag curve.

One heavy sphere sinks in ever thinner fluids, syrup to water, from rest until its speed stands
still. Its weight under water is W = (rho_b - rho_f) V g. Three speeds belong to it:

* measured: ``fluid_sim.body`` with drag by Reynolds number, added mass and buoyancy;
* own formula: W = Cd(Re) rho/2 v^2 pi r^2 with Cd of Brown and Lawler (2003), solved in numpy;
* standard: the same with the table of Clift, Grace and Weber (1978), log-log interpolated.

Stock MuJoCo (constant coefficients; its weight taken off by gravcomp, for it has no buoyancy)
sinks beside it.
Run: ``python -m benchmarks.plugins.plugin_terminal_velocity [--quick] [--json PATH]``.
"""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import mujoco
import numpy as np
from scipy.optimize import brentq

from benchmarks.common import RESULTS, ROOT, arguments, write
from fluid_sim_ros.physics.reynolds import sphere_cd_brown_lawler
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, world

WATER, SOLID, G, RADIUS = 1000.0, 2000.0, 9.81, 0.05  # [kg/m^3] twice, [m/s^2], [m]
VOLUME = 4 / 3 * np.pi * RADIUS**3  # [m^3]
WEIGHT = (SOLID - WATER) * VOLUME * G  # under water [N]
STOCK_COEFFICIENTS = (0.5, 0.25, 1.5, 1.0, 1.0)  # MuJoCo's defaults: Cd = 1 + 24/Re
STANDARD_DRAG = ROOT / 'test/physics/data/sphere_cd_standard.csv'
INTEGRATORS = ('RK4', 'implicitfast')
OWN_BOUND, STANDARD_BOUND = 1e-4, 0.04  # [-]


class Fall(NamedTuple):
    """A fluid and what must come out in it."""

    viscosity: float  # [Pa s]
    own: float  # speed by our formula [m/s]
    standard: float  # speed by the standard curve [m/s]


def standard_curve(path: Path = STANDARD_DRAG) -> Callable[[float], float]:
    """Return Cd(Re) of the standard table, linear in the logarithms."""
    with path.open(encoding='utf-8') as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith(('#', 'Re'))]
    log_re, log_cd = np.log(np.array(rows, dtype=float)).T
    return lambda reynolds: float(np.exp(np.interp(np.log(reynolds), log_re, log_cd)))


def terminal_speed(drag_coefficient: Callable[[float], float], viscosity: float) -> float:
    """Return the speed at which a drag curve carries the weight [m/s]."""

    def excess(log_reynolds: float) -> float:
        reynolds = np.exp(log_reynolds)
        speed = reynolds * viscosity / (WATER * 2 * RADIUS)
        drag = drag_coefficient(reynolds) * WATER / 2 * speed**2 * np.pi * RADIUS**2
        return float(np.log(drag / WEIGHT))

    root = float(np.exp(brentq(excess, np.log(0.02), np.log(3e5), xtol=1e-13)))
    return root * viscosity / (WATER * 2 * RADIUS)


def fall_at(reynolds: float) -> Fall:
    """Return the fluid in which the sphere settles at this Reynolds number by our formula."""
    drag = float(sphere_cd_brown_lawler(reynolds))
    speed = np.sqrt(2 * WEIGHT / (drag * WATER * np.pi * RADIUS**2))
    viscosity = WATER * speed * 2 * RADIUS / reynolds
    own = terminal_speed(lambda re: float(sphere_cd_brown_lawler(re)), viscosity)
    return Fall(viscosity, own, terminal_speed(standard_curve(), viscosity))


def settled_speed(model: mujoco.MjModel, data: mujoco.MjData, steps: int) -> float:
    """Return the speed of sinking after ``steps`` [m/s]; refuse one that still changes."""
    mujoco.mj_step(model, data, steps)
    before = float(data.qvel[2])
    mujoco.mj_step(model, data, steps // 10)
    if abs(data.qvel[2] / before - 1) > 1e-9:
        raise RuntimeError(f'speed still changes: {before} to {data.qvel[2]} m/s')
    return -float(data.qvel[2])


def plugin_speed(fall: Fall, integrator: str) -> float:
    """Return the terminal speed with fluid_sim.body [m/s]."""
    plugin = body_plugin(
        added_mass='auto', volume='auto', drag='ellipsoid', drag_reynolds='brown_lawler'
    )
    # from rest it takes about (m + m_A) v / W to gain speed: 40 of these, 20 steps each
    response = (SOLID + WATER / 2) * VOLUME * fall.own / WEIGHT
    model, data = load(
        world(
            free_body(ellipsoid([RADIUS] * 3, SOLID) + plugin), gravity=(0, 0, -G),
            timestep=response / 20, integrator=integrator,
            medium={'density': WATER, 'viscosity': fall.viscosity},
        )
    )  # fmt: skip
    return settled_speed(model, data, 800)


def stock_speed(fall: Fall) -> float:
    """Return the terminal speed of stock MuJoCo's ellipsoid model [m/s]."""
    body = free_body(ellipsoid([RADIUS] * 3, SOLID, STOCK_COEFFICIENTS)).replace(
        '<body ', f'<body gravcomp="{WATER / SOLID}" '
    )
    response = SOLID * VOLUME * fall.own / WEIGHT
    model, data = load(
        world(
            body, gravity=(0, 0, -G), timestep=response / 20, integrator='implicitfast',
            option=f'density="{WATER}" viscosity="{fall.viscosity:.17g}"',
        )
    )  # fmt: skip
    return settled_speed(model, data, 1600)


def measure(numbers: Array) -> dict[str, Any]:
    """Return speeds and relative errors for each Reynolds number."""
    falls = [fall_at(reynolds) for reynolds in numbers]
    own = np.array([fall.own for fall in falls])
    standard = np.array([fall.standard for fall in falls])
    result: dict[str, Any] = {
        'reynolds': list(map(float, numbers)),
        'viscosity_Pa_s': [fall.viscosity for fall in falls],
        'speed_standard_m_s': list(map(float, standard)),
    }
    for integrator in INTEGRATORS:
        speed = np.array([plugin_speed(fall, integrator) for fall in falls])
        result[integrator] = {
            'speed_m_s': list(map(float, speed)),
            'error_own_max': float(np.abs(speed / own - 1).max()),
            'error_standard': list(map(float, speed / standard - 1)),
            'error_standard_max': float(np.abs(speed / standard - 1).max()),
        }
    stock = np.array([stock_speed(fall) for fall in falls])
    result['stock'] = {
        'speed_m_s': list(map(float, stock)),
        'error_standard': list(map(float, stock / standard - 1)),
        'error_standard_max': float(np.abs(stock / standard - 1).max()),
    }
    return result


def draw(result: dict[str, Any]) -> None:
    """Draw drag coefficient and error of speed over the Reynolds number."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), layout='constrained')
    viscosity = np.array(result['viscosity_Pa_s'])
    grid = np.geomspace(0.07, 1.4e5, 300)
    curve = standard_curve()
    left.loglog(grid, [curve(re) for re in grid], 'k', label='standard curve')
    for name, label, mark in (('RK4', 'fluid_sim', 'C0o'), ('stock', 'stock MuJoCo', 'C3x')):
        speed = np.array(result[name]['speed_m_s'])
        drag = 2 * WEIGHT / (WATER * speed**2 * np.pi * RADIUS**2)
        left.loglog(WATER * speed * 2 * RADIUS / viscosity, drag, mark, ms=4, label=label)
        right.semilogx(
            result['reynolds'], 100 * np.array(result[name]['error_standard']), mark + '-', ms=4
        )
    left.set(xlabel='Re', ylabel='$C_d$', title='Drag coefficient at terminal velocity')
    left.legend()
    right.axhspan(-100 * STANDARD_BOUND, 100 * STANDARD_BOUND, alpha=0.15, label='bound, 4 %')
    right.set(xlabel='Re', ylabel='[%]', title='Terminal velocity against the standard curve')
    right.legend()
    for axis in (left, right):
        axis.grid(alpha=0.3)
    figure.savefig(RESULTS / 'plugin_terminal_velocity.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__, 'plugin_terminal_velocity')
    result = measure(np.geomspace(0.1, 1e5, 13 if options.quick else 61))
    for name in INTEGRATORS:
        own, standard = (result[name][f'error_{key}_max'] for key in ('own', 'standard'))
        print(f'{name:12} own formula {own:.1e} (bound {OWN_BOUND}), '
              f'standard {standard:.2%} (bound {STANDARD_BOUND:.0%})')  # fmt: skip
    print(f'stock        standard {result["stock"]["error_standard_max"]:.0%}')
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
