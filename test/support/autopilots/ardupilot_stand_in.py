# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A stand-in for ArduPilot: its packets, its reader and its motor tables, with a simple controller.

It knows nothing of this package: states come out of the JSON text, motors are driven by the
factors of ArduPilot's own tables (AP_MotorsMatrix, AP_Motors6DOF).
"""

import contextlib
import math
import random
import socket
import struct
import time

from test.support.autopilots.json_reader import JsonReader

#: roll, pitch, yaw, throttle, forward, lateral of each motor
VECTORED = (
    (0, 0, 1, 0, -1, 1), (0, 0, -1, 0, -1, -1), (0, 0, -1, 0, 1, 1), (0, 0, 1, 0, 1, -1),
    (1, 0, 0, -1, 0, 0), (-1, 0, 0, -1, 0, 0),
)  # fmt: skip
VECTORED_6DOF = (
    *VECTORED[:4],
    (1, -1, 0, -1, 0, 0), (-1, -1, 0, -1, 0, 0), (1, 1, 0, -1, 0, 0), (-1, 1, 0, -1, 0, 0),
)  # fmt: skip
#: angle from the nose, clockwise [deg], and the sign of the yaw that the motor gives
QUAD_X = ((45, 1), (-135, 1), (-45, -1), (135, -1))


def quad_x_factors() -> list[tuple[float, float, float]]:
    """Roll, pitch, yaw of each motor as AP_MotorsMatrix derives them from the angle."""
    return [
        (math.cos(math.radians(a + 90)), math.cos(math.radians(a)), spin) for a, spin in QUAD_X
    ]


class Link:
    """Sends servo packets, reads states, one for one; a lost datagram is asked for again."""

    def __init__(self, port: int, rate: int = 400) -> None:
        self.rate = rate
        self.count = 0
        self.reader = JsonReader()
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(('127.0.0.1', port))
        self.socket.settimeout(2.0)
        self.repeats = 0

    def packet(self, pulses: list[int]) -> bytes:
        form, magic = ('<HHI16H', 18458) if len(pulses) == 16 else ('<HHI32H', 29569)
        return struct.pack(form, magic, self.rate, self.count, *pulses)

    def exchange(self, pulses: list[int]) -> dict[str, list[float]]:
        data, deadline = self.packet(pulses), time.monotonic() + 5.0
        self.socket.send(data)
        while True:
            try:
                reply = self.socket.recv(65536)
                break
            except ConnectionRefusedError:  # the simulation is not there yet, or no longer
                time.sleep(0.01)
            except TimeoutError:
                self.repeats += 1
            assert time.monotonic() < deadline, 'nobody answers'
            with contextlib.suppress(ConnectionRefusedError):
                self.socket.send(data)
        self.count += 1
        return self.reader.read(reply)

    def close(self) -> None:
        self.socket.close()


def clipped(value: float, most: float = 1.0) -> float:
    return min(max(value, -most), most)


def padded(pulses: list[int], count: int = 16) -> list[int]:
    return pulses + [0] * (count - len(pulses))


def body_axes(attitude: list[float], vector_ned: list[float]) -> tuple[float, float]:
    """Forward and right components of a horizontal vector."""
    yaw = attitude[2]
    north, east = vector_ned[:2]
    return (
        math.cos(yaw) * north + math.sin(yaw) * east,
        -math.sin(yaw) * north + math.cos(yaw) * east,
    )


class Copter:
    """Holds a place [m, NED]: position to velocity to tilt to torque."""

    def __init__(self, target: tuple[float, float, float], hover: float) -> None:
        self.target, self.hover = target, hover

    def pulses(self, state: dict[str, list[float]]) -> list[int]:
        error = [t - p for t, p in zip(self.target, state['position'], strict=True)]
        asked = [clipped(0.8 * e, 1.5) for e in error]
        lack = [a - v for a, v in zip(asked, state['velocity'], strict=True)]
        forward, right = body_axes(state['attitude'], lack)
        roll, pitch, yaw = state['attitude']
        p, q, r = state['gyro']
        demand_roll = 0.25 * clipped(6 * (clipped(0.2 * right, 0.3) - roll) - p)
        demand_pitch = 0.25 * clipped(6 * (-clipped(0.2 * forward, 0.3) - pitch) - q)
        demand_yaw = 0.2 * clipped(1.0 * clipped(math.remainder(math.pi / 2 - yaw, math.tau)) - r)
        throttle = self.hover - 0.15 * clipped(lack[2], 2.0)
        shares = [
            throttle + demand_roll * fr + demand_pitch * fp + demand_yaw * fy
            for fr, fp, fy in quad_x_factors()
        ]
        return padded([round(1000 + 1000 * min(max(s, 0.0), 1.0)) for s in shares])


class Plane:
    """Takes off at full throttle and climbs along its heading; SERVO1 to 4 as by default."""

    def __init__(self, climb: float = 0.17) -> None:
        self.climb = climb  # [rad] nose up

    def pulses(self, state: dict[str, list[float]]) -> list[int]:
        roll, pitch, yaw = state['attitude']
        p, q, r = state['gyro']
        aileron = clipped(-1.5 * roll - 0.4 * p)  # > 0 rolls right
        elevator = clipped(0.3 + 1.5 * (self.climb - pitch) - 0.5 * q)  # > 0 pitches up
        rudder = clipped(0.8 * math.remainder(math.pi / 2 - yaw, math.tau) - 0.3 * r)
        sticks = [round(1500 + 400 * share) for share in (aileron, elevator, rudder)]
        return padded([sticks[0], sticks[1], 1900, sticks[2]])


class DepthSensor:
    """
    ArduSub's depth: 0 where it boots, and again wherever it would be above the surface.

    So noise moves the zero up, never down, while the vehicle is near it.
    """

    def __init__(self, noise: float) -> None:
        self.noise, self.zero = noise, None
        self.rng = random.Random(1)

    def read(self, down: float) -> float:
        value = down + self.rng.gauss(0.0, self.noise)
        self.zero = down if self.zero is None else min(self.zero, value)
        return value - self.zero


class Submarine:
    """Holds a depth [m], a heading and a level attitude, and a forward demand."""

    def __init__(self, factors: tuple, depth: float, yaw: float, forward: float = 0.0) -> None:
        self.factors, self.depth, self.yaw, self.forward = factors, depth, yaw, forward

    def pulses(self, state: dict[str, list[float]]) -> list[int]:
        roll, pitch, yaw = state['attitude']
        p, q, r = state['gyro']
        down, sinking = state['position'][2], state['velocity'][2]
        demand = (
            clipped(-1.0 * roll - 0.3 * p),
            clipped(-1.0 * pitch - 0.3 * q),
            clipped(0.6 * math.remainder(self.yaw - yaw, math.tau) - 0.3 * r, 0.5),
            clipped(-0.8 * (self.depth - down) + 1.0 * sinking),
            self.forward,
            0.0,
        )
        pulses = []
        for row in self.factors:
            share = clipped(sum(f * d for f, d in zip(row, demand, strict=True)))
            pulses.append(round(1500 + 400 * share))
        return padded(pulses)
