# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Files that are made of other people's data: never through a link, never two of one name."""

import os
import stat
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, MachineError, printable
from fluid_sim_ros.interruption import owns

#: Longest name of a file, without its ending [characters].
_LONGEST = 150


@contextmanager
def new_file(path: Path) -> Iterator[Path]:
    """
    Write a file that takes its place when it is whole.

    What stood there before is replaced: neither a link nor another name of the old file leads to
    the new content.

    Parameters
    ----------
    path
        Where the file shall stand.

    Returns
    -------
    context manager
        The path of an empty file in the same folder, with the same ending, to write to. It is
        gone where the block ends with an error.

    Raises
    ------
    ConfigError
        If a link stands there; a ``MachineError`` if the file cannot be written.

    """
    owns()
    shown = printable(str(path), 1000)
    if path.is_symlink():
        raise ConfigError(f'{shown}: a link stands there; remove it, or choose another place')
    if path.is_dir():
        raise ConfigError(f'{shown}: a folder stands there')
    if path.exists() and not os.access(path, os.W_OK):
        raise ConfigError(f'{shown}: cannot be written (it is read-only)')
    try:
        handle, name = tempfile.mkstemp(path.suffix, '.new_', path.parent)
    except OSError as error:
        raise MachineError(f'{shown}: cannot be written ({error.strerror})') from None
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(_mode(path))
        temporary.replace(path)
    except OSError as error:
        raise MachineError(f'{shown}: cannot be written ({error.strerror or error})') from None
    finally:
        with suppress(OSError):
            temporary.unlink()


def _mode(path: Path) -> int:
    """Return the mode of a file that stands there, or of a new one."""
    if path.exists():
        return stat.S_IMODE(path.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def file_names(names: Iterable[str]) -> list[str]:
    """
    Return a file name, without ending, for each of several names.

    Parameters
    ----------
    names
        Such as those of topics, ``/rov/odom``.

    Returns
    -------
    list
        Letters, digits, ``_`` and ``-``; no two are the same, whatever their case.

    """
    taken: set[str] = set()
    found = []
    for name in names:
        stem = ''.join(c if c.isascii() and (c.isalnum() or c in '_-') else '_' for c in name)
        stem = stem.strip('_')[:_LONGEST] or 'nameless'
        number, candidate = 1, stem
        while candidate.lower() in taken:
            number += 1
            candidate = f'{stem}_{number}'
        taken.add(candidate.lower())
        found.append(candidate)
    return found
