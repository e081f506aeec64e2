# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Thrust allocation: a wanted wrench becomes thrusts within their limits."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array

#: Axes of a wrench in the order of its six numbers.
AXES = ('fx', 'fy', 'fz', 'tx', 'ty', 'tz')
#: A thrust [N] that counts as none.
_NOTHING = 1e-12


class Allocator:
    """
    Allocates a wrench to thrusters by the pseudo-inverse, group by group when limits bind.

    Within limits u = B^+ w, the thrusts of least norm that give w (or come closest). Beyond
    them the wrench is built up in groups of axes, the most important first; each group is scaled
    by the largest factor in [0, 1] that keeps every thrust within its limits. So a group keeps
    its direction, no group takes from one before it, and the limits always hold.
    Method: prioritised direct scaling, after Durham (1993), J. Guidance 16(4).

    Parameters
    ----------
    matrix
        B, shape (6, n): wrench [N, N m] of each thruster at 1 N, body axes, about the centre of
        mass.
    limits
        Lowest and highest thrust [N], shape (n, 2); 0 must lie within.
    groups
        Axes (``AXES``) by importance, for example ``(('fz',), ('tx', 'ty'), ('tz',))``. Axes that
        stand in no group are not commanded.

    Raises
    ------
    ConfigError
        Shapes that do not fit, limits that exclude 0, an unknown or repeated axis.

    """

    def __init__(
        self, matrix: ArrayLike, limits: ArrayLike, groups: Sequence[Sequence[str]] = (AXES,)
    ) -> None:
        b = np.array(matrix, dtype=float)
        low_high = np.array(limits, dtype=float)
        if b.ndim != 2 or b.shape[0] != 6 or b.shape[1] == 0 or not np.isfinite(b).all():
            raise ConfigError(f'thruster matrix: shape {b.shape}; must be (6, n), n > 0, finite')
        if low_high.shape != (b.shape[1], 2):
            raise ConfigError(f'thrust limits: shape {low_high.shape}; must be ({b.shape[1]}, 2)')
        if not ((low_high[:, 0] <= 0).all() and (low_high[:, 1] >= 0).all()):
            raise ConfigError('thrust limits: 0 N must lie within the limits of every thruster')
        self.matrix = b
        self.limits = low_high
        #: Smallest factor that a group got in the last call; 1 when nothing was cut.
        self.scale = 1.0

        columns = [self._columns(group) for group in groups]
        used = [axis for group in columns for axis in group]
        if len(set(used)) != len(used):
            raise ConfigError(f'allocation groups {groups}: an axis stands twice')
        # pseudo-inverse of the commanded rows only: an axis that nobody asks for is free to move
        inverse = np.zeros((b.shape[1], 6))
        inverse[:, used] = np.linalg.pinv(b[used])
        # plain numbers: on so few of them, array calls take longer than the arithmetic
        self._rows = [tuple(row) for row in inverse.tolist()]
        self._groups = [_rows_of(inverse, group) for group in columns]
        self._limits = [(low, high) for low, high in low_high.tolist()]
        # within these every thrust is within its own limits
        self._low, self._high = float(low_high[:, 0].max()), float(low_high[:, 1].min())

    @staticmethod
    def _columns(group: Sequence[str]) -> list[int]:
        for axis in group:
            if axis not in AXES:
                raise ConfigError(f"allocation axis '{axis}'; allowed: {', '.join(AXES)}")
        return [AXES.index(axis) for axis in group]

    @property
    def rank(self) -> int:
        """Number of independent directions of the wrench that the thrusters reach."""
        return int(np.linalg.matrix_rank(self.matrix))

    def allocate(self, wrench_b: Sequence[float]) -> list[float]:
        """
        Return the thrusts for a wrench.

        Parameters
        ----------
        wrench_b
            Force [N] and torque [N m] about the centre of mass, body axes, six numbers.

        Returns
        -------
        Thrusts [N], one per thruster.

        """
        x, y, z, p, q, r = wrench_b
        thrusts = [
            a * x + b * y + c * z + d * p + e * q + f * r for a, b, c, d, e, f in self._rows
        ]
        self.scale = 1.0
        if self._low <= min(thrusts) and max(thrusts) <= self._high:
            return thrusts
        for thrust, (low, high) in zip(thrusts, self._limits, strict=True):
            if not low <= thrust <= high:
                return self._by_groups(wrench_b)
        return thrusts

    def _by_groups(self, wrench_b: Sequence[float]) -> list[float]:
        """Build the wrench up group by group, each as far as the limits allow."""
        limits = self._limits
        thrusts = [0.0] * len(limits)
        for rows in self._groups:
            wanted = _times(rows, wrench_b)
            factor = 1.0
            for want, thrust, (low, high) in zip(wanted, thrusts, limits, strict=True):
                if want > _NOTHING:
                    share = (high - thrust) / want
                elif want < -_NOTHING:
                    share = (low - thrust) / want
                else:
                    continue
                if share < factor:
                    factor = share if share > 0.0 else 0.0  # below 0 by rounding only
            if factor < self.scale:
                self.scale = factor
            thrusts = [
                # beyond the limits by rounding only
                low if (t := thrust + factor * want) < low else (high if t > high else t)
                for want, thrust, (low, high) in zip(wanted, thrusts, limits, strict=True)
            ]
        return thrusts


_Rows = list[tuple[float, ...]]


def _rows_of(inverse: Array, columns: list[int]) -> _Rows:
    """Return the inverse with all columns but those of one group set to zero."""
    share = np.zeros_like(inverse)
    share[:, columns] = inverse[:, columns]
    return [tuple(row) for row in share.tolist()]


def _times(rows: _Rows, wrench: Sequence[float]) -> list[float]:
    x, y, z, p, q, r = wrench
    return [a * x + b * y + c * z + d * p + e * q + f * r for a, b, c, d, e, f in rows]
