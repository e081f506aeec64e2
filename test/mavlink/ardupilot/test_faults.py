# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What ArduPilot's bridge refuses and reports, and random bytes."""

import contextlib
import random
import socket
import threading
from functools import partial

import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings, open_bridge
from fluid_sim_ros.simulation import Simulation
from test.support.autopilots.ardupilot_stand_in import (
    Link,
    padded,
)
from test.support.autopilots.autopilot_peers import BridgedFlight, waited

IDLE = padded([1000] * 4)


def test_a_stranger_is_not_answered_while_the_autopilot_is_there(flight, link):
    link.exchange(IDLE)
    stranger = Link(flight.port)
    stranger.count = 7
    stranger.socket.settimeout(0.05)
    stranger.socket.send(stranger.packet(padded([2000] * 4)))
    with pytest.raises(ConnectionRefusedError):  # the system says that nobody listens to it
        stranger.socket.recv(4096)
    link.exchange(IDLE)
    assert flight.bridge.counters.answered == 1


def test_a_flood_from_another_address_costs_nothing_and_is_never_adopted(flight, link):
    link.exchange(IDLE)
    over, sent = threading.Event(), []

    def flood():
        stranger = Link(flight.port)
        while not over.is_set():
            stranger.count += 1
            with contextlib.suppress(ConnectionRefusedError):
                stranger.socket.send(stranger.packet(padded([2000] * 4)))
                sent.append(1)
        stranger.close()

    thread = threading.Thread(target=flood)
    thread.start()
    try:
        for _ in range(300):
            link.exchange(IDLE)
        assert waited(lambda: len(sent) > 1000)
        link.exchange(IDLE)
    finally:
        over.set()
        thread.join()
    counters = flight.bridge.counters
    assert (counters.answered, counters.connections, counters.restarts) == (301, 1, 0)
    assert counters.strangers == counters.missed == link.repeats == 0


@pytest.mark.parametrize(
    ('change', 'line'),
    [
        (lambda data: data[:5], 'too short for a servo packet'),
        (lambda data: b'\x00\x00' + data[2:], 'magic 0 is not that of a servo packet'),
        (lambda data: data + b'\x00', '41 bytes, but magic 18458 has 40'),
        (
            lambda data: data[:2] + b'\x0a\x00' + data[4:],
            'frame rate 10 Hz is not from 11 to 8000',
        ),
        (lambda data: data[:2] + b'\xff\xff' + data[4:], 'frame rate 65535 Hz is not'),
        (lambda data: data * 100, '73 bytes, but magic 18458 has 40'),
    ],
)
def test_a_malformed_packet_is_counted_and_named(flight, link, change, line):
    link.socket.send(change(link.packet(IDLE)))
    assert waited(lambda: flight.bridge.counters.malformed == 1)
    assert line in flight.bridge.counters.last_fault
    link.exchange(IDLE)
    assert flight.bridge.status().level == 'warn'
    assert flight.simulation.step_count == 2


def test_an_output_that_drives_nothing_is_reported_once(flight, link):
    link.exchange(IDLE)
    for _ in range(100):
        link.exchange([*[1000] * 4, 1900, *[0] * 11])
    assert flight.reports[1:] == [
        ('output 5', 'ArduPilot moves output 5, which drives nothing'),
    ]


def fuzz(flight, link, packets, seed=1):
    rng = random.Random(seed)
    good, counters = link.packet(IDLE), flight.bridge.counters
    for sent in range(1, packets + 1):
        data = bytearray(good if sent % 2 else rng.randbytes(rng.randrange(0, 80)))
        if sent % 2:
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
            data = data[: rng.randrange(40)]
        link.socket.send(data)
        if sent % 50 == 0 or sent == packets:  # let it read, so that the system drops none
            assert waited(partial(lambda n: counters.malformed == n, sent))
    for _ in range(10):
        link.exchange(IDLE)
    assert counters.answered == 9  # the first packet answers nothing


def test_random_bytes_do_no_harm(flight, link):
    fuzz(flight, link, 2000)


@pytest.mark.full
@pytest.mark.timeout(1800)
def test_a_million_random_packets_do_no_harm(flight, link):
    fuzz(flight, link, 1_000_000)


def test_a_port_in_use_is_refused():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(('127.0.0.1', 0))
        port = other.getsockname()[1]
        with pytest.raises(
            ConfigError, match=rf'127\.0\.0\.1 port {port}: Address already in use'
        ):
            BridgedFlight('x500_ground', 'ardupilot', port=port)


def test_it_listens_on_this_host_only_unless_told_otherwise(flight):
    assert flight.bridge._port._socket.getsockname()[0] == '127.0.0.1'


@pytest.mark.parametrize(
    ('scene', 'options', 'line'),
    [
        ('x500_ground', {'protocol': 'betaflight'}, "protocol 'betaflight' is not known; allowed"),
        ('x500_ground', {'vehicle': 'y6'}, "vehicle 'y6' is not in the scene; it has: x500"),
        ('crazyflie', {}, "mapping 'ardupilot_crazyflie' is not known; mappings: ardupilot_"),
        ('bluerov2', {'mapping': 'ardupilot_x500'}, "thruster 'm1' is not in the vehicle"),
        ('x500_ground', {'mapping': 'px4_x500'}, "key 'protocol': is px4, not ardupilot"),
    ],
)
def test_wrong_options(scene, options, line):
    options = AutopilotOptions(**{'protocol': 'ardupilot', **options})
    with pytest.raises(Exception, match=line):
        open_bridge(Simulation(scene), options, Surroundings())
