# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Altitude, heading (or line) and airspeed hold of a fixed-wing aircraft."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.gains import Gains, gain
from fluid_sim_ros.control.integral import Integral
from fluid_sim_ros.control.law import ControlLaw, clamp, within
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError

_G = 9.81  # [m/s^2]


@dataclass(frozen=True)
class FixedWingGains(Gains):
    """
    Gains and limits; chosen for the Aerosonde at a control rate of 50 to 100 Hz.

    The five ``cruise_`` values are its level trim at 25 m/s (doc/vehicles/aerosonde.md); the laws
    scale them to other airspeeds, so they only need to be near.
    """

    cruise_airspeed: float = gain(25.0, 'm/s', 'airspeed of the values at cruise', positive=True)
    cruise_thrust: float = gain(52.9, 'N', 'thrust command at cruise')
    cruise_pitch: float = gain(0.05, 'rad', 'angle of attack at cruise')
    cruise_lift: float = gain(0.088, 'rad', 'angle of attack that carries the weight at cruise')
    cruise_elevator: float = gain(0.124, 'rad', 'elevator, trailing edge up, at cruise')
    energy: float = gain(0.5, '1/s', 'rate asked for per error of the total energy', positive=True)
    energy_integral: float = gain(0.02, '1/s^2', 'growth of that rate per error')
    balance: float = gain(
        0.7, '1/s', 'rate asked for per error of height less kinetic energy', positive=True
    )
    balance_integral: float = gain(0.04, '1/s^2', 'growth of that rate per error')
    heading: float = gain(0.5, '1/s', 'turn rate asked for per heading or course error')
    line: float = gain(0.02, '1/m', 'steepness of the course towards a line')
    max_intercept: float = gain(
        1.0, 'rad', 'largest angle between course and line far from it', acute=True
    )
    attitude: float = gain(4.0, '1/s', 'rate asked for per roll or pitch error')
    rate: float = gain(0.12, 's', 'aileron and elevator per rate error, at cruise')
    rate_integral: float = gain(0.8, '-', 'growth of aileron and elevator per rate error')
    yaw_rate: float = gain(0.3, 's', 'rudder per yaw rate beyond that of a coordinated turn')
    max_climb: float = gain(2.5, 'm/s', 'largest climb asked for')
    max_airspeed_error: float = gain(3.0, 'm/s', 'airspeed error from which on more does nothing')
    max_bank: float = gain(0.7, 'rad', 'largest bank', acute=True)
    max_pitch: float = gain(0.35, 'rad', 'largest pitch up or down', acute=True)
    max_rate: float = gain(1.5, 'rad/s', 'largest roll or pitch rate asked for')
    idle_thrust: float = gain(20.0, 'N', 'least thrust command; a stopped propeller is a brake')
    min_airspeed: float = gain(
        17.0, 'm/s', 'least airspeed held, whatever is asked for', positive=True
    )


class FixedWingCommand(NamedTuple):
    """Thrust at rest [N]; aileron, elevator, rudder [rad]: right, down and left when positive."""

    thrust: float
    aileron: float
    elevator: float
    rudder: float


class FlightTarget(NamedTuple):
    """
    What an aircraft holds.

    Attributes
    ----------
    altitude
        [m] above the world's z = 0.
    heading
        [rad], counter-clockwise from east.
    airspeed
        [m/s].
    line_w
        A point [m] on a line over ground to follow, whose direction is ``heading``; None: only the
        heading.

    """

    altitude: float
    heading: float
    airspeed: float
    line_w: Sequence[float] | None = None


