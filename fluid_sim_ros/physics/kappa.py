# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Added mass and added moment of inertia of a triaxial ellipsoid, exactly.

Tuckerman (1925), NACA report 210; Lamb (1932), art. 114-115. The textbook form of the added
moment of inertia is a difference of nearly equal numbers for nearly equal axes, and so is its
denominator for a disc. With

    D_i = r_x r_y r_z int_0^inf dl / ((r_j^2 + l)(r_k^2 + l) Delta),
    E_i = r_x r_y r_z int_0^inf l dl / ((r_j^2 + l)(r_k^2 + l) Delta),
    Delta = sqrt((r_x^2 + l)(r_y^2 + l)(r_z^2 + l)),

partial fractions give kappa_k - kappa_j = (r_j^2 - r_k^2) D_i, and kappa_x + kappa_y + kappa_z = 2
gives 2 - kappa_i = kappa_j + kappa_k and 2 - (r_j^2 + r_k^2) D_i = kappa_i + 2 E_i. Only sums of
positive numbers are left, so sphere, near-sphere and disc are as exact as anything else.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import elliprd

from fluid_sim_ros.physics.arrays import Array, column, not_negative, positive_vectors

# Trapezoidal rule in t = ln(l): the integrand is analytic for |Im t| < pi and decays at both ends,
# so the error falls like exp(-2 pi^2 / h). 256 nodes keep h < 0.4 up to axis ratios of 1e8.
_NODES = 256
_LOG_BELOW = 38.0  # exp(-38) = 3e-17: the part of D below exp(-38) r_min^2 is below rounding
_LOG_ABOVE = 26.0  # E decays like exp(-3 t / 2): exp(-39) is below rounding


def ellipsoid_volume(axes: ArrayLike) -> Array:
    """
    Return V = 4 pi r_x r_y r_z / 3, the volume of an ellipsoid.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).

    Returns
    -------
    [m^3], shape (...).

    """
    volume: Array = 4.0 / 3.0 * np.pi * positive_vectors(axes, 'semi-axes [m]').prod(axis=-1)
    return volume


def kappa(axes: ArrayLike) -> Array:
    """
    Return the shape coefficients kappa of an ellipsoid.

    kappa_i = r_x r_y r_z int_0^inf dl / ((r_i^2 + l) Delta) = 2/3 r_x r_y r_z
    R_D(r_j^2, r_k^2, r_i^2), Carlson's symmetric elliptic integral (DLMF 19.16.5). Sum is 2;
    sphere 2/3 each; unchanged by scaling.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).

    Returns
    -------
    [-], shape (..., 3), each between 0 and 2.

    """
    r = positive_vectors(axes, 'semi-axes [m]')
    r = r / r.max(axis=-1, keepdims=True)
    squares = r * r
    integral = elliprd(np.roll(squares, -1, axis=-1), np.roll(squares, -2, axis=-1), squares)
    value: Array = 2.0 / 3.0 * r.prod(axis=-1, keepdims=True) * integral
    return value


def kappa_divided_difference(axes: ArrayLike) -> tuple[Array, Array]:
    """
    Return D_i = (kappa_k - kappa_j)/(r_j^2 - r_k^2) [1/m^2] and E_i [-], free of cancellation.

    See the head of this file; finite and exact for equal axes (sphere: D = 2/(5 r^2), E = 4/15).

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).

    Returns
    -------
    Shape (..., 3) each.

    """
    r = positive_vectors(axes, 'semi-axes [m]')
    largest = r.max(axis=-1, keepdims=True)
    scaled = r / largest
    squares = scaled * scaled
    log_min = np.log(squares.min(axis=-1, keepdims=True))
    step = (_LOG_BELOW + _LOG_ABOVE - log_min) / (_NODES - 1)
    lam = np.exp(log_min - _LOG_BELOW + step * np.arange(_NODES))  # (..., nodes)
    shifted = squares[..., :, np.newaxis] + lam[..., np.newaxis, :]  # (..., 3, nodes)
    delta = np.sqrt(shifted.prod(axis=-2, keepdims=True))
    pair = np.roll(shifted, -1, axis=-2) * np.roll(shifted, -2, axis=-2)
    weight = (step * lam)[..., np.newaxis, :] / (pair * delta)
    product = scaled.prod(axis=-1, keepdims=True)
    divided = product * weight.sum(axis=-1) / largest**2
    moment = product * (weight * lam[..., np.newaxis, :]).sum(axis=-1)
    return divided, moment


def ellipsoid_added_mass(axes: ArrayLike, density: ArrayLike) -> tuple[Array, Array]:
    """
    Return the added masses and added moments of inertia of an ellipsoid about its centre.

    m_i = rho V kappa_i / (2 - kappa_i);
    I_i = rho V/5 (r_j^2 - r_k^2)^2 (kappa_k - kappa_j)
          / (2 (r_j^2 - r_k^2) + (r_j^2 + r_k^2)(kappa_j - kappa_k)),
    evaluated as rho V/5 (r_j^2 - r_k^2)^2 D_i / (kappa_i + 2 E_i). Tuckerman (1925).
    Inviscid, unbounded fluid. Sphere: m = rho V / 2, I = 0. Symmetric in the two other axes.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).

    Returns
    -------
    mass_a_b, inertia_a_b
        [kg] and [kg m^2] along the axes, shape (..., 3) each.

    """
    r = positive_vectors(axes, 'semi-axes [m]')
    displaced = column(not_negative(density, 'density [kg/m^3]') * ellipsoid_volume(r))
    k = kappa(r)
    r_j, r_k = np.roll(r, -1, axis=-1), np.roll(r, -2, axis=-1)
    k_j, k_k = np.roll(k, -1, axis=-1), np.roll(k, -2, axis=-1)
    divided, moment = kappa_divided_difference(r)
    mass = displaced * k / (k_j + k_k)
    difference = (r_j - r_k) * (r_j + r_k)
    inertia = displaced / 5.0 * difference**2 * divided / (k + 2.0 * moment)
    return mass, inertia
