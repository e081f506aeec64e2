# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A frame that a mesh carries with it, so that a turned mesh is worked on in the same way.

Repair, simplification and panels make choices that depend on the last digit of a coordinate. In
this frame a mesh and its turned, moved or scaled copy have the same coordinates to ten digits, and
so the same coefficients.
"""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.hydro.meshes.surface import Surface, areas
from fluid_sim_ros.physics.arrays import Array

#: Digits of a coordinate in units of the mesh's radius; a turn leaves an error of 1e-15.
_DIGITS = 10
#: Of the largest distance: the first vertex beyond it sets an axis. No ratio of a regular shape.
_FAR = 0.4837


@dataclass(frozen=True)
class Frame:
    """
    Where a mesh is: ``point = origin + length * rotation @ point_c``.

    Attributes
    ----------
    origin
        Of the frame, in mesh axes [m], shape (3,).
    rotation
        Turns components in the frame c into components in mesh axes, shape (3, 3).
    length
        Unit of length of the frame [m].

    """

    origin: Array
    rotation: Array
    length: float

    def inward(self, points: Array) -> Array:
        """
        Return points of the mesh in this frame.

        Parameters
        ----------
        points
            Mesh axes [m], shape (..., 3).

        Returns
        -------
        In units of ``length``, shape (..., 3).

        """
        result: Array = (points - self.origin) @ self.rotation / self.length
        return result

    def outward(self, points_c: Array) -> Array:
        """
        Return points of this frame in mesh axes.

        Parameters
        ----------
        points_c
            In units of ``length``, shape (..., 3).

        Returns
        -------
        Mesh axes [m], shape (..., 3).

        """
        result: Array = self.origin + self.length * points_c @ self.rotation.T
        return result


def framed(surface: Surface) -> tuple[Surface, Frame]:
    """
    Return a mesh in its own frame.

    Origin: the centre of the area. Axes: towards the first vertex that is far from it, and towards
    the first one that is far from that axis; the file's order of vertices decides, which a turn
    leaves as it is.

    Parameters
    ----------
    surface
        Any triangles whose vertices do not all lie on a line.

    Returns
    -------
    surface, frame
        Coordinates in units of the mesh's radius, rounded to 1e-10.

    """
    corners = surface.triangles
    weight = areas(corners)
    origin = weight @ corners.mean(axis=1) / weight.sum()
    arms = surface.vertices - origin
    distance = np.linalg.norm(arms, axis=1)
    length = float(distance.max())
    first = arms[int(np.argmax(distance > _FAR * length))]
    x = first / np.linalg.norm(first)
    beside = arms - np.outer(arms @ x, x)
    away = np.linalg.norm(beside, axis=1)
    second = beside[int(np.argmax(away > _FAR * away.max()))]
    y = second / np.linalg.norm(second)
    frame = Frame(origin, np.stack([x, y, np.cross(x, y)], axis=1), length)
    return Surface(np.round(frame.inward(surface.vertices), _DIGITS), surface.faces), frame
