# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a control law is told of its vehicle."""

import math
from collections.abc import Sequence
from typing import NamedTuple


class State(NamedTuple):
    """
    State of a vehicle's base_link at one time.

    Attributes
    ----------
    time
        Its stamp [s].
    position_w, quat_wb_wxyz
        Position [m], world axes, shape (3,); attitude, body to world, scalar first, shape (4,).
    velocity_b, omega_b
        Twist over ground in body axes [m/s], [rad/s], shape (3,) each.
    medium_w
        Velocity of the medium at the vehicle [m/s], world axes; zero where nobody asked for it.

    """

    time: float
    position_w: Sequence[float]
    quat_wb_wxyz: Sequence[float]
    velocity_b: Sequence[float]
    omega_b: Sequence[float]
    medium_w: Sequence[float] = (0.0, 0.0, 0.0)

    def is_sound(self) -> bool:
        """Return whether every number is finite and the quaternion is near a unit one."""
        time, (a, b, c), (w, x, y, z), (d, e, f), (g, h, i), (j, k, m) = self
        finite = math.isfinite(time + a + b + c + d + e + f + g + h + i + j + k + m)
        return finite and 0.5 < w * w + x * x + y * y + z * z < 2.0
