# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The shape of an open-frame ROV, made of boxes and cylinders, for examples.

About as large as a BlueROV2 and of no real vehicle: two side plates, a tube for the electronics,
one for the battery, foam on top, and eight ducts of thrusters without their propellers.
"""

from fluid_sim_ros.hydro.meshes.shapes import box, cylinder, together
from fluid_sim_ros.hydro.meshes.surface import Surface

#: Where the ducts are [m]: four horizontal ones, four vertical ones.
HORIZONTAL = ((0.15, -0.125), (0.15, 0.125), (-0.15, -0.125), (-0.15, 0.125))
VERTICAL = ((0.12, -0.22), (0.12, 0.22), (-0.12, -0.22), (-0.12, 0.22))
#: Height of the horizontal ducts, diameter and length of a duct [m].
DUCT_HEIGHT, DUCT_DIAMETER, DUCT_LENGTH = -0.04, 0.09, 0.05


def rov_frame(sections: int = 16) -> Surface:
    """
    Return the frame with all that is fixed to it, x forward, y left, z up.

    Parameters
    ----------
    sections
        Of the circles.

    Returns
    -------
    Surface
        Closed parts, some of which overlap [m].

    """
    plates = [box((0.44, 0.012, 0.22), (0.0, side * 0.17, -0.01)) for side in (1, -1)]
    bars = [box((0.03, 0.34, 0.012), (x, 0.0, z)) for x in (0.17, -0.17) for z in (-0.1, 0.05)]
    tubes = [
        cylinder(0.057, 0.34, 'x', (0.0, 0.0, 0.06), 2 * sections),
        cylinder(0.045, 0.32, 'x', (0.0, 0.0, -0.07), 2 * sections),
    ]
    foam = [box((0.30, 0.08, 0.05), (0.0, side * 0.13, 0.105)) for side in (1, -1)]
    ducts = [
        cylinder(DUCT_DIAMETER / 2, DUCT_LENGTH, 'z', (x, y, 0.02), sections) for x, y in VERTICAL
    ]
    ducts += [
        cylinder(DUCT_DIAMETER / 2, DUCT_LENGTH, 'x', (x, y, DUCT_HEIGHT), sections)
        for x, y in HORIZONTAL
    ]
    # carriers hold the outer ducts to the plates
    carriers = [box((0.03, 0.08, 0.012), (x, 0.8 * y, 0.02)) for x, y in VERTICAL]
    return together([*plates, *bars, *tubes, *foam, *ducts, *carriers])
