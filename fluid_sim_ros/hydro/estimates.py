# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Added mass as it is estimated without a computation: from an ellipsoid, and from a box."""

import numpy as np

from fluid_sim_ros.hydro.statics import Statics
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass

#: Square prism along its length: length over width, and added mass over rho times its volume;
#: DNV-RP-C205 (2010), table D-2.
_PRISM = np.array([
    [1, 2, 3, 4, 5, 6, 7, 10],
    [0.68, 0.36, 0.24, 0.19, 0.15, 0.13, 0.11, 0.08],
])  # fmt: skip
#: Square plate face on: added mass over rho pi/4 width^3, same table.
_PLATE = 0.579


def ellipsoid_estimate(statics: Statics, density: float) -> Array:
    """
    Return the added mass of the ellipsoid with the body's volume and the proportions of its box.

    Exact for that ellipsoid (Lamb 1932); what `new-vehicle` takes without a mesh.

    Parameters
    ----------
    statics
        Of the body.
    density
        Of the fluid [kg/m^3].

    Returns
    -------
    Diagonal [kg] x 3, [kg m^2] x 3, shape (6,).

    """
    share = statics.volume / (np.pi / 6 * statics.size.prod())
    axes = 0.5 * statics.size * share ** (1 / 3)
    mass, inertia = ellipsoid_added_mass(axes, density)
    both: Array = np.concatenate([np.atleast_1d(mass), np.atleast_1d(inertia)])
    return both


def box_estimate(statics: Statics, density: float) -> Array:
    """
    Return the added mass of the box around the body, along its axes.

    Of a prism as long as the box is along the axis, with a square of the same area across;
    DNV-RP-C205 table D-2, between a plate and a cube on a straight line.

    Parameters
    ----------
    statics
        Of the body.
    density
        Of the fluid [kg/m^3].

    Returns
    -------
    [kg], shape (3,).

    """
    result = np.empty(3)
    for axis in range(3):
        length = statics.size[axis]
        width = np.sqrt(np.delete(statics.size, axis).prod())
        ratio = length / width
        plate = _PLATE * np.pi / 4 * width**3
        if ratio < 1:
            result[axis] = plate + (_PRISM[1, 0] * width**3 - plate) * ratio
        else:
            result[axis] = np.interp(ratio, *_PRISM) * width**2 * length
    return density * result
