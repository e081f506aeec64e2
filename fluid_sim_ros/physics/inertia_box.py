# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The inertia model: drag and Stokes resistance of a body's equivalent inertia box.

MuJoCo documentation, chapter "Fluid forces", section "Inertia model". The shape of the body is
that of the homogeneous box with the same mass and principal moments of inertia.
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import (
    Array,
    Wrench,
    column,
    not_negative,
    positive,
    positive_vectors,
    vectors,
)


def equivalent_inertia_box(mass: ArrayLike, inertia: ArrayLike) -> Array:
    """
    Return the half-lengths of the box with the given mass and principal moments of inertia.

    r_x = sqrt(3/(2 m) (I_yy + I_zz - I_xx)) and cyclic; MuJoCo, "Inertia model".

    Parameters
    ----------
    mass
        [kg], shape (...).
    inertia
        Principal moments of inertia about the centre of mass [kg m^2], shape (..., 3).

    Returns
    -------
    Half-lengths along the principal axes [m], shape (..., 3).

    Raises
    ------
    ConfigError
        If the moments break the triangle inequality, so that no body has them.

    """
    mass = positive(mass, 'mass [kg]')
    inertia = positive_vectors(inertia, 'inertia [kg m^2]')
    opposite = inertia.sum(axis=-1, keepdims=True) - 2 * inertia
    if np.any(opposite < 0):
        raise ConfigError(f'inertia: {inertia.tolist()}; allowed: each at most the sum of others')
    box: Array = np.sqrt(1.5 * opposite / column(mass))
    return box


def inertia_box_drag(
    half_b: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike, density: ArrayLike
) -> Wrench:
    """
    Return the quadratic drag on a box.

    f_i = -2 rho r_j r_k |v_i| v_i and g_i = -1/2 rho r_i (r_j^4 + r_k^4) |w_i| w_i; MuJoCo,
    "Inertia model". For high Reynolds numbers. Dissipates; each component is odd in its own
    velocity component and does not see the others.

    Parameters
    ----------
    half_b
        Half-lengths of the box [m], shape (..., 3).
    v_rel_b, omega_b
        Velocity relative to the medium at the centre of mass [m/s] and angular velocity [rad/s],
        along the principal axes, shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).

    Returns
    -------
    force_b, torque_b
        [N] and [N m] about the centre of mass, shape (..., 3) each.

    """
    half = positive_vectors(half_b, 'half-lengths [m]')
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    rho = column(not_negative(density, 'density [kg/m^3]'))
    r_j, r_k = np.roll(half, -1, axis=-1), np.roll(half, -2, axis=-1)
    force = -2.0 * rho * r_j * r_k * np.abs(v) * v
    torque = -0.5 * rho * half * (r_j**4 + r_k**4) * np.abs(omega) * omega
    return force, torque


def sphere_resistance(
    radius: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike, viscosity: ArrayLike
) -> Wrench:
    """
    Return the Stokes resistance of a sphere.

    f = -6 pi beta r v and g = -8 pi beta r^3 w; Stokes (1850), Lamb (1932) art. 337. Exact for a
    sphere at Re << 1. Dissipates, linear (so odd) in the velocities.

    Parameters
    ----------
    radius
        [m], shape (...).
    v_rel_b, omega_b
        Relative velocity [m/s] and angular velocity [rad/s], shape (..., 3).
    viscosity
        Dynamic viscosity beta [Pa s], shape (...). MuJoCo's text calls it kinematic; the unit of
        the formula, and of the engine, is Pa s (air 1.8e-5, water 9e-4 at 25 C).

    """
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    r = column(positive(radius, 'radius [m]'))
    beta = column(not_negative(viscosity, 'viscosity [Pa s]'))
    return -6.0 * np.pi * beta * r * v, -8.0 * np.pi * beta * r**3 * omega


def inertia_box_viscous(
    half_b: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike, viscosity: ArrayLike
) -> Wrench:
    """
    Return the Stokes resistance of the sphere equivalent to a box, r_eq = (r_x + r_y + r_z)/3.

    MuJoCo, "Inertia model". Dissipates, odd in the velocities.

    Parameters
    ----------
    half_b
        Half-lengths of the box [m], shape (..., 3).
    v_rel_b, omega_b
        Velocity of the centre of mass relative to the medium [m/s] and angular velocity [rad/s],
        principal axes, shape (..., 3).
    viscosity
        Dynamic, of the medium [Pa s], shape (...).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the centre of mass, principal axes, shape (..., 3) each.

    """
    half = positive_vectors(half_b, 'half-lengths [m]')
    return sphere_resistance(half.mean(axis=-1), v_rel_b, omega_b, viscosity)


def inertia_box_wrench(
    half_b: ArrayLike,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike,
    *,
    density: ArrayLike,
    viscosity: ArrayLike,
) -> dict[str, Wrench]:
    """
    Return the terms of the inertia model: ``drag`` and ``viscous``.

    MuJoCo, "Inertia model".

    Parameters
    ----------
    half_b
        Half-lengths of the box [m], shape (..., 3).
    v_rel_b, omega_b
        Velocity of the centre of mass relative to the medium [m/s] and angular velocity [rad/s],
        principal axes, shape (..., 3).
    density, viscosity
        Of the medium [kg/m^3] and dynamic [Pa s], shape (...).

    Returns
    -------
    Term -> (force_b [N], torque_b [N m]) about the centre of mass, principal axes, shape (..., 3).

    """
    return {
        'drag': inertia_box_drag(half_b, v_rel_b, omega_b, density),
        'viscous': inertia_box_viscous(half_b, v_rel_b, omega_b, viscosity),
    }
