# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The parser of ``fluid_sim``: exact options, one-line errors that say what was meant, colour."""

import argparse
import re
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from rich_argparse import RichHelpFormatter

from fluid_sim_ros.errors import did_you_mean, listed

#: Exit code of wrong input.
WRONG_INPUT = 2
_CHOICE = re.compile(r"argument (\S+): invalid choice: '(.*)' \(choose from (.*)\)")


class _Formatter(RichHelpFormatter):
    """Coloured on a terminal, plain elsewhere; square brackets are units, no markup."""

    usage_markup = help_markup = text_markup = False


class Parser(argparse.ArgumentParser):
    """
    A parser that takes no abbreviated options, and whose errors are one line.

    Parameters
    ----------
    **settings
        As of ``argparse.ArgumentParser``.

    """

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, formatter_class=_Formatter, **settings)
        self.commands: dict[str, Parser] = {}

    def add_commands(self) -> 'argparse._SubParsersAction[Parser]':
        """Return where subcommands are added; ``commands`` has them by name."""
        found = self.add_subparsers(dest='command', required=True, metavar='COMMAND')
        self.commands = found.choices  # it grows with each command
        return found

    def error(self, message: str) -> NoReturn:
        """
        End with one line on standard error.

        Parameters
        ----------
        message
            Of argparse; a choice that is not known gets the one that was meant.

        """
        if chosen := _CHOICE.fullmatch(message):
            known = re.findall(r"[^', ]+", chosen[3])
            what, word, _ = chosen.groups()
            hint = did_you_mean(word, known)
            message = f"{what} '{word}' is not known{hint} allowed: {listed(known)}"
        self.exit(WRONG_INPUT, f'{self.prog}: error: {message} (see {self.prog} --help)\n')

    def refuse(self, rest: Sequence[str]) -> NoReturn:
        """
        End with one line about arguments that nobody took.

        Parameters
        ----------
        rest
            The arguments.

        """
        options = [word for word in rest if word.startswith('-')]
        if not options:
            self.error(f'unknown arguments: {" ".join(rest)}')
        option = options[0].split('=')[0]
        known = [name for name in self._option_string_actions if name.startswith('--')]
        hint = did_you_mean(option, known)
        allowed = '' if hint != ';' else f' allowed: {listed(known)}'
        self.error(f"option '{option}' is not known{hint}{allowed}")

    def shows_itself(self, words: Sequence[str]) -> None:
        """
        Print the help of what is called without any argument though it needs some.

        Parameters
        ----------
        words
            Of the command line.

        """
        asked = self.commands.get(words[0]) if len(words) == 1 else self if not words else None
        # argparse calls a positional argument that may be left out (*) required
        if asked is not None and any(a.required and a.nargs != '*' for a in asked._actions):
            asked.print_help()


def above(low: float, kind: type[float] | type[int] = float) -> Callable[[str], float]:
    """
    Return an argparse type: a finite number above a limit.

    Parameters
    ----------
    low
        The limit.
    kind
        ``int`` for whole numbers.

    """
    return _number(lambda value: low < value < float('inf'), f'above {low:g}', kind)


def at_least(low: float, kind: type[float] | type[int] = float) -> Callable[[str], float]:
    """
    Return an argparse type: a finite number that is not below a limit.

    Parameters
    ----------
    low
        The limit.
    kind
        ``int`` for whole numbers.

    """
    return _number(lambda value: low <= value < float('inf'), f'{low:g} or more', kind)


def _number(
    fits: Callable[[float], bool], rule: str, kind: type[float] | type[int]
) -> Callable[[str], float]:
    def parse(text: str) -> float:
        try:
            value = kind(text)
        except ValueError:
            what = 'a whole number' if kind is int else 'a number'
            raise argparse.ArgumentTypeError(f"'{text}' is not {what}") from None
        if not fits(value):
            raise argparse.ArgumentTypeError(f'must be {rule} (got {text})')
        return value

    return parse
