# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The waves of a model as a patch of triangles in a picture."""

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import surface

#: Cells per side of the patch, the size of those in the middle in extents of the vehicle, and how
#: much larger they become outwards: the patch reaches about 75 extents.
_CELLS, _CELL, _SPREAD = 48, 0.5, 4.2
WATER = np.array([0.15, 0.45, 0.6, 0.45], dtype=np.float32)
#: Times the colour: in the deepest trough and on the highest crest, whose slopes are gentle.
_TROUGH, _CREST = (np.array([shade, shade, shade, 1.0], dtype=np.float32) for shade in (0.6, 1.5))
#: From the cell's corner (two are its far one) to the ends of the two edges of each triangle.
_CORNERS = (((0, 0), (1, 0), (0, 1)), ((1, 1), (0, 1), (1, 0)))


def surface_heights(model: mujoco.MjModel, data: mujoco.MjData, points: Array) -> Array | None:
    """
    Return the heights of the waves over points, at the data's time.

    Parameters
    ----------
    model, data
        A simulation of it.
    points
        x and y in the world [m], shape (n, 2).

    Returns
    -------
    Array or None
        [m], shape (n,); None for a model whose surface has no waves.

    """
    kind, heights = surface.surface_heights(model, data, points)
    return heights if kind == surface.WAVES else None


def add_waves(
    scene: mujoco.MjvScene,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    center: Array,
    extent: float,
) -> None:
    """
    Add the waves around a point to a scene; nothing for a model without waves.

    Parameters
    ----------
    scene
        To which the triangles are added.
    model, data
        Whose time it is.
    center
        Middle of the patch, world [m].
    extent
        Of the vehicle [m]; sets the size of the triangles.

    """
    cell = _CELL * extent
    # on a grid that stays where it is, so that the surface does not shimmer as the vehicle moves
    middle = np.round(np.asarray(center)[:2] / cell)
    share = np.linspace(-1.0, 1.0, _CELLS + 1)
    ticks = np.sinh(_SPREAD * share) / _SPREAD * (_CELLS // 2)
    grid = (middle + np.stack(np.meshgrid(ticks, ticks, indexing='ij'), axis=-1)) * cell
    heights = surface_heights(model, data, grid.reshape(-1, 2))
    if heights is None:
        return
    nodes = np.concatenate([grid, heights.reshape(*ticks.shape, -1)[..., np.newaxis]], axis=-1)
    # a cell has one shade, by the height of its first corner
    shades = (nodes[:-1, :-1, 2].ravel() - heights.min()) / max(float(np.ptp(heights)), 1e-9)
    for corners in _CORNERS:
        at, right, left = (
            nodes[i : _CELLS + i, j : _CELLS + j].reshape(-1, 3) for i, j in corners
        )
        edges = np.stack([right - at, left - at], axis=-1)
        normal = np.cross(edges[..., 0], edges[..., 1])
        # the renderer's triangle is (0, 0), (1, 0), (0, 1) of its frame: the edges are its axes
        axes = np.concatenate([edges, normal[..., np.newaxis]], axis=-1).reshape(-1, 9)
        for place, frame, shade in zip(at, axes, shades, strict=True):
            if scene.ngeom >= scene.maxgeom:
                return
            mujoco.mjv_initGeom(
                scene.geoms[scene.ngeom], mujoco.mjtGeom.mjGEOM_TRIANGLE,
                np.ones(3), place, frame, WATER * (_TROUGH + shade * (_CREST - _TROUGH)),
            )  # fmt: skip
            scene.ngeom += 1
