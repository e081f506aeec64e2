# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Opens data files of others: regular files only, since a pipe would be waited for without end."""

import errno
import os
import stat
from pathlib import Path
from typing import BinaryIO


def open_data(path: Path) -> BinaryIO:
    """
    Open a file for reading bytes.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    BinaryIO
        To be closed by the caller.

    Raises
    ------
    OSError
        If it cannot be opened, or is a pipe, a folder or a device.

    """
    return os.fdopen(open_handle(path), 'rb')


def open_handle(path: Path) -> int:
    """
    Open a file for reading; what ``open_data`` says holds.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    int
        Its handle, to be closed by the caller.

    Raises
    ------
    OSError
        If it cannot be opened, or is a pipe, a socket, a folder or a device.

    """
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        if error.errno != errno.ENXIO:  # as for a socket
            raise
        raise OSError(0, f'not a regular file but {kind_of(path)}') from None
    mode = os.fstat(handle).st_mode
    if not stat.S_ISREG(mode):
        os.close(handle)
        raise OSError(0, f'not a regular file but {_kind(mode)}')
    return handle


def kind_of(path: Path) -> str:
    """
    Return what stands at a path, in words.

    Parameters
    ----------
    path
        Any.

    Returns
    -------
    str
        ``a pipe``, ``a socket``, ``a device``, ``a folder``, ``a file``, or empty where nothing
        can be found.

    """
    try:
        return _kind(path.stat().st_mode)
    except (OSError, ValueError):
        return ''


def _kind(mode: int) -> str:
    kinds = {
        stat.S_IFIFO: 'a pipe', stat.S_IFSOCK: 'a socket', stat.S_IFDIR: 'a folder',
        stat.S_IFREG: 'a file',
    }  # fmt: skip
    return kinds.get(stat.S_IFMT(mode), 'a device')
