# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Numbers, words and matrices of a seed: most of them usual, some at the ends of the allowed."""

import math
from random import Random

import numpy as np
from numpy.typing import ArrayLike

Keys = dict[str, str]

#: Numbers that few have tried, all of them finite.
_FAR = (0.0, -0.0, 5e-324, 1e-300, -1e-300, 1e-30, 1e15, -1e15, 1e100, -1e100, 1e150, -1e150)
_SHARE_FAR = 0.03


class Draw(Random):
    """
    What a seed draws.

    Parameters
    ----------
    seed
        Text or number; the same one draws the same.

    """

    def yes(self, share: float = 0.5) -> bool:
        """Return True with a probability."""
        return self.random() < share

    def size(self, low: float, high: float, *, far: tuple[float, ...] = ()) -> float:
        """Return a number > 0, spread evenly over the powers of ten; seldom one of ``far``."""
        if far and self.yes(_SHARE_FAR):
            return self.choice(far)
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def zero_or_size(self, low: float, high: float) -> float:
        """Return a number >= 0."""
        return 0.0 if self.yes(0.1) else self.size(low, high, far=(1e-300, 1e12))

    def signed(self, scale: float = 1.0) -> float:
        """Return a number of either sign; seldom one that few have tried."""
        return self.choice(_FAR) if self.yes(_SHARE_FAR) else self.gauss(0, scale)

    def vector(self, scale: float = 1.0, count: int = 3) -> str:
        """Return numbers of either sign."""
        return written([self.signed(scale) for _ in range(count)])

    def unit(self) -> str:
        """Return a direction."""
        if self.yes():
            return self.choice(('1 0 0', '0 1 0', '0 0 1', '0 0 -1'))
        found = np.array([self.gauss(0, 1) for _ in range(3)])
        return written(found / np.linalg.norm(found))

    def semidefinite(self, scale: float) -> np.ndarray:
        """Return a symmetric positive semi-definite matrix, shape (6, 6)."""
        rank = self.choice((1, 3, 6, 6))
        root = np.array([[self.gauss(0, 1) for _ in range(rank)] for _ in range(6)])
        return scale * root @ root.T

    def some(self, keys: Keys, share: float = 0.5) -> Keys:
        """Return some of the keys."""
        return {key: value for key, value in keys.items() if self.yes(share)}


def written(values: ArrayLike) -> str:
    """Return numbers with all their digits, of any shape."""
    return ' '.join(f'{value:.17g}' for value in np.asarray(values, dtype=float).reshape(-1))
