"""What the subcommands of ``fluid_sim`` share."""

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.errors import needed_for

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress, ProgressColumn

    from fluid_sim_ros.lab.progress import Report

#: Shows a table, or writes a result as JSON: (path or None, table, result).
Show = Callable[[str | None, Any, object], None]

JSON_HELP = 'also write the result as JSON; - is standard output'


def add_command(
    commands: Any,
    name: str,
    text: str,
    function: Callable[[argparse.Namespace, Show], int],
    show: Show,
) -> argparse.ArgumentParser:
    """
    Add a subcommand with --json; a package that it lacks becomes one line of what to do.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    name
        Of the subcommand.
    text
        What it does, in a line.
    function
        Runs it: takes parsed options and ``show``, returns the exit code.
    show
        Shows table and JSON.

    Returns
    -------
    ArgumentParser
        Of the subcommand, with ``--json``.

    """

    def run(arguments: argparse.Namespace) -> int:
        with needed_for(name):
            return function(arguments, show)

    parser: argparse.ArgumentParser = commands.add_parser(name, help=text, description=text)
    parser.add_argument('--json', metavar='PATH', help=JSON_HELP)
    parser.set_defaults(function=run)
    return parser


def plain_lines(console: 'Console') -> Callable[[str], None]:
    """
    Return what shows a line of text as it is: what looks like markup is none.

    Parameters
    ----------
    console
        Where it is shown.

    """

    def show(line: str) -> None:
        console.out(line, highlight=False)

    return show


def progress_bar(*columns: 'str | ProgressColumn') -> 'Progress':
    """
    Return a bar on standard error, so that standard output holds the result only.

    Parameters
    ----------
    *columns
        Of rich, between the bar and the remaining time.

    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    return Progress(
        TextColumn('{task.description}'), BarColumn(), *columns, TimeRemainingColumn(),
        console=console, transient=True, disable=not console.is_terminal,
    )  # fmt: skip


@contextmanager
def progress_of_parts() -> Iterator['Report']:
    """
    Give a function that shows how far a measurement is, on standard error.

    Returns
    -------
    context manager
        Gives a function that takes what is done, how many, and of how many.

    """
    with progress_bar('{task.completed}/{task.total}') as bar:
        tasks: dict[str, Any] = {}

        def report(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what, total=total)
            bar.update(tasks[what], completed=done, visible=done < total)

        yield report
