# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Vehicle damping in Fossen's form, and its secant matrix for semi-implicit stepping.

Fossen (2021), Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed., ch. 6 and 8.
nu = (v_rel, omega), body axes; D is positive for damping (D = -X_u of ship theory).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.added_mass import added_mass_coriolis
from fluid_sim_ros.physics.arrays import Array, vectors
from fluid_sim_ros.physics.matrix6 import matrix6


class CrossTerm(NamedTuple):
    """One term f_row -= coef |nu_abs| nu_lin; rows and velocities count x y z p q r from 0."""

    row: int
    abs_index: int
    lin_index: int
    coef: float


def linear_damping_matrix(values: ArrayLike, name: str = 'linear_damping') -> Array:
    """
    Return D_lin from 6 or 36 numbers.

    Parameters
    ----------
    values
        The diagonal, or all numbers row by row: [N s/m], [N s], [N m s].
    name
        What the value is called in an error.

    Returns
    -------
    About the reference point, body axes, shape (6, 6).

    Raises
    ------
    ConfigError
        If the symmetric part is not positive semi-definite: the body would gain energy.

    """
    matrix = _square(values, name)
    lowest = float(np.linalg.eigvalsh(0.5 * (matrix + matrix.T))[0])
    if lowest < -1e-9 * np.abs(matrix).max():
        raise ConfigError(f'{name}: lowest eigenvalue {lowest:.6g}; allowed: >= 0')
    return matrix


def quadratic_damping_matrix(values: ArrayLike, name: str = 'quadratic_damping') -> Array:
    """
    Return D_q from 6 or 36 numbers; entry (i, j) multiplies |nu_j| nu_j.

    Parameters
    ----------
    values
        The diagonal, or all numbers row by row: [N s^2/m^2], [N s^2/m], [N s^2], [N m s^2].
    name
        What the value is called in an error.

    Returns
    -------
    About the reference point, body axes, shape (6, 6).

    Raises
    ------
    ConfigError
        If a diagonal entry is negative. Off the diagonal any sign is allowed (published sets have
        both); whether such a set dissipates at all velocities is for its author to know.

    """
    matrix = _square(values, name)
    if np.any(np.diag(matrix) < 0):
        raise ConfigError(f'{name}: diagonal {np.diag(matrix).tolist()}; allowed: >= 0')
    return matrix


def _square(values: ArrayLike, name: str) -> Array:
    count = np.asarray(values).size
    if count not in (6, 36):
        raise ConfigError(f'{name}: {count} numbers; allowed: 6 or 36')
    return matrix6(values, name)


def damping_wrench(d_linear: ArrayLike, d_quadratic: ArrayLike, nu: ArrayLike) -> Array:
    """
    Return -D_lin nu - D_q (|nu| o nu), o element-wise.

    Odd in nu; dissipates when D_lin is positive semi-definite and D_q diagonal.

    Parameters
    ----------
    d_linear, d_quadratic
        Shape (..., 6, 6).
    nu
        Velocity relative to the medium and angular velocity, body axes, shape (..., 6).

    Returns
    -------
    Force [N] and torque [N m] about the reference point, shape (..., 6).

    """
    nu = vectors(nu, 'nu', 6)
    linear = np.asarray(d_linear, dtype=np.float64) @ nu[..., np.newaxis]
    quadratic = np.asarray(d_quadratic, dtype=np.float64) @ (np.abs(nu) * nu)[..., np.newaxis]
    return -(linear + quadratic)[..., 0]


