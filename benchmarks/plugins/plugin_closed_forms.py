"""
The plugins against closed forms: pushed and released bodies, pendulum, Munk, floats, entry.

Each group returns relative errors with the bound that they are held to. Run:
``python -m benchmarks.plugins.plugin_closed_forms [--quick] [--json PATH]``.
"""

from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from scipy.optimize import brentq

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, text, world

WATER, G = 1000.0, 9.81


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


def period(times: Array, values: Array) -> float:
    """Return the mean period from the zero crossings of a decaying or steady oscillation."""
    rising = np.flatnonzero((values[:-1] < 0) & (values[1:] >= 0))
    share = values[rising] / (values[rising] - values[rising + 1])
    crossings = times[rising] + share * (times[1] - times[0])
    return float(np.mean(np.diff(crossings)))


def oscillation(
    model: mujoco.MjModel, data: mujoco.MjData, read: Any, duration: float
) -> tuple[Array, Array]:
    """Return times and ``read()`` at every step."""
    steps = round(duration / model.opt.timestep)
    values = np.zeros(steps)
    for i in range(steps):
        values[i] = read()
        mujoco.mj_step(model, data)
    return np.arange(steps) * model.opt.timestep, values


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


def settled_depth(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    """Return the height at which weight and buoyancy cancel (upright)."""

    def net(height: float) -> float:
        data.qpos[2] = height
        mujoco.mj_forward(model, data)
        return float(data.qfrc_passive[2] - data.qfrc_bias[2])

    return float(brentq(net, -0.3, 0.3, xtol=1e-13))


def float_cases() -> dict[str, tuple[str, float, float, float]]:
    """
    Return name -> (body, depth of the origin, heave stiffness, roll stiffness about x).

    Depth is the height of the origin at rest. Roll stiffness: rho g V_wet (BM - (z_G - z_B)), with
    BM the second moment of the waterplane over V_wet; for the sphere m g times the distance from
    its centre down to the centre of mass.
    """
    cases = {}
    radius, low = 0.15, 0.04
    volume = 4 / 3 * np.pi * radius**3
    mass = 0.4 * WATER * volume

    def wet(depth: float) -> float:
        return np.pi * (radius**2 * (radius + depth) - (depth**3 + radius**3) / 3)

    sunk = brentq(lambda d: wet(d) - mass / WATER, -radius, radius, xtol=1e-14)
    area = np.pi * (radius**2 - sunk**2)
    inside = (
        f'<inertial pos="0 0 {-low}" mass="{mass:.17g}" diaginertia=".02 .03 .04"/>'
        f'<geom type="sphere" size="{radius}"/>'
    )
    cases['sphere'] = (inside, -sunk, WATER * G * area, mass * G * low)

    half = np.array([0.3, 0.2, 0.1])
    draft = 0.12
    mass = WATER * 4 * half[0] * half[1] * draft
    inside = (
        f'<inertial pos="0 0 0" mass="{mass:.17g}" diaginertia=".9 1.2 1.5"/>'
        f'<geom type="box" size="{text(half)}"/>'
    )
    second = 2 * half[0] * (2 * half[1]) ** 3 / 12
    cases['box'] = (
        inside,
        half[2] - draft,
        WATER * G * 4 * half[0] * half[1],
        WATER * G * second - mass * G * (half[2] - draft / 2),
    )

    axes = np.array([0.35, 0.25, 0.15])
    whole = ellipsoid_volume(axes)
    mass = 0.6 * WATER * float(whole)
    share = brentq(lambda p: 2 / 3 + p - p**3 / 3 - 0.6 * 4 / 3, -1, 1, xtol=1e-14)
    sunk = share * axes[2]
    area = np.pi * axes[0] * axes[1] * (1 - share**2)
    second = np.pi / 4 * axes[0] * axes[1] ** 3 * (1 - share**2) ** 2
    center = -3 * (1 - share**2) ** 2 / (4 * (2 + 3 * share - share**3)) * axes[2]
    inside = (
        f'<inertial pos="0 0 0" mass="{mass:.17g}" diaginertia=".3 .5 .7"/>'
        f'<geom type="ellipsoid" size="{text(axes)}"/>'
    )
    cases['ellipsoid'] = (
        inside,
        -sunk,
        WATER * G * area,
        WATER * G * second + mass * G * center,
    )
    return cases


def floats() -> dict[str, float]:
    """
    Return errors of depth [of 0.1 m], heave and roll frequency of three floats.

    Each without and with a stated added mass about the centre of mass, of which the wetted share
    takes part: omega^2 = stiffness / (m + s A). The slamming force is of second order here.
    """
    errors = {}
    for name, (inside, height, heave, roll) in float_cases().items():
        for added in (0.0, 1.0):
            label = f'float_{name}' + ('_added_mass' if added else '')
            model, data = float_model(inside, added)
            mass, center = model.body_mass[1], model.body_ipos[1]
            share = mass / (WATER * volume_of(inside))
            about_x = model.body_inertia[1, np.argmax(np.abs(_axes(model)[0]))]
            errors[f'{label}_depth'] = abs(settled_depth(model, data) - height) / 0.1

            mujoco.mj_resetData(model, data)
            data.qpos[2] = height + 1e-5
            times, values = oscillation(model, data, lambda d=data, h=height: d.qpos[2] - h, 10.0)
            expected = 2 * np.pi * np.sqrt((mass + share * added * HEAVE_ADDED) / heave)
            errors[f'{label}_heave'] = abs(period(times, values) / expected - 1)

            mujoco.mj_resetData(model, data)
            angle = 1e-4
            data.qpos[:] = [0, 0, height, np.cos(angle / 2), np.sin(angle / 2), 0, 0]
            # turn about the centre of mass, so that heave and sway stay at rest
            data.qpos[1] += center[2] * np.sin(angle)
            data.qpos[2] += center[2] * (1 - np.cos(angle))
            times, values = oscillation(model, data, lambda d=data: d.qpos[4], 20.0)
            expected = 2 * np.pi * np.sqrt((about_x + share * added * ROLL_ADDED) / roll)
            errors[f'{label}_roll'] = abs(period(times, values) / expected - 1)
    return errors


HEAVE_ADDED, ROLL_ADDED = 9.0, 0.4  # [kg], [kg m^2], stated


def float_model(inside: str, added: float) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a float in still water, with the stated added mass times ``added``."""
    values: dict[str, Any] = {'volume': 'auto'}
    if added:
        center = inside.split('pos="')[1].split('"')[0]
        diagonal = added * np.array([5, 6, HEAVE_ADDED, ROLL_ADDED, 0.3, 0.2])
        values |= {'added_mass': diagonal, 'reference_point': center}
    return load(
        world(
            free_body(inside + body_plugin(**values)),
            gravity=(0, 0, -G),
            timestep=0.002,
            medium={'density': WATER, 'surface': 0},
        )
    )


def volume_of(inside: str) -> float:
    """Return the whole volume of the float's geom [m^3]."""
    size = np.array(inside.split('size="')[1].split('"')[0].split(), dtype=float)
    if 'box' in inside:
        return float(8 * size.prod())
    return float(ellipsoid_volume(size if size.size == 3 else np.full(3, size[0])))


def _axes(model: mujoco.MjModel) -> Array:
    """Return the inertial frame's axes in body axes (rows: body x, y, z)."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, model.body_iquat[1])
    return matrix.reshape(3, 3)


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
