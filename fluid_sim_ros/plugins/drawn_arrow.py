# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Arrows in pictures: their measure, and how one gets into a picture of MuJoCo's."""

from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array

_ARROW, _LABEL = mujoco.mjtGeom.mjGEOM_ARROW, mujoco.mjtGeom.mjGEOM_LABEL


def add_arrow(
    scene: Any, start: Array, along: Array, width: float, color: Array, label: str = ''
) -> bool:
    """
    Add an arrow to a scene, if there is room.

    Of the length that ``mjv_connector`` gives an arrow MuJoCo 4.0 draws half: it is doubled here.

    Parameters
    ----------
    scene
        ``MjvScene``.
    start, along
        Where it begins, and where its tip is from there, world axes [m], shape (3,).
    width
        Of its shaft [m].
    color
        Red, green, blue and opacity, 0 to 1, shape (4,).
    label
        Is written beyond its tip.

    Returns
    -------
    bool
        Whether there was room.

    """
    if scene.ngeom + 2 > scene.maxgeom:
        return False
    shade = np.asarray(color, dtype=np.float32)
    arrow = scene.geoms[scene.ngeom]
    mujoco.mjv_initGeom(arrow, _ARROW, np.zeros(3), np.zeros(3), np.zeros(9), shade)
    mujoco.mjv_connector(arrow, _ARROW, width, start, start + along)
    arrow.size[2] *= 2.0
    scene.ngeom += 1
    if label:
        tip = scene.geoms[scene.ngeom]
        place = start + 1.1 * along
        mujoco.mjv_initGeom(tip, _LABEL, np.full(3, width), place, np.eye(3).ravel(), shade)
        tip.label = label
        scene.ngeom += 1
    return True


def extent(model: mujoco.MjModel, base: int) -> float:
    """
    Return how far the geoms of a body, and of all below it, reach from its origin.

    Parameters
    ----------
    model
        The compiled model.
    base
        Id of the body.

    Returns
    -------
    float
        [m]; 0.1 for a body without geoms.

    """
    reach = 0.0
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        offset = float(np.linalg.norm(model.geom_pos[geom]))
        while body > base:
            offset += float(np.linalg.norm(model.body_pos[body]))
            body = int(model.body_parentid[body])
        if body == base:
            reach = max(reach, offset + min(float(model.geom_rbound[geom]), 1e3))
    return reach or 0.1
