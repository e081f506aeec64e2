# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The shadow of a body along each axis, exactly."""

import numpy as np

from fluid_sim_ros.hydro.meshes.manifold import manifold_of
from fluid_sim_ros.hydro.meshes.repair import Solid
from fluid_sim_ros.hydro.meshes.surface import components
from fluid_sim_ros.physics.arrays import Array


def projected_areas(solid: Solid) -> Array:
    """
    Return the area of a body's shadow along x, y and z of its mesh.

    The union of its projected faces (manifold3d), holes left out.

    Parameters
    ----------
    solid
        The closed body.

    Returns
    -------
    [m^2], shape (3,).

    """
    import manifold3d

    surface = solid.surface
    count, label = components(surface.faces)
    parts = [manifold_of(surface.part(label == k)) for k in range(count)]
    result = np.zeros(3)
    for axis in range(3):
        # mesh axes turned so that this one is the z along which manifold3d projects
        order = [(axis + 1) % 3, (axis + 2) % 3, axis]
        turn = np.zeros((3, 4))
        turn[:, :3] = solid.frame.rotation[order]
        shadows = [part.transform(turn).project() for part in parts]
        shadow = manifold3d.CrossSection.batch_boolean(shadows, manifold3d.OpType.Add)
        result[axis] = shadow.area()
    return result * solid.frame.length**2
