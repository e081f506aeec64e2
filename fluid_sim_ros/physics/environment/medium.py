# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The medium around the body: vertical profiles, changing targets, two layers.

A flow is horizontal-profile times reference velocity, u(z, t) = f(z) U(t). Heights are world z
above the datum of the profile (the ground for wind, the bed for a current) [m].
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, column, not_negative, positive, vectors


def power_law_profile(height: ArrayLike, reference: float, exponent: float) -> tuple[Array, Array]:
    """
    Return f = (z/z_ref)^alpha and df/dz [1/m]; 0 and 0 at and below the ground.

    Wind over open land alpha = 1/7 (Peterson and Hennessey 1978, J. Appl. Meteor. 17:390), tidal
    current 1/7 over the bed (Soulsby 1997, Dynamics of Marine Sands).

    Parameters
    ----------
    height
        z [m], shape (...).
    reference
        z_ref at which f = 1 [m].
    exponent
        alpha [-], positive.

    """
    z, z_ref = np.asarray(height, dtype=np.float64), float(positive(reference, 'reference [m]'))
    alpha = float(positive(exponent, 'exponent'))
    inside = z > 0
    safe = np.where(inside, z, z_ref)
    factor = np.where(inside, (safe / z_ref) ** alpha, 0.0)
    return factor, np.where(inside, alpha * factor / safe, 0.0)


def logarithmic_profile(
    height: ArrayLike, reference: float, roughness: float
) -> tuple[Array, Array]:
    """
    Return f = ln(z/z_0)/ln(z_ref/z_0) and df/dz [1/m]; 0 and 0 at and below the roughness.

    Law of the wall for a rough surface, neutral stratification; Stull (1988), ch. 9. Roughness
    length z_0: sea 2e-4 m, grass 0.03 m, suburb 0.5 m (WMO).

    Parameters
    ----------
    height
        Above the ground [m], shape (...).
    reference
        Height at which f is 1 [m], above the roughness length.
    roughness
        z_0 [m], above 0.

    Returns
    -------
    factor, slope
        f [-] and df/dz [1/m], shape (...) each.

    Raises
    ------
    ConfigError
        If the reference height is not above the roughness length.

    """
    z, z_0 = np.asarray(height, dtype=np.float64), float(positive(roughness, 'roughness [m]'))
    if not reference > z_0:
        raise ConfigError(f'reference [m]: {reference}; allowed: > roughness {z_0}')
    scale = np.log(reference / z_0)
    inside = z > z_0
    safe = np.where(inside, z, z_0)
    return np.log(safe / z_0) / scale, np.where(inside, 1.0 / (safe * scale), 0.0)


def table_profile(
    height: ArrayLike, heights: ArrayLike, factors: ArrayLike
) -> tuple[Array, Array]:
    """
    Return f by linear interpolation of a table, and df/dz [1/m]; constant beyond its ends.

    At a knot the slope is that of the interval above.

    Parameters
    ----------
    height
        Above the datum [m], shape (...).
    heights
        Of the knots [m], rising strictly, shape (n,).
    factors
        f at the knots [-], shape (n,).

    Returns
    -------
    factor, slope
        f [-] and df/dz [1/m], shape (...) each.

    Raises
    ------
    ConfigError
        If the knots do not rise strictly, or there are too few.

    """
    z, knots = np.asarray(height, dtype=np.float64), np.asarray(heights, dtype=np.float64)
    values = np.asarray(factors, dtype=np.float64)
    if knots.ndim != 1 or knots.size < 2 or values.shape != knots.shape:
        raise ConfigError(f'profile: {knots.size} heights; allowed: two or more, one factor each')
    if not np.all(np.diff(knots) > 0):
        raise ConfigError(f'profile: heights {knots.tolist()}; allowed: rising strictly')
    slopes = np.concatenate([[0.0], np.diff(values) / np.diff(knots), [0.0]])
    slope: Array = slopes[np.searchsorted(knots, z, side='right')]
    return np.interp(z, knots, values), slope


