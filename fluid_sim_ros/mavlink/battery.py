# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A battery that a vehicle's thrusters draw on."""

from collections.abc import Sequence

from fluid_sim_ros.mavlink.mapping import BatteryFile

_HOUR = 3600.0  # [s]


class Battery:
    """
    Voltage and current of a battery: a linear source behind a resistance.

    The current of a thruster goes with its thrust to the power of 1.5, since the ideal power of an
    actuator disk at rest is T^1.5 / sqrt(2 rho A) (Leishman, Principles of Helicopter
    Aerodynamics, eq. 2.15), and the voltage hardly changes.

    Parameters
    ----------
    file
        Its numbers.
    limits
        Largest thrust of each thruster [N].

    Attributes
    ----------
    voltage, current
        At its terminals [V], [A].
    used, left
        Charge that was drawn [Ah], and the share of its capacity that is left.

    """

    def __init__(self, file: BatteryFile, limits: Sequence[float]) -> None:
        self._file = file
        self._limits = tuple(limits)
        self.refill()

    def refill(self) -> None:
        """Be full again, as where a flight begins anew."""
        self.used, self.left = 0.0, 1.0
        self.current = self._file.idle
        self.voltage = self._file.full

    def draw(self, thrusts: Sequence[float], seconds: float) -> None:
        """
        Use it for a while.

        Parameters
        ----------
        thrusts
            Of all thrusters [N].
        seconds
            How long.

        """
        file = self._file
        shares = [(abs(t) / limit) ** 1.5 for t, limit in zip(thrusts, self._limits, strict=True)]
        self.current = file.idle + file.full_current * sum(shares) / len(shares)
        self.used += self.current * seconds / _HOUR
        self.left = max(0.0, 1.0 - self.used / file.capacity)
        open_voltage = file.empty + self.left * (file.full - file.empty)
        self.voltage = max(0.0, open_voltage - file.resistance * self.current)
