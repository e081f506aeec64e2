# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The keys of ``fluid_sim.thruster`` for a thruster of a new vehicle."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.new_vehicle.layout import DENSITY, Thruster

#: V/(n D) at which the thrust vanishes: guesses, those of bluerov2 and x500 (doc/thruster.md).
_DUCTED_ADVANCE, _OPEN_ADVANCE = 0.73, 0.6


def instance_keys(thruster: Thruster, *, water: bool) -> dict[str, str]:
    """
    Return the keys of ``fluid_sim.thruster`` for a thruster.

    Parameters
    ----------
    thruster
        Its numbers.
    water
        Whether it is in water: its thrust then follows the density at the disc.

    Returns
    -------
    dict
        Key -> value.

    """
    low, high = thruster.limits
    speeds = [thruster.speed(high)] + ([-thruster.speed(low)] if low < 0 else [])
    keys = {
        'curve': 'quadratic',
        'thrust_coefficient': _text(thruster.k),
        'rad_s_max': _text(speeds),
        'diameter': _text(thruster.diameter),
    }
    if any(thruster.lag):
        keys['time_constant'] = _text(thruster.lag)
    if thruster.spin:
        keys |= {
            'torque_ratio': _text(thruster.torque_ratio),
            'spin': 'ccw' if thruster.spin > 0 else 'cw',
        }
    if water:  # by the density at the disc
        keys |= {'fluid': 'local', 'density': _text(DENSITY['water'])}
    # for the rung inflow, off otherwise: as the T200, and as an open rotor of usual pitch
    keys['zero_thrust_advance'] = _text(_DUCTED_ADVANCE if water else _OPEN_ADVANCE)
    if not water:
        keys |= {'inflow_law': 'momentum', 'density': _text(DENSITY['air'])}
    return keys


def _text(values: ArrayLike) -> str:
    return ' '.join(f'{value + 0.0:.12g}' for value in np.atleast_1d(values))
