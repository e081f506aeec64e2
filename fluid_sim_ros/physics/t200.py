# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The Blue Robotics T200 at rest in water: thrust against pulse width, 10 to 20 V.

Source: Blue Robotics, "T200 Public Performance Data, 10-20 V", September 2019.
"""

from typing import NamedTuple

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array


class Supply(NamedTuple):
    """Full thrust at 1900 and 1100 us [N] and the edges of the dead zone [us]."""

    forward: float
    reverse: float
    dead_low: float
    dead_high: float


#: By supply voltage [V].
SUPPLIES = {
    10.0: Supply(28.7, 22.6, 1460, 1540),
    12.0: Supply(36.4, 28.6, 1464, 1536),
    14.0: Supply(44.4, 34.5, 1468, 1532),
    16.0: Supply(51.4, 39.9, 1472, 1528),
    18.0: Supply(59.0, 45.0, 1472, 1528),
    20.0: Supply(65.9, 49.4, 1476, 1528),
}

#: Share of the full thrust at eighths of the way from the dead zone to full command (14 V sheet).
SHAPE_FORWARD = (0, 0.068, 0.161, 0.268, 0.389, 0.527, 0.691, 0.857, 1)
SHAPE_REVERSE = (0, 0.071, 0.168, 0.274, 0.398, 0.540, 0.696, 0.861, 1)

#: Rows of full command at 16 V: thrust [N] and speed [rpm], forward and reverse.
FULL_SPEED = ((51.4, 3533.0), (39.9, 3465.0))


def t200_table(voltage: float) -> Array:
    """
    Return the static curve of thrust against pulse width.

    Full thrust and dead zone are the sheet's at 10, 12, ... 20 V and linear between; the shape in
    between is that of the 14 V sheet at every voltage (a pure square is up to 15 % of full thrust
    off). Continuous, never falling, zero in the dead zone.

    Parameters
    ----------
    voltage
        Of the supply, 10 to 20 [V].

    Returns
    -------
    Rows (pulse [us], thrust [N]), pulses rising, shape (18, 2).

    Raises
    ------
    ConfigError
        Outside 10 to 20 V.

    """
    volts = sorted(SUPPLIES)
    if not volts[0] <= voltage <= volts[-1]:
        raise ConfigError(f'voltage: {voltage}; allowed: {volts[0]:g}..{volts[-1]:g} [V]')
    columns = np.array([SUPPLIES[v] for v in volts]).T
    forward, reverse, low, high = (np.interp(voltage, volts, column) for column in columns)
    way = np.linspace(0, 1, len(SHAPE_FORWARD))
    back = np.c_[low + way * (1100 - low), -reverse * np.array(SHAPE_REVERSE)]
    ahead = np.c_[high + way * (1900 - high), forward * np.array(SHAPE_FORWARD)]
    table: Array = np.r_[back[::-1], ahead]
    return table


def t200_speed_constants() -> Array:
    """Return k of T = k omega|omega| forward and reverse [N/(rad/s)^2], shape (2,)."""
    return np.array([thrust / (rpm * np.pi / 30) ** 2 for thrust, rpm in FULL_SPEED])
