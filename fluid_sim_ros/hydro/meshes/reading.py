# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Reading a mesh file of a stranger: in a process of its own, with bounded memory and time.

The process reads the file with trimesh and repairs what it finds. Whatever a file does to a
reader, it ends here as one line.
"""

import json
import math
import os
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.hydro.meshes.frame import Frame
from fluid_sim_ros.hydro.meshes.repair import Solid
from fluid_sim_ros.hydro.meshes.surface import Surface
from fluid_sim_ros.interruption import owns
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.limits import VARIABLE, beyond, check_limit, limit

FORMATS = ('stl', 'obj', 'ply', 'glb', 'gltf', 'dae', 'off')
UNITS = {'m': 1.0, 'cm': 0.01, 'mm': 0.001, 'in': 0.0254, 'ft': 0.3048}
#: What a file allows for, beyond the limits of memory [bytes] and processor time [s].
_BYTES_PER_BYTE, _SECONDS_PER_BYTE = 100, 4e-6
#: Wall time beyond that of the processor, on a busy machine [s].
_PATIENCE = 30.0
#: A body larger or smaller than this [m] has its unit asked for.
_LARGE, _SMALL = 30.0, 5e-3


@dataclass(frozen=True)
class MeshFile:
    """
    A mesh file that was read.

    Attributes
    ----------
    path
        Of the file.
    solid
        The closed body, in metres.
    triangles
        How many the file has.
    unit
        That the file's numbers were taken in.
    repairs
        What was repaired or assumed, one phrase each.

    """

    path: Path
    solid: Solid
    triangles: int
    unit: str
    repairs: tuple[str, ...]


def read_mesh(path: Path, unit: str | None = None, up: str = 'keep') -> MeshFile:
    """
    Return the closed solid of a mesh file.

    Parameters
    ----------
    path
        STL, OBJ, PLY, GLB, glTF, DAE or OFF.
    unit
        Of the file's numbers, one of `UNITS`. None: metres, and a size that no vehicle has is
        refused with the question for the unit.
    up
        Which axis of the file becomes z, one of ``up_axis.UPS``: the axes as they are, as the
        file states it, or the one named.

    Returns
    -------
    MeshFile
        With what was repaired.

    Raises
    ------
    ConfigError
        If it is no such file, is larger than what is read, is no solid and cannot be made one,
        or its unit must be asked for.

    """
    if unit is not None and unit not in UNITS:
        raise ConfigError(f"unit '{unit}': unknown; allowed: {listed(UNITS)}")
    _check_file(path)
    owns()
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / 'solid.npz'
        head = _in_a_process(path, UNITS[unit] if unit else 0.0, up, result)
        with np.load(result) as arrays:
            surface = Surface(arrays['vertices'], arrays['faces'])
            frame = Frame(arrays['origin'], arrays['rotation'], float(arrays['length']))
    said = (*head['repairs'], *([head['axes']] if head['axes'] else []))
    solid = Solid(surface, frame, said)
    if unit is None:
        _check_size(path, solid.in_mesh_axes().size())
    taken = unit or {1.0: 'm'}.get(head['unit'], f'units of {head["unit"]:g} m, as the file says')
    return MeshFile(path, solid, int(head['triangles']), taken, solid.repairs)


def read_triangles(path: Path, unit: str | None = None, up: str = 'keep') -> Surface:
    """
    Return the triangles of a mesh file as they are, for looks: open, crossing or inside out.

    Parameters
    ----------
    path
        As of `read_mesh`.
    unit
        As of `read_mesh`, and no size is asked about.
    up
        As of `read_mesh`.

    Returns
    -------
    Surface
        In metres.

    Raises
    ------
    ConfigError
        If it is no such file, or larger than what is read.

    """
    if unit is not None and unit not in UNITS:
        raise ConfigError(f"unit '{unit}': unknown; allowed: {listed(UNITS)}")
    _check_file(path)
    owns()
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / 'triangles.npz'
        _in_a_process(path, UNITS[unit] if unit else 0.0, up, result, 'as_it_is')
        with np.load(result) as arrays:
            return Surface(arrays['vertices'], arrays['faces'])


def _check_file(path: Path) -> None:
    kind = path.suffix.lower().lstrip('.')
    if kind not in FORMATS:
        raise ConfigError(
            f"{path}: '{path.suffix}' is no mesh format that is read; allowed: {listed(FORMATS)}"
        )
    if not path.exists():
        raise ConfigError(f'{path}: no such file')
    if not path.is_file():
        raise ConfigError(f'{path}: is no regular file')
    try:
        size = path.stat().st_size
        with path.open('rb'):
            pass
    except OSError as error:
        raise ConfigError(f'{path}: cannot be read ({error.strerror})') from None
    check_limit('mesh_bytes', size, f'{path}: size (export it with fewer triangles)')
    if size == 0:
        raise ConfigError(f'{path}: is empty')


def _check_size(path: Path, size: Array) -> None:
    box = ' x '.join(f'{x:.4g}' for x in size)
    if size.max() > _LARGE:
        raise ConfigError(
            f'{path}: {box} m is larger than {_LARGE:g} m; is it in millimetres? give --unit mm, '
            'or --unit m to take it as it is'
        )
    if size.max() < _SMALL:
        raise ConfigError(
            f'{path}: {box} m is smaller than {1e3 * _SMALL:g} mm; give --unit (of: '
            f'{listed(UNITS)}) to say what its numbers are'
        )


def memory_and_time(path: Path) -> tuple[int, int]:
    """
    Return what the process that reads a file may use: memory [bytes], processor time [s].

    Parameters
    ----------
    path
        The file.

    """
    size = path.stat().st_size
    seconds = limit('mesh_seconds') + _SECONDS_PER_BYTE * size
    return limit('mesh_memory') + _BYTES_PER_BYTE * size, math.ceil(seconds)


def _in_a_process(path: Path, scale: float, up: str, result: Path, *mode: str) -> dict[str, Any]:
    """Let the file be read and repaired; return what was said about it."""
    from fluid_sim_ros.hydro.meshes import reader_process

    command = [sys.executable, '-m', reader_process.__name__, str(path), repr(scale), up,
               str(result), *mode]  # fmt: skip
    _, seconds = memory_and_time(path)
    # one thread: each reserves memory, and none is needed
    environment = os.environ | {'OMP_NUM_THREADS': '1', 'OPENBLAS_NUM_THREADS': '1'}
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors='replace', check=False,
            stdin=subprocess.DEVNULL, timeout=_PATIENCE + seconds, env=environment,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise beyond('mesh_seconds', limit('mesh_seconds'), f'{path}: its time') from None
    if -done.returncode in (signal.SIGXCPU, signal.SIGKILL):
        raise beyond('mesh_seconds', limit('mesh_seconds'), f'{path}: its time')
    try:
        head: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    except (IndexError, ValueError):
        raise ConfigError(
            f'{path}: its reader ended by itself (exit code {done.returncode}); the file is '
            f'damaged, or needs more memory than {VARIABLE}=mesh_memory=NUMBER allows'
        ) from None
    missing = head.get('missing')
    if missing:
        raise ModuleNotFoundError(f'No module named {missing!r}', name=str(missing))
    if head.get('memory'):
        raise beyond('mesh_memory', limit('mesh_memory'), f'{path}: its memory')
    fault = head.get('error')
    if fault:
        raise ConfigError(f'{path}: {fault}')
    return head
