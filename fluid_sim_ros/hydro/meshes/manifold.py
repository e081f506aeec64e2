# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Closed meshes as solids of manifold3d, and back."""

from typing import Any

import numpy as np

from fluid_sim_ros.hydro.meshes.surface import Faces, MeshFaultError, Surface
from fluid_sim_ros.physics.arrays import Array


def manifold_of(surface: Surface) -> Any:
    """
    Return a closed mesh as a solid of manifold3d.

    Parameters
    ----------
    surface
        Closed, all faces outward.

    Raises
    ------
    MeshFaultError
        If it is none.

    """
    import manifold3d

    mesh = manifold3d.Mesh64(
        # manifold3d wants arrays that it might write to
        np.array(surface.vertices, order='C'),
        np.array(surface.faces, dtype=np.uint64, order='C'),
    )
    solid = manifold3d.Manifold(mesh)
    if solid.status() != manifold3d.Error.NoError:
        mesh.merge()
        solid = manifold3d.Manifold(mesh)
    if solid.status() != manifold3d.Error.NoError:
        raise MeshFaultError(
            f'a part is no closed solid ({solid.status().name}); mend it in a modelling program',
            surface.vertices.mean(axis=0),
        )
    return solid


def surface_of(solid: Any) -> Surface:
    """
    Return the mesh of a solid of manifold3d.

    Parameters
    ----------
    solid
        A ``manifold3d.Manifold``.

    Returns
    -------
    Surface
        Closed, in double precision.

    """
    mesh = solid.to_mesh64()
    faces: Faces = np.asarray(mesh.tri_verts).astype(np.int64)
    vertices: Array = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3]
    return Surface(vertices, faces)
