# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Readers of other projects, on logs of strangers: they print, and they raise anything."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import TextIOBase

from fluid_sim_ros.errors import printable


class _Nowhere(TextIOBase):
    """Takes text and keeps none of it: of a damaged log there may be a line for each byte."""

    def write(self, text: str, /) -> int:
        """
        Take a text.

        Parameters
        ----------
        text
            What is printed.

        Returns
        -------
        int
            Its length.

        """
        return len(text)


@contextmanager
def silent() -> Iterator[None]:
    """
    Keep what a reader prints of a damaged log from the terminal.

    Returns
    -------
    context manager
        In which nothing is printed.

    """
    nowhere = _Nowhere()
    with redirect_stdout(nowhere), redirect_stderr(nowhere):
        yield


@contextmanager
def silent_native() -> Iterator[None]:
    """
    Keep what a reader's native code prints from the terminal, too; for the whole process.

    Returns
    -------
    context manager
        In which nothing is printed.

    """
    sys.stderr.flush()
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        with silent():
            yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)


def reason_of(error: Exception) -> str:
    """
    Return why a reader failed, on one line.

    Parameters
    ----------
    error
        What it raised.

    Returns
    -------
    str
        Its words, or its kind.

    """
    return printable(' '.join(str(error).split()), 300) or type(error).__name__
