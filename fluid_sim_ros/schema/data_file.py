"""Opens data files of others: regular files only, since a pipe would be waited for without end."""

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
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        os.close(handle)
        raise OSError(0, 'not a regular file')
    return os.fdopen(handle, 'rb')
