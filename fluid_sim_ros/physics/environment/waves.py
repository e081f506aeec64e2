# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Linear (Airy) waves on water: dispersion, surface and flow, for deep and finite depth.

A sea is a sum of plane waves; with theta = k.x - omega t + phase the surface is
eta = sum a cos(theta). Heights z are above the mean level [m]. World axes, z up. The waves do not
feel the current: both add up. Source of the equations: Dean and Dalrymple, Water Wave Mechanics
for Engineers and Scientists (1991), ch. 3.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, column, positive, vectors
from fluid_sim_ros.physics.environment.wave_dispersion import checked_height, dispersion_wavenumber

#: e^(-2 k h) beyond this k h is below the rounding of 1: the water counts as deep.
DEEP = 20.0


class Sea(NamedTuple):
    """The components of a sea; arrays of one entry per component."""

    amplitude: Array  # a [m], shape (n,)
    omega: Array  # angular frequency [rad/s], shape (n,)
    wavenumber: Array  # k [rad/m], shape (n,)
    direction: Array  # unit vector along which the component travels, world x y, shape (n, 2)
    phase: Array  # [rad], shape (n,)
    depth: float  # of the bed below the mean level [m]; inf: deep water
    repeat: float  # period after which the sea repeats exactly [s]


class Surface(NamedTuple):
    """The surface over points of the plane, and how it changes there."""

    height: Array  # eta [m], shape (...)
    slope: Array  # (d/dx, d/dy) eta [-], shape (..., 2)
    rate: Array  # d eta/dt [m/s], shape (...)
    slope_rate: Array  # d/dt of the slope [1/s], shape (..., 2)
    curvature: Array  # second derivatives of eta [1/m], shape (..., 2, 2)


class Flow(NamedTuple):
    """The undisturbed flow of the waves at points."""

    velocity: Array  # u [m/s], shape (..., 3)
    gradient: Array  # du_i/dx_j [1/s], shape (..., 3, 3)
    rate: Array  # du/dt at the fixed point [m/s^2], shape (..., 3)

    @property
    def acceleration(self) -> Array:
        """Du/Dt = du/dt + (u . grad) u [m/s^2], shape (..., 3)."""
        carried: Array = np.einsum('...ij,...j->...i', self.gradient, self.velocity)
        return self.rate + carried


def regular_waves(
    height: float,
    period: float,
    direction: ArrayLike = (1.0, 0.0),
    depth: float = np.inf,
    gravity: float = 9.81,
) -> Sea:
    """
    Return waves of one height and period; a crest passes the origin at t = 0.

    Parameters
    ----------
    height, period
        From trough to crest [m], 0 up to `breaking_height`; of the wave [s], > 0.
    direction
        Along which the waves travel, world x y, any length but 0, shape (2,).
    depth, gravity
        As in `dispersion_wavenumber`.

    """
    omega = 2.0 * np.pi / np.atleast_1d(positive(period, 'period [s]'))
    return Sea(
        amplitude=np.full(1, 0.5 * checked_height(height, period, depth, gravity)),
        omega=omega,
        wavenumber=dispersion_wavenumber(omega, depth, gravity),
        direction=unit_direction(direction)[np.newaxis],
        phase=np.zeros(1),
        depth=float(depth),
        repeat=float(period),
    )


def unit_direction(direction: ArrayLike) -> Array:
    """
    Return a direction in the plane as a unit vector.

    Parameters
    ----------
    direction
        World x and y, any length but 0, shape (2,).

    Returns
    -------
    [-], shape (2,).

    Raises
    ------
    ConfigError
        If the direction is 0 or not finite.

    """
    along = vectors(direction, 'direction', 2)
    length = np.linalg.norm(along)
    if along.shape != (2,) or not (np.isfinite(length) and length > 0):
        raise ConfigError(f'direction: {along.tolist()}; allowed: x and y, not both 0')
    unit: Array = along / length
    return unit


