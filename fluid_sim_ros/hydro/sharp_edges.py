# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Sharp edges of a body, and panels that grow narrow towards them.

At an edge the potential goes like r^(2/3) and the velocity like r^(-1/3) (Lamb 1932, art. 63).
Even panels then converge slowly; cuts at distances like (k/n)^2 restore the order.
"""

import numpy as np

from fluid_sim_ros.hydro.meshes.surface import Surface, area_vectors, face_pairs
from fluid_sim_ros.hydro.quads import NOTHING, sound
from fluid_sim_ros.physics.arrays import Array

#: Two faces that turn by more than this make a sharp edge.
SHARP_ANGLE = np.radians(30.0)
_SIDES = 4
#: Lengths that a file in single precision leaves open.
_ROUNDING = 1e-6
_AT_ONCE = 4_000_000


def sharp_edges(surface: Surface) -> Array:
    """
    Return the edges at which a surface turns by more than `SHARP_ANGLE`.

    Parameters
    ----------
    surface
        Closed.

    Returns
    -------
    Ends of each edge, shape (n, 2, 3).

    """
    normals = area_vectors(surface.triangles)
    length = np.linalg.norm(normals, axis=1)
    unit = normals / np.maximum(length, 1e-300)[:, None]
    pairs, _ = face_pairs(surface.faces)
    one, two = pairs.T
    turn = np.einsum('ij,ij->i', unit[one], unit[two])
    # the direction of a sliver is rounding: it is nobody's edge
    whole = (length > NOTHING)[pairs].all(axis=1)
    sharp = whole & (turn < np.cos(SHARP_ANGLE))
    shared = [
        np.intersect1d(surface.faces[a], surface.faces[b])[:2]
        for a, b in zip(one[sharp], two[sharp], strict=True)
    ]
    ends: Array = surface.vertices[np.array(shared, dtype=np.int64).reshape(-1, 2)]
    return ends


def cut_towards_edges(
    panels: Array, edges: Array, depth: float, layers: int, most: int
) -> Array | None:
    """
    Return panels cut by lines parallel to the nearest sharp edge.

    Layer k ends at the distance depth (k/layers)^2 from the edge.

    Parameters
    ----------
    panels
        Flat and convex, three-cornered ones with the last corner twice, shape (n, 4, 3).
    edges
        Ends of the sharp edges, shape (m, 2, 3).
    depth
        Distance from the edge up to which is cut, in the unit of the panels.
    layers
        Their number within ``depth``.
    most
        Panels wanted at most.

    Returns
    -------
    Panels, shape (k, 4, 3); None: more than ``most`` would come out.

    """
    levels = depth * (np.arange(1, layers) / layers) ** 2
    if not len(edges) or len(panels) > most:
        return panels if len(panels) <= most else None
    inward = _distances(panels, edges)
    lowest, highest = inward.min(axis=1), inward.max(axis=1)
    slices = (lowest[:, None] < levels - _ROUNDING) & (highest[:, None] > levels + _ROUNDING)
    if len(panels) + np.count_nonzero(slices) > most:
        return None
    touched = np.isfinite(inward[:, 0]) & (inward.min(axis=1) < levels[-1])
    pieces = [panels[~touched]]
    for corners, distance in zip(panels[touched], inward[touched], strict=True):
        pieces.append(_sliced(corners, distance, levels))
    result = sound(np.concatenate(pieces))
    return result if len(result) <= most else None


def _distances(panels: Array, edges: Array) -> Array:
    """
    Return the distance of each corner from the line of the panel's nearest edge, in its plane.

    Nearest to the panel's centre; NaN where the panel does not lie beside that edge.
    """
    count = np.where((panels[:, 2] == panels[:, 3]).all(axis=1), 3, 4)
    middle = (panels[:, :3].sum(axis=1) + panels[:, 3] * (count == 4)[:, None]) / count[:, None]
    start, along = edges[:, 0], edges[:, 1] - edges[:, 0]
    square = np.maximum(np.einsum('ij,ij->i', along, along), 1e-300)
    nearest = np.zeros(len(panels), dtype=np.int64)
    step = max(1, _AT_ONCE // len(edges))
    for first in range(0, len(panels), step):
        arm = middle[first : first + step, None] - start
        share = np.clip(np.einsum('ijk,jk->ij', arm, along) / square, 0, 1)
        away = np.linalg.norm(arm - share[..., None] * along, axis=2)
        # the first of equals, so that rounding does not choose
        closest = away <= away.min(axis=1, keepdims=True) * (1 + 1e-5) + 1e-7
        nearest[first : first + step] = closest.argmax(axis=1)
    normal = np.cross(panels[:, 1] - panels[:, 0], panels[:, 2] - panels[:, 0])
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    direction = along[nearest] / np.sqrt(square[nearest])[:, None]
    across = np.cross(normal, direction)
    length = np.linalg.norm(across, axis=1)
    across = across / np.maximum(length, 1e-300)[:, None]
    reach = np.einsum('ij,ij->i', middle - start[nearest], across)
    across = across * np.where(reach < 0, -1.0, 1.0)[:, None]
    inward: Array = np.einsum('ijk,ik->ij', panels - start[nearest][:, None], across)
    inward[length < 0.5] = np.nan
    return inward


def _sliced(corners: Array, distance: Array, levels: Array) -> Array:
    """Return one panel sliced at the levels of a distance that is linear over it."""
    polygon = np.c_[corners, distance]
    if (corners[2] == corners[3]).all():
        polygon = polygon[:3]
    pieces = []
    for level in levels:
        if polygon[:, 3].min() < level - _ROUNDING and polygon[:, 3].max() > level + _ROUNDING:
            near, polygon = _cut(polygon, level)
            pieces += _panels(near[:, :3])
    pieces += _panels(polygon[:, :3])
    return np.array(pieces)


def _cut(polygon: Array, level: float) -> tuple[Array, Array]:
    near, far = [], []
    for here, there in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if here[3] <= level:
            near.append(here)
        if here[3] >= level:
            far.append(here)
        if (here[3] - level) * (there[3] - level) < 0:
            point = here + (level - here[3]) / (there[3] - here[3]) * (there - here)
            point[3] = level
            near.append(point)
            far.append(point)
    return np.array(near), np.array(far)


def _panels(polygon: Array) -> list[Array]:
    """Return a convex polygon as panels of four and three corners."""
    count = len(polygon)
    if count < 3:
        return []
    rest = []
    if count > _SIDES:
        rest = _panels(polygon[[0, *range(_SIDES - 1, count)]])
        polygon = polygon[:_SIDES]
    return [polygon if len(polygon) == _SIDES else polygon[[0, 1, 2, 2]], *rest]
