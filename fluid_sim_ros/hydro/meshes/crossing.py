# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Whether a closed surface crosses itself, by the solid angle that it fills.

Just outside of a face a closed surface fills no solid angle, just inside 4 pi. Where it crosses
itself, a face lies inside the body, or beside a part that is inside out, and one of both differs.
"""

import numpy as np

from fluid_sim_ros.hydro.meshes.simplify import decimated
from fluid_sim_ros.hydro.meshes.surface import Surface, area_vectors
from fluid_sim_ros.physics.arrays import Array

#: Faces looked at; those of a mesh that is looked at as it is; solid angles evaluated at once.
_SAMPLE = 600
_FACES = 6000
_AT_ONCE = 500_000
#: So many faces of a simplified mesh must be wrong: simplifying may fold a few.
_FEW = 3


def winding_numbers(points: Array, triangles: Array) -> Array:
    """
    Return how often closed triangles wind around points.

    Solid angle of each triangle by van Oosterom and Strackee (1983), IEEE Trans. Biomed. Eng. 30,
    summed, over 4 pi.

    Parameters
    ----------
    points
        Not on the surface [m], shape (n, 3).
    triangles
        Corners [m], shape (m, 3, 3).

    Returns
    -------
    1 inside, 0 outside, shape (n,).

    """
    result = np.empty(len(points))
    step = max(1, _AT_ONCE // max(1, len(triangles)))
    for start in range(0, len(points), step):
        a, b, c = np.moveaxis(triangles[None] - points[start : start + step, None, None], 2, 0)
        la, lb, lc = (np.linalg.norm(x, axis=-1) for x in (a, b, c))
        above = np.einsum('ijk,ijk->ij', a, np.cross(b, c))
        below = la * lb * lc
        for one, two, length in ((a, b, lc), (b, c, la), (c, a, lb)):
            below += np.einsum('ijk,ijk->ij', one, two) * length
        result[start : start + step] = np.arctan2(above, below).sum(axis=1) / (2 * np.pi)
    return result


def crossing_point(surface: Surface) -> Array | None:
    """
    Return a point on a face of which one side is not outside or the other is not inside.

    Parameters
    ----------
    surface
        Closed, in its own frame (radius 1). An even sample of the faces is looked at, of a large
        mesh those of a simpler one.

    Returns
    -------
    Shape (3,), or None: no crossing was found.

    """
    simple = len(surface.faces) > _FACES
    if simple:
        surface = decimated(surface, _FACES)
    triangles = surface.triangles
    normals = area_vectors(triangles)
    doubled = 2 * np.linalg.norm(normals, axis=1)
    fit = np.flatnonzero(doubled > 1e-12)
    chosen = fit[:: max(1, len(fit) // _SAMPLE)]
    middle = triangles[chosen].mean(axis=1)
    unit = normals[chosen] / np.linalg.norm(normals[chosen], axis=1, keepdims=True)
    # close to the face, measured by its own size, but beyond rounding
    off = unit * np.maximum(1e-3 * np.sqrt(doubled[chosen]), 1e-7)[:, None]
    outside = np.rint(winding_numbers(middle + off, triangles))
    inside = np.rint(winding_numbers(middle - off, triangles))
    wrong = np.flatnonzero((outside != 0) | (inside != 1))
    if len(wrong) < (_FEW if simple else 1):
        return None
    point: Array = middle[wrong[0]]
    return point
