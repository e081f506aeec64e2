# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Depth, heading, attitude and speed (or position) hold of an underwater vehicle."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.allocation import AXES, Allocator
from fluid_sim_ros.control.axes import reached_axes
from fluid_sim_ros.control.gains import Gains, gain
from fluid_sim_ros.control.integral import Integral
from fluid_sim_ros.control.law import ControlLaw, within
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError

#: Attitude and depth before travel: a vehicle that rolls cannot point its thrust.
PRIORITY = (('tx', 'ty'), ('fz',), ('tz',), ('fx', 'fy'))
#: Which axes a vehicle shall have rather than others that depend on them: attitude comes last, as
#: the righting moment takes care of it.
_WANTED = ('fz', 'tz', 'fx', 'fy', 'tx', 'ty')
#: A vehicle without sway turns towards its place while that is farther than this [m].
_AIMED = 0.5


@dataclass(frozen=True)
class UnderwaterGains(Gains):
    """Gains and limits; chosen for a BlueROV2 Heavy at 50 to 100 Hz."""

    position: float = gain(0.8, '1/s', 'speed asked for per position (or depth) error')
    velocity: float = gain(4.0, '1/s', 'acceleration asked for per speed error')
    integral: float = gain(
        4.0, '1/s^2', 'growth of the acceleration per speed error: no depth error with ballast, '
        'no drift in a current'
    )  # fmt: skip
    attitude: float = gain(3.0, '1/s', 'rate asked for per attitude error')
    rate: float = gain(8.0, '1/s', 'angular acceleration per rate error')
    attitude_integral: float = gain(
        8.0, '1/s^2', 'growth of the angular acceleration per rate error: no tilt and no heading '
        'error against a righting moment or a tether'
    )  # fmt: skip
    added_mass: float = gain(
        0.8, '-', 'inertia that has to be moved beside the own one, as a share of it; published '
        'sets for this vehicle lie between 0.2 and 1.4'
    )  # fmt: skip
    max_speed: float = gain(0.8, 'm/s', 'largest horizontal speed asked for')
    max_climb: float = gain(0.5, 'm/s', 'largest vertical speed asked for')
    max_rate: float = gain(1.0, 'rad/s', 'largest rate asked for')
    max_integral: float = gain(4.0, 'm/s^2', 'largest acceleration of the integrator on each axis')
    max_angular_integral: float = gain(
        20.0, 'rad/s^2', 'largest angular acceleration of the integrator on each axis'
    )


class DepthTarget(NamedTuple):
    """
    What an underwater vehicle holds.

    Attributes
    ----------
    depth
        [m], positive below the world's z = 0.
    heading
        [rad], counter-clockwise from east.
    speed_h
        Surge (along the heading) and sway (to its left) over ground [m/s], shape (2,).
    place_w
        Horizontal position [m], world axes; takes the place of ``speed_h``. None: only the speed.

    """

    depth: float
    heading: float
    speed_h: Sequence[float] = (0.0, 0.0)
    place_w: Sequence[float] | None = None


