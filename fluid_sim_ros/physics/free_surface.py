# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Bodies cut by a plane water surface, exactly.

The surface is given in the body's axes: ``up_b``, the unit normal that points out of the water,
and ``height``, the height of the surface above the body's origin along it [m]. A point x is under
water when up_b . x <= height.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Array, column, norm, positive_vectors, vectors
from fluid_sim_ros.physics.volume import box_mesh, checked_mesh


class Cut(NamedTuple):
    """The part of a body under the surface."""

    volume: Array  # [m^3], shape (...)
    center_b: Array  # centre of that volume [m], shape (..., 3); finite but idle when empty
    waterplane_area: Array  # area of the body's section with the surface [m^2], shape (...)
    waterplane_center_b: Array  # centre of that section [m], shape (..., 3); likewise


def ellipsoid_cut(axes: ArrayLike, up_b: ArrayLike, height: ArrayLike) -> Cut:
    """
    Return the part of an ellipsoid under the surface.

    An affine map S = diag(r) from the unit ball: with q = S up, n' = q/|q| and
    p = clamp(height/|q|, -1, 1), the cap of the ball below p gives
    V = pi/3 r_x r_y r_z (1 + p)^2 (2 - p) and centre -3 (1 - p)^2 / (4 (2 - p)) S n'; the section
    is pi r_x r_y r_z (1 - p^2)/|q| about p S n'. Exact; continuous with its first derivative.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3); the origin is the ellipsoid's centre.
    up_b
        Unit normal of the surface, ellipsoid axes, shape (..., 3).
    height
        Of the surface above the centre [m], shape (...).

    """
    r = positive_vectors(axes, 'semi-axes [m]')
    stretched = r * vectors(up_b, 'up_b')
    length = norm(stretched)
    p = np.clip(column(height) / length, -1.0, 1.0)
    product = r.prod(axis=-1)
    direction = r * stretched / length
    return Cut(
        volume=(np.pi / 3.0 * product * ((1.0 + p) ** 2 * (2.0 - p))[..., 0]),
        center_b=-0.75 * (1.0 - p) ** 2 / (2.0 - p) * direction,
        waterplane_area=(np.pi * product * ((1.0 - p * p) / length)[..., 0]),
        waterplane_center_b=p * direction,
    )


def box_cut(half: ArrayLike, up_b: ArrayLike, height: float) -> Cut:
    """
    Return the part of a box under the surface, exactly.

    Parameters
    ----------
    half
        Half-lengths [m], shape (3,); the origin is the centre.
    up_b
        Unit normal of the surface, box axes, shape (3,).
    height
        Of the surface above the centre [m].

    Returns
    -------
    See `Cut`.

    """
    return polyhedron_cut(*box_mesh(half), up_b, height)


def polyhedron_cut(vertices_b: ArrayLike, faces: ArrayLike, up_b: ArrayLike, height: float) -> Cut:
    """
    Return the part of a closed triangle mesh under the surface.

    Each triangle is clipped by the surface; the signed tetrahedra from a point on the surface to
    the pieces add up to the volume, because the lid lies in the surface and adds nothing. The
    lid's area and first moment follow from the divergence theorem. Exact for any closed mesh,
    convex or not; at every tilt.

    Parameters
    ----------
    vertices_b, faces
        Closed mesh, faces outward, shapes (n, 3) [m] and (m, 3).
    up_b
        Unit normal of the surface, body axes, shape (3,).
    height
        Of the surface above the origin [m].

    Raises
    ------
    ConfigError
        If the mesh is not closed.

    """
    vertices, triangles = checked_mesh(vertices_b, faces)
    up = vectors(up_b, 'up_b')
    origin = height * up  # the surface's point nearest to the body's origin
    volume, moment = 0.0, np.zeros(3)
    lid_area, lid_moment = 0.0, np.zeros(3)
    for corners in vertices[triangles] - origin:
        for a, b, c in _below(corners, corners @ up):
            part = float(a @ np.cross(b, c)) / 6.0
            volume += part
            moment += part * (a + b + c) / 4.0
            facing = 0.5 * float(np.cross(b - a, c - a) @ up)
            lid_area -= facing
            lid_moment -= facing * (a + b + c) / 3.0
    lid_moment += volume * up
    return Cut(
        volume=np.asarray(volume),
        center_b=origin + moment / volume if volume > 0 else origin,
        waterplane_area=np.asarray(lid_area),
        waterplane_center_b=origin + lid_moment / lid_area if lid_area > 0 else origin,
    )


def _below(corners: Array, heights: Array) -> list[tuple[Array, Array, Array]]:
    """Return the triangles that make up the part of a triangle with heights <= 0."""
    kept: list[Array] = []
    for i in range(3):
        j = (i + 1) % 3
        if heights[i] <= 0:
            kept.append(corners[i])
        if (heights[i] <= 0) != (heights[j] <= 0):
            share = heights[i] / (heights[i] - heights[j])
            kept.append(corners[i] + share * (corners[j] - corners[i]))
    return [(kept[0], kept[k], kept[k + 1]) for k in range(1, len(kept) - 1)]


def wetted_volume_rate(
    cut: Cut, up_b: ArrayLike, height_rate: ArrayLike, omega_b: ArrayLike
) -> Array:
    """
    Return d(volume)/dt of a moving body's cut [m^3/s], shape (...).

    dV/dt = A_w (dh/dt + (w x up) . c_w): the surface sweeps through the body at its section's
    centre c_w. In body axes the normal turns with d(up)/dt = -w x up.

    Parameters
    ----------
    cut
        Of the body at this instant.
    up_b
        Unit normal of the surface, shape (..., 3).
    height_rate
        Rate of the surface's height above the body's origin [m/s]: minus the origin's upward
        speed in still water, shape (...).
    omega_b
        Angular velocity of the body [rad/s], shape (..., 3).

    """
    tilt = np.cross(vectors(omega_b, 'omega_b'), vectors(up_b, 'up_b'))
    sweep = np.asarray(height_rate) + np.sum(tilt * cut.waterplane_center_b, axis=-1)
    rate: Array = cut.waterplane_area * sweep
    return rate
