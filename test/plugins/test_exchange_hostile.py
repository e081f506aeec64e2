# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whatever an autopilot's peer sends, the compiled exchange reads within bounds and hands on."""

import ctypes
import random
import socket
import struct

import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.plugins import exchange as ex
from fluid_sim_ros.plugins.exchange import exchange_library

VOLUMES = [2000, pytest.param(100_000, marks=[pytest.mark.full, pytest.mark.timeout(1800)])]
#: MAV frame of HIL_ACTUATOR_CONTROLS, and the byte that stands for its definition.
HEAD, IDENTITY, EXTRA, SIZE = b'\xfd', 93, 47, 81


def checksum(data: bytes) -> int:
    """Return CRC-16/MCRF4XX, bit by bit."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x8408 if crc & 1 else 0)
    return crc


def answer(payload: bytes, identity: int = IDENTITY, flags: int = 0) -> bytes:
    """Return a frame with a sound checksum, whatever its payload."""
    head = struct.pack('<BBBBBBHB', len(payload), flags, 0, 1, 1, 1, identity, 0)
    return HEAD + head + payload + struct.pack('<H', checksum(head + payload + bytes([EXTRA])))


def driven(simulation: Simulation, protocol: str) -> ActuatorMap:
    (vehicle,) = simulation.vehicles.values()
    actuators = ActuatorMap(*load_mapping(protocol, vehicle.kind, ''), vehicle)
    actuators.drive(*simulation.control_ports(vehicle.name))
    return actuators


@pytest.mark.parametrize('count', VOLUMES)
def test_random_bytes_of_a_px4_are_handed_on(count):
    rng, simulation = random.Random(8), Simulation('x500')
    actuators, library = driven(simulation, 'px4'), exchange_library()
    ours, theirs = socket.socketpair()
    whole = ex.Px4Exchange(driven=ctypes.addressof(actuators.driven))
    whole.peer.socket = ours.fileno()
    usual = 0
    with ours, theirs:
        for i in range(count):
            payload = rng.randbytes(rng.randrange(300))
            if rng.random() < 0.5:
                payload = struct.pack('<QQ', 7, 1) + rng.randbytes(65)
            data = rng.choice((
                payload, HEAD + payload, answer(payload[:255]), answer(payload[:SIZE]),
                answer(payload[:SIZE]) * 2, answer(payload[:SIZE], rng.randrange(1 << 16)),
                answer(payload[:SIZE], flags=1), answer(b'\7' + payload[1:SIZE])[: i % 100],
                payload * 200,
            ))  # fmt: skip
            if not data:
                continue
            theirs.send(data)
            found = library.px4_exchange(ctypes.addressof(whole), ex.HEAR, 0, 7, 0, b'', 0, 0.1)
            assert found in (ex.ANSWERED, ex.OTHER)
            assert ctypes.string_at(whole.portion, whole.size) == data
            usual += found == ex.ANSWERED
            ranges = simulation.model.actuator_ctrlrange
            assert (simulation.data.ctrl >= ranges[:, 0]).all()
            assert (simulation.data.ctrl <= ranges[:, 1]).all()
        assert usual > 0.1 * count
        ask = (ctypes.addressof(whole), ex.HEAR, 0, 7, 0, b'', 0)
        assert library.px4_exchange(*ask, 0.0) == ex.SILENT
        theirs.close()
        assert library.px4_exchange(*ask, 0.1) == ex.GONE


@pytest.mark.parametrize('count', VOLUMES)
def test_random_bytes_of_an_ardupilot_are_handed_on(count):
    rng, simulation = random.Random(9), Simulation('bluerov2_heavy')
    actuators, library = driven(simulation, 'ardupilot'), exchange_library()
    whole = ex.ArduPilotExchange(driven=ctypes.addressof(actuators.driven), rate=400)
    ours, theirs = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
    usual = 0
    with ours, theirs:
        for end in (ours, theirs):
            end.bind(('127.0.0.1', 0))
        whole.peer.socket = ours.fileno()
        assert not library.ardupilot_connected(ctypes.addressof(whole))
        ours.connect(theirs.getsockname())
        assert library.ardupilot_connected(ctypes.addressof(whole))
        theirs.connect(ours.getsockname())
        for i in range(count):
            pulses = rng.choice((16, 32))
            magic = rng.choice((18458, 29569, 18458 if pulses == 16 else 29569))
            data = struct.pack(
                '<HHI', magic, rng.choice((400, 400, 50)), i + rng.choice((0, 0, 1))
            )
            data += rng.randbytes(2 * pulses)
            data = rng.choice(
                (data, data, data[:-1], data + b'0', data * 9, rng.randbytes(i % 99))
            )
            theirs.send(data)
            found = library.ardupilot_exchange(ctypes.addressof(whole), ex.HEAR, 0, 0.0, i, 0.1)
            assert found in (ex.ANSWERED, ex.OTHER)
            assert ctypes.string_at(whole.packet, whole.size) == data[: ex.LONGEST_PACKET + 1]
            usual += found == ex.ANSWERED
        assert usual > 0.05 * count


def test_what_a_px4_does_not_take_is_told():
    """A full socket: what was sent and what is left make the frame and what follows it."""
    simulation = Simulation('x500')
    actuators, library = driven(simulation, 'px4'), exchange_library()
    imu = ex.Instrument(kind=0, period=1, width=6, tick=5, block=0)
    sensors = ex.Px4Sensors()
    sensors.instruments[0] = ctypes.addressof(imu)
    whole = ex.Px4Exchange(
        driven=ctypes.addressof(actuators.driven), sensors=ctypes.addressof(sensors), system=1,
        component=51,
    )  # fmt: skip
    ours, theirs = socket.socketpair()
    with ours, theirs:
        ours.setblocking(False)
        whole.peer.socket = ours.fileno()
        others, sent, wanted = bytes(range(256)) * 64, 0, b''
        while True:
            about = (ctypes.addressof(whole), ex.ASK | ex.OBSERVED, 5, 4000, 3)
            found = library.px4_exchange(*about, others, len(others), 0.0)
            wanted += ctypes.string_at(whole.frame, whole.frame_size) + others
            sent += whole.sent
            if found != ex.ANSWERED:
                break
        assert found == ex.HELD
        assert whole.sent < whole.frame_size + len(others)
        theirs.setblocking(False)
        got = b''
        while len(got) < sent:
            got += theirs.recv(1 << 20)
        assert got == wanted[:sent]
        theirs.close()
        assert library.px4_exchange(*about, others, len(others), 0.0) == ex.GONE
