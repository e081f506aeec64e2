# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The one place where a damaged or lying log becomes an error: file, place and reason, on one line.

The readers check what they read and raise ``BadRecordError`` or ``LogError`` with a reason.
Whatever else a crafted log makes a library raise is met here, too, so that no log ends in a
traceback; the first cause stays attached (``__cause__``) for whoever looks for it.
"""

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import mujoco
import zstandard

from fluid_sim_ros.errors import (
    DivergedError,
    FluidSimError,
    MachineError,
    MissingExtraError,
    of_machine,
    printable,
)
from fluid_sim_ros.recording.model.mjcf_text import MjcfError


class LogError(FluidSimError):
    """A log is not readable, or lacks what was asked of it."""


class BadRecordError(Exception):
    """A record does not hold what its kind must hold."""


#: What libraries raise for content that no check before them refused.
_FORESEEN = (
    ArithmeticError, AttributeError, BufferError, EOFError, LookupError, MemoryError, OSError,
    RecursionError, RuntimeError, TypeError, ValueError, mujoco.FatalError, struct.error,
    zstandard.ZstdError,
)  # fmt: skip


@contextmanager
def reading(path: Path, place: str = '') -> Iterator[None]:
    """
    Turn what the content of a log causes into a ``LogError``.

    Parameters
    ----------
    path
        The log.
    place
        What of it is read, such as ``chunk at byte 123``.

    Returns
    -------
    context manager
        In which the content is used.

    Raises
    ------
    LogError
        With file, place and reason. A simulation that diverges, a package that is missing and
        what the machine cannot do are no faults of a log, and stay what they are.
    MachineError
        Where there is no space, or no file handle.

    """
    where = f'{printable(str(path), 1000)}: ' + (f'{place}: ' if place else '')
    try:
        yield
    except (DivergedError, MachineError, MissingExtraError):
        raise
    except (FluidSimError, BadRecordError, MjcfError) as error:
        line = str(error)
        known = isinstance(error, LogError) and line.startswith(where.split(': ')[0])
        raise LogError(line if known else f'{where}{line}') from error
    except _FORESEEN as error:
        if isinstance(error, OSError) and (lacking := of_machine(error)):
            raise MachineError(lacking) from error
        raise LogError(f'{where}{reason_of(error)}') from error


def reason_of(error: BaseException) -> str:
    """
    Return why something failed, on one line.

    Parameters
    ----------
    error
        Of a library.

    Returns
    -------
    str
        What it says, or its kind.

    """
    words = printable(' '.join(str(error).split()), 300)
    if isinstance(error, MemoryError):
        return 'it asks for more memory than there is'
    if isinstance(error, RecursionError):
        return 'its values are nested too deeply'
    return words or type(error).__name__
