# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A measured or computed flow on a rectilinear grid, u(t, x, y, z)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, vectors
from fluid_sim_ros.physics.environment.waves import Flow

AXES = ('t', 'x', 'y', 'z')


class Grid(NamedTuple):
    """Axes that rise strictly, and the velocity at every grid point."""

    axes: tuple[Array, Array, Array, Array]  # t [s], x, y, z [m], one or more points each
    velocity: Array  # world axes [m/s], shape (n_t, n_x, n_y, n_z, 3)


def checked_grid(axes: tuple[ArrayLike, ...], velocity: ArrayLike) -> Grid:
    """
    Return a grid, or raise a ConfigError that says what is wrong and where.

    Parameters
    ----------
    axes
        t [s], x, y, z [m]: one or more numbers each, rising strictly.
    velocity
        Shape (n_t, n_x, n_y, n_z, 3) [m/s].

    """
    arrays = tuple(np.atleast_1d(np.asarray(axis, dtype=np.float64)) for axis in axes)
    field = np.asarray(velocity, dtype=np.float64)
    for name, axis in zip(AXES, arrays, strict=True):
        if axis.ndim != 1 or not np.all(np.isfinite(axis)):
            raise ConfigError(f'axis {name}: must be finite numbers in one row')
        if axis.size == 0:
            raise ConfigError(f'axis {name}: empty')
        fall = np.flatnonzero(np.diff(axis) <= 0)
        if fall.size:
            at = int(fall[0])
            raise ConfigError(
                f'axis {name}: must rise strictly; {axis[at + 1]:g} follows {axis[at]:g} '
                f'(point {at + 2})'
            )
    shape = (*(axis.size for axis in arrays), 3)
    if field.shape != shape:
        raise ConfigError(f'velocity: shape {field.shape}; allowed: {shape} for these axes')
    gaps = np.argwhere(~np.isfinite(field).all(axis=-1))
    if gaps.size:
        place = ', '.join(
            f'{name} = {axis[i]:g}' for name, axis, i in zip(AXES, arrays, gaps[0], strict=True)
        )
        raise ConfigError(f'velocity: {len(gaps)} gaps (not finite), the first at {place}')
    t, x, y, z = arrays
    return Grid((t, x, y, z), field)


def grid_flow(grid: Grid, position_w: ArrayLike, time: ArrayLike) -> Flow:
    """
    Return the flow of a grid at points.

    Linear in each of t, x, y, z between the grid points, so it never leaves the range of the data
    and is continuous; gradient and rate are the exact derivatives of this interpolant, constant
    along their own axis within a cell and those of the cell above at a grid point. Beyond an end
    of an axis the value at the end holds (derivative 0); an axis of one point holds everywhere.

    Parameters
    ----------
    grid
        As ``checked_grid`` returns it.
    position_w
        World points [m], shape (..., 3).
    time
        [s], shape (...).

    """
    point = vectors(position_w, 'position_w')
    at = np.broadcast_arrays(np.asarray(time, dtype=np.float64), *np.moveaxis(point, -1, 0))
    places = [_locate(axis, x) for axis, x in zip(grid.axes, at, strict=True)]
    velocity, slopes = np.zeros((*at[0].shape, 3)), np.zeros((4, *at[0].shape, 3))
    for corner in np.ndindex(2, 2, 2, 2):
        index, parts, changes = [], [], []
        for high, axis, (low, share, slope) in zip(corner, grid.axes, places, strict=True):
            index.append(np.minimum(low + high, axis.size - 1))
            parts.append(share if high else 1.0 - share)
            changes.append(slope if high else -slope)
        value = grid.velocity[tuple(index)]
        velocity += np.prod(parts, axis=0)[..., np.newaxis] * value
        for i in range(4):
            factors = [*parts[:i], changes[i], *parts[i + 1 :]]
            slopes[i] += np.prod(factors, axis=0)[..., np.newaxis] * value
    return Flow(velocity, np.moveaxis(slopes[1:], 0, -1), slopes[0])


def _locate(axis: Array, x: Array) -> tuple[NDArray[np.intp], Array, Array]:
    """Return the point below, the share of the way to the next, and its slope (0: held)."""
    low = np.clip(np.searchsorted(axis, x, side='right') - 1, 0, axis.size - 1)
    inside = (x >= axis[0]) & (x < axis[-1])
    step = np.diff(axis, append=axis[-1] + 1.0)[low]
    slope = np.where(inside, 1.0 / step, 0.0)
    return low, np.where(inside, (x - axis[low]) / step, 0.0), slope
