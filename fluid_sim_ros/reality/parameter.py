# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One parameter of a model that can be fitted."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import mujoco

#: What makes a parameter felt.
MANOEUVRES = {
    'rotor_drag': 'steady flight at speed along x and y',
    'rotor_drag_along': 'climbs and descents at speed',
    'zero_thrust_advance': 'climbs and descents at speed',
    'rotor_height': 'steady flight at speed along x and y, with quick stops',
    'thrust_coefficient': 'hover and climbs; with mass only their ratio is seen: weigh it',
    'torque_ratio': 'steps in yaw',
    'time_constant': 'steps of the commands',
    'mass': 'a known thrust: with thrust_coefficient only their ratio is seen, weigh it',
    'inertia': 'steps in roll, pitch and yaw',
    'com': 'hover and turns',
    'added_mass': 'quick steps along the axis from rest',
    'linear_damping': 'slow steady motion and free decay along the axis',
    'quadratic_damping': 'fast steady motion along the axis',
    'volume': 'a free rise or descent without thrust',
    'center_of_buoyancy': 'a free decay in roll and pitch',
    'delay': 'quick turns and stops; with time_constant, commands that change within the lag',
    'slow_wind': 'flight in several directions', 'slow_current': 'motion in several directions',
    'wind': 'flight in several directions', 'current': 'motion in several directions',
}  # fmt: skip


@dataclass(frozen=True)
class Parameter:
    """
    A number of a model that can be fitted.

    Attributes
    ----------
    name, unit
        Such as ``rotor_drag``, ``thrust_coefficient.m1``, ``quadratic_damping.heave``.
    value
        In the model.
    low, high
        Bounds.
    scale
        A typical size, for steps.
    put
        Writes a value into a spec.

    """

    name: str
    unit: str
    value: float
    low: float
    high: float
    scale: float
    put: Callable[[mujoco.MjSpec, float], None]

    @property
    def manoeuvre(self) -> str:
        """What would make it felt."""
        return MANOEUVRES.get(self.name.partition('.')[0], 'motion along its axis')


def words_of(config: Any, key: str) -> list[float]:
    """
    Return the numbers of a key of a plugin.

    Parameters
    ----------
    config
        Of the plugin.
    key
        Its name.

    """
    return [float(word) for word in config.get(key, '').split()]


def text_of(numbers: Iterable[float]) -> str:
    """
    Return numbers as the value of a key.

    Parameters
    ----------
    numbers
        They.

    """
    return ' '.join(f'{number:.12g}' for number in numbers)
