# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Small array helpers that the physics functions share: shapes, signs, checks."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros.errors import ConfigError

#: Numbers of any shape in double precision: the alias of the whole package.
Array = NDArray[np.float64]
Wrench = tuple[Array, Array]  # force [N], torque [N m]


def vectors(value: ArrayLike, name: str, size: int = 3) -> Array:
    """
    Return a value as vectors of double precision.

    Parameters
    ----------
    value
        Numbers, shape (..., size).
    name
        What the value is called in an error.
    size
        Length of each vector.

    Returns
    -------
    The same numbers, shape (..., size).

    Raises
    ------
    ConfigError
        If the last axis has another length.

    """
    array = np.asarray(value, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != size:
        raise ConfigError(f'{name}: shape {array.shape}; allowed: (..., {size})')
    return array


def positive_vectors(value: ArrayLike, name: str, size: int = 3) -> Array:
    """
    Return vectors whose entries are all finite and above zero.

    Parameters
    ----------
    value
        Numbers, shape (..., size).
    name
        What the value is called in an error.
    size
        Length of each vector.

    Returns
    -------
    The same numbers, shape (..., size).

    Raises
    ------
    ConfigError
        If a number is not finite or not above zero, or the shape does not fit.

    """
    array = vectors(value, name, size)
    if not np.all(np.isfinite(array) & (array > 0)):
        raise ConfigError(f'{name}: {array.tolist()}; allowed: finite numbers > 0')
    return array


def not_negative(value: ArrayLike, name: str) -> Array:
    """
    Return numbers that are all finite and at least zero.

    Parameters
    ----------
    value
        Numbers of any shape.
    name
        What the value is called in an error.

    Returns
    -------
    The same numbers, same shape.

    Raises
    ------
    ConfigError
        If a number is not finite or below zero.

    """
    array = np.asarray(value, dtype=np.float64)
    if not np.all(np.isfinite(array) & (array >= 0)):
        raise ConfigError(f'{name}: {array.tolist()}; allowed: finite numbers >= 0')
    return array


def positive(value: ArrayLike, name: str) -> Array:
    """
    Return numbers that are all finite and above zero.

    Parameters
    ----------
    value
        Numbers of any shape.
    name
        What the value is called in an error.

    Returns
    -------
    The same numbers, same shape.

    Raises
    ------
    ConfigError
        If a number is not finite or not above zero.

    """
    array = np.asarray(value, dtype=np.float64)
    if not np.all(np.isfinite(array) & (array > 0)):
        raise ConfigError(f'{name}: {array.tolist()}; allowed: finite numbers > 0')
    return array


def norm(v: Array) -> Array:
    """
    Return the lengths of vectors, ready to divide them by.

    Parameters
    ----------
    v
        Vectors, shape (..., n).

    Returns
    -------
    Lengths in the unit of ``v``, shape (..., 1).

    """
    length: Array = np.linalg.norm(v, axis=-1, keepdims=True)
    return length


def unit_or_zero(v: Array) -> Array:
    """
    Return unit vectors; a zero vector stays zero (no direction, no NaN).

    Parameters
    ----------
    v
        Vectors, shape (..., n).

    Returns
    -------
    [-], same shape.

    """
    # Divide by the largest entry first: squares of tiny components would underflow.
    scale = np.max(np.abs(v), axis=-1, keepdims=True)
    scaled = v / np.where(scale > 0, scale, 1.0)
    length = norm(scaled)
    unit: Array = scaled / np.where(length > 0, length, 1.0)
    return unit


def column(value: ArrayLike) -> Array:
    """
    Return scalars with one more axis, ready to multiply vectors.

    Parameters
    ----------
    value
        Scalars, shape (...).

    Returns
    -------
    The same numbers, shape (..., 1).

    """
    return np.asarray(value, dtype=np.float64)[..., np.newaxis]


def cross_matrix(v: ArrayLike) -> Array:
    """
    Return the matrix S(v) with S(v) w = v x w.

    Parameters
    ----------
    v
        Vectors, shape (..., 3).

    Returns
    -------
    S in the unit of ``v``, shape (..., 3, 3).

    """
    v = vectors(v, 'vector')
    s = np.zeros((*v.shape, 3))
    s[..., 0, 1], s[..., 0, 2], s[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    s[..., 1, 0], s[..., 2, 0], s[..., 2, 1] = v[..., 2], -v[..., 1], v[..., 0]
    return s
