# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads gridded winds and currents from NPZ and NetCDF files; a fault is one line."""

import base64
import math
import struct
import zipfile
import zlib
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError, listed, printable
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.grid import AXES, Grid, checked_grid
from fluid_sim_ros.scene.npz_files import read_npz
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import beyond, check_limit, expanded_size, limit

#: Components of the velocity, world x y z; without w the flow is level.
COMPONENTS = ('u', 'v', 'w')
#: NetCDF units that are understood, and their SI factor; times may go on with "since ...".
_UNITS = {
    't': {'s': 1.0, 'second': 1.0, 'seconds': 1.0, 'minutes': 60.0, 'hours': 3600.0,
          'days': 86400.0},
    'x': {'m': 1.0, 'meter': 1.0, 'meters': 1.0, 'metre': 1.0, 'metres': 1.0, 'km': 1000.0},
    'u': {'m/s': 1.0, 'm s-1': 1.0, 'm s**-1': 1.0, 'm.s-1': 1.0, 'meter second-1': 1.0},
}  # fmt: skip
_UNITS |= {'y': _UNITS['x'], 'z': _UNITS['x'], 'v': _UNITS['u'], 'w': _UNITS['u']}
#: What the readers of these formats raise for damaged files.
_DAMAGED = (
    ArithmeticError, AssertionError, AttributeError, EOFError, LookupError, MemoryError, OSError,
    RecursionError, RuntimeError, TypeError, ValueError, struct.error, zipfile.BadZipFile,
    zlib.error,
)  # fmt: skip
#: First bytes of a NetCDF-4 file, which is HDF5.
_HDF5 = b'\x89HDF\r\n\x1a\n'


def read_grid(path: Path) -> Grid:
    """
    Return the grid of a file.

    NPZ: axes t [s], x, y, z [m] (world; those that are left out do not matter to the flow) and
    components u, v and perhaps w [m/s], each of the shape of the present axes in this order.
    NetCDF (classic format): coordinate variables of the same names (or time), components with
    these dimensions in any order, units of length, time and speed as CF has them.

    Parameters
    ----------
    path
        ``.npz``, ``.nc`` or ``.cdf``.

    Raises
    ------
    ConfigError
        For a file that cannot be read, missing or misshapen arrays, axes that do not rise, gaps
        (masked, NaN or infinite), or units that are not understood; a ``LimitError`` for one that
        stands for more numbers than a limit allows.

    """
    try:
        if path.suffix == '.npz':
            fields = _from_npz(path)
        elif path.suffix in ('.nc', '.cdf'):
            fields = _from_netcdf(path)
        else:
            raise ConfigError(f"kind '{path.suffix}' is not known; allowed: .npz, .nc, .cdf")
        return _grid(fields)
    except ConfigError as error:
        raise type(error)(f'{path}: {error}') from None
    except FileNotFoundError:
        raise ConfigError(f'{path}: no such file') from None
    except _DAMAGED as error:
        reason = printable(' '.join(str(error).split()) or type(error).__name__)
        raise ConfigError(f'{path}: cannot be read: {reason}') from None


def _from_npz(path: Path) -> dict[str, Array]:
    with open_data(path) as file:
        return read_npz(file, path.stat().st_size, (*AXES, *COMPONENTS))


def _from_netcdf(path: Path) -> dict[str, Array]:
    from scipy.io import netcdf_file  # late: it takes longer to load than all of ours

    check_limit('grid_bytes', path.stat().st_size, 'size')
    with open_data(path) as stream:
        if stream.read(len(_HDF5)) == _HDF5:
            raise ConfigError('is NetCDF-4; write it as classic: nccopy -k classic IN OUT')
        stream.seek(0)
        return _netcdf_fields(netcdf_file(stream, mmap=False, maskandscale=True))


def _netcdf_fields(opened: Any) -> dict[str, Array]:
    fields: dict[str, Array] = {}
    with opened as file:
        names = {'time': 't', **{name: name for name in (*AXES, *COMPONENTS)}}
        for stored, name in names.items():
            if stored not in file.variables:
                continue
            variable = file.variables[stored]
            _check_packing(stored, variable)
            values = np.ma.filled(np.ma.asarray(variable[:], dtype=np.float64), np.nan)
            if name in COMPONENTS:
                values = _in_order(stored, variable.dimensions, values, names)
            fields[name] = values * _factor(stored, name, variable)
    return fields


def _check_packing(stored: str, variable: Any) -> None:
    """Refuse attributes of several numbers, which would make a table of each value."""
    for key in ('scale_factor', 'add_offset', 'missing_value', '_FillValue'):
        if np.size(getattr(variable, key, 0)) != 1:
            raise ConfigError(f"variable '{stored}': attribute '{key}' must be one number")


