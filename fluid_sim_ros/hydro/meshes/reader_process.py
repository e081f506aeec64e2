# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The process that reads one mesh file: ``python -m ... FILE SCALE UP RESULT [as_it_is]``.

It limits its own memory and processor time, writes the repaired solid to RESULT (npz), or with
``as_it_is`` the triangles, and one line of JSON to standard output. SCALE 0: the unit that a DAE
file states, else metres. UP: one of ``up_axis.UPS``.
"""

import importlib
import json
import logging
import resource
import sys
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.reading import memory_and_time
from fluid_sim_ros.hydro.meshes.repair import Solid, repaired
from fluid_sim_ros.hydro.meshes.surface import Surface
from fluid_sim_ros.hydro.meshes.up_axis import turned_up
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.limits import check_limit

#: Packages without which some formats are not read; trimesh may do without any other.
_NEEDED = ('trimesh', 'collada', 'lxml')


def main() -> int:
    """
    Read the file of the command line.

    Returns
    -------
    int
        0, also where the file was refused: the line says why.

    """
    path, scale, up, result = (
        Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3], Path(sys.argv[4])
    )  # fmt: skip
    logging.disable(logging.CRITICAL)  # of trimesh: what is wrong is said in one line
    memory, seconds = memory_and_time(path)
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        rotation, words = turned_up(path, up)
        head = (_read_as_it_is if sys.argv[5:] else _read)(path, scale, rotation, result)
        head['axes'] = words
    except ConfigError as error:
        head = {'error': str(error)}
    except MemoryError:
        head = {'memory': True}
    except ModuleNotFoundError as error:
        head = {'missing': error.name}
    except Exception as error:  # noqa: BLE001  what follows from a stranger's numbers
        head = {'error': f'cannot be made a solid ({_words(error)})'}
    sys.stdout.write('\n' + json.dumps(head) + '\n')
    return 0


def surface_of_file(path: Path, scale: float) -> tuple[Surface, float]:
    """
    Return the triangles of a mesh file as they are, in this very process.

    Parameters
    ----------
    path
        Of the file.
    scale
        Unit of its numbers [m]; 0: as the file states it, else metres.

    Returns
    -------
    surface, scale
        In metres, and the unit that was taken [m].

    Raises
    ------
    ConfigError
        If it is no mesh.

    """
    pieces, own = _pieces(path)
    unit = scale or own
    if not any(len(faces) for _, faces in pieces):
        raise ConfigError('no triangles in it')
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in pieces[:-1])])
    vertices = np.concatenate([vertices for vertices, _ in pieces])
    faces = np.concatenate(
        [faces + start for (_, faces), start in zip(pieces, starts, strict=True)]
    )
    return Surface(unit * vertices, faces), unit


def solid_of_file(path: Path, scale: float) -> tuple[Solid, int]:
    """
    Return the closed solid of a mesh file, in this very process.

    Parameters
    ----------
    path
        Of the file.
    scale
        Unit of its numbers [m]; 0: as the file states it, else metres.

    Returns
    -------
    solid, triangles
        And how many triangles the file has.

    Raises
    ------
    ConfigError
        If it is no mesh, or no solid and cannot be made one.

    """
    surface, _ = surface_of_file(path, scale)
    return repaired(surface), len(surface.faces)


def _turned(surface: Surface, rotation: Array) -> Surface:
    if np.array_equal(rotation, np.eye(3)):
        return surface
    return Surface(surface.vertices @ rotation.T, surface.faces)


def _read_as_it_is(path: Path, scale: float, rotation: Array, result: Path) -> dict[str, Any]:
    surface, unit = surface_of_file(path, scale)
    surface = _turned(surface, rotation)
    np.savez(result, vertices=surface.vertices, faces=surface.faces)
    return {'triangles': len(surface.faces), 'unit': unit}


def _read(path: Path, scale: float, rotation: Array, result: Path) -> dict[str, Any]:
    surface, unit = surface_of_file(path, scale)
    solid = repaired(_turned(surface, rotation))
    frame = solid.frame
    np.savez(
        result, vertices=solid.surface.vertices, faces=solid.surface.faces, origin=frame.origin,
        rotation=frame.rotation, length=frame.length,
    )  # fmt: skip
    return {
        'triangles': len(surface.faces), 'repairs': list(solid.repairs), 'unit': unit,
    }  # fmt: skip


def _pieces(path: Path) -> tuple[list[tuple[Any, Any]], float]:
    """Return vertices and faces of each mesh, where the file's scene puts it, and its unit [m]."""
    trimesh = _trimesh()
    try:
        scene = trimesh.load_scene(
            path, process=False, skip_materials=True, allow_remote=False, maintain_order=True
        )
        nodes = list(scene.graph.nodes_geometry)
        check_limit('mesh_pieces', len(nodes), 'meshes in it')
        pieces, count, unit = [], 0, 1.0
        for node in nodes:
            transform, name = scene.graph[node]
            mesh = scene.geometry[name]
            faces = getattr(mesh, 'faces', None)
            if faces is None or not len(faces):
                continue
            unit = _unit_of(mesh, path)
            count += len(faces)
            check_limit('mesh_triangles', count, 'triangles (export it with fewer)')
            vertices = np.asarray(mesh.vertices, dtype=np.float64)
            corners = np.asarray(faces, dtype=np.int64)
            if vertices.shape != (len(vertices), 3) or corners.shape != (len(corners), 3):
                raise ConfigError('its faces are no triangles in three dimensions')
            if corners.min() < 0 or corners.max() >= len(vertices):
                raise ConfigError('a face names a vertex that the file does not have')
            turned = np.asarray(transform, dtype=np.float64)
            placed = vertices
            if not np.array_equal(turned, np.eye(4)):
                placed = vertices @ turned[:3, :3].T + turned[:3, 3]
            if np.linalg.det(turned[:3, :3]) < 0:  # a mirror image
                corners = corners[:, ::-1]
            pieces.append((placed, corners))
    except (ConfigError, MemoryError):
        raise
    except Exception as error:  # a reader of strangers' files raises anything
        if getattr(error, 'name', None) in _NEEDED:
            raise
        raise ConfigError(
            f'is no {path.suffix.lower().lstrip(".")} mesh ({_words(error)})'
        ) from None
    return pieces, unit


def _trimesh() -> Any:
    """Import trimesh without scipy: it reads files without, in a third of the time."""
    if 'scipy' in sys.modules:
        return importlib.import_module('trimesh')
    sys.modules['scipy'] = None  # type: ignore[assignment]  # what Python takes for missing
    try:
        return importlib.import_module('trimesh')
    finally:
        del sys.modules['scipy']


def _words(error: Exception) -> str:
    return f'{type(error).__name__}: {" ".join(str(error).split())[:160]}'


def _unit_of(mesh: Any, path: Path) -> float:
    """Return the unit that a DAE file states, which trimesh hands on and does not apply [m]."""
    words = str(mesh.metadata.get('units', '')).split(' ')
    if path.suffix.lower() != '.dae' or words[-2:] != ['*', 'meters']:
        return 1.0
    unit = float(words[0])
    return unit if np.isfinite(unit) and unit > 0 else 1.0


if __name__ == '__main__':
    sys.exit(main())
