# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a controller has to know of its vehicle."""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array


@dataclass(frozen=True)
class Plant:
    """
    Mass, inertia and thrusters of a rigid vehicle.

    Attributes
    ----------
    mass
        [kg].
    inertia
        Moments about the centre of mass, body axes [kg m^2]; products of inertia are neglected.
    weight
        Force that thrust has to carry [N]: gravity less buoyancy.
    thruster_matrix
        Wrench [N, N m] of each thruster at 1 N about the centre of mass, body axes, shape (6, n).
    thrust_limits
        Lowest and highest thrust [N], shape (n, 2).

    """

    mass: float
    inertia: tuple[float, float, float]
    weight: float
    thruster_matrix: Array
    thrust_limits: Array

    def __post_init__(self) -> None:
        if not (np.isfinite(self.mass) and self.mass > 0):
            raise ConfigError(f'vehicle mass {self.mass} kg: must be finite and above 0')
        if not all(np.isfinite(j) and j > 0 for j in self.inertia):
            raise ConfigError(f'vehicle inertia {self.inertia} kg m^2: all must be above 0')
        if self.thruster_matrix.shape[1:] == (0,):
            raise ConfigError('the vehicle has no thrusters; a controller needs some')
