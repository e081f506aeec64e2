# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Depth, heading and speed hold of a torpedo: one propeller, a rudder and stern planes."""

import math
from dataclasses import dataclass
from typing import NamedTuple

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.gains import Gains, gain
from fluid_sim_ros.control.integral import Integral
from fluid_sim_ros.control.law import ControlLaw, clamp, within
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError


@dataclass(frozen=True)
class TorpedoGains(Gains):
    """Gains and limits; chosen for a REMUS 100 at 1 to 2.5 m/s and 20 to 100 Hz."""

    depth: float = gain(0.25, '1/s', 'vertical speed asked for per depth error')
    trim: float = gain(
        0.15, '1/s', 'growth of the vertical speed asked for per error of it: no depth error '
        'with ballast or buoyancy'
    )  # fmt: skip
    attitude: float = gain(0.6, '1/s', 'rate asked for per pitch or heading error')
    rate: float = gain(3.0, '1/s', 'angular acceleration per rate error')
    rate_integral: float = gain(
        1.5, '1/s^2', 'growth of the angular acceleration per rate error: against the righting '
        'moment and the drag of turning'
    )  # fmt: skip
    fin_authority: float = gain(
        0.74, '1/m^2', 'angular acceleration by the fins per deflection and squared speed; of the '
        'REMUS 100: Muuds over moment of inertia and added moment of inertia', positive=True
    )  # fmt: skip
    speed: float = gain(0.5, '1/s', 'acceleration asked for per speed error')
    speed_integral: float = gain(
        0.1, '1/s^2', 'growth of the acceleration per speed error: carries the drag'
    )
    max_pitch: float = gain(0.35, 'rad', 'largest pitch asked for', acute=True)
    max_climb: float = gain(0.25, 'm/s', 'largest vertical speed asked for')
    max_trim: float = gain(0.6, 'm/s', 'largest vertical speed of the trim')
    max_rate: float = gain(
        0.1, 'rad/s', 'largest rate asked for; a tighter turn takes the speed that the planes need'
    )
    min_speed: float = gain(
        0.7, 'm/s', 'speed below which the fins are taken to be no weaker, so that they do not go '
        'to their limits at rest', positive=True
    )  # fmt: skip


class CruiseTarget(NamedTuple):
    """
    What a torpedo holds.

    Attributes
    ----------
    depth
        [m], positive below the world's z = 0.
    heading
        [rad], counter-clockwise from east.
    speed
        Forward speed over ground [m/s].

    """

    depth: float
    heading: float
    speed: float


class TorpedoController(ControlLaw):
    """
    Holds depth, heading and surge speed by planes, rudder and propeller.

    Cascades (Fossen 2021, ch. 15). With U = max(|u|, min_speed):

    vertical speed  c* = K_z (z* - z), within +-max_climb
    pitch, up       theta* = asin((c* + i)/U), di/dt = K_i (c* - c), within +-max_pitch
    rates           [theta', psi']* = K (errors of pitch and heading), to body axes by the roll
    deflection      [planes, rudder] = (K_w (w* - w) + j)/(a U^2), dj/dt = K_j (w* - w)
    thrust          m (K_u (u* - u) + k), dk/dt = K_s (u* - u)

    Each integrator stands still while what it feeds is at its limit, and all start anew when time
    goes back. Roll is left to the righting moment. A vehicle that is lighter than the water needs
    speed to stay down.

    Parameters
    ----------
    plant
        Mass and one thruster, which pushes forward.
    max_deflection
        Of the fins [rad].
    gains
        See `TorpedoGains`.

    """

    def __init__(
        self, plant: Plant, max_deflection: float, gains: TorpedoGains | None = None
    ) -> None:
        matrix = plant.thruster_matrix
        if matrix.shape[1] != 1 or matrix[0, 0] <= 0:
            raise ConfigError(
                f'{matrix.shape[1]} thrusters; this controller needs one, which pushes forward'
            )
        if not 0 < max_deflection < math.pi / 2:
            raise ConfigError(
                f'largest deflection of the fins {max_deflection} rad: must be above 0, below pi/2'
            )
        self.plant = plant
        self.max_deflection = max_deflection
        self.gains = gains = gains or TorpedoGains()
        self._low, self._high = (float(limit) for limit in plant.thrust_limits[0])
        self._trim = Integral(gains.trim, gains.max_trim, 1)
        most = max_deflection * gains.fin_authority * 4.0  # [rad/s^2] what fins give at 2 m/s
        self._planes = Integral(gains.rate_integral, most, 1)
        self._rudder = Integral(gains.rate_integral, most, 1)
        self._drag = Integral(gains.speed_integral, self._high / plant.mass, 1)
        super().__init__(self._trim, self._planes, self._rudder, self._drag)

    def step(self, state: State, target: CruiseTarget) -> tuple[float, float, float]:
        """
        Return what answers a state.

        Parameters
        ----------
        state
            Of the vehicle.
        target
            What to hold.

        Returns
        -------
        tuple
            Thrust [N]; deflection of the rudder, positive to the left, and of the planes, positive
            nose down [rad].

        """
        self._advance(state.time)
        velocity_b, omega_b = state.velocity_b, state.omega_b
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        u = max(abs(velocity_b[0]), self.gains.min_speed)
        climb = rot.to_world(r_wb, velocity_b)[2]
        pitch = self._pitch(-target.depth - state.position_w[2], climb, u)
        rate_y, rate_z = self._rates(r_wb, pitch, target.heading)
        planes = self._deflection(self._planes, rate_y - omega_b[1], u)
        rudder = self._deflection(self._rudder, rate_z - omega_b[2], u)
        return self._thrust(target.speed - velocity_b[0]), rudder, planes

    def _pitch(self, rise: float, climb: float, u: float) -> float:
        """Return the pitch [rad], nose up, that leads to a height ``rise`` [m] above."""
        gains = self.gains
        wanted = within(gains.depth * rise, gains.max_climb)
        sine = (wanted + self._trim.value[0]) / u
        bound = math.sin(gains.max_pitch)
        self._trim.keep(wanted - climb, limited=abs(sine) >= bound)
        return math.asin(within(sine, bound))

    def _rates(self, r_wb: rot.Rotation, pitch: float, heading: float) -> tuple[float, float]:
        """Return the rates about the body's y and z axes [rad/s] towards pitch and heading."""
        gains = self.gains
        up = rot.elevation_of(r_wb)
        # Fossen (2021), eq. 2.39; up is minus the turn about y in axes forward, left, up
        of_pitch = -within(gains.attitude * (pitch - up), gains.max_rate)
        of_heading = gains.attitude * rot.wrap(heading - rot.yaw_of(r_wb))
        of_heading = within(of_heading, gains.max_rate) * math.cos(up)
        roll = rot.roll_of(r_wb)
        c, s = math.cos(roll), math.sin(roll)
        return c * of_pitch + s * of_heading, c * of_heading - s * of_pitch

    def _deflection(self, integral: Integral, error: float, u: float) -> float:
        """Return the deflection [rad] that a rate error [rad/s] asks for."""
        gains = self.gains
        wanted = gains.rate * error + integral.value[0]
        wanted /= gains.fin_authority * u * u
        integral.keep(error, limited=abs(wanted) >= self.max_deflection)
        return within(wanted, self.max_deflection)

    def _thrust(self, error: float) -> float:
        """Return the thrust [N] that a speed error [m/s] asks for."""
        wanted = self.plant.mass * (self.gains.speed * error + self._drag.value[0])
        self._drag.keep(error, limited=not self._low < wanted < self._high)
        return clamp(wanted, self._low, self._high)
