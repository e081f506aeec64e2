# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The free surface of a model's medium."""

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.native import native

#: What ``surface_heights`` says of a surface.
NO_SURFACE, LEVEL, WAVES = 0, 1, 2


def surface_heights(
    model: mujoco.MjModel, data: mujoco.MjData, points: Array
) -> tuple[int, Array]:
    """
    Return the heights of the free surface over points, at the data's time.

    Parameters
    ----------
    model, data
        Of a simulation.
    points
        x and y in the world [m], shape (n, 2).

    Returns
    -------
    kind
        ``NO_SURFACE``, ``LEVEL`` or ``WAVES``.
    heights
        World z [m], shape (n,); zeros without a surface.

    """
    points = np.ascontiguousarray(points, dtype=np.float64)
    heights = np.zeros(len(points))
    kind = native().surface(
        model._address, data._address, points.ctypes.data, len(points), heights.ctypes.data
    )
    return kind, heights
