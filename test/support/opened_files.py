# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which files of a folder are opened, by whatever process, as the kernel reports it (inotify)."""

import ctypes
import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_OPEN, _NONBLOCK = 0x20, os.O_NONBLOCK
_EVENT = struct.Struct('iIII')


@contextmanager
def opened_files(folder: Path) -> Iterator[list[str]]:
    """
    Watch a folder while the block runs.

    Parameters
    ----------
    folder
        With files; opening the folder itself does not count.

    Returns
    -------
    context manager
        A list that holds the names of opened files, once the block has ended.

    """
    libc = ctypes.CDLL(None, use_errno=True)
    handle = libc.inotify_init1(_NONBLOCK)
    if handle < 0 or libc.inotify_add_watch(handle, os.fsencode(folder), _OPEN) < 0:
        raise OSError(ctypes.get_errno(), 'inotify')
    names: list[str] = []
    try:
        yield names
        while True:
            try:
                data = os.read(handle, 1 << 16)
            except BlockingIOError:
                break
            at = 0
            while at < len(data):
                _, _, _, length = _EVENT.unpack_from(data, at)
                name = data[at + _EVENT.size : at + _EVENT.size + length].rstrip(b'\x00')
                if name:
                    names.append(name.decode())
                at += _EVENT.size + length
    finally:
        os.close(handle)
