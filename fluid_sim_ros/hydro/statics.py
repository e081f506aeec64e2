# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Volume, centre of buoyancy, wetted area and righting arms of a closed body under water."""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.hydro.meshes.repair import Solid
from fluid_sim_ros.hydro.meshes.surface import areas, volume_and_center
from fluid_sim_ros.physics.arrays import Array

#: Of the largest size; a file in single precision has 6e-8.
_ROUNDING = 1e-9
_HEELS = (10.0, 30.0, 60.0, 90.0)  # [deg]


@dataclass(frozen=True)
class Statics:
    """
    What a body at rest displaces.

    Attributes
    ----------
    volume
        [m^3].
    center
        Centre of buoyancy, mesh axes [m], shape (3,).
    wetted_area
        [m^2].
    size
        Length, width, height of the box around it, mesh axes [m], shape (3,).

    """

    volume: float
    center: Array
    wetted_area: float
    size: Array


def statics_of(solid: Solid) -> Statics:
    """
    Return what a body displaces, exact for its mesh.

    Parameters
    ----------
    solid
        The closed body.

    Returns
    -------
    Statics
        In mesh axes.

    """
    surface = solid.in_mesh_axes()
    triangles = surface.triangles
    volume, center = volume_and_center(triangles)
    # rounding of the coordinates is not a place
    center[np.abs(center) < _ROUNDING * surface.size().max()] = 0.0
    return Statics(volume, center, float(areas(triangles).sum()), surface.size())


@dataclass(frozen=True)
class Righting:
    """
    How a body under water rights itself.

    Attributes
    ----------
    net_buoyancy
        Upward, buoyancy less weight [N].
    arm_b
        From the centre of mass to the centre of buoyancy, mesh axes [m], shape (3,).
    roll, pitch
        Attitude at which it hangs still, with the centre of buoyancy above the centre of mass
        [deg].
    heel
        Angles from that attitude [deg].
    arms
        Righting arm at each of them, |arm_b| sin(heel) [m].

    """

    net_buoyancy: float
    arm_b: Array
    roll: float
    pitch: float
    heel: Array
    arms: Array


def righting_of(
    statics: Statics, mass: float, mass_center: Array, density: float, gravity: float
) -> Righting:
    """
    Return how a wholly submerged body rights itself: the couple of weight and buoyancy.

    Parameters
    ----------
    statics
        Of the body.
    mass
        [kg].
    mass_center
        Mesh axes [m], shape (3,).
    density
        Of the fluid [kg/m^3].
    gravity
        [m/s^2].

    Returns
    -------
    Righting
        About the centre of mass.

    """
    arm = statics.center - mass_center
    heel = np.array(_HEELS)
    # level where the arm points up: roll about x first, then pitch about y
    roll = float(np.degrees(np.arctan2(arm[1], arm[2])))
    pitch = float(np.degrees(np.arctan2(0.0 - arm[0], np.hypot(arm[1], arm[2]))))
    return Righting(
        gravity * (density * statics.volume - mass), arm, roll, pitch, heel,
        float(np.linalg.norm(arm)) * np.sin(np.radians(heel)),
    )  # fmt: skip