def wave_surface(sea: Sea, position: ArrayLike, time: ArrayLike) -> Surface:
    """
    Return the surface of a sea over points at a time.

    Parameters
    ----------
    sea
        Its components.
    position
        World x y of the points [m], shape (..., 2).
    time
        [s], shape (...).

    """
    cosine, sine = _phases(sea, vectors(position, 'position', 2), time)
    k = column(sea.wavenumber) * sea.direction
    tensor = k[:, :, np.newaxis] * k[:, np.newaxis, :]
    up, across = sea.amplitude * cosine, sea.amplitude * sine
    return Surface(
        height=up.sum(axis=-1),
        slope=-across @ k,
        rate=across @ sea.omega,
        slope_rate=(up * sea.omega) @ k,
        curvature=-np.einsum('...n,nij->...ij', up, tensor),
    )


def wave_flow(sea: Sea, position: ArrayLike, time: ArrayLike) -> Flow:
    """
    Return the flow that a sea brings to points in the water.

    Horizontally a omega C cos(theta) along the direction, vertically a omega S sin(theta), with
    C = cosh k(z + h)/sinh k h and S = sinh k(z + h)/sinh k h (both e^(k z) in deep water). Free of
    divergence and rotation up to the mean level; above it C and S go on along their tangents at
    z = 0 (linear extrapolation; Rodenbusch and Forristall 1986, OTC 5097), so
    that the short waves on a crest of the long ones stay bounded. Velocity and Du/Dt are
    continuous there. Below the bed the flow is that at the bed.

    Parameters
    ----------
    sea
        Its components.
    position
        World x y, and z above the mean level, of the points [m], shape (..., 3).
    time
        [s], shape (...).

    """
    point = vectors(position, 'position')
    cosine, sine = _phases(sea, point[..., :2], time)
    c, s, c_slope, s_slope = _decay(sea, point[..., 2:])
    k, speed = sea.wavenumber, sea.amplitude * sea.omega
    d_x, d_y = sea.direction.T
    along, up = speed * c * cosine, speed * s * sine
    shear, lift = speed * c * sine, speed * s * cosine
    velocity = [along @ d_x, along @ d_y, up.sum(axis=-1)]
    rate = [(sea.omega * shear) @ d_x, (sea.omega * shear) @ d_y, -(lift @ sea.omega)]
    across = -shear @ (k * d_x * d_y)
    rise = speed * c_slope * cosine
    gradient = [
        [-shear @ (k * d_x * d_x), across, rise @ d_x],
        [across, -shear @ (k * d_y * d_y), rise @ d_y],
        [lift @ (k * d_x), lift @ (k * d_y), (speed * s_slope * sine).sum(axis=-1)],
    ]
    return Flow(
        np.stack(velocity, axis=-1),
        np.stack([np.stack(row, axis=-1) for row in gradient], axis=-2),
        np.stack(rate, axis=-1),
    )


def _phases(sea: Sea, position: Array, time: ArrayLike) -> tuple[Array, Array]:
    """Return cos and sin of k.x - omega t + phase, shape (..., n)."""
    way = position @ sea.direction.T
    theta = sea.wavenumber * way - sea.omega * column(time) + sea.phase
    return np.cos(theta), np.sin(theta)


def _decay(sea: Sea, z: Array) -> tuple[Array, Array, Array, Array]:
    """Return C, S and their derivatives by z [1/m] of each component; z of shape (..., 1)."""
    k, below = sea.wavenumber, np.clip(z, -sea.depth, 0.0)
    direct = np.exp(k * below)
    reflected, floor = np.zeros_like(direct), np.zeros_like(k)
    if np.isfinite(sea.depth):
        shallow = k * sea.depth < DEEP
        reflected = np.where(shallow, np.exp(-k * (below + 2.0 * sea.depth)), 0.0)
        floor = np.where(shallow, np.exp(-2.0 * k * sea.depth), 0.0)
    c, s = (direct + reflected) / (1.0 - floor), (direct - reflected) / (1.0 - floor)
    above = np.maximum(z, 0.0)
    inside = z >= -sea.depth  # the clamp below the bed has no slope
    return c + k * above * s, s + k * above * c, inside * k * s, inside * k * c
