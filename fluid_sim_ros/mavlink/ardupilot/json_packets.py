# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
ArduPilot's JSON interface: servo packets in, one line of JSON out, each a UDP datagram.

Servo packet, little endian: magic (u16), frame rate [Hz] (u16), frame count (u32), pulse widths
[us] (u16, 16 or 32 of them). The reader at the other end searches the text for its keys one by
one, so there are no spaces, and ``velocity`` stands before ``velocity_wind``.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass

from fluid_sim_ros.mavlink.ned import Quaternion, Vector3, euler

_HEAD = struct.Struct('<HHI')
_PULSES = {18458: struct.Struct('<16H'), 29569: struct.Struct('<32H')}
#: No servo packet is longer [bytes].
LONGEST_PACKET = _HEAD.size + 2 * 32
#: Channels of a radio control that it takes.
RC_CHANNELS = 12
#: A step of 0.1 s or more is a fault for ArduPilot itself; beyond the highest rate pulses are
#: no longer servo commands [Hz].
RATES = range(11, 8001)


@dataclass(frozen=True)
class ServoPacket:
    """One servo packet: ``rate`` [Hz], ``count`` of the frame, ``pulses`` [us]."""

    rate: int
    count: int
    pulses: tuple[int, ...]


def read_servo_packet(data: bytes) -> ServoPacket | str:
    """
    Return the packet that the bytes hold, or what is wrong with them.

    Parameters
    ----------
    data
        One datagram.

    Returns
    -------
    ServoPacket or str
        The packet, or one line that says what is wrong.

    """
    if len(data) < _HEAD.size:
        return f'{len(data)} bytes are too short for a servo packet'
    magic, rate, count = _HEAD.unpack_from(data)
    pulses = _PULSES.get(magic)
    if pulses is None:
        return f'magic {magic} is not that of a servo packet: 18458 or 29569 (ArduPilot 4.3 on)'
    if len(data) != _HEAD.size + pulses.size:
        return f'{len(data)} bytes, but magic {magic} has {_HEAD.size + pulses.size}'
    if rate not in RATES:
        return f'frame rate {rate} Hz is not from {RATES.start} to {RATES.stop - 1}'
    return ServoPacket(rate, count, pulses.unpack_from(data, _HEAD.size))


@dataclass(frozen=True)
class JsonState:
    """
    What one reply says.

    Attributes
    ----------
    time_s
        Time of the state by the autopilot's clock [s].
    gyro, specific_force
        Angular velocity [rad/s] and specific force [m/s^2], body axes (FRD).
    position, velocity
        From home [m], [m/s], NED.
    attitude
        Rotation FRD to NED, scalar first.
    wind
        Velocity of the air [m/s], NED, the direction that it moves to, or None.
    airspeed
        Speed through the air [m/s], or None.
    range_m
        Distance that the rangefinder measures [m], or None.
    wind_vane
        Wind as the vehicle meets it: where it comes from, clockwise from ahead [rad], and its
        speed [m/s]; or None.
    rc
        Pulse widths of the sticks [us], at most 12; empty: none.
    battery
        Voltage [V] and current [A], or None.

    """

    time_s: float
    gyro: Vector3
    specific_force: Vector3
    position: Vector3
    velocity: Vector3
    attitude: Quaternion
    wind: Vector3 | None = None
    airspeed: float | None = None
    range_m: float | None = None
    wind_vane: tuple[float, float] | None = None
    rc: Sequence[int] = ()
    battery: tuple[float, float] | None = None


_STATE = (
    '\n{"timestamp":%.10f,"imu":{"gyro":[%.9g,%.9g,%.9g],"accel_body":[%.9g,%.9g,%.9g]},'
    '"position":[%.12g,%.12g,%.12g],"attitude":[%.9g,%.9g,%.9g],'
    '"quaternion":[%.9g,%.9g,%.9g,%.9g],"velocity":[%.9g,%.9g,%.9g]'
)


def write_state(state: JsonState) -> bytes:
    """
    Return the reply that says a state.

    Parameters
    ----------
    state
        In the units and axes that ``JsonState`` states.

    Returns
    -------
    bytes
        One line of JSON.

    """
    text = _STATE % (
        state.time_s, *state.gyro, *state.specific_force, *state.position,
        *euler(state.attitude), *state.attitude, *state.velocity,
    )  # fmt: skip
    if state.wind is not None:
        north, east, down = state.wind
        text += f',"velocity_wind":[{north:.9g},{east:.9g},{down:.9g}]'
    if state.airspeed is not None:
        text += f',"airspeed":{state.airspeed:.9g}'
    if state.range_m is not None:
        text += f',"rng_1":{state.range_m:.9g}'
    if state.wind_vane is not None:
        direction, speed = state.wind_vane
        text += f',"windvane":{{"direction":{direction:.9g},"speed":{speed:.9g}}}'
    if state.rc:
        channels = ','.join(f'"rc_{i}":{pulse}' for i, pulse in enumerate(state.rc, 1))
        text += f',"rc":{{{channels}}}'
    if state.battery is not None:
        voltage, current = state.battery
        text += f',"battery":{{"voltage":{voltage:.6g},"current":{current:.6g}}}'
    return (text + '}\n').encode()