class UnderwaterController(ControlLaw):
    """
    Holds depth, heading and a level attitude, and a speed or a place.

    Axes that the thrusters do not reach (``lacks``) are left alone: roll and pitch to the righting
    moment. Without sway the vehicle turns towards the place that it is to reach, and moves ahead
    and astern only.

    v* = K_p (p* - p), or the speed asked for;  F = (1 + a) m (K_v (v* - v) + i) + W e_z with
    di/dt = K_i (v* - v). On SO(3) e = w* - w with w* = K_R log(R^T R_d);
    torque = (1 + a) J (K_w e + j) with dj/dt = K_j e. Integrators stand still while the
    thrusters are at their limits (anti-windup), and start anew when time goes back.

    Parameters
    ----------
    plant
        Mass, inertia, thrusters.
    gains
        See `UnderwaterGains`.

    Attributes
    ----------
    lacks
        Axes (``allocation.AXES``) that the thrusters do not reach by themselves.

    Raises
    ------
    ConfigError
        If they reach none.

    """

    def __init__(self, plant: Plant, gains: UnderwaterGains | None = None) -> None:
        self.plant = plant
        self.gains = gains = gains or UnderwaterGains()
        reached = reached_axes(plant.thruster_matrix, _WANTED)
        if not reached:
            raise ConfigError('thruster matrix: the thrusters reach no axis by themselves')
        self.lacks = tuple(axis for axis in AXES if axis not in reached)
        groups = [tuple(axis for axis in group if axis in reached) for group in PRIORITY]
        self.allocator = Allocator(
            plant.thruster_matrix, plant.thrust_limits, [group for group in groups if group]
        )
        self._has_force = [axis in reached for axis in AXES[:3]]
        self._has_torque = [axis in reached for axis in AXES[3:]]
        self._integral = Integral(gains.integral, gains.max_integral)
        self._angular_integral = Integral(gains.attitude_integral, gains.max_angular_integral)
        moved = 1.0 + gains.added_mass
        self._constants = (
            gains.velocity, moved * plant.mass, plant.weight,
            gains.rate, *(moved * inertia for inertia in plant.inertia),
        )  # fmt: skip
        self._heading, self._level = 0.0, rot.from_yaw(0.0)
        super().__init__(self._integral, self._angular_integral)

    def step(self, state: State, target: DepthTarget) -> list[float]:
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
        time, position_w, quat_wb_wxyz, velocity_b, omega_b, _ = state
        self._advance(time)
        r_wb = rot.from_quaternion(quat_wb_wxyz)
        velocity_w = rot.to_world(r_wb, velocity_b)
        if self.lacks:
            target = self._within_reach(position_w, target)
        error_w = self._speed_error(position_w, velocity_w, target)
        error_b = self._rate_error(r_wb, omega_b, target.heading)
        if self.lacks:
            error_w = rot.to_world(r_wb, _kept(rot.to_body(r_wb, error_w), self._has_force))
            error_b = _kept(error_b, self._has_torque)
        thrusts = self.allocator.allocate(self._wrench(r_wb, error_w, error_b))
        limited = self.allocator.scale < 1.0
        self._integral.keep(*error_w, limited=limited)
        self._angular_integral.keep(*error_b, limited=limited)
        return thrusts

    def _within_reach(self, position_w: Sequence[float], target: DepthTarget) -> DepthTarget:
        """Return the target with a heading towards the place, for a vehicle without sway."""
        if target.place_w is None or 'fy' not in self.lacks:
            return target
        x, y = target.place_w[0] - position_w[0], target.place_w[1] - position_w[1]
        if math.hypot(x, y) < _AIMED:
            return target
        return target._replace(heading=math.atan2(y, x))

    def _speed_error(
        self, position_w: Sequence[float], velocity_w: rot.Vector3, target: DepthTarget
    ) -> rot.Vector3:
        """Return v* - v [m/s], world axes."""
        gains = self.gains
        depth, heading, speed_h, place_w = target
        if place_w is None:
            c, s = math.cos(heading), math.sin(heading)
            vx = c * speed_h[0] - s * speed_h[1]
            vy = s * speed_h[0] + c * speed_h[1]
        else:
            vx = gains.position * (place_w[0] - position_w[0])
            vy = gains.position * (place_w[1] - position_w[1])
        speed = math.hypot(vx, vy)
        if speed > gains.max_speed:
            vx, vy = vx * gains.max_speed / speed, vy * gains.max_speed / speed
        vz = within(gains.position * (-depth - position_w[2]), gains.max_climb)
        return (vx - velocity_w[0], vy - velocity_w[1], vz - velocity_w[2])

    def _wrench(
        self, r_wb: rot.Rotation, error_w: rot.Vector3, error_b: rot.Vector3
    ) -> tuple[float, ...]:
        """Return force [N] and torque [N m], body axes, written out: it is in every answer."""
        gain, moved, weight, turn, jx, jy, jz = self._constants
        (x, y, z), (ix, iy, iz) = error_w, self._integral.value
        (p, q, r), (ip, iq, ir) = error_b, self._angular_integral.value
        fx = moved * (gain * x + ix)
        fy = moved * (gain * y + iy)
        fz = moved * (gain * z + iz) + weight
        r00, r01, r02, r10, r11, r12, r20, r21, r22 = r_wb
        return (
            r00 * fx + r10 * fy + r20 * fz,
            r01 * fx + r11 * fy + r21 * fz,
            r02 * fx + r12 * fy + r22 * fz,
            jx * (turn * p + ip),
            jy * (turn * q + iq),
            jz * (turn * r + ir),
        )

    def _rate_error(
        self, r_wb: rot.Rotation, omega_b: Sequence[float], heading: float
    ) -> rot.Vector3:
        """Return w* - w [rad/s], body axes, w* towards level and the heading."""
        gain, most = self.gains.attitude, self.gains.max_rate
        if heading != self._heading:  # most states are answered with the same
            self._heading, self._level = heading, rot.from_yaw(heading)
        ex, ey, ez = rot.error(self._level, r_wb)
        ex, ey, ez = gain * ex, gain * ey, gain * ez
        p, q, r = omega_b
        return (
            (-most if ex < -most else (most if ex > most else ex)) - p,
            (-most if ey < -most else (most if ey > most else ey)) - q,
            (-most if ez < -most else (most if ez > most else ez)) - r,
        )


def _kept(vector: Sequence[float], keep: Sequence[bool]) -> rot.Vector3:
    """Return a vector with zeros where an axis is not to be kept."""
    x, y, z = (value if kept else 0.0 for value, kept in zip(vector, keep, strict=True))
    return x, y, z
