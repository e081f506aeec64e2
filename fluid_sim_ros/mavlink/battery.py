# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A battery that a vehicle's thrusters draw on."""

import ctypes
from collections.abc import Sequence

from fluid_sim_ros.mavlink.mapping import BatteryFile
from fluid_sim_ros.plugins.exchange import BatteryState

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
    state
        The same where the compiled exchange draws on it (plugins/src/exchange/battery.cc, with
        the same bits as ``draw``): ``voltage`` and ``current`` at its terminals [V], [A]; the
        charge ``used`` [Ah], and the share of its capacity that is ``left``.

    """

    def __init__(self, file: BatteryFile, limits: Sequence[float]) -> None:
        self._file = file
        self._limits = tuple(limits)
        self._numbers = (ctypes.c_double * len(self._limits))(*self._limits)
        self.state = BatteryState(
            full=file.full, empty=file.empty, capacity=file.capacity, resistance=file.resistance,
            idle=file.idle, full_current=file.full_current, thrusters=len(self._limits),
            limits=ctypes.addressof(self._numbers),
        )  # fmt: skip
        self.refill()

    @property
    def voltage(self) -> float:
        """At its terminals [V]."""
        return float(self.state.voltage)

    @property
    def current(self) -> float:
        """At its terminals [A]."""
        return float(self.state.current)

    @property
    def used(self) -> float:
        """Charge that was drawn [Ah]."""
        return float(self.state.used)

    @property
    def left(self) -> float:
        """The share of its capacity that is left."""
        return float(self.state.left)

    def refill(self) -> None:
        """Be full again, as where a flight begins anew."""
        state, file = self.state, self._file
        state.used, state.left = 0.0, 1.0
        state.current, state.voltage = file.idle, file.full

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
        file, state = self._file, self.state
        shares = 0.0  # added one by one: from Python 3.12 on ``sum`` rounds otherwise
        for thrust, limit in zip(thrusts, self._limits, strict=True):
            shares += (abs(thrust) / limit) ** 1.5
        current = file.idle + file.full_current * shares / len(self._limits)
        used = state.used + current * seconds / _HOUR
        left = max(0.0, 1.0 - used / file.capacity)
        open_voltage = file.empty + left * (file.full - file.empty)
        state.current, state.used, state.left = current, used, left
        state.voltage = max(0.0, open_voltage - file.resistance * current)
