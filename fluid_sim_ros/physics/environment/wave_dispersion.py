# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The length of linear waves, and the height at which they break."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, positive


def dispersion_wavenumber(omega: ArrayLike, depth: float, gravity: float) -> Array:
    """
    Return k of omega^2 = g k tanh(k h) [rad/m].

    Newton's method on x tanh x = omega^2 h/g from the explicit approximation of Guo (2002),
    Coastal Engineering 45:71, which is within 0.75 %; the result is exact to rounding.

    Parameters
    ----------
    omega
        Angular frequency [rad/s], positive, shape (...).
    depth
        h [m], positive; inf for deep water, where k = omega^2/g.
    gravity
        g [m/s^2], positive.

    """
    square = positive(omega, 'omega [rad/s]') ** 2 / float(positive(gravity, 'gravity [m/s^2]'))
    if not depth > 0:
        raise ConfigError(f'depth [m]: {depth}; allowed: > 0')
    if np.isinf(depth):
        return square
    target = square * depth
    x = target * (1.0 - np.exp(-(target**1.25))) ** -0.4
    for _ in range(4):  # quadratic from 0.75 %: three are enough, the fourth costs nothing
        t = np.tanh(x)
        x = x - (x * t - target) / (t + x * (1.0 - t * t))
    wavenumber: Array = x / depth
    return wavenumber


def breaking_height(period: float, depth: float, gravity: float = 9.81) -> float:
    """
    Return the height at which waves of a period break: 0.142 L tanh(k h).

    Miche (1944), Annales des Ponts et Chaussees 114. Linear waves describe the flow well up to
    about a third of it.

    Parameters
    ----------
    period
        Of the waves [s], above 0.
    depth
        h [m], above 0; inf for deep water.
    gravity
        g [m/s^2], above 0.

    Returns
    -------
    From trough to crest [m].

    Raises
    ------
    ConfigError
        If a number is not above 0.

    """
    omega = 2.0 * np.pi / float(positive(period, 'period [s]'))
    k = float(dispersion_wavenumber(omega, depth, gravity))
    return 0.142 * 2.0 * np.pi / k * float(np.tanh(k * depth))


def checked_height(height: float, period: float, depth: float, gravity: float) -> float:
    """
    Return a wave height at which the waves do not break.

    Parameters
    ----------
    height
        From trough to crest [m].
    period
        Of the waves [s], above 0.
    depth
        h [m], above 0; inf for deep water.
    gravity
        g [m/s^2], above 0.

    Returns
    -------
    The height [m].

    Raises
    ------
    ConfigError
        If waves so high would break, see `breaking_height`.

    """
    limit = breaking_height(period, depth, gravity)
    if not 0.0 <= height <= limit:
        raise ConfigError(
            f'height: {height} m; allowed: 0 to {limit:.6g} m, where waves of {period} s break'
        )
    return float(height)
