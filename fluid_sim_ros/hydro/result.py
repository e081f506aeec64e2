# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Coefficients as JSON."""

from typing import Any

import numpy as np

from fluid_sim_ros.hydro.coefficients import Coefficients
from fluid_sim_ros.hydro.damping import Damping
from fluid_sim_ros.hydro.keys import body_keys

#: The volume of a repaired mesh is exact to its coordinates, which are rounded to 1e-10.
_VOLUME_ERROR = 1e-9


def as_json(found: Coefficients) -> dict[str, Any]:
    """
    Return coefficients as JSON has them.

    Parameters
    ----------
    found
        Of a mesh.

    Returns
    -------
    dict
        SI units, mesh axes; ``added_mass`` as `fluid_sim.body` wants it.

    """
    added, statics, damping = found.added_mass, found.statics, found.damping
    mass = found.request.density * statics.volume
    diagonal, error = np.diag(added.matrix), np.diag(added.error)
    about_center = np.diag(added.about(statics.center).matrix)
    result: dict[str, Any] = {
        'mesh': str(found.file.path),
        'unit': found.file.unit,
        'triangles': found.file.triangles,
        'repairs': list(found.file.repairs),
        'density': found.request.density,
        'viscosity': found.viscosity,
        'volume': statics.volume,
        'center_of_buoyancy': statics.center.tolist(),
        'wetted_area': statics.wetted_area,
        'size': statics.size.tolist(),
        'reference_point': added.point.tolist(),
        'added_mass': added.matrix.tolist(),
        'estimated_errors': {
            'added_mass': added.error.tolist(),
            'added_mass_diagonal_relative': [
                float(e / a) if a > e else None for a, e in zip(diagonal, error, strict=True)
            ],
            'volume': _VOLUME_ERROR * statics.volume,
        },
        'bounded_by': [
            {'name': plane.name, 'normal': plane.normal.tolist(), 'offset': plane.offset}
            for plane in found.request.planes
        ],
        'added_mass_over_displaced': (about_center[:3] / mass).tolist(),
        'compared': {
            'ellipsoid': found.ellipsoid.tolist(),
            'box': found.box.tolist(),
            'added_mass_about_center_of_buoyancy': about_center.tolist(),
        },
        'panels': list(added.panels),
        'volume_ratio': added.volume_ratio,
        'seconds': added.seconds,
        'damping': _damping_json(damping, found.request.thrust),
        'righting': None,
        'keys': body_keys(found),
    }
    if found.righting is not None:
        righting = found.righting
        result['righting'] = {
            'net_buoyancy': righting.net_buoyancy,
            'center_of_buoyancy_from_center_of_mass': righting.arm_b.tolist(),
            'roll_deg': righting.roll,
            'pitch_deg': righting.pitch,
            'heel_deg': righting.heel.tolist(),
            'righting_arm': righting.arms.tolist(),
        }
    return result


def _damping_json(damping: Damping, thrust: float | None) -> dict[str, Any]:
    result: dict[str, Any] = {
        'speed': damping.speed,
        'quadratic': damping.quadratic.tolist(),
        'quadratic_low': damping.low.tolist(),
        'quadratic_high': damping.high.tolist(),
        'linear': damping.linear.tolist(),
        'axes': [
            {
                'shape': axis.shape.name, 'drag_coefficient': axis.shape.coefficient,
                'range': [axis.shape.low, axis.shape.high], 'source': axis.shape.source,
                'projected_area': axis.shadow, 'reynolds': axis.reynolds,
                'friction_coefficient': axis.friction, 'friction_area': axis.rubbed,
                'form': axis.form, 'friction': axis.rub,
            }
            for axis in damping.axes
        ],
        'thrust_at_speed': (damping.quadratic[:3] * damping.speed**2).tolist(),
    }  # fmt: skip
    if thrust is not None:
        result['thrust'] = thrust
        result['top_speed'] = damping.top_speeds(thrust).tolist()
    return result
