# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Falling plates: the model of Andersen, Pesavento and Wang (2005) as MJCF, and as problems."""

import numpy as np
from scipy.integrate import solve_ivp

from fluid_sim_ros.lab.problems.closed_forms import G, keyframe, level_states, scene_of
from fluid_sim_ros.lab.problems.mjcf import body_plugin, text, world
from fluid_sim_ros.lab.problems.problem import TIMESTEPS, Problem, Rung
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.falling_plate import PlateParams, falling_plate_rhs

A, BETA, FLUID = 0.05, 0.02, 1000.0  # half width [m], b/a [-], [kg/m^3]
SPAN = np.pi * A / 2  # of the plate; then the ellipsoid (a, a, b) has its area 2 a SPAN
START = (0.0, 0.0, 0.3, 0.01, -0.01, 0.01)  # x, y, angle, velocity and spin: the general case


def speed_scale(inertia: float, beta: float = BETA) -> float:
    """
    Return U = sqrt((rho_s/rho_f - 1) g b) [m/s] for I* = rho_s b/(rho_f a).

    Parameters
    ----------
    inertia
        I* = rho_s b/(rho_f a) [-].
    beta
        b/a, thickness over width [-].

    Returns
    -------
    float
        U [m/s].

    """
    return float(np.sqrt((inertia / beta - 1) * G * beta * A))


def coefficients(inertia: float, beta: float) -> tuple[float, ...]:
    """
    Return blunt, slender, angular, Kutta and Magnus coefficient of the ellipsoid (a, a, b).

    Its volume is 4/3 pi a^2 b where the plate has pi a b SPAN, its swept inertia 8 pi/15 a^5; the
    two equal long axes keep the slender coefficient out of the angular drag.

    Parameters
    ----------
    inertia
        I* [-].
    beta
        b/a [-].

    Returns
    -------
    tuple
        Five numbers [-].

    """
    p = PlateParams(inertia)
    volume_ratio = np.pi * A * SPAN / (4 / 3 * np.pi * A * A)
    return (
        (p.a_drag + p.b_drag) / 2,  # 2 a SPAN rho C v^2 = rho a SPAN (A + B) v^2
        (p.a_drag - p.b_drag) / 2,
        p.mu_quadratic * 15 / 8 * SPAN / A,  # pi rho a^4 SPAN mu2 |w| w
        p.c_translation,
        2 * p.c_rotation / (np.pi * beta) * volume_ratio,  # 2/beta for the plate's volume
    )


def start_state(inertia: float, beta: float = BETA) -> tuple[Array, Array]:
    """
    Return START in the joints' coordinates.

    Parameters
    ----------
    inertia
        I* [-].
    beta
        b/a [-].

    Returns
    -------
    qpos, qvel
        x, z [m] and angle [rad]; their rates [m/s], [rad/s]; shape (3,) each.

    """
    x, y, angle, vx, vy, spin = START
    scale, cosine, sine = speed_scale(inertia, beta), np.cos(angle), np.sin(angle)
    qvel = scale * np.array([vx * cosine - vy * sine, vx * sine + vy * cosine, spin / A])
    return np.array([x * A, y * A, angle]), qvel


