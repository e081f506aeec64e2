# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""PX4's bridge when PX4 halts, goes away, or sends anything at all."""

import random
import socket
import time

import pytest

from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from test.support.autopilots import hil_wire
from test.support.autopilots.autopilot_peers import BridgedFlight, waited
from test.support.autopilots.px4_stand_in import Px4

IDLE = [0.0] * 4


def test_a_px4_that_is_halted_at_its_start_stops_time_and_goes_on(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.0)
    with BridgedFlight('x500_ground', 'px4').running() as flight:
        px4 = Px4(flight.port, silent=0)

        def time_stands_still():  # the kernel's buffers grow while they fill
            step = flight.simulation.step_count
            time.sleep(0.1)
            silent = flight.bridge.status().message == 'PX4 does not read; waiting for it'
            return silent and flight.simulation.step_count == step

        assert waited(time_stands_still, 20.0)
        while flight.bridge.status().level != 'ok':  # it reads what has come, and answers
            px4.answer(px4.sensors()['time_usec'], IDLE)
        for _ in range(20):
            px4.exchange(IDLE)


def test_a_new_process_finds_its_vehicle_at_the_start(flight, px4):
    for _ in range(100):
        px4.exchange([0.9] * 4)
    px4.close()
    assert waited(lambda: flight.bridge.counters.disconnections == 1)
    assert flight.bridge.status().message == f'waiting for PX4 on TCP port {flight.port}'
    assert not flight.simulation.data.ctrl.any()  # motors off
    step = flight.simulation.step_count
    time.sleep(0.06)
    assert flight.simulation.step_count == step  # and time stands still
    again = Px4(flight.port, silent=0)
    assert again.exchange(IDLE)['time_usec'] == 4000
    assert flight.resets == 1
    assert flight.simulation.data.qpos[2] == pytest.approx(0.13, abs=1e-3)


def disconnect(flight, times, seed=3):
    rng, counters = random.Random(seed), flight.bridge.counters
    served = 0
    for _ in range(times):
        px4 = Px4(flight.port, silent=rng.randrange(3))
        exchanges = rng.randrange(4)
        for _ in range(exchanges):
            px4.exchange(IDLE)
        served += bool(exchanges)
        if rng.random() < 0.5:  # with bytes unread: a reset instead of an orderly end
            px4.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b'\1\0\0\0\0\0\0\0')
        px4.close()
        assert waited(lambda: counters.disconnections == counters.connections)
    # one that went away before it was served is not counted
    assert times >= counters.connections == counters.disconnections >= served > times / 2
    last = Px4(flight.port, silent=0)
    last.exchange(IDLE)
    assert last.rules.first == 4000


def test_disconnections_at_any_moment_do_no_harm(flight, monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    disconnect(flight, 30)


@pytest.mark.full
@pytest.mark.timeout(1800)
def test_1000_disconnections_do_no_harm(flight, monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    disconnect(flight, 1000)


def fuzz(flight, px4, messages, seed=2):
    """Send broken and foreign bytes between answers; every answer must still arrive."""
    rng = random.Random(seed)
    for _ in range(messages // 20):
        sensors = px4.sensors()
        noise = b''
        for _ in range(20):
            kind = rng.randrange(3)
            data = bytearray(
                hil_wire.pack(
                    'HIL_ACTUATOR_CONTROLS', rng.randrange(256),
                    time_usec=rng.randrange(2**64), controls=[rng.uniform(-9, 9)] * 16,
                )
            )  # fmt: skip
            if kind == 0:
                data = rng.randbytes(rng.randrange(60)).translate(NO_MARKER)
            elif kind == 1:
                data[rng.randrange(10, len(data))] ^= 1 << rng.randrange(8)
            noise += data
        px4.socket.sendall(noise)
        px4.answer(sensors['time_usec'], IDLE)
    answered = messages // 20
    assert waited(lambda: flight.bridge.counters.answered == answered)
    assert flight.bridge.counters.malformed > messages // 2
    assert len(flight.bridge._reader._mav.buf) < 300


#: Random bytes must not announce a message that swallows the next one.
NO_MARKER = bytes(0 if byte in (0xFD, 0xFE) else byte for byte in range(256))


def test_random_bytes_do_no_harm(flight, px4):
    fuzz(flight, px4, 2000)


@pytest.mark.full
@pytest.mark.timeout(1800)
def test_a_million_random_messages_do_no_harm(flight, px4):
    fuzz(flight, px4, 1_000_000)


def test_a_peer_of_random_bytes_keeps_little_memory(flight):
    px4, rng = Px4(flight.port), random.Random(4)
    for _ in range(200):
        px4.socket.sendall(rng.randbytes(1000))

    def all_is_read():
        parser = flight.bridge._reader._mav  # made anew with the connection
        return parser.total_bytes_received >= 200_000 and len(parser.buf) < 300

    assert waited(all_is_read)
    assert flight.bridge.counters.malformed > 100
