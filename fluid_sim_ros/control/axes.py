# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which axes of a wrench a set of thrusters reaches, each by itself."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.control.allocation import AXES

#: What people call the axes, and what is not held where one is missing.
NAMES = {
    'fx': 'surge', 'fy': 'sway', 'fz': 'heave', 'tx': 'roll', 'ty': 'pitch', 'tz': 'yaw',
}  # fmt: skip
#: An axis is reached where at least this share of it is independent of those before it.
_INDEPENDENT = 1e-3


def reached_axes(matrix: ArrayLike, priority: Sequence[str]) -> tuple[str, ...]:
    """
    Return the axes that can be commanded independently of each other.

    Rows of the thruster matrix are taken in the order of priority, each where it does not depend
    on those taken before (Gram-Schmidt); forces and torques are compared by their largest rows.

    Parameters
    ----------
    matrix
        Wrench [N, N m] of each thruster at 1 N, body axes, about the centre of mass, shape
        (6, n).
    priority
        Axes (``AXES``), the most important first.

    Returns
    -------
    tuple
        Those of them that are reached, in their order.

    """
    b = np.array(matrix, dtype=float)
    for rows in (slice(0, 3), slice(3, 6)):
        largest = np.linalg.norm(b[rows], axis=1).max()
        if largest > 0:
            b[rows] /= largest
    taken: list[str] = []
    basis: list[np.ndarray] = []
    for axis in priority:
        row = b[AXES.index(axis)]
        rest = row - sum(
            (direction * (direction @ row) for direction in basis), np.zeros(len(row))
        )
        length = float(np.linalg.norm(rest))
        if length > _INDEPENDENT:
            taken.append(axis)
            basis.append(rest / length)
    return tuple(taken)
