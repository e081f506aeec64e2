# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Formulas as MuJoCo's chapter "Fluid forces" prints them, where the engine computes something else.

Tests and benchmarks compare them with the engine and with ``fluid_sim_ros.physics``, which follows
the engine; doc/physics.md says by how much they differ.
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import (
    Array,
    Wrench,
    column,
    norm,
    not_negative,
    positive_vectors,
    vectors,
)
from fluid_sim_ros.physics.drag import angular_moment
from fluid_sim_ros.physics.kappa import ellipsoid_volume, kappa
from fluid_sim_ros.physics.projection import projected_area_mujoco, section_normal


def max_projected_area_as_printed(axes: ArrayLike) -> Array:
    """
    Return 4 pi r_max r_min [m^2], shape (...): what the chapter calls A_max.

    Not a projected area (a sphere has pi r^2); the engine uses `max_projected_area`.
    """
    r = positive_vectors(axes, 'semi-axes [m]')
    area: Array = 4.0 * np.pi * r.max(axis=-1) * r.min(axis=-1)
    return area


def blunt_slender_drag_as_printed(
    axes: ArrayLike,
    v_rel_b: ArrayLike,
    *,
    density: ArrayLike,
    c_blunt: ArrayLike,
    c_slender: ArrayLike,
) -> Array:
    """
    Return the drag with A_max = 4 pi r_max r_min.

    Differs from the engine whenever 4 r_min != r_mid; can push a thin plate along its motion
    (A_max < A). Arguments as in `physics.drag.blunt_slender_drag`.
    """
    v = vectors(v_rel_b, 'v_rel_b')
    shadow = projected_area_mujoco(axes, v)
    reference = np.asarray(c_blunt) * shadow + np.asarray(c_slender) * (
        max_projected_area_as_printed(axes) - shadow
    )
    return -column(not_negative(density, 'density [kg/m^3]') * reference) * norm(v) * v


def angular_drag_as_printed(
    axes: ArrayLike,
    omega_b: ArrayLike,
    *,
    density: ArrayLike,
    c_angular: ArrayLike,
    c_slender: ArrayLike,
) -> Array:
    """
    Return the torque -rho w (mom . w).

    Even in w, so it feeds energy wherever mom . w < 0: half of all directions. Arguments as
    in `physics.drag.angular_drag`.
    """
    omega = vectors(omega_b, 'omega_b')
    moment = angular_moment(axes, c_angular, c_slender)
    rho = column(not_negative(density, 'density [kg/m^3]'))
    torque: Array = -rho * np.sum(moment * omega, axis=-1, keepdims=True) * omega
    return torque


def added_mass_coriolis_as_printed(
    mass_a_b: ArrayLike, inertia_a_b: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike
) -> Wrench:
    """
    Return the velocity part with the general form, torque + w x dT/dw.

    The last term has the wrong sign against the compact form, the engine and Euler's equations;
    still workless, so energy does not show it: the angular impulse does.
    """
    m_a, i_a = vectors(mass_a_b, 'mass_a_b'), vectors(inertia_a_b, 'inertia_a_b')
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    momentum = m_a * v
    return np.cross(momentum, omega), np.cross(momentum, v) + np.cross(omega, i_a * omega)


def added_inertia_as_printed(axes: ArrayLike, density: ArrayLike) -> Array:
    """
    Return the added moments of inertia by the quotient of the chapter.

    The same number as `ellipsoid_added_mass` where no two axes are close, wrong by cancellation
    where they are; equal axes are set to 0 as the limit demands.
    """
    r = positive_vectors(axes, 'semi-axes [m]')
    displaced = column(not_negative(density, 'density [kg/m^3]') * ellipsoid_volume(r))
    k = kappa(r)
    j2, k2 = np.roll(r, -1, axis=-1) ** 2, np.roll(r, -2, axis=-1) ** 2
    k_j, k_k = np.roll(k, -1, axis=-1), np.roll(k, -2, axis=-1)
    upper = (j2 - k2) ** 2 * (k_k - k_j)
    lower = 2.0 * (j2 - k2) + (j2 + k2) * (k_j - k_k)
    quotient: Array = displaced / 5.0 * upper / np.where(lower == 0, 1.0, lower)
    return quotient


def kutta_force_as_printed(
    axes: ArrayLike, v_rel_b: ArrayLike, *, density: ArrayLike, c_kutta: ArrayLike
) -> Array:
    """
    Return the lift in its first form, C_K rho A / |v| (v x v_par) x v.

    v_par = v - (v . n^) n^ is the part of the velocity in the section's plane. Equal to
    `physics.lift.kutta_force` by algebra.
    """
    v = vectors(v_rel_b, 'v_rel_b')
    normal = section_normal(axes, v)
    along = v - np.sum(v * normal, axis=-1, keepdims=True) * normal
    speed = norm(v)
    rho = not_negative(density, 'density [kg/m^3]')
    factor = column(np.asarray(c_kutta) * rho * projected_area_mujoco(axes, v))
    return factor / np.where(speed > 0, speed, 1.0) * np.cross(np.cross(v, along), v)
