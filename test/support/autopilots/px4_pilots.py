# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pilots of the stand-in for PX4 and its motor geometry: multirotor, plane, submarine."""

import math
from collections.abc import Sequence

import numpy as np

from test.support.autopilots.px4_stand_in import Px4

EARTH_RADIUS = 6371000.0  # [m]
#: Position (forward, right) [m] and yaw torque per thrust [m] of 10016
IRIS = ((0.1515, 0.245, 0.05), (-0.1515, -0.1875, 0.05), (0.1515, -0.245, -0.05),
        (-0.1515, 0.1875, -0.05))  # fmt: skip
#: Axis and position (forward, right, down) of the rotors of 1022
HEAVY = (
    ((1, -1, 0), (0.5, 0.3, 0.2)), ((1, 1, 0), (0.5, -0.3, 0.2)),
    ((1, 1, 0), (-0.5, 0.3, 0.2)), ((1, -1, 0), (-0.5, -0.3, 0.2)),
    ((0, 0, -1), (0.5, 0.5, 0)), ((0, 0, 1), (0.5, -0.5, 0)),
    ((0, 0, 1), (-0.5, 0.5, 0)), ((0, 0, -1), (-0.5, -0.5, 0)),
)  # fmt: skip
Numbers = Sequence[float]


def rotated(quat: Numbers, vector: Numbers) -> list[float]:
    """Rotate a vector by a unit quaternion (scalar first)."""
    w, x, y, z = quat
    a, b, c = vector
    u, v, t = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return [a + w * u + y * t - z * v, b + w * v + z * u - x * t, c + w * t + x * v - y * u]


def turned(quat: Numbers, angle: Numbers) -> list[float]:
    """Turn an attitude by a small angle about body axes."""
    w, x, y, z = quat
    a, b, c = (0.5 * part for part in angle)
    product = (
        w - x * a - y * b - z * c,
        x + w * a + y * c - z * b,
        y + w * b - x * c + z * a,
        z + w * c + x * b - y * a,
    )
    norm = math.sqrt(sum(part * part for part in product))
    return [part / norm for part in product]


def angles(quat: Numbers) -> tuple[float, float, float]:
    w, x, y, z = quat
    return (
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(clipped(2 * (w * y - z * x), 1)),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )


def clipped(value: float, most: float) -> float:
    return min(max(value, -most), most)


class Estimate:
    """Attitude, velocity and place: dead reckoning from the IMU between true states."""

    def __init__(self) -> None:
        self.quat = [1.0, 0.0, 0.0, 0.0]
        self.velocity, self.position = [0.0] * 3, [0.0] * 3
        self.rates = [0.0] * 3
        self._home: tuple[float, ...] = ()
        self._time = 0

    def update(self, px4: Px4, sensors: dict) -> None:
        dt = (sensors['time_usec'] - self._time) * 1e-6 if self._time else 0.0
        self._time = sensors['time_usec']
        self.rates = [sensors['xgyro'], sensors['ygyro'], sensors['zgyro']]
        self.quat = turned(self.quat, [dt * rate for rate in self.rates])
        force = rotated(self.quat, (sensors['xacc'], sensors['yacc'], sensors['zacc']))
        force[2] += 9.81
        for i in range(3):
            self.velocity[i] += dt * force[i]
            self.position[i] += dt * self.velocity[i]
        self._correct(px4.latest)

    def _correct(self, latest: dict[str, dict]) -> None:
        seen, true = latest.get('ODOMETRY'), latest.get('HIL_STATE_QUATERNION')
        if seen is not None:
            if seen['time_usec'] == self._time:
                self.quat = seen['q']
                self.position = [seen['x'], seen['y'], seen['z']]
                self.velocity = rotated(self.quat, (seen['vx'], seen['vy'], seen['vz']))
        elif true is not None and true['time_usec'] == self._time:
            self.quat = true['attitude_quaternion']
            self.velocity = [0.01 * true['vx'], 0.01 * true['vy'], 0.01 * true['vz']]
            place = (true['lat'] * 1e-7, true['lon'] * 1e-7, true['alt'] * 1e-3)
            self._home = self._home or place
            metres = math.radians(EARTH_RADIUS)
            self.position = [
                metres * (place[0] - self._home[0]),
                metres * (place[1] - self._home[1]) * math.cos(math.radians(place[0])),
                self._home[2] - place[2],
            ]