def _in_order(
    stored: str, dimensions: tuple[str, ...], values: Array, names: Mapping[str, str]
) -> Array:
    """Return a component with its dimensions in the order t, x, y, z."""
    axes = [names.get(dimension, dimension) for dimension in dimensions]
    unknown = [axis for axis in axes if axis not in AXES]
    if unknown:
        name = printable(unknown[0])
        raise ConfigError(
            f"variable '{stored}': dimension '{name}'; allowed: {listed(AXES)}, time"
        )
    return np.transpose(values, sorted(range(len(axes)), key=lambda i: AXES.index(axes[i])))


def _factor(stored: str, name: str, variable: Any) -> float:
    raw = getattr(variable, 'units', b'')
    units = raw.decode(errors='replace') if isinstance(raw, bytes) else str(raw)
    known = _UNITS[name]
    word = units.split(' since ')[0].strip()
    if not word:
        return 1.0
    if word not in known:
        raise ConfigError(
            f"variable '{stored}': units '{printable(units)}'; allowed: {listed(known)}"
        )
    return known[word]


def _grid(fields: Mapping[str, Array]) -> Grid:
    present = [axis for axis in AXES if axis in fields]
    for name in ('u', 'v'):
        if name not in fields:
            raise ConfigError(
                f"no component '{name}'; needed: u, v (and w) over t, x, y, z; "
                f'it has: {listed(fields)}'
            )
    if not present:
        raise ConfigError(f'no axis; needed: some of {listed(AXES)}')
    axes = {axis: fields.get(axis, np.zeros(1)) for axis in AXES}
    wanted = tuple(fields[axis].size for axis in present)
    shape = tuple(axes[axis].size for axis in AXES)
    stated = [name for name in COMPONENTS if name in fields]
    for name in stated:  # before room is made for as many points as the axes state
        if fields[name].shape != wanted:
            raise ConfigError(
                f"component '{name}': shape {fields[name].shape}; allowed: {wanted}, the "
                f'points of {listed(present)}'
            )
    check_limit('grid_bytes', math.prod(shape) * 24, 'the grid')
    velocity = np.zeros((*shape, 3))
    for name in stated:
        velocity[..., COMPONENTS.index(name)] = fields[name].reshape(shape)
    return checked_grid(tuple(axes.values()), velocity)


def grid_numbers(grid: Grid) -> Array:
    """
    Return a grid as the numbers that a <numeric> holds for fluid_sim.medium.

    Parameters
    ----------
    grid
        Axes [s], [m] and velocities [m/s].

    Returns
    -------
    Array
        Four sizes, the axes, the velocities; one row.

    """
    sizes = np.array([axis.size for axis in grid.axes], dtype=np.float64)
    return np.concatenate([sizes, *grid.axes, grid.velocity.ravel()])


def pack(grid: Grid) -> str:
    """
    Return a grid as text, to the bit: what a scene holds of its file.

    Parameters
    ----------
    grid
        Axes [s], [m] and velocities [m/s].

    Returns
    -------
    str
        Of ``grid_numbers``, compressed.

    """
    return base64.b64encode(zlib.compress(grid_numbers(grid).astype('<f8').tobytes())).decode()


def unpack(text: str) -> Array:
    """
    Return the numbers of a packed grid.

    Parameters
    ----------
    text
        As ``pack`` returned it.

    Returns
    -------
    Array
        As ``grid_numbers`` returned it.

    Raises
    ------
    ConfigError
        If the text is none.

    """
    numbers = np.frombuffer(_expanded(text, limit('grid_bytes'), 'grid_bytes'), '<f8')
    sizes = numbers[:4]
    if len(sizes) < 4 or not all(size >= 1 and size == size // 1 for size in sizes.tolist()):
        raise ConfigError('data of a grid: its sizes are none')
    counts = [int(size) for size in sizes]
    if len(numbers) != 4 + sum(counts) + 3 * math.prod(counts):
        raise ConfigError('data of a grid: their number is not what its sizes need')
    ends = np.cumsum([4, *counts])
    axes = tuple(numbers[a:b] for a, b in pairwise(ends))
    return grid_numbers(checked_grid(axes, numbers[ends[-1] :].reshape(*counts, 3)))


def check_packed(text: str) -> None:
    """
    Refuse a packed grid of a stranger that grows to much more than its text explains.

    Parameters
    ----------
    text
        As ``pack`` returns it.

    Raises
    ------
    ConfigError
        If the text is none; a ``LimitError`` of ``expansion``.

    """
    _expanded(text, expanded_size(len(text)), 'expansion')


def _expanded(text: str, most: int, name: str) -> bytes:
    """Return what a packed text holds, or raise what names the limit."""
    try:
        unpacker = zlib.decompressobj()
        data = unpacker.decompress(base64.b64decode(text, validate=True), most + 1)
    except (ValueError, zlib.error) as error:
        raise ConfigError(f'data of a grid: {error}') from None
    if len(data) > most:
        raise beyond(name, limit(name), f'data of a grid: more than {most} bytes')
    if not unpacker.eof or len(data) % 8:
        raise ConfigError('data of a grid: cut')
    return data