class FixedWingController(ControlLaw):
    """
    Holds altitude, airspeed, and a heading or a line over ground, in wind and gusts.

    Altitude and airspeed by total energy (Lambregts 1983, AIAA 83-2239; Beard and McLain 2012,
    ch. 6): with the energy height e = h + V^2/2g and the balance b = h - V^2/2g,
    de/dt = V (T - D)/mg and, at constant energy, db/dt = 2 V gamma. So thrust drives the error of
    e, T = T0 + (mg/V)(K_e e~ + i), and pitch that of b, theta = alpha0 + (K_b b~ + j)/2V, with
    the trim T0 and alpha0 at the reference airspeed fed forward.

    Heading by coordinated turns (Beard and McLain, ch. 5), tan(bank) = V/g K_h error. A line by
    its course chi = chi_line - (2/pi) chi_max atan(K_l d) at a distance d (ch. 10), which the
    heading loop follows with the course over ground in place of the heading. Attitude by rate
    loops, whose integrals leave the heading no bias worth an integral of its own; deflections
    scale with 1/V^2, as the moments do with V^2.

    Integrals stand still while their actuator is at a limit and start anew when time goes back.

    Parameters
    ----------
    plant
        Mass and one thruster, which pushes forward.
    max_deflection
        Of the surfaces [rad].
    gains
        See `FixedWingGains`.

    Raises
    ------
    ConfigError
        If the vehicle has not one thruster, or the thrust at cruise lies beyond its limits.

    """

    def __init__(
        self, plant: Plant, max_deflection: float, gains: FixedWingGains | None = None
    ) -> None:
        self.gains = gains = gains or FixedWingGains()
        if len(plant.thrust_limits) != 1:
            raise ConfigError(
                f'{len(plant.thrust_limits)} thrusters; this controller needs one propeller'
            )
        self._weight = plant.weight
        lowest, self._highest = plant.thrust_limits[0].tolist()
        self._lowest = max(lowest, gains.idle_thrust)
        self._max_deflection = max_deflection
        if not self._lowest < gains.cruise_thrust < self._highest:
            raise ConfigError(
                f"gain 'cruise_thrust': {gains.cruise_thrust:g} N; must lie between "
                f'{self._lowest:g} and {self._highest:g} N, the limits of the thruster'
            )
        self._energy = Integral(gains.energy_integral, gains.max_climb, 1)
        self._balance = Integral(gains.balance_integral, 2.0 * gains.max_climb, 1)
        self._rates = Integral(gains.rate_integral, max_deflection, 2)
        super().__init__(self._energy, self._balance, self._rates)

    def step(self, state: State, target: FlightTarget) -> FixedWingCommand:
        """
        Return the commands that answer a state.

        Parameters
        ----------
        state
            Of the vehicle, with the velocity of the air as its medium's.
        target
            What to hold.

        Returns
        -------
        FixedWingCommand
            Thrust [N] and deflections [rad].

        """
        self._advance(state.time)
        altitude, heading, airspeed, line_w = target
        position_w, omega_b = state.position_w, state.omega_b
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        velocity_w = rot.to_world(r_wb, state.velocity_b)
        speed = max(math.dist(velocity_w, state.medium_w), 0.5 * self.gains.min_airspeed)
        roll = rot.roll_of(r_wb)

        error = rot.wrap(heading - rot.yaw_of(r_wb))
        over_ground = speed
        if line_w is not None:
            over_ground = math.hypot(velocity_w[0], velocity_w[1])
            course = self._course(position_w, line_w, heading)
            error = rot.wrap(course - math.atan2(velocity_w[1], velocity_w[0]))
        bank = self._bank(error, over_ground)
        wanted = max(airspeed, self.gains.min_airspeed)
        thrust, pitch = self._energies(altitude - position_w[2], speed, wanted, roll)
        aileron, elevator = self._deflect(r_wb, omega_b, roll, bank, pitch, speed)
        return FixedWingCommand(thrust, aileron, elevator, self._rudder(omega_b[2], roll, speed))

    def _course(
        self, position_w: Sequence[float], line_w: Sequence[float], direction: float
    ) -> float:
        """Return the course over ground [rad] that leads onto a line and along it."""
        gains, c, s = self.gains, math.cos(direction), math.sin(direction)
        left = c * (position_w[1] - line_w[1]) - s * (position_w[0] - line_w[0])
        return direction - gains.max_intercept * 2 / math.pi * math.atan(gains.line * left)

    def _bank(self, error: float, speed: float) -> float:
        """Return the bank [rad], right wing down, for a heading error [rad], left."""
        gains = self.gains
        return within(-math.atan(speed / _G * gains.heading * error), gains.max_bank)

    def _energies(
        self, climb: float, speed: float, wanted: float, roll: float
    ) -> tuple[float, float]:
        """Return thrust command [N] and pitch [rad] for an altitude error [m] and airspeeds."""
        gains = self.gains
        most = gains.max_climb / max(gains.energy, gains.balance)
        height = within(climb, most)
        faster = within(wanted - speed, gains.max_airspeed_error)
        kinetic = faster * (speed + 0.5 * faster) / _G
        relative = wanted / gains.cruise_airspeed

        energy = height + kinetic
        rate = gains.energy * energy + self._energy.value[0]
        thrust = gains.cruise_thrust * relative**2 + self._weight / speed * rate
        bounded = clamp(thrust, self._lowest, self._highest)
        # beyond the clamp the error says nothing of the trim
        far = height != climb
        self._energy.keep(energy, limited=far or bounded != thrust)

        balance = height - kinetic
        load = 1.0 / max(math.cos(roll), 0.5)
        incidence = gains.cruise_pitch + gains.cruise_lift * (load / relative**2 - 1.0)
        rate = gains.balance * balance + self._balance.value[0]
        pitch = incidence + rate / (2.0 * speed)
        self._balance.keep(balance, limited=far or abs(pitch) >= gains.max_pitch)
        return bounded, within(pitch, gains.max_pitch)

    def _deflect(
        self,
        r_wb: rot.Rotation,
        omega_b: Sequence[float],
        roll: float,
        bank: float,
        pitch: float,
        speed: float,
    ) -> tuple[float, float]:
        """Return aileron and elevator [rad] for a bank and a pitch [rad]."""
        gains, most, limit = self.gains, self.gains.max_rate, self._max_deflection
        # pitch up is a turn about -y; in a bank the nose stays up by a pitch rate of its own
        nose_up = rot.elevation_of(r_wb)
        turning = _G / speed * math.tan(within(roll, 1.0)) * math.sin(roll)
        rolling = within(gains.attitude * rot.wrap(bank - roll), most) - omega_b[0]
        pitching = within(gains.attitude * (pitch - nose_up), most) + turning + omega_b[1]
        scale = (gains.cruise_airspeed / speed) ** 2
        held_roll, held_pitch = self._rates.value
        aileron = scale * (gains.rate * rolling + held_roll)
        elevator = -scale * (gains.rate * pitching + held_pitch + gains.cruise_elevator)
        self._rates.keep(
            rolling if abs(aileron) < limit else 0.0, pitching if abs(elevator) < limit else 0.0
        )
        return within(aileron, limit), within(elevator, limit)

    def _rudder(self, yaw_rate: float, roll: float, speed: float) -> float:
        """Return the rudder [rad] that damps what is not the yaw rate of a coordinated turn."""
        gains, limit = self.gains, self._max_deflection
        coordinated = -_G / speed * math.sin(roll)
        scale = (gains.cruise_airspeed / speed) ** 2
        return within(scale * gains.yaw_rate * (coordinated - yaw_rate), limit)
