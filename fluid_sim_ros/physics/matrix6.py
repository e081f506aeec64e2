# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
6x6 matrices of rigid bodies, added mass and damping: reading, checking, other points and axes.

Order of rows and columns: x y z roll pitch yaw. A mass matrix about a point maps (v, omega) of
that point to (p, l) about it.
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, cross_matrix

# FLU <-> FRD: y and z of linear and of angular quantities change sign; its own inverse.
_FLIP = np.array([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])


def matrix6(values: ArrayLike, name: str) -> Array:
    """
    Return a 6x6 matrix from 6, 21 or 36 numbers.

    6: the diagonal; 21: the upper triangle row by row (11 12 13 14 15 16 22 23 ... 66) of a
    symmetric matrix; 36: row by row. Order of rows: x y z roll pitch yaw.

    Parameters
    ----------
    values
        6, 21 or 36 numbers, in any shape.
    name
        What the value is called in an error.

    Returns
    -------
    The matrix, shape (6, 6), in the units of ``values``.

    Raises
    ------
    ConfigError
        If a number is not finite, or there are not 6, 21 or 36 of them.

    """
    flat = np.asarray(values, dtype=np.float64).reshape(-1)
    if not np.all(np.isfinite(flat)):
        raise ConfigError(f'{name}: {flat.tolist()}; allowed: finite numbers')
    if flat.size == 6:
        return np.diag(flat)
    if flat.size == 21:
        upper = np.zeros((6, 6))
        upper[np.triu_indices(6)] = flat
        return upper + np.triu(upper, 1).T
    if flat.size == 36:
        return flat.reshape(6, 6)
    raise ConfigError(f'{name}: {flat.size} numbers; allowed: 6, 21 or 36')


def added_mass_matrix(values: ArrayLike, name: str = 'added_mass') -> Array:
    """
    Return the added-mass matrix A from 6, 21 or 36 numbers (order: `matrix6`), checked.

    Blocks: A_vv [kg], A_vw [kg m], A_ww [kg m^2], all of the sign of a mass.

    Parameters
    ----------
    values
        6, 21 or 36 numbers, body axes, about the reference point.
    name
        What the value is called in an error.

    Returns
    -------
    A, shape (6, 6), exactly symmetric.

    Raises
    ------
    ConfigError
        If A is not symmetric and positive semi-definite to 1e-9 of its largest entry.

    """
    matrix = matrix6(values, name)
    tolerance = 1e-9 * np.abs(matrix).max()
    if np.abs(matrix - matrix.T).max() > tolerance:
        raise ConfigError(f'{name}: not symmetric; allowed: A = A^T')
    matrix = 0.5 * (matrix + matrix.T)
    lowest = float(np.linalg.eigvalsh(matrix)[0])
    if lowest < -tolerance:
        raise ConfigError(f'{name}: lowest eigenvalue {lowest:.6g}; allowed: >= 0')
    return matrix


def shift_reference_point(matrix: ArrayLike, offset_b: ArrayLike) -> Array:
    """
    Return a 6x6 mass (or added-mass) matrix for another reference point of the same body.

    A' = H^T A H with H = [[1, S(offset)], [0, 1]]: the old point's velocity is
    v_old = v_new + offset x omega. Keeps the kinetic energy, symmetry and rank.

    Parameters
    ----------
    matrix
        About the old point, body axes, shape (..., 6, 6).
    offset_b
        From the old to the new point [m], body axes, shape (..., 3).

    Returns
    -------
    About the new point, body axes, shape (..., 6, 6).

    """
    offset = cross_matrix(offset_b)
    H = np.zeros((*offset.shape[:-2], 6, 6))
    H[...] = np.eye(6)
    H[..., :3, 3:] = offset
    return np.swapaxes(H, -1, -2) @ np.asarray(matrix, dtype=np.float64) @ H


def rotate_matrix6(matrix: ArrayLike, rot_bg: ArrayLike) -> Array:
    """
    Return a 6x6 matrix given in axes g in body axes b: diag(R, R) A diag(R, R)^T.

    Parameters
    ----------
    matrix
        In axes g, shape (..., 6, 6).
    rot_bg
        Rotation that turns components in g into components in b, shape (..., 3, 3).

    Returns
    -------
    The matrix in axes b about the same point, shape (..., 6, 6).

    """
    rotation = np.asarray(rot_bg, dtype=np.float64)
    both = np.zeros((*rotation.shape[:-2], 6, 6))
    both[..., :3, :3] = rotation
    both[..., 3:, 3:] = rotation
    return both @ np.asarray(matrix, dtype=np.float64) @ np.swapaxes(both, -1, -2)


def frd_to_flu_matrix(matrix_frd: ArrayLike) -> Array:
    """
    Return a 6x6 matrix of FRD axes (ship theory, SNAME) in FLU axes: T A T.

    T = diag(1, -1, -1, 1, -1, -1) is its own inverse, so the same function leads back. Only the
    entries that couple {x, roll} with {y, z, pitch, yaw} change sign.

    Parameters
    ----------
    matrix_frd
        In axes forward, right, down, shape (..., 6, 6).

    Returns
    -------
    In axes forward, left, up, shape (..., 6, 6).

    """
    return np.asarray(matrix_frd, dtype=np.float64) * np.outer(_FLIP, _FLIP)
