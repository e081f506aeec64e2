"""
A stand-in for PX4: its bytes, its rules for sensor messages and its motor geometry.

It knows nothing of this package. Bytes go through the codec by hand (hil_wire); the rules are
those of PX4's simulator module: groups of bits count only as a whole, time must go on, readings
must not stand still.
"""

import math
import select
import socket
import time
from collections.abc import Sequence

import numpy as np

from test.support.autopilots import hil_wire

GROUPS = {'accel': 0x007, 'gyro': 0x038, 'mag': 0x1C0, 'baro': 0x1A00, 'airspeed': 0x400}
#: Readings of a group that never change for so many messages in a row count as stale.
STALE = 10
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


class Rules:
    """What PX4 asks of HIL_SENSOR, checked message by message."""

    def __init__(self) -> None:
        self.first = self.time = 0  # [us]
        self.counts = dict.fromkeys(GROUPS, 0)
        self.last: dict[str, tuple] = {}
        self.still = dict.fromkeys(GROUPS, 0)

    def check(self, message: dict) -> None:
        assert message['time_usec'] > self.time, 'time must go on'
        self.time = message['time_usec']
        self.first = self.first or self.time
        assert message['id'] == 0
        bits = message['fields_updated']
        groups = {name for name, mask in GROUPS.items() if bits & mask}
        for name in groups:
            assert bits & GROUPS[name] == GROUPS[name], f'{name}: only some of its bits'
            self.counts[name] += 1
        assert bits == sum(GROUPS[name] for name in groups), f'unknown bits in {bits:#x}'
        assert {'accel', 'gyro'} <= groups
        readings = {
            'accel': (message['xacc'], message['yacc'], message['zacc']),
            'gyro': (message['xgyro'], message['ygyro'], message['zgyro']),
            'mag': (message['xmag'], message['ymag'], message['zmag']),
            'baro': (message['abs_pressure'],),
        }
        for name in groups & readings.keys():
            same = readings[name] == self.last.get(name)
            self.still[name] = self.still[name] + 1 if same else 0
            assert self.still[name] < STALE, f'{name} is stale'
            self.last[name] = readings[name]
        if 'baro' in groups:
            assert 500 < message['abs_pressure'] < 1100
            assert -40 < message['temperature'] < 85
        if 'mag' in groups:
            assert 0.2 < math.hypot(*readings['mag']) < 0.7


class Px4:
    """Connects, reads what arrives, and answers HIL_SENSOR."""

    def __init__(self, port: int, silent: int = 15) -> None:
        self.silent = silent
        self.rules = Rules()
        self.latest: dict[str, dict] = {}
        self.counts: dict[str, int] = {}
        self.rest = b''
        self.sequence = 0
        self.socket = self._connect(port)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.send('COMMAND_LONG', command=511, param1=115.0, param2=5000.0)
        self.send('HEARTBEAT', autopilot=12, mavlink_version=3)

    @staticmethod
    def _connect(port: int) -> socket.socket:
        deadline = time.monotonic() + 5.0
        while True:
            try:
                return socket.create_connection(('127.0.0.1', port), 5.0)
            except ConnectionRefusedError:
                assert time.monotonic() < deadline, f'nobody listens on port {port}'
                time.sleep(0.01)

    def send(self, name: str, **values) -> None:
        self.socket.sendall(hil_wire.pack(name, self.sequence, **values))
        self.sequence += 1

    def sensors(self) -> dict:
        """Return the next HIL_SENSOR; everything before it is kept in ``latest``."""
        while True:
            messages, self.rest = hil_wire.frames(self.rest)
            if messages:
                break
            data = self.socket.recv(65536)
            assert data, 'the simulator has closed the connection'
            self.rest += data
        sensors = [fields for name, fields in messages if name == 'HIL_SENSOR']
        for name, fields in messages:
            self.latest[name] = fields
            self.counts[name] = self.counts.get(name, 0) + 1
        if not sensors:
            return self.sensors()
        for fields in sensors:
            self.rules.check(fields)
        return sensors[-1]

    def answer(self, time_us: int, controls: list[float], armed: bool = True) -> None:
        controls = [*controls, *[0.0] * (16 - len(controls))]
        self.send(
            'HIL_ACTUATOR_CONTROLS', time_usec=time_us, flags=1, controls=controls,
            mode=129 if armed else 1,
        )  # fmt: skip

    def exchange(self, controls: list[float], armed: bool = True) -> dict:
        """Answer the next HIL_SENSOR, unless still starting up, and return it."""
        message = self.sensors()
        if self.silent > 0:
            self.silent -= 1
        else:
            self.answer(message['time_usec'], controls, armed)
        return message

    def nothing_comes(self, seconds: float) -> bool:
        return not select.select([self.socket], [], [], seconds)[0]

    def close(self) -> None:
        self.socket.close()


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
