# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Errors that the package raises; each message is one line that says what is allowed.

Text of files, logs and networks goes into them, and onto a terminal, by ``printable``.
"""

import difflib
import errno
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from datetime import date
from itertools import islice
from reprlib import Repr
from typing import Any

#: Longest piece of foreign text in a line for people, and longest line [characters]; most names
#: of a list.
MOST_TEXT, MOST_LINE, MOST_NAMES = 200, 4000, 50
#: A name that is longer than what is shown of others, or anything else without a space.
_LONG_WORD = re.compile(rf"'[^']{{{MOST_TEXT},}}'|\S{{{MOST_TEXT},}}")

#: Least share of equal letters at which one word is taken for another: rovv and rov have 0.86.
_SIMILAR = 0.7


class FluidSimError(Exception):
    """
    Base of every error that the package raises on purpose.

    Its message is one line without control characters, whatever texts of others are in it. In one
    that is too long, long names are cut, so that what is allowed, behind them, is still seen.

    Parameters
    ----------
    message
        One line.

    """

    def __init__(self, message: object = '') -> None:
        words = str(message)
        if len(words) > MOST_LINE:
            words = _LONG_WORD.sub(lambda found: _cut(found[0]), words)
        super().__init__(printable(words, MOST_LINE))


class ConfigError(FluidSimError):
    """A scene, vehicle or parameter file is wrong; the message names file, key and value."""


class ModelError(FluidSimError):
    """An MJCF model does not load or does not fit the scene that names it."""


class LimitError(ConfigError):
    """A file asks for more than a limit allows; the message says which, and how to raise it."""


class CommandError(FluidSimError):
    """A command has the wrong length, a value that is not finite, or an unknown target."""


class PluginError(FluidSimError):
    """The MuJoCo plugin library is missing or was built for another MuJoCo version."""


class MissingExtraError(FluidSimError):
    """An optional part is not installed; the message says which extra brings it."""


class MachineError(ConfigError):
    """The machine cannot do what was asked, whatever the files say: no OpenGL, no space."""


class AutopilotError(FluidSimError):
    """An autopilot has died, does not answer any more, or was never heard of."""


class DivergedError(FluidSimError):
    """
    The simulation left the range of finite numbers.

    Parameters
    ----------
    message
        One line: what diverged, where and when.
    time
        Simulated time of the first bad step [s]; kept as an attribute.
    body
        Name of the body that holds the bad degree of freedom; kept as an attribute.

    """

    def __init__(self, message: str, *, time: float, body: str) -> None:
        super().__init__(message)
        self.time = time
        self.body = body


def printable(text: object, most: int = MOST_TEXT) -> str:
    r"""
    Return text of others as it may be shown: on one line, without control characters, cut.

    What is not printable (line ends, escape sequences, marks that turn the direction of the text,
    halves of surrogate pairs) becomes an escape such as ``\x1b``.

    Parameters
    ----------
    text
        Of a file, a log or a network; no text: its ``repr``, cut at each level.
    most
        Longest text [characters]; what is cut off is counted.

    """
    words = text if isinstance(text, str) else _Cut().repr(text)
    rest = len(words) - most
    if rest > 0:
        words = words[:most]
    if not words.isprintable():
        words = ''.join(c if c.isprintable() else _escaped(c) for c in words)
    return f'{words}... ({rest} more characters)' if rest > 0 else words


def _cut(word: str) -> str:
    quote = "'" if word[0] == word[-1] == "'" else ''
    inner = word.strip("'") if quote else word
    return f'{quote}{printable(inner)}{quote}'


def _escaped(character: str) -> str:
    return character.encode('unicode_escape').decode('ascii')


class _Cut(Repr):
    """A ``repr`` that looks at a few members and levels only: its cost does not grow."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel, self.maxstring, self.maxother = 3, MOST_TEXT, MOST_TEXT

    def repr_int(self, x: int, level: int) -> str:
        digits = x.bit_length() // 3.33
        return f'a number of about {digits:.0f} digits' if digits > self.maxlong else repr(x)

    def repr_instance(self, x: Any, level: int) -> str:
        """Return the text of what is no container, or the name of its type."""
        if isinstance(x, bytes | bytearray):
            return repr(bytes(x[:MOST_TEXT]))
        if isinstance(x, float | complex | bool | date | None):
            return repr(x)
        return f'<{type(x).__name__}>'


def listed(names: Iterable[str]) -> str:
    """
    Return names as the tail of an error message: ``a, b, c`` or ``(none)``.

    Parameters
    ----------
    names
        What is allowed or exists, in the order of the message; the first 50 are shown.

    """
    remaining = iter(names)
    first = [printable(name, 100) for name in islice(remaining, MOST_NAMES)]
    rest = sum(1 for _ in remaining)
    return ', '.join([*first, *([f'and {rest} more'] if rest else [])]) or '(none)'


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """
    Return how an error goes on after a word that is not known: with the most similar known one.

    Parameters
    ----------
    word
        What the user wrote.
    known
        What would have been right.

    Returns
    -------
    str
        ``; did you mean 'rov'?``, or ``;`` where nothing is similar. A list of what is allowed
        follows in the message.

    """
    # foreign names may be long and many; comparing them all would take its time
    written = {name.lower(): name for name in islice(known, 500) if len(name) <= MOST_TEXT}
    word = word[:MOST_TEXT].lower()
    similar = difflib.get_close_matches(word, written, n=1, cutoff=_SIMILAR)
    # two letters that changed places weigh too much in short words
    similar += [name for name in written if sorted(name) == sorted(word)]
    return f"; did you mean '{printable(written[similar[0]])}'?" if similar else ';'


#: What a machine lacks or forbids, whatever is asked of it, and what helps.
_OF_MACHINE = {
    errno.EMFILE: '; raise the limit, such as: ulimit -n 1024',
    errno.ENFILE: '; close other programs',
    errno.EAGAIN: '; close other programs',
    errno.ENOSPC: '',
    errno.EDQUOT: '',
    errno.EROFS: '',
}


def of_machine(error: OSError) -> str:
    """
    Return what to say of an error that is the machine's, whatever file it met; or nothing.

    Parameters
    ----------
    error
        Of the operating system.

    Returns
    -------
    str
        What is lacking, with the file and the remedy where they are known; empty: it may as well
        be the file's.

    """
    if error.errno not in _OF_MACHINE:
        return ''
    where = f'{printable(str(error.filename), 1000)}: ' if error.filename else ''
    return f'{where}{error.strerror}{_OF_MACHINE[error.errno]}'


@contextmanager
def needed_for(what: str) -> Iterator[None]:
    """
    Say in one line what to do where a package is missing that ``what`` needs.

    Parameters
    ----------
    what
        Beginning of the message: who needs the package.

    Returns
    -------
    context manager
        In which the package is imported.

    Raises
    ------
    MissingExtraError
        In place of a ModuleNotFoundError about a package of others.

    """
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith('fluid_sim_ros'):
            raise
        raise MissingExtraError(
            f'{what} needs {error.name}, which is not installed; '
            'fluid_sim doctor says what to type'
        ) from None
