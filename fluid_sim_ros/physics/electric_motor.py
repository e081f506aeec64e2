# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A brushless motor and its propeller in equilibrium: from the throttle to the speed."""

import math
from dataclasses import dataclass

from fluid_sim_ros.errors import ConfigError

Coefficients = tuple[float, float, float]


@dataclass(frozen=True)
class ElectricMotor:
    """
    A brushless motor: V = throttle V_max = i R + K w, torque = K (i - i0).

    Attributes
    ----------
    torque_constant
        K [N m/A = V s/rad]; 60/(2 pi KV) for KV in rpm/V.
    resistance
        R [ohm].
    no_load_current
        i0 [A].
    max_voltage
        V_max [V].

    """

    torque_constant: float
    resistance: float
    no_load_current: float
    max_voltage: float

    def __post_init__(self) -> None:
        for name in ('torque_constant', 'resistance', 'max_voltage'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise ConfigError(f"motor '{name}': {value}; must be finite and above 0")

    def throttle(self, speed: float, torque: float) -> float:
        """
        Return the throttle that holds a speed against a shaft torque.

        Beard and McLain (2012), Small Unmanned Aircraft, supplement to section 4.3.

        Parameters
        ----------
        speed
            Of the shaft [rad/s].
        torque
            That the load resists with [N m].

        Returns
        -------
        [-]; above 1 the motor cannot hold the speed.

        """
        current = torque / self.torque_constant + self.no_load_current
        voltage = self.resistance * current + self.torque_constant * speed
        return voltage / self.max_voltage

    def speed(
        self,
        throttle: float,
        airspeed: float,
        *,
        torque_coefficients: Coefficients,
        diameter: float,
        density: float,
    ) -> float:
        """
        Return the steady speed [rad/s] of the motor with a propeller.

        Beard and McLain (2012), Small Unmanned Aircraft, supplement to section 4.3: where the
        motor's torque is that of the propeller, Q = rho D^5 (c0 n^2 + c1 n V/D + c2 V^2/D^2) with
        n = w/(2 pi): a quadratic in w, of which the larger root is the stable one. Never below 0:
        a propeller that the flow turns is not described.

        Parameters
        ----------
        throttle
            0 to 1.
        airspeed
            Along the axis V [m/s].
        torque_coefficients
            c0, c1, c2 of CQ(J).
        diameter, density
            [m], [kg/m^3].

        Raises
        ------
        ConfigError
            If the propeller asks for no equilibrium at this throttle and airspeed.

        """
        c0, c1, c2 = torque_coefficients
        k, r, rho, d = self.torque_constant, self.resistance, density, diameter
        a = rho * d**5 * c0 / (2 * math.pi) ** 2
        b = rho * d**4 * c1 * airspeed / (2 * math.pi) + k * k / r
        c = rho * d**3 * c2 * airspeed**2 - k * (
            self.max_voltage * throttle / r - self.no_load_current
        )
        inside = b * b - 4 * a * c
        if inside < 0 or a <= 0:
            raise ConfigError(
                f'motor and propeller have no steady speed at throttle {throttle:g} and '
                f'{airspeed:g} m/s'
            )
        return max((-b + math.sqrt(inside)) / (2 * a), 0.0)


#: Motor of the Aerosonde: 145 rpm/V, 0.042 ohm, 1.5 A, 44.4 V (mavsim_public).
AEROSONDE_MOTOR = ElectricMotor(60 / (2 * math.pi * 145), 0.042, 1.5, 44.4)
