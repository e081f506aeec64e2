# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the subcommands of ``fluid_sim`` share."""

import argparse
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.errors import MOST_LINE, ConfigError, needed_for, printable
from fluid_sim_ros.interruption import owns

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

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


def add_scene(
    parser: argparse.ArgumentParser, *, nargs: str | None = None, help: str = ''
) -> None:
    """
    Add the positional argument ``scene``, which shells complete.

    Parameters
    ----------
    parser
        Of a subcommand.
    nargs
        As of argparse.
    help
        What it is for; default: what is allowed.

    """
    text = help or 'name (fluid_sim scenes), or an MJCF or YAML file'
    action = parser.add_argument('scene', metavar='SCENE', nargs=nargs, help=text)
    completion.completed_by(action, completion.scenes)


def console() -> 'Console':
    """Return the console that results are shown on."""
    from fluid_sim_ros.output.plain_console import PlainConsole

    return PlainConsole()


def plain_text(lines: Iterable[str]) -> str:
    """
    Return lines for the console: no markup, no control characters, each cut.

    Parameters
    ----------
    lines
        With texts of files in them.

    """
    from rich.markup import escape

    return escape('\n'.join(printable(line, MOST_LINE) for line in lines))


def unbroken(lines: 'Iterable[str | Path]') -> 'Text':
    """
    Return lines that are not wrapped: paths that are to be copied.

    Parameters
    ----------
    lines
        One line each.

    Returns
    -------
    Text
        For rich.

    """
    from rich.text import Text

    return Text('\n'.join(map(str, lines)), no_wrap=True, overflow='ignore')


def fraction(text: str) -> float:
    """
    Read a share: ``0.01`` or ``1%``.

    Parameters
    ----------
    text
        As it was typed.

    Returns
    -------
    float
        [-].

    Raises
    ------
    ArgumentTypeError
        If it is neither.

    """
    number, percent, rest = text.strip().partition('%')
    try:
        value = float(number)
    except ValueError:
        value = math.nan
    if rest or not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{text}': must be a share, such as 0.01 or 1%")
    return value / 100 if percent else value


@contextmanager
def made_folder(folder: Path, option: str = '--out') -> Iterator[Path]:
    """
    Give a folder for results; one that stays empty is taken away again.

    Parameters
    ----------
    folder
        Made, with all above it, where it is not there.
    option
        That named it, for an error.

    Returns
    -------
    context manager
        Gives the folder.

    Raises
    ------
    ConfigError
        If it cannot be made.

    """
    owns()
    new = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        _take_away(new)
        raise ConfigError(f'{option} {folder}: {error.strerror}') from None
    try:
        yield folder
    finally:
        _take_away(new)


def _take_away(folders: Sequence[Path]) -> None:
    """Remove those folders that are empty, innermost first."""
    for folder in folders:
        with suppress(OSError):  # it holds something, or was never made
            folder.rmdir()
