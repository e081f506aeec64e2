# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Corners that lie on one another become one vertex; faces that are nothing go."""

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.hydro.meshes.surface import Faces, Surface, directed_edges, edge_keys, labels
from fluid_sim_ros.physics.arrays import Array

#: Widest gap that is welded, of the mesh's radius.
WIDEST_GAP = 1e-3
_GAPS = (1e-7, 1e-6, 1e-5, 1e-4, WIDEST_GAP)


def welded(surface: Surface) -> Surface:
    """
    Return a mesh in which equal corners are one vertex, without faces that are a line or a point.

    Of faces with the same three corners, one in each direction cancel (a wall without thickness),
    and copies in the same direction count once. Vertices stand in the order of their first use.

    Parameters
    ----------
    surface
        Any triangles.

    Returns
    -------
    Surface
        The same shape.

    """
    used = surface.faces.reshape(-1)
    mentioned, numbers = np.unique(used, return_inverse=True)
    equal = _equal_rows(surface.vertices[mentioned] + 0.0)
    return _in_order_of_use(surface.vertices[mentioned], equal[numbers.reshape(-1)])


def _equal_rows(points: Array) -> NDArray[np.int64]:
    """Return, for each point, the number of one that is equal to it; the same one for all."""
    order = np.lexsort(points.T)
    ordered = points[order]
    new = np.r_[True, (ordered[1:] != ordered[:-1]).any(axis=1)]
    result = np.empty(len(points), dtype=np.int64)
    result[order] = order[np.flatnonzero(new)[np.cumsum(new) - 1]]
    return result


def _in_order_of_use(vertices: Array, corners: NDArray[np.int64]) -> Surface:
    kept, first, numbers = np.unique(corners, return_index=True, return_inverse=True)
    rank = np.empty(len(kept), dtype=np.int64)
    by_use = np.argsort(first)
    rank[by_use] = np.arange(len(kept))
    faces = without_nothing(rank[numbers.reshape(-1)].reshape(-1, 3))
    return Surface(vertices[kept[by_use]], faces)


def without_nothing(faces: Faces) -> Faces:
    """
    Return the faces without those that use a vertex twice, cancel each other, or are copies.

    Parameters
    ----------
    faces
        Shape (m, 3).

    Returns
    -------
    Shape (k, 3), in the same order.

    """
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    if not len(faces):
        return faces
    group = _equal_rows(np.sort(faces, axis=1).astype(np.float64))
    if len(np.unique(group)) == len(faces):
        return faces
    rolled = faces[np.arange(len(faces))[:, None], _from_lowest(faces)]
    sense = np.where(rolled[:, 1] < rolled[:, 2], 1, -1)
    total = np.bincount(group, weights=sense).astype(np.int64)
    # one face of the sense that is left over, the first in the file
    keep = np.sign(total[group]) == sense
    seen = np.zeros(len(faces), bool)
    chosen = np.flatnonzero(keep)
    _, first = np.unique(group[chosen], return_index=True)
    seen[chosen[first]] = True
    return faces[seen]


def _from_lowest(faces: Faces) -> Faces:
    start = faces.argmin(axis=1)
    rolled: Faces = (start[:, None] + np.arange(3)) % 3
    return rolled


def open_edges(faces: Faces) -> Faces:
    """
    Return the edges that no face runs along in the other direction.

    Parameters
    ----------
    faces
        All of one sense, shape (m, 3).

    Returns
    -------
    From, to, as the faces run; shape (n, 2).

    """
    edges = directed_edges(faces)
    _, group = np.unique(edge_keys(edges), return_inverse=True)
    balance = np.bincount(group, weights=np.where(edges[:, 0] < edges[:, 1], 1, -1))
    left: Faces = edges[balance[group] != 0]
    return left


def lonely_edges(faces: Faces) -> Faces:
    """
    Return the edges of one face only, whatever the sense of the faces is.

    Parameters
    ----------
    faces
        Shape (m, 3).

    Returns
    -------
    From, to, as the faces run; shape (n, 2).

    """
    edges = directed_edges(faces)
    _, group, count = np.unique(edge_keys(edges), return_inverse=True, return_counts=True)
    left: Faces = edges[count[group] == 1]
    return left


def without_cracks(surface: Surface) -> tuple[Surface, float]:
    """
    Return a mesh in which corners beside an open edge are moved together, where that closes it.

    Parameters
    ----------
    surface
        Welded, in its own frame (radius 1).

    Returns
    -------
    surface, gap
        The mesh, and the widest gap that was closed, of the radius; 0: nothing was open, or
        moving corners by up to `WIDEST_GAP` did not help.

    """
    gap = 0.0
    for reach in _GAPS:
        edges = lonely_edges(surface.faces)
        if not len(edges):
            break
        moved = _drawn_together(surface, np.unique(edges), reach)
        if len(lonely_edges(moved.faces)) < len(edges):
            surface, gap = moved, reach
    return surface, gap


def _drawn_together(surface: Surface, beside: Faces, reach: float) -> Surface:
    """Return the mesh with the given vertices made one where they are within reach."""
    from scipy.spatial import cKDTree  # takes longer to import than most meshes, which are closed

    points: Array = surface.vertices[beside]
    pairs = cKDTree(points).query_pairs(reach, output_type='ndarray')
    if not len(pairs):
        return surface
    _, group = labels(len(beside), pairs)
    _, first = np.unique(group, return_index=True)
    numbers = np.arange(len(surface.vertices))
    numbers[beside] = beside[first][group]
    return Surface(surface.vertices, without_nothing(numbers[surface.faces]))