def faded_moments(d_linear: ArrayLike, fade: ArrayLike, nu: ArrayLike) -> Array:
    """
    Return D_lin with the moments of roll and pitch by surge and sway times 1/(1 + V/v_f).

    Rotors in oblique flow: such a moment grows slower than the speed. The form is fitted to
    flights (doc/vehicles/crazyflie_37g.md), with the right limits: linear in a slow flow, constant
    in a fast one.

    Parameters
    ----------
    d_linear
        Shape (6, 6).
    fade
        v_f of roll and of pitch [m/s], shape (2,); 0: it does not fade.
    nu
        Velocity relative to the medium [m/s] and angular velocity [rad/s], body axes, shape (6,).

    Returns
    -------
    Shape (6, 6).

    """
    matrix = np.array(d_linear, dtype=np.float64)
    nu = vectors(nu, 'nu', 6)
    across = float(np.hypot(nu[0], nu[1]))
    for row, speed in zip((3, 4), np.asarray(fade, dtype=np.float64), strict=True):
        if speed > 0:
            matrix[row, :2] /= 1.0 + across / speed
    return matrix


def cross_damping_wrench(terms: Sequence[CrossTerm], nu: ArrayLike) -> Array:
    """
    Return the sum of -coef |nu_a| nu_b into each row, for terms such as Y_|v|r or N_|v|r.

    Odd in nu. Not dissipative in general: fitted coefficients.

    Parameters
    ----------
    terms
        The terms; coefficients in SI units, of the sign of a resistance.
    nu
        Velocity relative to the medium [m/s] and angular velocity [rad/s], body axes,
        shape (..., 6).

    Returns
    -------
    Force [N] and torque [N m] about the reference point, body axes, shape (..., 6).

    """
    nu = vectors(nu, 'nu', 6)
    wrench = np.zeros_like(nu)
    for term in terms:
        product = np.abs(nu[..., term.abs_index]) * nu[..., term.lin_index]
        wrench[..., term.row] -= term.coef * product
    return wrench


def without_convection(terms: Sequence[CrossTerm], matrix: ArrayLike) -> list[CrossTerm]:
    """
    Return cross terms less what an added mass gives of them.

    Published sets state totals, such as M_uw with the Munk moment A_33 - A_11 in it. With these
    terms and `added_mass_coriolis` of the same A the totals come out once, while nu_abs > 0
    (backwards the part of the added mass changes sign, that of lift and drag does not).

    Parameters
    ----------
    terms
        Totals, each with two different velocities; a pair of them once in a row.
    matrix
        A about the reference point, body axes, shape (6, 6).

    Returns
    -------
    The terms that are left, in the same order.

    """
    rest = []
    for term in terms:
        first, second = np.eye(6)[term.abs_index], np.eye(6)[term.lin_index]
        # of second degree: f(x + y) - f(x) - f(y) leaves the mixed product
        both, one, other = (
            np.concatenate(added_mass_coriolis(matrix, nu[:3], nu[3:]))[term.row]
            for nu in (first + second, first, second)
        )
        rest.append(term._replace(coef=term.coef + both - one - other))
    return rest


def secant_damping(d_linear: ArrayLike, d_quadratic: ArrayLike, nu: ArrayLike) -> Array:
    """
    Return D_s, the symmetric positive semi-definite part of D_lin + D_q diag(|nu|).

    M + h D_s as effective mass makes a first-order step of damping unconditionally stable, and
    exact in form for pure quadratic drag (v' = v/(1 + h D |v|/m)). The symmetric part keeps the
    power, nu . D_s nu >= nu . D nu; negative eigenvalues are set to 0 (never less damping).

    Parameters
    ----------
    d_linear, d_quadratic
        About the reference point, body axes, shape (..., 6, 6).
    nu
        Velocity relative to the medium [m/s] and angular velocity [rad/s], body axes,
        shape (..., 6).

    Returns
    -------
    D_s: [N s/m], [N s], [N m s], shape (..., 6, 6).

    """
    nu = vectors(nu, 'nu', 6)
    scaled = np.asarray(d_quadratic, dtype=np.float64) * np.abs(nu)[..., np.newaxis, :]
    matrix = np.asarray(d_linear, dtype=np.float64) + scaled
    values, basis = np.linalg.eigh(0.5 * (matrix + np.swapaxes(matrix, -1, -2)))
    kept = np.maximum(values, 0.0)
    secant: Array = (basis * kept[..., np.newaxis, :]) @ np.swapaxes(basis, -1, -2)
    return secant
