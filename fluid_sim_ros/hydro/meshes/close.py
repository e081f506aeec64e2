# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Faces of a part turned to one side, and its holes closed with lids."""

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.hydro.meshes.surface import (
    Faces,
    MeshFaultError,
    Surface,
    area_vectors,
    areas,
    face_pairs,
    labels,
)
from fluid_sim_ros.hydro.meshes.weld import open_edges
from fluid_sim_ros.physics.arrays import Array

#: A lid may be this far from flat, of its own size; a lid of a small hole any way it is.
_FLAT = 0.1
_SMALL = 0.1  # of the mesh's radius


def turned_to_one_side(surface: Surface) -> tuple[Surface, int]:
    """
    Return a mesh whose neighbouring faces agree on which side is outside.

    A face and its reverse are two nodes; neighbours tie the nodes that agree. Where both nodes of
    a face end in one group the surface has one side only.

    Parameters
    ----------
    surface
        Welded.

    Returns
    -------
    surface, turned
        The mesh, and how many faces were turned; of each part the smaller share.

    Raises
    ------
    MeshFaultError
        If a part has one side only (a Moebius band).

    """
    faces, count = surface.faces, len(surface.faces)
    pairs, agree = face_pairs(faces)
    one, two = pairs.T
    same = np.stack([one, two + np.where(agree, 0, count)], axis=1)
    other = np.stack([one + count, two + np.where(agree, count, 0)], axis=1)
    _, group = labels(2 * count, np.concatenate([same, other]))
    if (group[:count] == group[count:]).any():
        raise MeshFaultError(
            'the surface has one side only (a Moebius band); mend it in a modelling program',
            _middle(surface, group[:count] == group[count:]),
        )
    _, part = labels(count, pairs)
    # of the two senses of each part, the one that most of its faces have
    first = np.zeros(part.max() + 1, dtype=np.int64)
    first[part[::-1]] = group[:count][::-1]
    backward = group[:count] != first[part]
    share = np.bincount(part, weights=backward) / np.bincount(part)
    backward ^= share[part] > 0.5
    turned = faces.copy()
    turned[backward] = turned[backward][:, ::-1]
    return Surface(surface.vertices, turned), int(backward.sum())


def with_lids(surface: Surface) -> tuple[Surface, list[float]]:
    """
    Return a mesh with a fan of triangles over each hole.

    Parameters
    ----------
    surface
        All faces of a part on one side; in its own frame (radius 1).

    Returns
    -------
    surface, widths
        The mesh, and the largest width of each hole, of the radius.

    Raises
    ------
    MeshFaultError
        If the edges of a hole branch, or it is too large and too far from flat for a lid.

    """
    vertices, faces, widths = surface.vertices, [surface.faces], []
    for loop in _loops(open_edges(surface.faces), vertices):
        rim = vertices[loop]
        middle = rim.mean(axis=0)
        width = 2 * float(np.linalg.norm(rim - middle, axis=1).max())
        fan = np.stack([np.roll(loop, -1), loop, np.full_like(loop, len(vertices))], axis=1)
        height = _out_of_plane(rim, middle)
        if width > _SMALL and height > _FLAT * width:
            raise MeshFaultError(
                f'a hole of {len(loop)} edges is {height / width:.0%} of its width out of flat: '
                'no lid fits; close it in a modelling program',
                middle,
            )
        vertices = np.concatenate([vertices, middle[None]])
        faces.append(fan)
        widths.append(width)
    return Surface(vertices, np.concatenate(faces)), widths


def _out_of_plane(rim: Array, middle: Array) -> float:
    """Return how far the rim is from its own plane."""
    spokes = np.stack([rim, np.roll(rim, -1, axis=0), np.broadcast_to(middle, rim.shape)], axis=1)
    normal = area_vectors(spokes).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length == 0 or length < 1e-9 * areas(spokes).sum():
        return float(np.linalg.norm(rim - middle, axis=1).max())
    return float(np.abs((rim - middle) @ normal).max() / length)


def _loops(edges: Faces, vertices: Array) -> list[NDArray[np.int64]]:
    """Return the vertices around each hole, in the direction of the faces."""
    following: dict[int, list[int]] = {}
    for start, end in edges.tolist():
        following.setdefault(start, []).append(end)
    loops = []
    while following:
        path = [next(iter(following))]
        place = {path[0]: 0}
        while path:
            here = path[-1]
            ends = following.get(here)
            if not ends:
                raise MeshFaultError(
                    'more than two faces meet at an edge, or the edges of a hole branch; mend it '
                    'in a modelling program',
                    vertices[here],
                )
            end = ends.pop()
            if not ends:
                del following[here]
            if end in place:  # a loop closes here
                at = place[end]
                loops.append(np.array(path[at:], dtype=np.int64))
                for vertex in path[at + 1 :]:
                    del place[vertex]
                path = path[: at + 1]
                if at == 0 and end not in following:
                    break
                continue
            place[end] = len(path)
            path.append(end)
    return [loop for loop in loops if len(loop) > 2]


def _middle(surface: Surface, chosen: NDArray[np.bool_]) -> Array:
    """Return the centre of some faces."""
    middle: Array = surface.triangles[chosen].reshape(-1, 3).mean(axis=0)
    return middle
