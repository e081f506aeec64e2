# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where a sensor is and how it moves, from the observed state of its vehicle."""

from collections.abc import Sequence

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.sensors.mount import Mount

#: Linear and angular velocity lie side by side.
_VELOCITIES = slice(nat.LINEAR_VELOCITY.start, nat.ANGULAR_VELOCITY.stop)


class Posed:
    """
    What sensors measure with.

    In plain floats, in a fixed order: three times as fast as products of small arrays, and the
    same bits on every processor and in the compiled twin (plugins/src/exchange).

    Parameters
    ----------
    state
        Row of ``Simulation.observe`` of the vehicle, which follows each call.
    mount
        Where the sensor sits.

    Attributes
    ----------
    mount
        As above.

    """

    def __init__(self, state: Array, mount: Mount) -> None:
        self.mount = mount
        self._state = state
        self._arm = mount.position_b.tolist()
        self._matrix = np.empty(9)

    def _axes_w(self) -> list[float]:
        """Return base_link's axes in the world: the columns of nine numbers, row by row."""
        mujoco.mju_quat2Mat(self._matrix, self._state[nat.QUATERNION])
        return self._matrix.tolist()

    def _to_body(self, vector_w: Sequence[float]) -> tuple[float, float, float]:
        """Turn a world vector into base_link's axes."""
        x, y, z = vector_w
        a, b, c, d, e, f, g, h, i = self._axes_w()
        return a * x + d * y + g * z, b * x + e * y + h * z, c * x + f * y + i * z

    def _to_world(self, vector_b: Sequence[float]) -> tuple[float, float, float]:
        """Turn a vector of base_link's axes into those of the world."""
        x, y, z = vector_b
        a, b, c, d, e, f, g, h, i = self._axes_w()
        return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z

    def _rotation_bw(self) -> Array:
        """Return the matrix that turns world vectors into base_link's axes, shape (3, 3)."""
        return np.array(self._axes_w()).reshape(3, 3).T

    def _position_w(self) -> tuple[float, float, float]:
        """Return the sensor's place in the world [m]."""
        px, py, pz = self._state[nat.POSITION].tolist()
        x, y, z = self._to_world(self._arm)
        return px + x, py + y, pz + z

    def _velocity_b(self) -> Array:
        """Return the velocity of the sensor's place [m/s], base_link axes: v + w x r."""
        vx, vy, vz, wx, wy, wz = self._state[_VELOCITIES].tolist()
        rx, ry, rz = self._arm
        return np.array([vx + wy * rz - wz * ry, vy + wz * rx - wx * rz, vz + wx * ry - wy * rx])
