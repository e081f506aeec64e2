# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Tables for a terminal of 80 columns: a column that says nothing is left out."""

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table

#: What is below this is noise of the arithmetic, and shown as 0.
_NOISE = 1e-12


def table_of(
    headers: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    idle: Collection[str] = ('',),
    whole: bool = True,
    **settings: Any,
) -> 'Table':
    """
    Return a table without the columns in which every cell is an idle one.

    Parameters
    ----------
    headers
        Of the columns; plain text.
    rows
        Cells; plain text.
    idle
        Cells that say nothing.
    whole
        Whether the first column never wraps.
    **settings
        Of ``rich.table.Table``, such as ``title``.

    Returns
    -------
    Table
        Its columns fold where the terminal is too narrow.

    """
    from rich.markup import escape
    from rich.table import Column, Table

    kept = [i for i in range(len(headers)) if not rows or any(row[i] not in idle for row in rows)]
    columns = [
        Column(escape(headers[i]), overflow='fold', no_wrap=whole and place == 0)
        for place, i in enumerate(kept)
    ]
    table = Table(*columns, **settings)
    for row in rows:
        table.add_row(*(escape(row[i]) for i in kept))
    return table


def short(value: float) -> str:
    """
    Return a number with five digits; 0 for what is only noise.

    Parameters
    ----------
    value
        Any number.

    """
    return f'{0.0 if abs(value) < _NOISE else value:.5g}'
