# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Drag of a hull in air, as keys of ``fluid_sim.body``."""

import numpy as np

from fluid_sim_ros.hydro.damping import damping_of
from fluid_sim_ros.hydro.keys import numbers
from fluid_sim_ros.hydro.panels import panels_of
from fluid_sim_ros.hydro.projected import projected_areas
from fluid_sim_ros.hydro.quads import three_cornered
from fluid_sim_ros.new_vehicle.importing.hull import Hull
from fluid_sim_ros.physics.arrays import Array

_VISCOSITY = 1.79e-5  # [Pa s] air at 15 degC (ISA)
_PANELS = 600  # strips for the drag of a turning body
_SPEED = 5.0  # [m/s] at which friction is taken


def air_drag_keys(hull: Hull, density: float, point: Array) -> dict[str, str]:
    """
    Return form drag and friction of a hull; its added mass and buoyancy in air are left out.

    Parameters
    ----------
    hull
        Of the vehicle.
    density
        Of the air [kg/m^3].
    point
        About which damping is stated, base axes [m], shape (3,).

    Returns
    -------
    dict
        Key -> value.

    """
    solid = hull.file.solid
    panels = panels_of(solid.surface, _PANELS).fine
    corners = np.concatenate([
        panels[:, [0, 1, 2]], panels[~three_cornered(panels)][:, [0, 2, 3]],
    ])  # fmt: skip
    damping = damping_of(
        solid.frame.outward(corners), hull.statics, projected_areas(solid), point, density,
        _VISCOSITY, speed=_SPEED,
    )  # fmt: skip
    return {
        'reference_point': numbers(point),
        'quadratic_damping': numbers(damping.quadratic, 4),
        'drag': 'none',
    }
