# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Drag coefficients by the shape that a body shows along an axis, with their published range.

Hoerner (1965), Fluid-Dynamic Drag; DNV-RP-C205 (2010), appendix E. By the area of the shadow.
"""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.physics.arrays import Array

#: A shape is told by the share of its shadow behind faces within 30 deg of the flow: flat face 1,
#: round cylinder 0.5, sphere 0.25.
FACING = float(np.cos(np.radians(30.0)))
_FLAT, _ROUND = 0.7, 0.4
_LONG_FACE = 5.0  # aspect ratio of a shadow that is a strip
_LONG_BODY = 1.5  # depth over the diameter of the shadow behind which the flow reattaches
_SLENDER = 3.0
_ACROSS = 2.0


@dataclass(frozen=True)
class DragClass:
    """
    A shape and its drag coefficient.

    Attributes
    ----------
    name
        What the shape is.
    low, coefficient, high
        Published range and the value taken [-], by the area of the shadow.
    source
        Where they stand.

    """

    name: str
    low: float
    coefficient: float
    high: float
    source: str


CLASSES = {
    'strip': DragClass(
        'long flat face', 1.2, 1.5, 2.0,
        'plates of aspect ratio 5 and more: Hoerner 1965, ch. 3; DNV-RP-C205 app. E',
    ),
    'face': DragClass(
        'flat face', 0.8, 1.05, 1.2, 'cube and plate, face on: Hoerner 1965, ch. 3',
    ),
    'block': DragClass(
        'flat face of a long body', 0.8, 0.87, 1.0,
        'cylinder along its axis, length over 1.5 diameters: Hoerner 1965, ch. 3',
    ),
    'across': DragClass(
        'round body across its length', 0.3, 0.8, 1.2,
        'cylinder of finite length across the flow, 0.3 beyond Re 5e5: Hoerner 1965, ch. 3; '
        'DNV-RP-C205 app. E',
    ),
    'sphere': DragClass(
        'round body', 0.1, 0.47, 0.5, 'sphere, 0.1 to 0.2 beyond Re 4e5: Hoerner 1965, ch. 3',
    ),
    'edged': DragClass(
        'body with edges and curves', 0.5, 0.8, 1.1,
        'between sphere and cube: Hoerner 1965, ch. 3',
    ),
}  # fmt: skip


def slender_class(slenderness: float, friction: float, wet_over_shadow: float) -> DragClass:
    """
    Return the pressure drag of a slender round body along its axis.

    Hoerner (1965), 6-17: C_D,wet = C_f (1 + 1.5 (d/l)^1.5 + 7 (d/l)^3); the friction itself is
    counted apart.

    Parameters
    ----------
    slenderness
        Length over diameter [-].
    friction
        C_f [-].
    wet_over_shadow
        Wetted area over the area of the shadow [-].

    Returns
    -------
    DragClass
        From half of it to four times (laminar separation at the tail).

    """
    thickness = 1 / slenderness
    share = 1.5 * thickness**1.5 + 7 * thickness**3
    coefficient = friction * share * wet_over_shadow
    return DragClass(
        'slender body along its axis', 0.5 * coefficient, coefficient, 4 * coefficient,
        'form factor of streamlined bodies: Hoerner 1965, eq. 6-28',
    )  # fmt: skip


def given_class(coefficient: float) -> DragClass:
    """
    Return a coefficient that the user stated.

    Parameters
    ----------
    coefficient
        [-], by the area of the shadow.

    Returns
    -------
    DragClass
        Without a range.

    """
    return DragClass('as given', coefficient, coefficient, coefficient, 'stated by the user')


def class_of(facing_share: float, shadow: float, size: Array, axis: int) -> str:
    """
    Return the name of the class that a body shows along an axis.

    Parameters
    ----------
    facing_share
        Of the shadow, behind faces within 30 deg of the axis.
    shadow
        Its area [m^2].
    size
        Of the box around the body [m], shape (3,).
    axis
        0, 1 or 2.

    Returns
    -------
    str
        A key of `CLASSES`, or ``slender``.

    """
    across = np.delete(size, axis)
    aspect = float(across.max() / across.min())
    slenderness = float(size[axis] / np.sqrt(4 * shadow / np.pi))
    if facing_share > _FLAT:
        if aspect > _LONG_FACE:
            return 'strip'
        return 'block' if slenderness > _LONG_BODY else 'face'
    if slenderness > _SLENDER:
        return 'slender' if facing_share < _ROUND else 'block'
    if facing_share > _ROUND:
        return 'across' if aspect > _ACROSS else 'edged'
    return 'across' if aspect > _SLENDER else 'sphere'
