# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
``fluid_sim doctor``: what is installed and works, what is missing, and what to type.

Every check looks at the real thing: it loads the library, makes a rendering context, imports the
messages. A check that could take the process down runs in a process of its own.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from fluid_sim_ros.cli.doctor.machine import machine_checks, rendering
from fluid_sim_ros.cli.doctor.optional import optional_parts
from fluid_sim_ros.cli.doctor.ros import ros_checks
from fluid_sim_ros.cli.doctor.row import Row

if TYPE_CHECKING:
    from rich.table import Table

__all__ = ['Row', 'examine', 'table', 'works']


def examine() -> list[Row]:
    """
    Run every check.

    Returns
    -------
    rows
        In the order of the table.

    """
    return [*machine_checks(), *ros_checks(), rendering(), *optional_parts()]


def works(rows: Sequence[Row]) -> bool:
    """
    Return whether nothing is broken; what is merely absent does not count.

    Parameters
    ----------
    rows
        Of ``examine``.

    """
    return all(row.state != 'broken' for row in rows)


def table(rows: Sequence[Row]) -> 'Table':
    """
    Return the rows as a table for the terminal.

    Parameters
    ----------
    rows
        Of ``examine``.

    """
    from rich.markup import escape
    from rich.table import Column, Table

    colours = {'ok': 'green', 'absent': 'yellow', 'broken': 'red'}
    headers = [Column(name, overflow='fold') for name in ('part', 'state', 'found', 'what to do')]
    result = Table(*headers, title='fluid_sim doctor')
    for row in rows:
        state = f'[{colours[row.state]}]{row.state}[/]'
        result.add_row(row.name, state, escape(row.found), escape(row.remedy))
    return result
