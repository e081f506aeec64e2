# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How long work tells how far it is, and how that is shown on standard error."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.interruption import owns

if TYPE_CHECKING:
    from rich.progress import Progress, ProgressColumn

#: Arguments: what is being done, how far it is, and of how many.
Report = Callable[[str, int, int], None]

#: Outside of a terminal a long part tells how far it is so often [s].
_TELL_EVERY = 10.0
#: Work on a log of usual size is done by then, and tells nothing outside of a terminal [s].
LOG_PATIENCE = 5.0


def silent(what: str, done: int, total: int) -> None:
    """
    Tell nobody: the default ``Report``.

    Parameters
    ----------
    what, done, total
        Passed over.

    """


def status_line() -> 'Progress':
    """Return a line on standard error that is written anew, in place of a bar."""
    from rich.progress import Progress, TextColumn
    from rich.table import Column

    from fluid_sim_ros.output.plain_console import PlainConsole

    owns()  # a line without a cursor
    console = PlainConsole(stderr=True)
    text = TextColumn(
        '{task.description}', markup=False, table_column=Column(no_wrap=True, overflow='ellipsis')
    )
    return Progress(text, console=console, transient=True, disable=not console.is_terminal)


def progress_bar(*columns: 'str | ProgressColumn') -> 'Progress':
    """
    Return a bar on standard error, so that standard output holds the result only.

    Parameters
    ----------
    *columns
        Of rich, between the bar and the remaining time.

    """
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    from fluid_sim_ros.output.plain_console import PlainConsole

    owns()
    console = PlainConsole(stderr=True)
    name = TextColumn('{task.description}', markup=False)
    return Progress(
        name, BarColumn(), *columns, TimeRemainingColumn(),
        console=console, transient=True, disable=not console.is_terminal,
    )  # fmt: skip


@contextmanager
def progress_of_parts(patience: float = 0.0) -> Iterator[Report]:
    """
    Give a function that shows how far a measurement is, on standard error.

    A bar that lives in a terminal; elsewhere a line for each part as it begins, and for a long
    one now and then.

    Parameters
    ----------
    patience
        Parts that take less tell nothing outside of a terminal [s].

    Returns
    -------
    context manager
        Gives a function that takes what is done, how many, and of how many.

    """
    from rich.progress import TimeElapsedColumn

    with progress_bar('{task.completed}/{task.total}', TimeElapsedColumn()) as bar:
        tasks: dict[str, Any] = {}
        told: dict[str, float] = {}

        def report(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what, total=total)
            bar.update(tasks[what], completed=done, visible=done < total)
            now = time.monotonic()
            last = told.setdefault(what, now + patience - _TELL_EVERY)
            begun = done > 0 or not patience
            if bar.disable and begun and done < total and now >= last + _TELL_EVERY:
                told[what] = now
                sys.stderr.write(f'{what}: {done} of {total}\n')

        yield report
