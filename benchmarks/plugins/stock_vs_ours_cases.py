# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The cases of plugin_stock_vs_ours: each a fact, in stock MuJoCo and with fluid_sim."""

from typing import Any, NamedTuple

import mujoco
import numpy as np
from scipy.optimize import brentq

from benchmarks.plugins import plugin_falling_plate as falling_plate
from benchmarks.plugins import plugin_kirchhoff as kirchhoff
from benchmarks.plugins import plugin_terminal_velocity as terminal
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from fluid_sim_ros.physics.kirchhoff import rigid_body_matrix
from fluid_sim_ros.physics.projection import projected_area
from test.support.oscillations import oscillation, period
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    free_body,
    load,
    set_medium,
    world,
)

WATER, G = 1000.0, 9.81  # [kg/m^3], [m/s^2]
HULL = np.array([0.5, 0.2, 0.1])  # semi-axes [m]
STOCK = f'density="{WATER}"'
DEFAULTS = (0.5, 0.25, 1.5, 1.0, 1.0)  # MuJoCo's fluidcoef
FREE = {'added_mass': 'auto', 'drag': 'none'}


class Row(NamedTuple):
    """One fact; ``stock`` None where stock MuJoCo has nothing to compare."""

    case: str
    unit: str
    exact: float
    stock: float | None
    ours: float
    scale: float = 1.0  # what an error is counted in where ``exact`` is 0

    def error(self, value: float) -> float:
        """Return the error of a value, relative to the reference."""
        return abs(value - self.exact) / (abs(self.exact) or self.scale)


def pair(
    geom: str, *, gravity: float = 0.0, gravcomp: float = 0.0, **values: Any
) -> list[tuple[mujoco.MjModel, mujoco.MjData]]:
    """Return the same free body in stock MuJoCo and with fluid_sim, in water, RK4 at 10 ms."""
    bodies = (
        free_body(geom).replace('<body ', f'<body gravcomp="{gravcomp}" '),
        free_body(geom + body_plugin(**values)),
    )
    fluids = ({'option': STOCK}, {'medium': {'density': WATER}})
    return [
        load(world(body, gravity=(0, 0, -gravity), **fluid))
        for body, fluid in zip(bodies, fluids, strict=True)
    ]


def neutral_ellipsoid() -> Row:
    """Return the position error after 5 s against Kirchhoff's equations (DOP853, 1e-12)."""
    start = np.array([1.0, 0.5, 0.3, 1.0, 2.0, 1.5])  # [m/s], [rad/s]
    mass = WATER * float(ellipsoid_volume(HULL))
    inertia = mass / 5 * ((HULL**2).sum() - HULL**2)
    added = np.concatenate(ellipsoid_added_mass(HULL, WATER))
    matrix = rigid_body_matrix(mass, inertia, np.zeros(3)) + np.diag(added)
    case = kirchhoff.Case('', matrix, np.zeros(3), start)
    exact = kirchhoff.reference(case, 5.0)[:3]
    errors = []
    for model, data in pair(ellipsoid(HULL, WATER), **FREE):
        data.qvel[:] = start
        mujoco.mj_step(model, data, 500)
        errors.append(float(np.linalg.norm(data.qpos[:3] - exact)))
    return Row('Neutral ellipsoid .5/.2/.1 m coasting, off after 5 s', 'm', 0.0, *errors)


def released_sphere() -> Row:
    """Return the acceleration of a sphere of half the density of water, released at rest."""
    values = []
    lift = WATER / 500  # without it stock falls, -9.81 m/s^2
    for model, data in pair(
        ellipsoid([0.1] * 3, 500), gravity=G, gravcomp=lift, volume='auto', **FREE
    ):
        mujoco.mj_forward(model, data)
        values.append(float(data.qacc[2]))
    exact = (WATER - 500) * G / (500 + WATER / 2)
    case = 'Sphere of density 500 released in water (stock: gravcomp 2): acceleration'
    return Row(case, 'm/s^2', exact, *values)


