# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Lift of the ellipsoid model: Magnus force of a spin, Kutta force of an angle of attack."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Array, column, not_negative, unit_or_zero, vectors
from fluid_sim_ros.physics.kappa import ellipsoid_volume
from fluid_sim_ros.physics.projection import projected_area_mujoco, section_normal


def magnus_force(
    axes: ArrayLike,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike,
    *,
    density: ArrayLike,
    c_magnus: ArrayLike,
) -> Array:
    """
    Return the Magnus force on a spinning ellipsoid.

    f = C_M rho V w x v; MuJoCo, "Magnus force". Does no work on the translation (f . v = 0);
    odd in v and odd in w.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    v_rel_b, omega_b
        Velocity relative to the medium [m/s] and angular velocity [rad/s], ellipsoid axes,
        shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).
    c_magnus
        Coefficient [-], shape (...); MuJoCo's default is 1.

    Returns
    -------
    Force [N], ellipsoid axes, shape (..., 3).

    """
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    rho = not_negative(density, 'density [kg/m^3]')
    return column(np.asarray(c_magnus) * rho * ellipsoid_volume(axes)) * np.cross(omega, v)


def kutta_force(
    axes: ArrayLike, v_rel_b: ArrayLike, *, density: ArrayLike, c_kutta: ArrayLike
) -> Array:
    """
    Return the lift of the circulation that the Kutta condition makes.

    f = C_K rho A (v^ . n^)(n^ x v) x v with A the lemma's area and n^ the section's normal;
    MuJoCo, "Kutta condition". Zero for a sphere and for flow along an axis; normal to v, so it
    does no work; odd in v. For a thin plate C_L = C_K sin(2 alpha) on the half-area of MuJoCo's
    definition; no stall. It needs the lemma's area: the true one would add a second sine.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    v_rel_b
        Velocity relative to the medium [m/s], ellipsoid axes, shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).
    c_kutta
        Coefficient [-], shape (...); MuJoCo's default is 1.

    Returns
    -------
    Force [N], ellipsoid axes, shape (..., 3).

    """
    v = vectors(v_rel_b, 'v_rel_b')
    normal = section_normal(axes, v)
    cosine = np.sum(unit_or_zero(v) * normal, axis=-1)
    rho = not_negative(density, 'density [kg/m^3]')
    factor = column(np.asarray(c_kutta) * rho * projected_area_mujoco(axes, v) * cosine)
    return factor * np.cross(np.cross(normal, v), v)