class Quad:
    """Holds a place [m, NED]; demands become motor commands by the signs of the geometry."""

    def __init__(self, target: tuple[float, float, float], hover: float) -> None:
        self.target, self.hover = target, hover
        self.estimate = Estimate()

    def controls(self, px4: Px4, sensors: dict) -> list[float]:
        state = self.estimate
        state.update(px4, sensors)
        asked = [
            clipped(0.8 * (t - p), 1.5) for t, p in zip(self.target, state.position, strict=True)
        ]
        north, east, down = (clipped(a - v, 2) for a, v in zip(asked, state.velocity, strict=True))
        roll, pitch, yaw = angles(state.quat)
        forward = math.cos(yaw) * north + math.sin(yaw) * east
        right = -math.sin(yaw) * north + math.cos(yaw) * east
        p, q, r = state.rates
        demands = (
            clipped(0.25 * (6 * (clipped(0.15 * right, 0.3) - roll) - p), 0.2),
            clipped(0.25 * (6 * (-clipped(0.15 * forward, 0.3) - pitch) - q), 0.2),
            clipped(0.2 * (clipped(math.remainder(math.pi / 2 - yaw, math.tau), 1) - r), 0.2),
        )
        throttle = self.hover - 0.12 * down
        commands = []
        for x, y, spin in IRIS:
            signs = (-math.copysign(1, y), math.copysign(1, x), math.copysign(1, spin))
            change = sum(sign * demand for sign, demand in zip(signs, demands, strict=True))
            commands.append(min(max(throttle + change, 0.0), 1.0))
        return commands


class Plane:
    """Takes off at full throttle and climbs along its heading; outputs as in 1030."""

    def __init__(self, climb: float = 0.17) -> None:
        self.climb = climb  # [rad] nose up
        self.estimate = Estimate()

    def controls(self, px4: Px4, sensors: dict) -> list[float]:
        state = self.estimate
        state.update(px4, sensors)
        roll, pitch, yaw = angles(state.quat)
        p, q, r = state.rates
        aileron = clipped(-1.5 * roll - 0.4 * p, 1)  # > 0 rolls right
        elevator = clipped(0.3 + 1.5 * (self.climb - pitch) - 0.5 * q, 1)  # > 0 pitches up
        rudder = clipped(0.8 * math.remainder(math.pi / 2 - yaw, math.tau) - 0.3 * r, 1)
        outputs = [0.0] * 16
        outputs[2], outputs[4] = rudder, 1.0
        outputs[3], outputs[6], outputs[7] = -aileron, aileron, elevator
        return outputs


class Submarine:
    """Holds a depth, a heading and a level attitude; allocation by the inverse of the geometry."""

    def __init__(self, depth: float, yaw: float, forward: float = 0.0) -> None:
        self.depth, self.yaw, self.forward = depth, yaw, forward
        self.estimate = Estimate()
        effect = np.array([[*a, *np.cross(p, a)] for a, p in HEAVY], dtype=float).T
        self._inverse = np.linalg.pinv(effect).tolist()

    def controls(self, px4: Px4, sensors: dict) -> list[float]:
        state = self.estimate
        state.update(px4, sensors)
        roll, pitch, yaw = angles(state.quat)
        p, q, r = state.rates
        turn = clipped(math.remainder(self.yaw - yaw, math.tau), 1)
        demand = (
            self.forward, 0.0,
            clipped(2.0 * (self.depth - state.position[2]) - 2.0 * state.velocity[2], 2),
            -1.0 * roll - 0.3 * p, -1.0 * pitch - 0.3 * q, 0.6 * turn - 0.3 * r,
        )  # fmt: skip
        return [
            clipped(sum(part * d for part, d in zip(row, demand, strict=True)), 1)
            for row in self._inverse
        ]
