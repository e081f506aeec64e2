# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Volumes and centres of volume of the shapes that MuJoCo's geoms can have."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, positive, positive_vectors, vectors
from fluid_sim_ros.physics.kappa import ellipsoid_volume

__all__ = [
    'box_volume',
    'capsule_volume',
    'cylinder_volume',
    'ellipsoid_volume',
    'mesh_volume',
    'sphere_volume',
]

Faces = NDArray[np.int64]


def sphere_volume(radius: ArrayLike) -> Array:
    """
    Return 4 pi r^3 / 3, the volume of a sphere.

    Parameters
    ----------
    radius
        r [m], above 0, shape (...).

    Returns
    -------
    [m^3], shape (...).

    """
    volume: Array = 4.0 / 3.0 * np.pi * positive(radius, 'radius [m]') ** 3
    return volume


def capsule_volume(radius: ArrayLike, half_length: ArrayLike) -> Array:
    """
    Return pi r^2 (2 h + 4 r / 3), the volume of a capsule.

    Parameters
    ----------
    radius
        r [m], above 0, shape (...).
    half_length
        h, half the length of the cylindrical part, as in MJCF [m], above 0, shape (...).

    Returns
    -------
    [m^3], shape (...).

    """
    r, h = positive(radius, 'radius [m]'), positive(half_length, 'half-length [m]')
    volume: Array = np.pi * r**2 * (2.0 * h + 4.0 / 3.0 * r)
    return volume


def cylinder_volume(radius: ArrayLike, half_length: ArrayLike) -> Array:
    """
    Return 2 pi r^2 h, the volume of a cylinder.

    Parameters
    ----------
    radius
        r [m], above 0, shape (...).
    half_length
        h, half the length, as in MJCF [m], above 0, shape (...).

    Returns
    -------
    [m^3], shape (...).

    """
    r, h = positive(radius, 'radius [m]'), positive(half_length, 'half-length [m]')
    volume: Array = 2.0 * np.pi * r**2 * h
    return volume


def box_volume(half: ArrayLike) -> Array:
    """
    Return 8 h_x h_y h_z, the volume of a box.

    Parameters
    ----------
    half
        Half-lengths h [m], above 0, shape (..., 3).

    Returns
    -------
    [m^3], shape (...).

    """
    volume: Array = 8.0 * positive_vectors(half, 'half-lengths [m]').prod(axis=-1)
    return volume


def mesh_volume(vertices_b: ArrayLike, faces: ArrayLike) -> tuple[float, Array]:
    """
    Return the volume and the centre of volume of a closed triangle mesh.

    Sum of signed tetrahedra (divergence theorem); exact for any closed, outward-oriented mesh,
    convex or not. Keeps its value under a shift of the origin.

    Parameters
    ----------
    vertices_b
        Corner points [m], shape (n, 3).
    faces
        Corners of each triangle, counter-clockwise seen from outside, shape (m, 3).

    Returns
    -------
    volume, center_b
        [m^3] and [m], shape (3,).

    Raises
    ------
    ConfigError
        If the mesh is open, or encloses no volume (or is inside out).

    """
    vertices, triangles = checked_mesh(vertices_b, faces)
    origin = vertices.mean(axis=0)  # near the mesh: no cancellation for a mesh far away
    a, b, c = np.moveaxis(vertices[triangles] - origin, 1, 0)
    parts = np.sum(a * np.cross(b, c), axis=-1) / 6.0
    volume = float(parts.sum())
    if volume <= 0:
        raise ConfigError(f'mesh: volume {volume:.6g}; allowed: > 0 with outward faces')
    return volume, origin + parts @ (a + b + c) / (4.0 * volume)


def checked_mesh(vertices_b: ArrayLike, faces: ArrayLike) -> tuple[Array, Faces]:
    """
    Return a closed mesh as arrays.

    Parameters
    ----------
    vertices_b
        Corner points [m], body axes, shape (n, 3).
    faces
        Corners of each triangle, counter-clockwise seen from outside, shape (m, 3).

    Returns
    -------
    vertices_b, faces
        The same, as arrays of numbers and of whole numbers.

    Raises
    ------
    ConfigError
        If the mesh is open, or an edge is not met once in each direction.

    """
    vertices = vectors(vertices_b, 'vertices [m]')
    triangles: Faces = np.asarray(faces, dtype=np.int64).reshape(-1, 3)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    forward = {(int(i), int(j)) for i, j in edges}
    if len(forward) != len(edges) or any((j, i) not in forward for i, j in forward):
        raise ConfigError(
            'mesh: open or badly oriented; allowed: each edge once in each direction'
        )
    return vertices, triangles


def box_mesh(half: ArrayLike) -> tuple[Array, Faces]:
    """
    Return a box as a closed mesh.

    Parameters
    ----------
    half
        Half-lengths [m], above 0, shape (3,).

    Returns
    -------
    vertices_b, faces
        Corners [m], shape (8, 3), and triangles, counter-clockwise seen from outside, shape (12,
        3).

    """
    h = positive_vectors(half, 'half-lengths [m]')
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return signs * h, np.array(faces, dtype=np.int64)
