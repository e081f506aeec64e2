# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which geoms of a model are drawn, which of them move as one, and in which colours."""

from collections.abc import Sequence

import mujoco

from fluid_sim_ros.physics.arrays import Array


def welded(model: mujoco.MjModel) -> dict[int, list[int]]:
    """
    Return the geoms that move as one, by the body whose pose they follow.

    Parameters
    ----------
    model
        The compiled model.

    Returns
    -------
    dict
        Body id -> ids of the geoms that are drawn: those that are visible, of the groups that
        MuJoCo's viewer shows.

    """
    found: dict[int, list[int]] = {}
    for geom in range(model.ngeom):
        if model.geom_group[geom] > 2 or _rgba(model, geom)[3] == 0.0:
            continue
        root = int(model.body_weldid[model.geom_bodyid[geom]])
        found.setdefault(root, []).append(geom)
    return found


def _rgba(model: mujoco.MjModel, geom: int) -> Array:
    material = int(model.geom_matid[geom])
    rgba: Array = model.mat_rgba[material] if material >= 0 else model.geom_rgba[geom]
    return rgba


def colors(model: mujoco.MjModel, geoms: Sequence[int]) -> dict[tuple[float, ...], list[int]]:
    """
    Return geoms by their colour.

    Parameters
    ----------
    model
        The compiled model.
    geoms
        Their ids.

    Returns
    -------
    dict
        (red, green, blue, opacity), 0 to 1 -> ids.

    """
    found: dict[tuple[float, ...], list[int]] = {}
    for geom in geoms:
        found.setdefault(tuple(float(x) for x in _rgba(model, geom)), []).append(geom)
    return found
