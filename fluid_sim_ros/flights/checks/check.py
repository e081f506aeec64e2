# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a check of a flight's signals says."""

from dataclasses import dataclass

import numpy as np

#: Clock offsets that are tried [s].
LAGS = np.arange(-0.3, 0.3001, 0.005)


@dataclass(frozen=True)
class Check:
    """
    One signal, or a pair of them.

    Attributes
    ----------
    what
        The pair in words.
    quantity
        The signal that is checked.
    error
        What of the change is not explained, as a share [-]; None: too little motion to tell.
    offset
        The checked signal's clock minus that of the other [s], where it can be told.
    finding
        What is wrong, '' where nothing is.
    sure
        Whether a flight with the finding cannot be right; else it is said, and used.

    """

    what: str
    quantity: str
    error: float | None
    offset: float | None
    finding: str = ''
    sure: bool = True
