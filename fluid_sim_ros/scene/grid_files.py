"""Reads gridded winds and currents from NPZ and NetCDF files; a fault is one line."""

import base64
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.grid import AXES, Grid, checked_grid

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
        (masked, NaN or infinite), or units that are not understood.

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
        raise ConfigError(f'{path}: {error}') from None
    except FileNotFoundError:
        raise ConfigError(f'{path}: no such file') from None
    except (OSError, ValueError, TypeError, zipfile.BadZipFile) as error:
        raise ConfigError(f'{path}: cannot be read: {" ".join(str(error).split())}') from None


def _from_npz(path: Path) -> dict[str, Array]:
    with np.load(path, allow_pickle=False) as file:
        return {
            name: np.asarray(file[name], dtype=np.float64)
            for name in (*AXES, *COMPONENTS)
            if name in file.files
        }


def _from_netcdf(path: Path) -> dict[str, Array]:
    from scipy.io import netcdf_file  # late: it takes longer to load than all of ours

    with path.open('rb') as file:
        if file.read(len(_HDF5)) == _HDF5:
            raise ConfigError('is NetCDF-4; write it as classic: nccopy -k classic IN OUT')
    fields: dict[str, Array] = {}
    with netcdf_file(path, mmap=False, maskandscale=True) as file:
        names = {'time': 't', **{name: name for name in (*AXES, *COMPONENTS)}}
        for stored, name in names.items():
            if stored not in file.variables:
                continue
            variable = file.variables[stored]
            values = np.ma.filled(np.ma.asarray(variable[:], dtype=np.float64), np.nan)
            if name in COMPONENTS:
                values = _in_order(stored, variable.dimensions, values, names)
            fields[name] = values * _factor(stored, name, variable)
    return fields


def _in_order(
    stored: str, dimensions: tuple[str, ...], values: Array, names: Mapping[str, str]
) -> Array:
    """Return a component with its dimensions in the order t, x, y, z."""
    axes = [names.get(dimension, dimension) for dimension in dimensions]
    unknown = [axis for axis in axes if axis not in AXES]
    if unknown:
        raise ConfigError(
            f"variable '{stored}': dimension '{unknown[0]}'; allowed: {listed(AXES)}, time"
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
        raise ConfigError(f"variable '{stored}': units '{units}'; allowed: {listed(known)}")
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
    velocity = np.zeros((*shape, 3))
    for i, name in enumerate(COMPONENTS):
        if name not in fields:
            continue
        if fields[name].shape != wanted:
            raise ConfigError(
                f"component '{name}': shape {fields[name].shape}; allowed: {wanted}, the "
                f'points of {listed(present)}'
            )
        velocity[..., i] = fields[name].reshape(shape)
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
    try:
        return np.frombuffer(zlib.decompress(base64.b64decode(text)), '<f8').astype(np.float64)
    except (ValueError, zlib.error) as error:
        raise ConfigError(f'data of a grid: {error}') from None
