# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How the laboratory tells how far it is."""

from collections.abc import Callable

#: Arguments: what is being done, how far it is, and of how many.
Report = Callable[[str, int, int], None]


def silent(what: str, done: int, total: int) -> None:
    """
    Tell nobody: the default ``Report``.

    Parameters
    ----------
    what, done, total
        Passed over.

    """
