# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Several propellers that push a torpedo forward, as one."""

from dataclasses import replace

import numpy as np

from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.errors import ConfigError

#: A thruster counts where at least this share of its thrust points forward.
_FORWARD = 0.5


class Propulsion:
    """
    Shares a forward thrust among the thrusters that point forward, each by its limit.

    Parameters
    ----------
    plant
        The vehicle with all its thrusters.

    Attributes
    ----------
    plant
        The same with one thruster that pushes forward.

    Raises
    ------
    ConfigError
        If none points forward, or one that does has no limits.

    """

    def __init__(self, plant: Plant) -> None:
        forward = np.where(plant.thruster_matrix[0] > _FORWARD, plant.thruster_matrix[0], 0.0)
        low, high = plant.thrust_limits.T
        if not forward.any():
            raise ConfigError('no thruster pushes forward; this controller needs one')
        if len(forward) == 1:
            self.plant, self._shares = plant, [1.0]
            return
        if not np.isfinite(plant.thrust_limits[forward > 0]).all():
            raise ConfigError('thrusters that push forward need limits (ctrlrange)')
        lowest, most = float(forward @ low), float(forward @ high)
        matrix = np.zeros((6, 1))
        matrix[0] = 1.0
        self.plant = replace(
            plant, thruster_matrix=matrix, thrust_limits=np.array([[lowest, most]])
        )
        self._shares = (np.where(forward > 0, high, 0.0) / most).tolist()

    def thrusts(self, thrust: float) -> list[float]:
        """
        Return the thrust of each thruster.

        Parameters
        ----------
        thrust
            Of all together, forward [N].

        Returns
        -------
        list
            [N], one per thruster.

        """
        return [share * thrust for share in self._shares]
