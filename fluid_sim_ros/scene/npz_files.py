# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads arrays of numbers from NPZ files of others, within limits and without pickles."""

import math
import zipfile
from collections.abc import Collection
from tokenize import TokenError
from typing import IO

import numpy as np
from numpy.lib import format as npy

from fluid_sim_ros.errors import ConfigError, printable
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.limits import check_limit, expanded_size

#: Kinds of numbers: truth values, whole numbers, floats.
_KINDS = 'biuf'
_PIECE = 1 << 20


def read_npz(file: IO[bytes], size: int, names: Collection[str]) -> dict[str, Array]:
    """
    Return some arrays of an NPZ file.

    Parameters
    ----------
    file
        The file.
    size
        Of the file [bytes].
    names
        Of the arrays; others are passed over.

    Returns
    -------
    dict
        Name -> numbers, for those that there are.

    Raises
    ------
    ConfigError
        For an array that is none of numbers, or whose size is not what it states; a
        ``LimitError`` of ``grid_bytes`` or ``expansion``.
    OSError, ValueError, RuntimeError, EOFError
        What zipfile and numpy raise for damaged files.

    """
    found: dict[str, Array] = {}
    allowed = expanded_size(size)
    with zipfile.ZipFile(file) as archive:
        for name in names:
            if f'{name}.npy' not in archive.namelist():
                continue
            info = archive.getinfo(f'{name}.npy')
            check_limit('grid_bytes', info.file_size, f"array '{name}' [bytes]")
            allowed -= info.file_size
            if allowed < 0:
                check_limit('expansion', math.inf, f"array '{name}' of {info.file_size} bytes")
            with archive.open(info) as member:
                found[name] = _array(member, name, info.file_size)
    return found


def _array(member: IO[bytes], name: str, size: int) -> Array:
    version = npy.read_magic(member)
    read = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}.get(version)
    if read is None:
        raise ConfigError(f"array '{name}': version {version} of its format is not known")
    try:
        shape, fortran, dtype = read(member)
    except (SyntaxError, TokenError):
        raise ConfigError(f"array '{name}': its head cannot be read") from None
    if dtype.kind not in _KINDS:
        raise ConfigError(f"array '{name}': {printable(str(dtype))}; must be numbers")
    stated = math.prod(shape) * dtype.itemsize
    if stated > size:
        raise ConfigError(f"array '{name}': shape {printable(shape)} needs more than its data")
    data = b''.join(iter(lambda: member.read(_PIECE), b''))
    if len(data) != stated:
        shown = printable(shape)
        raise ConfigError(
            f"array '{name}': {len(data)} bytes of data; its shape {shown} needs {stated}"
        )
    numbers = np.frombuffer(data, dtype).astype(np.float64)
    return numbers.reshape(shape[::-1]).T if fortran else numbers.reshape(shape)
