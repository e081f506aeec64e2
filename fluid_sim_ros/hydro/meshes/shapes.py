# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Closed meshes of simple shapes, and files of them: for examples and tests."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.hydro.meshes.surface import Surface
from fluid_sim_ros.physics.volume import box_mesh

_GOLDEN = 0.5 * (1 + 5**0.5)


def box(size: ArrayLike, center: ArrayLike = (0.0, 0.0, 0.0)) -> Surface:
    """
    Return a box of 12 triangles.

    Parameters
    ----------
    size
        Length, width, height [m].
    center
        [m].

    """
    vertices, faces = box_mesh(0.5 * np.asarray(size, dtype=float))
    return Surface(vertices + np.asarray(center, dtype=float), faces)


def cylinder(
    radius: float,
    length: float,
    axis: str = 'z',
    center: ArrayLike = (0.0, 0.0, 0.0),
    sections: int = 32,
) -> Surface:
    """
    Return a cylinder.

    Parameters
    ----------
    radius, length
        [m].
    axis
        ``x``, ``y`` or ``z``.
    center
        [m].
    sections
        Of the circle.

    """
    angle = 2 * np.pi * np.arange(sections) / sections
    rim = radius * np.c_[np.cos(angle), np.sin(angle)]
    half = np.full(sections, length / 2)
    ends = [[0, 0, -length / 2], [0, 0, length / 2]]
    vertices = np.concatenate([np.c_[rim, -half], np.c_[rim, half], ends])
    here = np.arange(sections)
    there = (here + 1) % sections
    low, high = np.full(sections, 2 * sections), np.full(sections, 2 * sections + 1)
    faces = np.concatenate([
        np.c_[here, there, there + sections], np.c_[here, there + sections, here + sections],
        np.c_[low, there, here], np.c_[high, here + sections, there + sections],
    ])  # fmt: skip
    turn = {'x': [2, 0, 1], 'y': [1, 2, 0], 'z': [0, 1, 2]}[axis]
    return Surface(vertices[:, turn] + np.asarray(center, dtype=float), faces)


def ellipsoid(axes: ArrayLike, subdivisions: int = 3) -> Surface:
    """
    Return an ellipsoid: an icosahedron whose faces are quartered again and again.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (3,).
    subdivisions
        20 x 4^subdivisions faces.

    """
    g = _GOLDEN
    points = np.array([
        (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
        (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1),
    ], dtype=float)  # fmt: skip
    faces = np.array([
        (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
        (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9),
        (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1),
    ])  # fmt: skip
    for _ in range(subdivisions):
        edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        ends, number = np.unique(edges, axis=0, return_inverse=True)
        ab, bc, ca = (number.reshape(-1, 3) + len(points)).T
        a, b, c = faces.T
        points = np.concatenate([points, points[ends].mean(axis=1)])
        faces = np.concatenate([
            np.c_[a, ab, ca], np.c_[ab, b, bc], np.c_[ca, bc, c], np.c_[ab, bc, ca],
        ])  # fmt: skip
    unit = points / np.linalg.norm(points, axis=1, keepdims=True)
    return Surface(unit * np.asarray(axes, dtype=float), faces)


def together(shapes: Sequence[Surface]) -> Surface:
    """
    Return shapes in one mesh, each as it is.

    Parameters
    ----------
    shapes
        At least one.

    """
    starts = np.cumsum([0, *(len(shape.vertices) for shape in shapes[:-1])])
    return Surface(
        np.concatenate([shape.vertices for shape in shapes]),
        np.concatenate([
            shape.faces + start for shape, start in zip(shapes, starts, strict=True)
        ]),
    )  # fmt: skip


def write_obj(surface: Surface, path: Path) -> None:
    """
    Write a mesh as OBJ, in double precision.

    Parameters
    ----------
    surface
        Any.
    path
        Of the file.

    """
    points = [f'v {x!r} {y!r} {z!r}' for x, y, z in surface.vertices.tolist()]
    corners = [f'f {a} {b} {c}' for a, b, c in (surface.faces + 1).tolist()]
    path.write_text('\n'.join([*points, *corners]) + '\n', encoding='ascii')


def stl_bytes(surface: Surface) -> bytes:
    """
    Return a mesh as binary STL, in single precision as that format has it.

    Parameters
    ----------
    surface
        Any.

    """
    kind = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('rest', '<u2')])
    record = np.zeros(len(surface.faces), dtype=kind)
    record['corners'] = surface.triangles
    return b'fluid_sim_ros'.ljust(80) + np.uint32(len(record)).tobytes() + record.tobytes()


def write_stl(surface: Surface, path: Path) -> None:
    """
    Write a mesh as binary STL.

    Parameters
    ----------
    surface
        Any.
    path
        Of the file.

    """
    path.write_bytes(stl_bytes(surface))