def flow_velocity(factor: ArrayLike, velocity_w: ArrayLike) -> Array:
    """
    Return the velocity u = f(z) U of a flow with a vertical profile.

    Parameters
    ----------
    factor
        f at the height of the point [-], shape (...).
    velocity_w
        U, at the reference height [m/s], world axes, shape (..., 3).

    Returns
    -------
    [m/s], world axes, shape (..., 3).

    """
    return column(factor) * vectors(velocity_w, 'velocity_w')


def flow_acceleration(
    factor: ArrayLike, slope: ArrayLike, velocity_w: ArrayLike, velocity_rate_w: ArrayLike
) -> Array:
    """
    Return Du/Dt = f dU/dt + u_z f' U of the undisturbed flow at a point [m/s^2].

    The material derivative of u = f(z) U(t): the second part is (u . grad) u and vanishes for a
    horizontal flow. The body's own velocity does not enter: a body towed through a steady profile
    feels no acceleration of the flow.

    Parameters
    ----------
    factor, slope
        f(z) [-] and f'(z) [1/m] at the point, shape (...).
    velocity_w, velocity_rate_w
        U [m/s] and dU/dt [m/s^2], world axes, shape (..., 3).

    """
    reference = vectors(velocity_w, 'velocity_w')
    rise = column(factor) * reference[..., 2:]  # u_z
    change = column(factor) * vectors(velocity_rate_w, 'velocity_rate_w')
    return change + rise * column(slope) * reference


def slew_limited(
    start_w: ArrayLike, target_w: ArrayLike, rate: float, elapsed: ArrayLike
) -> tuple[Array, Array]:
    """
    Return a velocity on its way from start to target at a bounded rate, and its derivative.

    A straight line at constant speed ``rate`` in velocity space, then rest at the target. Exact in
    closed form, so the derivative is the true one at every time: a step of the target never is
    a force spike. It belongs to the interval that follows (0 from the arrival on).

    Parameters
    ----------
    start_w, target_w
        [m/s], shape (..., 3).
    rate
        Largest acceleration of the medium [m/s^2].
    elapsed
        Time since the target was set [s], shape (...).

    Returns
    -------
    velocity_w, velocity_rate_w
        [m/s] and [m/s^2], shape (..., 3) each.

    """
    start, target = vectors(start_w, 'start_w'), vectors(target_w, 'target_w')
    limit = float(positive(rate, 'rate [m/s^2]'))
    way = target - start
    distance = np.linalg.norm(way, axis=-1, keepdims=True)
    moved = limit * column(not_negative(elapsed, 'elapsed [s]'))
    direction = way / np.where(distance > 0, distance, 1.0)
    arrived = moved >= distance
    return (
        np.where(arrived, target, start + moved * direction),
        np.where(arrived, 0.0, limit * direction),
    )


def layered(height: ArrayLike, surface: ArrayLike, below: ArrayLike, above: ArrayLike) -> Array:
    """
    Return a property (density, viscosity) at a height: ``below`` up to the surface.

    Parameters
    ----------
    height
        World z of the point [m], shape (...).
    surface
        World z of the surface [m], shape (...).
    below, above
        The property in the lower and the upper medium, in any unit, shape (...).

    Returns
    -------
    In the same unit, shape (...).

    """
    wet = np.asarray(height) <= np.asarray(surface)
    return np.where(wet, np.asarray(below, dtype=np.float64), above)


def blended(share: ArrayLike, below: ArrayLike, above: ArrayLike) -> Array:
    """
    Return s below + (1 - s) above: a property seen by a body with wetted share s.

    Parameters
    ----------
    share
        Wetted share s in [0, 1], shape (...).
    below, above
        The property in the lower and the upper medium, in any unit, shape (...).

    Returns
    -------
    In the same unit, shape (...).

    """
    s = np.asarray(share, dtype=np.float64)
    mixture: Array = s * np.asarray(below) + (1.0 - s) * np.asarray(above)
    return mixture
