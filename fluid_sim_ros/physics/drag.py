# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Drag of the ellipsoid model: blunt, slender, angular, Stokes resistance and its history."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import (
    Array,
    Wrench,
    column,
    norm,
    not_negative,
    positive_vectors,
    vectors,
)
from fluid_sim_ros.physics.inertia_box import sphere_resistance
from fluid_sim_ros.physics.projection import (
    max_projected_area,
    projected_area,
    projected_area_mujoco,
)

Area = Literal['lemma', 'true']


def drag_area(axes: ArrayLike, v_rel_b: Array, area: Area) -> Array:
    """
    Return the projected area that the drag uses.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    v_rel_b
        Velocity relative to the medium, ellipsoid axes, shape (..., 3); only its direction counts.
    area
        ``lemma``: the engine's area; ``true``: the true projected area.

    Returns
    -------
    [m^2], shape (...).

    Raises
    ------
    ConfigError
        For any other ``area``.

    """
    match area:
        case 'lemma':
            return projected_area_mujoco(axes, v_rel_b)
        case 'true':
            return projected_area(axes, v_rel_b)
    raise ConfigError(f"area: '{area}'; allowed: 'lemma', 'true'")


def blunt_slender_drag(
    axes: ArrayLike,
    v_rel_b: ArrayLike,
    *,
    density: ArrayLike,
    c_blunt: ArrayLike,
    c_slender: ArrayLike,
    area: Area = 'lemma',
) -> Array:
    """
    Return the translational drag of an ellipsoid.

    f = -rho (C_blunt A + C_slender (A_max - A)) |v| v; MuJoCo, "Viscous drag", with
    A_max = pi r_max r_mid as the engine has it. There is no factor 1/2, so a textbook drag
    coefficient equals 2 C. Dissipates for non-negative coefficients (A <= A_max), odd in v.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    v_rel_b
        Velocity relative to the medium at the centre [m/s], ellipsoid axes, shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).
    c_blunt, c_slender
        Coefficients [-], shape (...); MuJoCo's defaults are 0.5 and 0.25.
    area
        ``lemma``: the engine's area; ``true``: the true projected area.

    Returns
    -------
    Force [N], ellipsoid axes, shape (..., 3).

    """
    v = vectors(v_rel_b, 'v_rel_b')
    rho = not_negative(density, 'density [kg/m^3]')
    shadow = drag_area(axes, v, area)
    # Never negative but by rounding, which the maximum takes off so that drag never pushes.
    rest = np.maximum(max_projected_area(axes) - shadow, 0.0)
    reference = np.asarray(c_blunt) * shadow + np.asarray(c_slender) * rest
    return -column(rho * reference) * norm(v) * v


def swept_inertia(axes: ArrayLike) -> Array:
    """
    Return I_D,i = 8 pi/15 r_i max(r_j, r_k)^4.

    Moment of inertia, per unit density, of the ellipsoid swept by a turn about axis i. MuJoCo,
    "Viscous drag".

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).

    Returns
    -------
    About each axis [m^5], shape (..., 3).

    """
    r = positive_vectors(axes, 'semi-axes [m]')
    widest = np.maximum(np.roll(r, -1, axis=-1), np.roll(r, -2, axis=-1))
    moment: Array = 8.0 * np.pi / 15.0 * r * widest**4
    return moment


def angular_moment(axes: ArrayLike, c_angular: ArrayLike, c_slender: ArrayLike) -> Array:
    """
    Return C_angular I_D + C_slender (I_max - I_D), the moment that the angular drag takes.

    MuJoCo, "Viscous drag". The second part is 0 about the axis that sweeps most and large
    about the long axis of a slender body.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    c_angular, c_slender
        Coefficients [-], shape (...); MuJoCo's defaults are 1.5 and 0.25.

    Returns
    -------
    About each axis [m^5], shape (..., 3).

    """
    swept = swept_inertia(axes)
    # The largest entry is 8 pi/15 r_mid r_max^4, the engine's I_max.
    largest = swept.max(axis=-1, keepdims=True)
    moment: Array = column(c_angular) * swept + column(c_slender) * (largest - swept)
    return moment