def pendulum() -> Row:
    """Return the period of an aluminium ball on a rod; stock with gravcomp for the buoyancy."""
    radius, density, length, start = 0.05, 2700.0, 0.6, 0.02
    mass, displaced = (float(rho * 4 / 3 * np.pi * radius**3) for rho in (density, WATER))
    exact = 2 * np.pi * np.sqrt(
        ((mass + displaced / 2) * length**2 + 0.4 * mass * radius**2)
        / ((mass - displaced) * G * length)
    ) * (1 + start**2 / 16)  # fmt: skip
    geom = ellipsoid([radius] * 3, density)
    periods = []
    for inside, attribute, fluid in (
        (geom, f'gravcomp="{displaced / mass}"', {'option': STOCK}),
        (geom + body_plugin(volume='auto', **FREE), '', {'medium': {'density': WATER}}),
    ):
        body = (
            f'<body name="bob" pos="0 0 {-length}" {attribute}>'
            f'<joint axis="0 1 0" pos="0 0 {length}"/>{inside}</body>'
        )
        model, data = load(world(body, gravity=(0, 0, -G), timestep=0.002, **fluid))
        data.qpos[0] = start
        times, angle = oscillation(model, data, lambda d=data: d.qpos[0], 20.0)
        periods.append(period(times, angle))
    case = 'Aluminium ball on a .6 m rod in water (stock: gravcomp .37): period'
    return Row(case, 's', float(exact), *periods)


def munk_growth() -> Row:
    """Return the growth rate of yaw of a 5:1 hull that runs along its axis at 1 m/s."""
    axes = np.array([0.5, 0.1, 0.1])
    (m_x, _, m_z), (_, i_a, _) = ellipsoid_added_mass(axes, WATER)
    mass = WATER * float(ellipsoid_volume(axes))
    inertia = mass / 5 * (axes[0] ** 2 + axes[2] ** 2)
    exact = float(np.sqrt((m_z - m_x) * (mass + m_x) / ((mass + m_z) * (inertia + i_a))))
    rates = []
    for model, data in pair(ellipsoid(axes, WATER), **FREE):
        data.qvel[:] = [1, 0, 0, 0, 1e-9, 0]
        mujoco.mj_step(model, data, 300)  # the decaying part is gone
        before, steps = float(data.qvel[4]), 100
        mujoco.mj_step(model, data, steps)
        rates.append(float(np.log(data.qvel[4] / before) / (steps * model.opt.timestep)))
    return Row('5:1 hull at 1 m/s: growth rate of the Munk instability', '1/s', exact, *rates)


def spinning_sphere() -> Row:
    """
    Return the side force over rho V w x v of a spinning sphere with C_M = 1.

    The sphere's momentum with its fluid changes by the Magnus force alone, so that
    (m + rho V/2) a = C_M rho V w x v.
    """
    volume = float(ellipsoid_volume([0.1] * 3))
    geom, mass = ellipsoid([0.1] * 3, 500, (0, 0, 0, 0, 1)), 500 * volume
    values = []
    for (model, data), total in zip(
        pair(geom, added_mass='auto', drag='ellipsoid'), (mass, mass + WATER * volume / 2),
        strict=True,
    ):  # fmt: skip
        data.qvel[:] = [1, 0, 0, 0, 0, 1]
        mujoco.mj_forward(model, data)
        values.append(float(total * data.qacc[1] / (WATER * volume)))
    case = 'Spinning sphere with Magnus coefficient 1: coefficient that acts'
    return Row(case, '', 1.0, *values)


def thin_disc_area() -> Row:
    """Return the drag area of a 1:1:.01 disc 1 degree off edge-on, over the true shadow."""
    axes, speed = np.array([0.1, 0.1, 0.001]), 2.0
    direction = np.array([np.cos(np.radians(1)), 0, np.sin(np.radians(1))])
    true = float(projected_area(axes, direction))
    geom = ellipsoid(axes, 1000, (1, 0, 0, 0, 0))
    areas = []
    for model, data in pair(geom, drag='ellipsoid', drag_area='true'):
        data.qvel[:3] = speed * direction
        mujoco.mj_forward(model, data)
        drag = data.qfrc_passive[:3] @ direction  # no spin, so no convective force beside it
        areas.append(float(-drag / (WATER * speed**2) / true))
    return Row('Disc 1:1:.01 at 1 degree to the flow: drag area / shadow', '', 1.0, *areas)


def thin_disc_added_mass() -> Row:
    """
    Return the added mass of a 1:1:.001 disc across its plane, over rho V.

    Oblate spheroid, e^2 = 1 - c^2/a^2: alpha = 2/e^2 (1 - sqrt(1 - e^2)/e asin e), and the ratio
    is alpha/(2 - alpha); Lamb (1932), art. 114 and 373.
    """
    axes = np.array([0.5, 0.5, 0.0005])
    e = np.sqrt(1 - (axes[2] / axes[0]) ** 2)
    alpha = 2 / e**2 * (1 - np.sqrt(1 - e**2) / e * np.arcsin(e))
    displaced = WATER * float(ellipsoid_volume(axes))
    stock, ours = pair(ellipsoid(axes, 500), **FREE)
    mujoco.mj_forward(*ours)
    heave = np.zeros((6, 6))
    mujoco.mj_fullM(*ours, heave)
    values = (
        WATER * stock[0].geom_fluid[0, 8] / displaced,
        (heave[2, 2] - ours[0].body_mass[1]) / displaced,
    )
    exact = float(alpha / (2 - alpha))
    return Row('Disc 1:1:.001: added mass across it / (rho V)', '', exact, *map(float, values))


