# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Residuals of accelerations as numbers: by axis, and against speed, tilt and drive."""

from typing import Any

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.reality.residual.residuals import Residuals

#: A model's acceleration that is smaller, or less alike what was measured, says nothing of a
#: scale: [m/s^2] or [rad/s^2], and the square of the cosine between both.
_FELT, _ALIKE = 0.2, 0.5
#: Nor does a velocity that changes by less say anything of drag, rms about its mean [m/s].
_MOVED = 0.1
AXES = ('x', 'y', 'z')


def summary(found: Residuals, floats: bool = False) -> dict[str, Any]:
    """
    Return the residuals as numbers.

    Parameters
    ----------
    found
        Along a flight.
    floats
        Whether the vehicle's weight is carried by the water: then it says nothing of thrust.

    Returns
    -------
    dict
        Per kind and axis: ``mean``, ``rms``, ``scale`` (measured over model; None where the model
        has too little along the axis to tell), ``speed_rms`` (of the velocity about its mean),
        ``per_speed`` (residual per velocity along the axis; None where it changes too little) and
        the rms in four parts of speed, tilt and drive.

    """
    result: dict[str, Any] = {'floats': floats}
    for name, unit, measured, model in (
        ('specific_force', 'm/s^2', found.force, found.force_model),
        ('angular_acceleration', 'rad/s^2', found.turn, found.turn_model),
    ):
        if not len(measured):
            continue
        off = measured - model
        axes = {
            axis: _axis(measured[:, i], model[:, i], found.speed[:, i], floats)
            for i, axis in enumerate(AXES)
        }
        size = np.linalg.norm(off, axis=1)
        result[name] = {
            'unit': unit, 'axes': axes,
            'against': {
                'speed_m_s': _parts(np.linalg.norm(found.speed, axis=1), size),
                'tilt_deg': _parts(np.degrees(found.tilt), size),
                'drive': _parts(found.drive, size),
            },
        }  # fmt: skip
    if len(found.force):
        off = found.force[:, 2] - found.force_model[:, 2]
        result['specific_force']['z_rms_of_g'] = float(np.sqrt((off**2).mean()) / GRAVITY)
    return result


def _axis(measured: Array, model: Array, speed: Array, centred: bool) -> dict[str, float | None]:
    off, moving = measured - model, speed - speed.mean()
    moved = float(np.sqrt((moving**2).mean()))
    tells = moved > _MOVED
    return {
        'mean': float(off.mean()),
        'rms': float(np.sqrt((off**2).mean())),
        'measured_rms': float(np.sqrt((measured**2).mean())),
        'model_rms': float(np.sqrt((model**2).mean())),
        'scale': _scale(measured, model, centred),
        'speed_rms': moved,
        'per_speed': float(moving @ off / (moving @ moving)) if tells else None,
        'per_speed_explains': float(np.corrcoef(speed, off)[0, 1] ** 2)
        if tells and np.ptp(off) > 1e-12 else 0.0,
    }  # fmt: skip


def _scale(measured: Array, model: Array, centred: bool) -> float | None:
    """Return measured over model by least squares; None where there is too little to tell."""
    if centred:
        measured, model = measured - measured.mean(), model - model.mean()
    both, size, seen = (float(a @ b) for a, b in (
        (measured, model), (model, model), (measured, measured),
    ))  # fmt: skip
    if size < _FELT**2 * len(model) or both**2 < _ALIKE * size * seen:
        return None
    return both / size


def _parts(by: Array, size: Array) -> list[dict[str, float]]:
    """Return the rms of a residual in four parts of equal number."""
    order = np.argsort(by)
    return [
        {'from': float(by[part].min()), 'to': float(by[part].max()),
         'rms': float(np.sqrt((size[part] ** 2).mean()))}
        for part in np.array_split(order, 4) if len(part)
    ]  # fmt: skip
