# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's geoms as triangles."""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
import trimesh
from numpy.typing import NDArray

from fluid_sim_ros.physics.arrays import Array

_GEOM = mujoco.mjtGeom
#: Edges between faces that meet at a larger angle stay sharp [rad].
_SHARP = 0.5
#: What is drawn elsewhere: planes are the ground of the scene.
LEFT_OUT = (_GEOM.mjGEOM_PLANE,)


def mesh_of(model: mujoco.MjModel, geom: int) -> Any:
    """
    Return a geom as triangles in its own frame.

    Parameters
    ----------
    model
        The compiled model.
    geom
        Its id.

    Returns
    -------
    Trimesh or None
        None for a plane, and for kinds that have no surface.

    """
    size, kind = model.geom_size[geom], model.geom_type[geom]
    make = trimesh.creation
    if kind == _GEOM.mjGEOM_SPHERE:
        return make.icosphere(subdivisions=3, radius=size[0])
    if kind == _GEOM.mjGEOM_BOX:
        return make.box(extents=2.0 * size)
    if kind == _GEOM.mjGEOM_CAPSULE:
        mesh = make.capsule(radius=size[0], height=2.0 * size[1], count=[16, 16])
        return mesh.apply_translation(-mesh.bounds.mean(axis=0))
    if kind == _GEOM.mjGEOM_CYLINDER:
        return make.cylinder(radius=size[0], height=2.0 * size[1], sections=32)
    if kind == _GEOM.mjGEOM_ELLIPSOID:
        return make.icosphere(subdivisions=3, radius=1.0).apply_scale(size)
    if kind == _GEOM.mjGEOM_MESH:
        return _asset(model, int(model.geom_dataid[geom]))
    if kind == _GEOM.mjGEOM_HFIELD:
        return _height_field(model, int(model.geom_dataid[geom]))
    return None


def triangles(
    model: mujoco.MjModel, data: mujoco.MjData, root: int, geoms: Sequence[int]
) -> tuple[Array, Array] | None:
    """
    Return geoms as triangles in the frame of the body that they are welded to.

    Parameters
    ----------
    model, data
        Posed anyhow.
    root
        Id of the body.
    geoms
        Their ids.

    Returns
    -------
    vertices, faces
        [m], shape (n, 3), and three indices each, shape (m, 3); None if none has a surface.

    """
    r_wb = data.xmat[root].reshape(3, 3)
    parts = []
    for geom in geoms:
        mesh = mesh_of(model, geom)
        if mesh is None:
            continue
        pose = np.eye(4)
        pose[:3, :3] = r_wb.T @ data.geom_xmat[geom].reshape(3, 3)
        pose[:3, 3] = r_wb.T @ (data.geom_xpos[geom] - data.xpos[root])
        # vertices at sharp edges are doubled, so that each side has its own normal
        parts.append(trimesh.graph.smooth_shade(mesh.apply_transform(pose), angle=_SHARP))
    if not parts:
        return None
    whole: Any = trimesh.util.concatenate(parts)
    return np.asarray(whole.vertices), np.asarray(whole.faces)


def _asset(model: mujoco.MjModel, mesh: int) -> trimesh.Trimesh:
    vertex, face = int(model.mesh_vertadr[mesh]), int(model.mesh_faceadr[mesh])
    return trimesh.Trimesh(
        model.mesh_vert[vertex : vertex + int(model.mesh_vertnum[mesh])].copy(),
        model.mesh_face[face : face + int(model.mesh_facenum[mesh])].copy(),
        process=True,
    )


def _height_field(model: mujoco.MjModel, field: int) -> trimesh.Trimesh:
    rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
    start = int(model.hfield_adr[field])
    reach_x, reach_y, top, _ = model.hfield_size[field]
    z = model.hfield_data[start : start + rows * columns] * top
    x, y = np.meshgrid(
        np.linspace(-reach_x, reach_x, columns), np.linspace(-reach_y, reach_y, rows)
    )
    return trimesh.Trimesh(
        np.column_stack([x.ravel(), y.ravel(), z]), grid_faces(rows, columns), process=False
    )


def grid_faces(rows: int, columns: int) -> NDArray[np.uint32]:
    """
    Return the triangles of a grid of points, counter-clockwise seen from +z.

    Parameters
    ----------
    rows, columns
        Of points; a point's index is row * columns + column, x grows with the column.

    Returns
    -------
    Array
        Three indices each, shape (n, 3).

    """
    first = (np.arange(rows - 1)[:, np.newaxis] * columns + np.arange(columns - 1)).ravel()
    right, above = first + 1, first + columns
    return np.concatenate([
        np.column_stack([first, right, above + 1]), np.column_stack([first, above + 1, above]),
    ]).astype(np.uint32)  # fmt: skip
