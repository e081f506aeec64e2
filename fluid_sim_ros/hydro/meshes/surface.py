# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A triangle mesh as arrays: areas, volume, parts, edges."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array

Faces = NDArray[np.int64]


class MeshFaultError(ConfigError):
    """
    A mesh has a fault that is not repaired.

    Parameters
    ----------
    message
        What is wrong, and the remedy.
    point
        Where, in the axes that the mesh was worked on in, shape (3,); None: everywhere. Kept as
        an attribute.

    """

    def __init__(self, message: str, point: Array | None = None) -> None:
        super().__init__(message)
        self.point = point


@dataclass(frozen=True)
class Surface:
    """
    A triangle mesh.

    Attributes
    ----------
    vertices
        Corner points [m], shape (n, 3).
    faces
        Corners of each triangle, counter-clockwise seen from outside, shape (m, 3).

    """

    vertices: Array
    faces: Faces

    @property
    def triangles(self) -> Array:
        """The corners of each triangle [m], shape (m, 3, 3)."""
        corners: Array = self.vertices[self.faces]
        return corners

    def size(self) -> Array:
        """
        Return length, width and height of the box around the mesh.

        Returns
        -------
        [m], shape (3,).

        """
        extent: Array = np.ptp(self.vertices, axis=0)
        return extent

    def part(self, chosen: NDArray[np.bool_]) -> 'Surface':
        """
        Return some of the faces, with the vertices that they use, in the same order.

        Parameters
        ----------
        chosen
            Which faces, shape (m,).

        Returns
        -------
        Surface
            With vertices numbered anew.

        """
        kept, numbers = np.unique(self.faces[chosen], return_inverse=True)
        return Surface(self.vertices[kept], numbers.reshape(-1, 3))


def area_vectors(triangles: Array) -> Array:
    """
    Return normal times area of each triangle.

    Parameters
    ----------
    triangles
        Corners [m], shape (m, 3, 3).

    Returns
    -------
    [m^2], shape (m, 3).

    """
    a, b, c = np.moveaxis(triangles, 1, 0)
    vectors: Array = 0.5 * np.cross(b - a, c - a)
    return vectors


def areas(triangles: Array) -> Array:
    """
    Return the area of each triangle.

    Parameters
    ----------
    triangles
        Corners [m], shape (m, 3, 3).

    Returns
    -------
    [m^2], shape (m,).

    """
    result: Array = np.linalg.norm(area_vectors(triangles), axis=1)
    return result


def volume_and_center(triangles: Array) -> tuple[float, Array]:
    """
    Return the signed volume that closed triangles enclose, and its centre.

    Sum of signed tetrahedra (divergence theorem), exact for any closed mesh; negative where the
    faces point inward. As `physics.volume.mesh_volume`, without its checks.

    Parameters
    ----------
    triangles
        Corners [m], shape (m, 3, 3).

    Returns
    -------
    volume, center
        [m^3]; [m], shape (3,), of no meaning where the volume is 0.

    """
    origin = triangles.reshape(-1, 3).mean(axis=0)
    a, b, c = np.moveaxis(triangles - origin, 1, 0)
    parts = np.einsum('ij,ij->i', a, np.cross(b, c)) / 6.0
    volume = float(parts.sum())
    center = parts @ (a + b + c) / (4.0 * volume) if volume else np.zeros(3)
    return volume, origin + center


def directed_edges(faces: Faces) -> Faces:
    """
    Return the three edges of each face, all first edges before all second ones.

    Parameters
    ----------
    faces
        Shape (m, 3).

    Returns
    -------
    From, to; shape (3 m, 2). Edge k belongs to face k modulo m.

    """
    edges: Faces = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    return edges


def edge_keys(edges: Faces) -> NDArray[np.int64]:
    """
    Return one number per undirected edge.

    Parameters
    ----------
    edges
        From, to; shape (n, 2).

    Returns
    -------
    Equal for an edge and its reverse, shape (n,).

    """
    low, high = edges.min(axis=1), edges.max(axis=1)
    keys: NDArray[np.int64] = low * (int(edges.max(initial=0)) + 1) + high
    return keys


def face_pairs(faces: Faces) -> tuple[Faces, NDArray[np.bool_]]:
    """
    Return the pairs of faces that hang together at an edge.

    Where solids touch, four or more faces share an edge; they are paired in the order of the file,
    which lists one solid after the other. An odd face stays alone.

    Parameters
    ----------
    faces
        Shape (m, 3).

    Returns
    -------
    pairs, consistent
        Numbers of the faces, shape (n, 2); whether both run along the edge in opposite
        directions, as the faces of one side do, shape (n,).

    """
    edges = directed_edges(faces)
    keys, owner = edge_keys(edges), np.tile(np.arange(len(faces)), 3)
    order = np.lexsort((owner, keys))
    _, start, count = np.unique(keys[order], return_index=True, return_counts=True)
    place = np.arange(len(keys)) - np.repeat(start, count)
    first = np.flatnonzero((place % 2 == 0) & (place + 1 < np.repeat(count, count)))
    one, two = order[first], order[first + 1]
    pairs = np.stack([owner[one], owner[two]], axis=1)
    return pairs, edges[one, 0] != edges[two, 0]


def components(faces: Faces) -> tuple[int, NDArray[np.int64]]:
    """
    Return the parts that hang together over edges.

    Parameters
    ----------
    faces
        Shape (m, 3).

    Returns
    -------
    count, label
        Number of parts, and the part of each face, shape (m,), numbered by first face.

    """
    pairs, _ = face_pairs(faces)
    return labels(len(faces), pairs)


def labels(count: int, pairs: Faces) -> tuple[int, NDArray[np.int64]]:
    """
    Return the connected components of a graph.

    Parameters
    ----------
    count
        Of the nodes.
    pairs
        Nodes that hang together, shape (n, 2).

    Returns
    -------
    count, label
        Number of components, and that of each node, shape (count,), numbered by first node.

    """
    # as scipy's connected_components, whose import takes longer than most meshes
    root = np.arange(count)
    one, two = pairs.T
    while (apart := root[one] != root[two]).any():
        ends = root[pairs[apart]]
        np.minimum.at(root, ends.max(axis=1), ends.min(axis=1))
        while not np.array_equal(further := root[root], root):
            root = further
    firsts, label = np.unique(root, return_inverse=True)
    return len(firsts), label.reshape(-1)
