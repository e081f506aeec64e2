# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Position control of a multirotor: position, velocity, attitude and rate loops in cascade."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.allocation import Allocator
from fluid_sim_ros.control.approach import Approach
from fluid_sim_ros.control.gains import Gains, gain
from fluid_sim_ros.control.integral import Integral
from fluid_sim_ros.control.law import ControlLaw, clamp, within
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError

#: Roll and pitch before thrust: a vehicle that cannot tilt cannot be saved by more thrust; the
#: thrust command itself keeps ``thrust_margin`` clear, so there is room for both. Yaw comes last.
PRIORITY = (('fz',), ('tx', 'ty'), ('tz',))


@dataclass(frozen=True)
class MultirotorGains(Gains):
    """Gains and limits; chosen for the x500 at a control rate of 100 Hz."""

    position: float = gain(1.5, '1/s', 'speed asked for per position error')
    velocity: float = gain(4.0, '1/s', 'acceleration asked for per speed error')
    integral: float = gain(
        6.0, '1/s^2', 'growth of the acceleration per speed error: steady wind leaves no error'
    )
    attitude: float = gain(9.0, '1/s', 'rate asked for per attitude error')
    rate: float = gain(25.0, '1/s', 'angular acceleration per rate error, roll and pitch')
    yaw_rate: float = gain(
        8.0, '1/s', 'the same for yaw; weaker, since the reaction torque of rotors is small'
    )
    max_speed: float = gain(4.0, 'm/s', 'largest horizontal speed')
    max_climb: float = gain(2.0, 'm/s', 'largest vertical speed')
    max_acceleration: float = gain(3.0, 'm/s^2', 'largest change of the horizontal speed')
    max_lift: float = gain(2.0, 'm/s^2', 'largest change of the vertical speed')
    max_tilt: float = gain(0.6, 'rad', 'largest angle between thrust and up', acute=True)
    max_rate: float = gain(4.0, 'rad/s', 'largest rate asked for')
    max_integral: float = gain(6.0, 'm/s^2', 'largest acceleration of the integrator on each axis')
    thrust_margin: float = gain(
        0.1, '-', 'share of the total thrust that is kept for torque at both ends'
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.thrust_margin >= 0.5:
            raise ConfigError(f"gain 'thrust_margin': {self.thrust_margin}; must be below 0.5")


class PoseTarget(NamedTuple):
    """
    A place to hold.

    Attributes
    ----------
    position_w
        [m], world axes, shape (3,).
    yaw
        Heading [rad], counter-clockwise from east.

    """

    position_w: Sequence[float]
    yaw: float = 0.0


class MultirotorController(ControlLaw):
    """
    Holds a position and a heading, in wind too.

    v* approaches the target (`Approach`); a = dv*/dt + K_v (v* - v) + i, di/dt = K_i (v* - v).
    F = m (a + g e_z) gives thrust and, with the heading, attitude (Mellinger and Kumar 2011).
    On SO(3) w* = K_R log(R^T R_d); torque = J K_w (w* - w) + w x J w. The integrator stands still
    while a limit binds (anti-windup), and starts anew when time goes back.

    Parameters
    ----------
    plant
        Mass, inertia, thrusters.
    gains
        See `MultirotorGains`.

    """

    def __init__(self, plant: Plant, gains: MultirotorGains | None = None) -> None:
        self.plant = plant
        self.gains = gains = gains or MultirotorGains()
        self.allocator = Allocator(plant.thruster_matrix, plant.thrust_limits, PRIORITY)
        full = float(plant.thrust_limits[:, 1] @ plant.thruster_matrix[2])
        if full <= plant.weight:
            raise ConfigError(
                f'thrusters lift {full:.2f} N at most; the vehicle weighs {plant.weight:.2f} N'
            )
        self._lowest = gains.thrust_margin * full
        self._highest = max((1.0 - gains.thrust_margin) * full, plant.weight)
        self._tan_tilt = math.tan(gains.max_tilt)
        self._across = Approach(gains.position, gains.max_speed, gains.max_acceleration)
        self._upward = Approach(gains.position, gains.max_climb, gains.max_lift)
        self._integral = Integral(gains.integral, gains.max_integral)
        super().__init__(self._integral)

    @property
    def integral_w(self) -> tuple[float, float, float]:
        """Acceleration that the integrator holds against wind [m/s^2], world axes."""
        ax, ay, az = self._integral.value
        return (ax, ay, az)

    def step(self, state: State, target: PoseTarget) -> list[float]:
        """
        Return the thrusts that answer a state.

        Parameters
        ----------
        state
            Of the vehicle.
        target
            What to hold.

        Returns
        -------
        list
            Thrusts [N], one per thruster.

        """
        dt = self._advance(state.time)
        r_wb = rot.from_quaternion(state.quat_wb_wxyz)
        velocity_w = rot.to_world(r_wb, state.velocity_b)
        if self.restarted:
            self._across.restart(velocity_w[0], velocity_w[1])
            self._upward.restart(velocity_w[2], 0.0)
        error = self._speed_error(state.position_w, velocity_w, target.position_w, dt)
        force_w, limited = self._force(error)
        thrust = rot.to_body(r_wb, force_w)[2]
        bounded = clamp(thrust, self._lowest, self._highest)

        torque_b = self._torque(r_wb, state.omega_b, force_w, target.yaw)
        thrusts = self.allocator.allocate((0.0, 0.0, bounded, *torque_b))
        self._integral.keep(*error, limited=limited or bounded != thrust)
        return thrusts

    def _speed_error(
        self,
        position_w: Sequence[float],
        velocity_w: rot.Vector3,
        target_w: Sequence[float],
        dt: float,
    ) -> rot.Vector3:
        """Return v* - v [m/s], and move v* on towards the target."""
        self._across.step(target_w[0] - position_w[0], target_w[1] - position_w[1], dt)
        self._upward.step(target_w[2] - position_w[2], 0.0, dt)
        (vx, vy), (vz, _) = self._across.velocity, self._upward.velocity
        return (vx - velocity_w[0], vy - velocity_w[1], vz - velocity_w[2])

    def _force(self, error: rot.Vector3) -> tuple[rot.Vector3, bool]:
        """Return the thrust vector [N], world axes, and whether tilt or its sign was limited."""
        gains, i, plant = self.gains, self._integral.value, self.plant
        # a third of the weight at least: the thrust axis stays defined, and points up
        floor = plant.weight / 3.0
        (ax, ay), (az, _) = self._across.acceleration, self._upward.acceleration
        fz = plant.mass * (az + gains.velocity * error[2] + i[2]) + plant.weight
        limited = fz < floor
        fz = max(fz, floor)
        fx = plant.mass * (ax + gains.velocity * error[0] + i[0])
        fy = plant.mass * (ay + gains.velocity * error[1] + i[1])
        sideways, allowed = math.hypot(fx, fy), self._tan_tilt * fz
        if sideways > allowed:
            fx, fy, limited = fx * allowed / sideways, fy * allowed / sideways, True
        return (fx, fy, fz), limited

    def _torque(
        self, r_wb: rot.Rotation, omega_b: Sequence[float], force_w: rot.Vector3, yaw: float
    ) -> rot.Vector3:
        """Return the torque [N m], body axes, that turns the thrust axis along the force."""
        gains, (jx, jy, jz) = self.gains, self.plant.inertia
        fx, fy, fz = force_w
        inverse = 1.0 / math.sqrt(fx * fx + fy * fy + fz * fz)
        desired = rot.from_thrust_axis((fx * inverse, fy * inverse, fz * inverse), yaw)
        ex, ey, ez = rot.error(desired, r_wb)
        wx, wy, wz = omega_b
        most = gains.max_rate
        ax = gains.rate * (within(gains.attitude * ex, most) - wx)
        ay = gains.rate * (within(gains.attitude * ey, most) - wy)
        # yaw: the attitude gain falls with the rate gain, so that the pair stays damped
        yaw_gain = gains.attitude * gains.yaw_rate / gains.rate if gains.rate else 0.0
        az = gains.yaw_rate * (within(yaw_gain * ez, most) - wz)
        return (
            jx * ax + (jz - jy) * wy * wz,
            jy * ay + (jx - jz) * wz * wx,
            jz * az + (jy - jx) * wx * wy,
        )
