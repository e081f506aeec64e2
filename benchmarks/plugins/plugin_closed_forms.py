# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The plugins against closed forms: pushed and released bodies, pendulum, Munk, floats, entry.

Each group returns relative errors with the bound that they are held to. Run:
``python -m benchmarks.plugins.plugin_closed_forms [--quick] [--json PATH]``.
"""

from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from benchmarks.plugins.float_closed_forms import WATER, G, floats
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from test.support.oscillations import oscillation, period
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, world


def added_mass_body(axes: Array, density: float, **values: Any) -> str:
    """Return an ellipsoid with exact added mass and no other fluid force than asked for."""
    return free_body(
        ellipsoid(axes, density) + body_plugin(added_mass='auto', drag='none', **values)
    )


def pushed() -> dict[str, float]:
    """Return the largest error of a m / F = 1/(1 + k), and of alpha I / M, on each axis."""
    axes, density = np.array([0.5, 0.2, 0.1]), 700.0
    model, data = load(world(added_mass_body(axes, density), medium={'density': WATER}))
    mass_a, inertia_a = ellipsoid_added_mass(axes, WATER)
    mass = density * ellipsoid_volume(axes)
    inertia = mass / 5 * ((axes**2).sum() - axes**2)
    total = np.r_[mass + mass_a, inertia + inertia_a]
    errors = []
    for i in range(6):
        data.xfrc_applied[1] = 0
        data.xfrc_applied[1, i] = 3.0
        mujoco.mj_forward(model, data)
        errors.append(abs(data.qacc[i] * total[i] / 3.0 - 1))
    return {'pushed_a_m_over_F': max(errors)}


def released() -> dict[str, float]:
    """Return the largest error of (rho_f - rho_b) g / (rho_b + rho_f/2) for released spheres."""
    errors = []
    for density in (20.0, 500.0, 990.0, 2500.0, 7800.0):
        body = added_mass_body(np.full(3, 0.1), density, volume='auto')
        model, data = load(world(body, gravity=(0, 0, -G), medium={'density': WATER}))
        mujoco.mj_forward(model, data)
        expected = (WATER - density) * G / (density + WATER / 2)
        errors.append(abs(data.qacc[2] / expected - 1))
    return {'released_acceleration': max(errors)}


def pendulum() -> dict[str, float]:
    """
    Return the error of the period of a sphere on a rod in water.

    (m L^2 + I + m_A L^2) theta'' = -(m - rho V) g L sin theta; amplitude 0.02 rad, whose finite
    size counts theta0^2/16 = 2.5e-5.
    """
    radius, density, length, start = 0.05, 2700.0, 0.6, 0.02
    volume = 4 / 3 * np.pi * radius**3
    mass = density * volume
    plugin = body_plugin(added_mass='auto', volume='auto', drag='none')
    body = (
        f'<body name="bob" pos="0 0 {-length}"><joint axis="0 1 0" pos="0 0 {length}"/>'
        f'{ellipsoid([radius] * 3, density)}{plugin}</body>'
    )
    model, data = load(world(body, gravity=(0, 0, -G), timestep=0.002, medium={'density': WATER}))
    data.qpos[0] = start
    times, angle = oscillation(model, data, lambda: data.qpos[0], 30.0)
    inertia = (mass + WATER * volume / 2) * length**2 + 0.4 * mass * radius**2
    expected = 2 * np.pi * np.sqrt(inertia / ((mass - WATER * volume) * G * length))
    return {'pendulum_period': abs(period(times, angle) / expected - 1)}


def munk() -> dict[str, float]:
    """
    Return the largest error of the growth rate of a body running along its long axis.

    sigma^2 = (m_z - m_x) (m + m_x) U^2 / ((m + m_z) (I + I_A)), a/b from 1.5 to 10. The start is
    the unstable eigenvector (heave, pitch) of the linearised Kirchhoff equations; the pitch rate
    is read off after one e-folding, at an amplitude of 1e-6.
    """
    worst = 0.0
    for ratio in (1.5, 2.0, 3.0, 5.0, 8.0, 10.0):
        axes = np.array([ratio, 1.0, 1.0]) * 0.1
        mass_a, inertia_a = ellipsoid_added_mass(axes, WATER)
        mass = WATER * ellipsoid_volume(axes)
        inertia = mass / 5 * (axes[0] ** 2 + axes[2] ** 2)
        m_x, m_z, i_y, speed = mass_a[0], mass_a[2], inertia + inertia_a[1], 1.0
        # (m + m_z) w' = (m + m_x) U q ; (I + I_A) q' = (m_z - m_x) U w   (body axes, z up)
        system = speed * np.array([[0, (mass + m_x) / (mass + m_z)], [(m_z - m_x) / i_y, 0]])
        growth = np.sqrt(system[0, 1] * system[1, 0])
        model, data = load(
            world(
                added_mass_body(axes, WATER),
                timestep=0.002 / growth,
                medium={'density': WATER},
            )
        )
        # heave rate w along z, pitch about y: q > 0 turns the nose down, w' = +U q
        vector = np.array([system[0, 1], growth]) / growth * 1e-6
        data.qvel[:] = [speed, 0, vector[0], 0, vector[1], 0]
        steps = 500
        mujoco.mj_step(model, data, steps)
        measured = np.log(data.qvel[4] / vector[1]) / (steps * model.opt.timestep)
        worst = max(worst, abs(measured / growth - 1))
    return {'munk_growth': worst}


def entry() -> dict[str, float]:
    """Return the error of m/(m + A) v0 for a light sphere that enters water, no gravity."""
    radius, mass, worst = 0.1, 1.0, 0.0
    volume = 4 / 3 * np.pi * radius**3
    for speed in (0.5, 3.0, 10.0):
        body = added_mass_body(np.full(3, radius), mass / volume)
        model, data = load(
            world(body, timestep=2e-4 / speed, medium={'density': WATER, 'surface': 0})
        )
        data.qpos[2], data.qvel[2] = 0.15, -speed
        mujoco.mj_step(model, data, round(1.5 / speed / model.opt.timestep))
        expected = -speed * mass / (mass + WATER * volume / 2)
        worst = max(worst, abs(data.qvel[2] / expected - 1))
    return {'entry_speed': worst}


BOUNDS = {
    'pushed_a_m_over_F': 1e-6,
    'released_acceleration': 1e-6,
    'pendulum_period': 1e-4,
    'munk_growth': 1e-3,
    'entry_speed': 1e-3,
    **{f'float_{shape}{added}_{what}': 1e-3
       for shape in ('sphere', 'box', 'ellipsoid') for added in ('', '_added_mass')
       for what in ('depth', 'heave', 'roll')},
}  # fmt: skip


def measure() -> dict[str, Any]:
    """Return every error."""
    errors: dict[str, Any] = {}
    for group in (pushed, released, pendulum, munk, floats, entry):
        errors |= group()
    return errors


def draw(errors: dict[str, Any]) -> None:
    """Draw each error beside its bound."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axis = plt.subplots(figsize=(8, 5), layout='constrained')
    names = list(BOUNDS)
    rows = np.arange(len(names))
    axis.scatter([max(errors[n], 1e-16) for n in names], rows, label='measured', zorder=3)
    axis.scatter([BOUNDS[n] for n in names], rows, marker='|', s=200, color='r', label='bound')
    axis.set_xscale('log')
    axis.set_yticks(rows, [name.replace('_', ' ') for name in names])
    axis.invert_yaxis()
    axis.grid(alpha=0.3)
    axis.set_xlabel('relative error')
    figure.legend(loc='outside upper right', ncols=2)
    figure.savefig(RESULTS / 'plugin_closed_forms.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_closed_forms')
    errors = measure()
    for name, bound in BOUNDS.items():
        mark = 'ok' if errors[name] <= bound else 'MISSED'
        print(f'{name:32} {errors[name]:9.2e}  bound {bound:.0e}  {mark}')
    write(options.json, {'errors': errors, 'bounds': BOUNDS})
    if not options.quick:
        draw(errors)


if __name__ == '__main__':
    main()