def plate_mjcf(inertia: float, *, plugin: bool, beta: float = BETA, timestep: float = 1e-3) -> str:
    """
    Return the plate with joints x, z and a hinge about y (its span).

    Per unit span the model has the units pi rho a^2 (mass), pi rho a^4 (inertia), a U (circulation
    over pi) and so on: added mass 1 across the plate, none along it, added inertia 1/8.

    Parameters
    ----------
    inertia
        I* [-].
    plugin
        With the forces of ``fluid_sim.body``, or stock MuJoCo's.
    beta
        b/a [-].
    timestep
        [s].

    Returns
    -------
    str
        The whole model.

    """
    scale = speed_scale(inertia, beta)
    mass = np.pi * FLUID * inertia * A**2 * SPAN
    heave, pitch = np.pi * FLUID * A**2 * SPAN, np.pi / 8 * FLUID * A**4 * SPAN
    if plugin:
        coef = f'fluidcoef="{text(coefficients(inertia, beta))}"'
        gravity, fluid = G, body_plugin(
            added_mass=[0, 0, heave, 0, pitch, 0],
            volume=np.pi * A * (beta * A) * SPAN,
            drag='ellipsoid',
            drag_area='true',
            rotational_damping=np.pi * A**3 * SPAN * PlateParams(inertia).mu_linear * scale,
        )  # fmt: skip
    else:
        # stock has no buoyancy: the same net weight
        coef, fluid, gravity = '', '', G * (1 - beta / inertia)
    own = mass * A**2 / 4
    body = (
        '<body name="plate" simple="false"><joint type="slide" axis="1 0 0"/>'
        '<joint type="slide" axis="0 0 1"/><joint axis="0 -1 0"/>'
        f'<inertial pos="0 0 0" mass="{mass:.17g}" '
        f'diaginertia="{own * 1.05:.17g} {own:.17g} {own * 1.05:.17g}"/>'
        f'<geom type="ellipsoid" size="{A} {A} {beta * A}" fluidshape="ellipsoid" {coef} '
        f'contype="0" conaffinity="0"/>{fluid}</body>'
    )
    return world(
        body, gravity=(0, 0, -gravity), timestep=timestep,
        medium={'density': FLUID} if plugin else None,
        option='' if plugin else f'density="{FLUID}"',
        extra=keyframe(*start_state(inertia, beta)),
    )  # fmt: skip


def plate_states(inertia: float, times: Array) -> Array:
    """
    Return the paper's motion.

    Parameters
    ----------
    inertia
        I* [-].
    times
        Rising from 0 [s], shape (n,).

    Returns
    -------
    Array
        States, shape (n, 1, 13).

    """
    scale = speed_scale(inertia)
    solution = solve_ivp(
        falling_plate_rhs, (0, times[-1] * scale / A), START, method='DOP853',
        t_eval=times * scale / A, rtol=1e-10, atol=1e-12, args=(PlateParams(inertia),),
    )  # fmt: skip
    x, y, angle, vx, vy, spin = solution.y
    states = level_states(len(times))
    states[:, 0, 0], states[:, 0, 2] = x * A, y * A
    states[:, 0, 3], states[:, 0, 5] = np.cos(angle / 2), -np.sin(angle / 2)
    states[:, 0, 7], states[:, 0, 9] = vx * scale, vy * scale
    states[:, 0, 11] = -spin * scale / A
    return states


def _problem(
    name: str, title: str, inertia: float, duration: float, finest: float = 5e-5
) -> Problem:
    stock = plate_mjcf(inertia, plugin=False)
    boxes = stock.replace('fluidshape="ellipsoid"', '')
    models = {
        'none': boxes.replace(f'density="{FLUID}"', ''),
        'inertia': boxes,
        'ellipsoid': stock,
        '+ added inertia': plate_mjcf(inertia, plugin=True),
    }
    return Problem(
        name=name, title=title,
        stands_for='falling cards of Andersen, Pesavento and Wang (2005), J. Fluid Mech. 541:91, '
        f'I* = {inertia}; their quasi-steady equations',
        duration=duration, reference_kind='ODE (DOP853)', sample=0.02,
        timesteps=tuple(h for h in TIMESTEPS if finest <= h <= 0.02),
        reference=lambda times: plate_states(inertia, times),
        rungs={rung: Rung(scene_of(name, mjcf, 'plate')) for rung, mjcf in models.items()},
    )  # fmt: skip


def plate_flutter() -> Problem:
    """Return a plate that swings from side to side as it falls."""
    return _problem('plate_flutter', 'Falling plate flutters', 1.1, 4.0)


def plate_tumble() -> Problem:
    """Return a plate that turns over and over."""
    return _problem('plate_tumble', 'Falling plate tumbles', 1.4, 4.0)


def plate_chaos() -> Problem:
    """Return a plate that never repeats itself."""
    return _problem('plate_chaos', 'Falling plate without a regular motion', 2.2, 40.0, 5e-4)