def accelerating_current() -> Row:
    """Return the speed of a neutral sphere after 1 s in a current that gains .4 m/s^2."""
    geom = ellipsoid([0.2] * 3, WATER, DEFAULTS)
    stock, _ = pair(geom, **FREE)
    model, data = load(
        world(
            free_body(geom + body_plugin(added_mass='auto', volume='auto', drag='ellipsoid')),
            medium={'density': WATER, 'current_slew': 0.4},
        )
    )
    set_medium(model, data, current=[5, 0, 0])
    mujoco.mj_step(model, data, 100)
    for _ in range(100):
        stock[0].opt.wind[0] = 0.4 * stock[1].time
        mujoco.mj_step(*stock)
    case = 'Neutral sphere in a current that gains .4 m/s^2: speed after 1 s'
    return Row(case, 'm/s', 0.4, float(stock[1].qvel[0]), float(data.qvel[0]))


def floating_sphere() -> Row:
    """Return the depth at which a sphere of density 400 floats, below its centre."""
    radius = 0.15
    # V_wet = pi/3 (r + z)^2 (2 r - z), z the height of the surface above the centre
    exact = brentq(
        lambda z: (radius + z) ** 2 * (2 * radius - z) / 4 / radius**3 - 0.4, -radius, radius,
        xtol=1e-14,
    )  # fmt: skip
    damping = np.array([9, 9, 9, 0.1, 0.1, 0.1]) * 10
    inside = ellipsoid([radius] * 3, 400)
    inside += body_plugin(volume='auto', linear_damping=damping, **FREE)
    model, data = load(
        world(
            free_body(inside), gravity=(0, 0, -G), timestep=0.005,
            medium={'density': WATER, 'surface': 0},
        )
    )  # fmt: skip
    mujoco.mj_step(model, data, 6000)
    case = 'Floating sphere of density 400, r .15 m: surface above its centre'
    return Row(case, 'm', float(exact), None, float(-data.qpos[2]))


def spheres(points: int) -> list[Row]:
    """Return the worst drag coefficient and terminal velocity of spheres over Re .1 to 1e5."""
    result = terminal.measure(np.geomspace(0.1, 1e5, points))
    curve, viscosity = terminal.standard_curve(), np.array(result['viscosity_Pa_s'])
    drag, speed = [], []
    for name in ('stock', 'RK4'):
        velocity = np.array(result[name]['speed_m_s'])
        reynolds = WATER * velocity * 2 * terminal.RADIUS / viscosity
        measured = 2 * terminal.WEIGHT / (WATER * velocity**2 * np.pi * terminal.RADIUS**2)
        ratio = measured / np.array([curve(re) for re in reynolds])
        drag.append(float(ratio[np.argmax(np.abs(np.log(ratio)))]))
        ratio = velocity / np.array(result['speed_standard_m_s'])
        speed.append(float(ratio[np.argmax(np.abs(ratio - 1))]))
    return [
        Row('Sphere, Re .1 to 1e5: worst Cd / standard curve', '', 1.0, *drag),
        Row('Sphere, Re .1 to 1e5: worst terminal velocity / standard', '', 1.0, *speed),
    ]


def tumbling_plate() -> Row:
    """Return the net turns of a plate at I* = 1.4 in the second half of its fall."""
    theory, stock, ours = (
        falling_plate.turns(falling_plate.MODELS[name](1.4))
        for name in ('theory', 'stock', 'plugin')
    )
    return Row('Plate of I* = 1.4 (it tumbles): turns in 100 a/U', '', theory, stock, ours)


def measure(points: int) -> list[Row]:
    """Return all rows."""
    return [
        neutral_ellipsoid(), released_sphere(), accelerating_current(), pendulum(),
        munk_growth(), spinning_sphere(), floating_sphere(), *spheres(points),
        thin_disc_area(), thin_disc_added_mass(), tumbling_plate(),
    ]  # fmt: skip
