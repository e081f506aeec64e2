# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How the fins of a torpedo turn it, whatever their number, places and signs."""

import math
from collections.abc import Sequence

import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.physics.arrays import Array

#: Rows of the effect: roll, pitch, yaw.
ROLL, PITCH, YAW = range(3)
#: A fin whose effect is below this share of the largest does not turn the vehicle.
_NOTABLE = 0.05


class FinMixer:
    """
    Turns the deflections of a rudder and stern planes into those of the fins that there are.

    The wanted angular acceleration is a U^2 (planes about y, rudder about z), with the authority
    ``a`` of the controller's fins; deflections of least norm give it, without roll where the fins
    can do that, too. Fossen (2021), Handbook of Marine Craft Hydrodynamics, section 9.4 (lift of
    fins is linear in the deflection and quadratic in the speed).

    Parameters
    ----------
    names
        Fins and other joint actuators, in the vehicle's order.
    effect
        Angular acceleration per deflection and squared speed [1/m^2], base_link axes (roll,
        pitch, yaw), shape (3, n).
    limits
        Lowest and highest deflection [rad], shape (n, 2).

    Attributes
    ----------
    names
        Those that turn the vehicle in pitch or yaw, in the vehicle's order.
    lacks
        ``pitch`` or ``yaw`` where no fin gives it by itself.
    authority
        Angular acceleration per deflection and squared speed that pitch and yaw both have at the
        largest deflection [1/m^2].
    max_deflection
        Largest deflection of the rudder and planes that it is asked for [rad].

    Raises
    ------
    ConfigError
        If none turns the vehicle in pitch or yaw, or a fin that does has no limits.

    """

    def __init__(self, names: Sequence[str], effect: Array, limits: Array) -> None:
        turning = np.linalg.norm(effect[[PITCH, YAW]], axis=0)
        largest = turning.max(initial=0.0)
        chosen = [i for i in range(len(names)) if largest > 0 and turning[i] > _NOTABLE * largest]
        if not chosen:
            raise ConfigError(
                'this controller needs fins (joint actuators) that turn the vehicle in pitch or '
                f'yaw at speed; it has the joint actuators: {listed(names)}'
            )
        self.names = tuple(names[i] for i in chosen)
        self._limits = [(float(low), float(high)) for low, high in limits[chosen]]
        if not all(low < 0 < high and math.isfinite(high - low) for low, high in self._limits):
            raise ConfigError(f'fins {listed(self.names)}: need limits (ctrlrange) around 0')
        matrix = effect[:, chosen]
        rows = _independent(matrix, (PITCH, YAW, ROLL))
        self.lacks = tuple(
            name for row, name in ((PITCH, 'pitch'), (YAW, 'yaw')) if row not in rows
        )
        inverse = np.zeros((len(chosen), 3))
        inverse[:, rows] = np.linalg.pinv(matrix[rows])
        self.max_deflection = min(min(-low, high) for low, high in self._limits)
        # what pitch and yaw both reach with every fin within its limits
        columns = [inverse[:, row] for row in (PITCH, YAW) if row in rows]
        highest = np.array([min(-low, high) for low, high in self._limits])
        reach = min(float((highest / np.maximum(abs(c), 1e-12)).min()) for c in columns)
        self.authority = reach / self.max_deflection
        self._of_planes = (inverse[:, PITCH] * self.authority).tolist()
        self._of_rudder = (inverse[:, YAW] * self.authority).tolist()

    def mix(self, rudder: float, planes: float) -> list[float]:
        """
        Return the deflections of the fins.

        Parameters
        ----------
        rudder, planes
            What a torpedo with these two would have, positive to the left and nose down [rad].

        Returns
        -------
        list
            One per name [rad], within the limits.

        """
        return [
            min(max(of_rudder * rudder + of_planes * planes, low), high)
            for of_rudder, of_planes, (low, high) in zip(
                self._of_rudder, self._of_planes, self._limits, strict=True
            )
        ]


def _independent(matrix: Array, order: Sequence[int]) -> list[int]:
    """Return the rows that are notable and do not depend on those before them."""
    rows: list[int] = []
    largest = np.linalg.norm(matrix[[PITCH, YAW]], axis=1).max()
    for row in order:
        candidate = matrix[[*rows, row]]
        smallest = np.linalg.svd(candidate, compute_uv=False)[-1]
        if len(candidate) <= matrix.shape[1] and smallest > _NOTABLE * largest:
            rows.append(row)
    return sorted(rows)