def angular_drag(
    axes: ArrayLike,
    omega_b: ArrayLike,
    *,
    density: ArrayLike,
    c_angular: ArrayLike,
    c_slender: ArrayLike,
) -> Array:
    """
    Return the quadratic drag torque of an ellipsoid, as the engine has it.

    g = -rho |mom o w| w with mom = C_angular I_D + C_slender (I_max - I_D), o the element-wise
    product. Dissipates, odd in w. C_slender can dominate: I_max / I_D is large on slender bodies.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    omega_b
        Angular velocity [rad/s], ellipsoid axes, shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).
    c_angular, c_slender
        Coefficients [-], shape (...); MuJoCo's defaults are 1.5 and 0.25.

    Returns
    -------
    Torque [N m], ellipsoid axes, shape (..., 3).

    """
    omega = vectors(omega_b, 'omega_b')
    rho = column(not_negative(density, 'density [kg/m^3]'))
    return -rho * norm(angular_moment(axes, c_angular, c_slender) * omega) * omega


def viscous_resistance(
    axes: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike, viscosity: ArrayLike
) -> Wrench:
    """
    Return the Stokes resistance of the sphere equivalent to an ellipsoid.

    r_D = (r_x + r_y + r_z)/3, then as `sphere_resistance`; MuJoCo, "Viscous drag". Exact for a
    sphere at Re << 1. Dissipates, linear in the velocities.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    v_rel_b, omega_b
        Velocity relative to the medium [m/s] and angular velocity [rad/s], ellipsoid axes,
        shape (..., 3).
    viscosity
        Dynamic, of the medium [Pa s], shape (...).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the centre, ellipsoid axes, shape (..., 3) each.

    """
    r = positive_vectors(axes, 'semi-axes [m]')
    return sphere_resistance(r.mean(axis=-1), v_rel_b, omega_b, viscosity)


#: Exponent c and factor c2 of the kernels of the history force: Mei and Adrian (1992), J. Fluid
#: Mech. 237:323; Dorgan and Loth (2007), Int. J. Multiphase Flow 33:833 (from memory).
HISTORY_KERNELS = {'mei_adrian': (2.0, 0.105), 'dorgan_loth': (2.5, 0.2)}


def history_kernel(lag: ArrayLike, reynolds: ArrayLike, kernel: str = 'dorgan_loth') -> Array:
    """
    Return K of the history force F = -6 pi mu r int K(t - s) dv/ds ds on a sphere.

    Basset (1888): K = x^(-1/2), for Re much below 1. At finite Re (Mei and Adrian 1992)
    K = [x^(1/2c) + (b x)^(2/c)]^(-c), b^2 = (Re/2)^3/(2 pi f^3), f = 0.75 + c2 Re: it dies out as
    x^(-2), for the wake is carried away. Re is that of the present speed.

    Parameters
    ----------
    lag
        x = (t - s)/T > 0 [-], T = r^2/(pi nu), shape (...).
    reynolds
        Re = 2 r |v|/nu [-], shape (...).
    kernel
        ``basset``, or a key of ``HISTORY_KERNELS``.

    Returns
    -------
    [-], shape (...).

    """
    x = np.asarray(lag, dtype=np.float64)
    if kernel == 'basset':
        basset: Array = x**-0.5 * np.ones_like(np.asarray(reynolds, dtype=np.float64))
        return basset
    if kernel not in HISTORY_KERNELS:
        raise ConfigError(
            f"history kernel '{kernel}'; allowed: basset, {', '.join(HISTORY_KERNELS)}"
        )
    c, c2 = HISTORY_KERNELS[kernel]
    re = np.asarray(reynolds, dtype=np.float64)
    b = np.sqrt((re / 2) ** 3 / (2 * np.pi * (0.75 + c2 * re) ** 3))
    found: Array = (x ** (0.5 / c) + (b * x) ** (2 / c)) ** -c
    return found
