# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Fewer triangles for the same shape."""

import numpy as np

from fluid_sim_ros.hydro.meshes.manifold import manifold_of, surface_of
from fluid_sim_ros.hydro.meshes.surface import (
    MeshFaultError,
    Surface,
    area_vectors,
    face_pairs,
)

#: A mesh of so few faces stays as it is.
_SIMPLE = 200
#: Share of the edges, and of the faces, that makes it worth while.
_MUCH = 0.2
_FLAT = np.cos(np.radians(0.1))


def decimated(surface: Surface, count: int) -> Surface:
    """
    Return a mesh with about so many triangles, by collapsing the edges that change it least.

    Quadric error metric of Garland and Heckbert (1997), by fast_simplification.

    Parameters
    ----------
    surface
        Closed.
    count
        Of triangles wanted; a mesh with no more is returned as it is.

    Returns
    -------
    Surface
        Of nearly the same volume.

    """
    if len(surface.faces) <= count:
        return surface
    import fast_simplification

    vertices, faces = fast_simplification.simplify(
        # it wants arrays that it might write to
        np.array(surface.vertices, order='C'),
        np.array(surface.faces, dtype=np.int32, order='C'),
        target_count=count,
    )
    return Surface(np.asarray(vertices, dtype=np.float64), np.asarray(faces, dtype=np.int64))


def without_flat_edges(surface: Surface) -> Surface:
    """
    Return a body with large triangles where it is flat, if that makes it much simpler.

    Parameters
    ----------
    surface
        Closed, radius 1.

    Returns
    -------
    Surface
        The same shape to a millionth of the radius, or the mesh itself.

    """
    if len(surface.faces) <= _SIMPLE:
        return surface
    normals = area_vectors(surface.triangles)
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    pairs, _ = face_pairs(surface.faces)
    flat = np.einsum('ij,ij->i', unit[pairs[:, 0]], unit[pairs[:, 1]]) > _FLAT
    if flat.mean() < _MUCH:
        return surface
    simple = within(surface, 1e-6)
    return simple if len(simple.faces) < (1 - _MUCH) * len(surface.faces) else surface


def within(surface: Surface, reach: float) -> Surface:
    """
    Return a body with fewer faces, nowhere farther from it than a distance.

    Parameters
    ----------
    surface
        Closed.
    reach
        Largest distance between both [unit of the mesh].

    Returns
    -------
    Surface
        Closed; the mesh itself where manifold3d does not take it.

    """
    try:
        return surface_of(manifold_of(surface).simplify(reach))
    except MeshFaultError:
        return surface
