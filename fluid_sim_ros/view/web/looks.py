# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a user of the page wants to see."""

from dataclasses import dataclass, field

CAMERAS = ('follow', 'free', 'onboard')


@dataclass
class Looks:
    """
    What a user wants to see; set by the panels, read for every picture.

    Attributes
    ----------
    vehicle
        That is followed.
    camera
        One of ``CAMERAS``.
    terms
        Whose arrows are drawn.
    scale
        Of the arrows; 1: the weight is two extents of the vehicle long.
    fluid_scale
        How much longer the arrows of fluid forces are drawn.
    flow_scale
        Length of the arrows of wind and current; 1: one extent for 5 m/s and 0.5 m/s.
    labels, flow, trail, each_thruster
        Whether these are drawn.

    """

    vehicle: str
    camera: str = 'follow'
    terms: set[str] = field(default_factory=set)
    scale: float = 1.0
    fluid_scale: float = 1.0
    flow_scale: float = 1.0
    labels: bool = True
    flow: bool = True
    trail: bool = True
    each_thruster: bool = True
