# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A usual exchange is one call of the library: the same bytes and commands as by its twin."""

import math
import random
import signal
import socket
import struct
import threading
from dataclasses import asdict

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.ardupilot import usual as ardupilot_usual
from fluid_sim_ros.mavlink.ardupilot.json_packets import write_state
from fluid_sim_ros.mavlink.ardupilot.json_state import ReplyWriter, StateReader
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from fluid_sim_ros.mavlink.px4 import usual as px4_usual
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_sensor import PlainReadings
from fluid_sim_ros.mavlink.px4.hil_state import HilState
from fluid_sim_ros.mavlink.px4.wire import Frame
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.plugins.exchange import ANSWERED, ASK, HEAR, OBSERVED
from test.support.autopilots.autopilot_peers import BridgedFlight, waited
from test.support.autopilots.posed import Posed
from test.support.autopilots.px4_stand_in import Px4

ANSWER = Frame(dialect.MAVLink_hil_actuator_controls_message)
HEARTBEAT = dialect.MAVLink_heartbeat_message(2, 12, 0, 0, 0, 3).pack(dialect.MAVLink(None))
SCENES = ('x500', 'aerosonde', 'bluerov2_heavy')
#: States of each scene; a million together in make test-full.
VOLUMES = [300, pytest.param(167_000, marks=[pytest.mark.full, pytest.mark.timeout(3600)])]
#: Exchanges of a flight.
FLIGHTS = [300, pytest.param(50_000, marks=[pytest.mark.full, pytest.mark.timeout(3600)])]


@pytest.fixture(autouse=True)
def patient(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 5.0)


def parts(posed, protocol):
    """Return mapping, actuators that write commands, and two batteries alike."""
    vehicle = posed.vehicle
    file, path = load_mapping(protocol, vehicle.kind, '')
    actuators = ActuatorMap(file, path, vehicle)
    actuators.drive(*posed.simulation.control_ports(vehicle.name))
    limits = vehicle.thrust_range[:, 1].tolist()
    batteries = [Battery(file.battery, limits) if file.battery else None for _ in range(2)]
    return file, actuators, *batteries


def check_commands(posed, actuators, outputs):
    """Compare ``ctrl`` with what the twin in Python commands for the outputs, to the bit."""
    control = posed.simulation.data.ctrl
    found = control.copy()
    thrusts, joints = actuators.plain_commands([*outputs, *[0.0] * 16])
    if thrusts:
        posed.simulation.set_thrust(posed.vehicle.name, thrusts)
    if joints:
        posed.simulation.set_joints(posed.vehicle.name, joints)
    assert found.tobytes() == control.tobytes()


@pytest.mark.parametrize('count', VOLUMES)
@pytest.mark.parametrize('scene', SCENES)
def test_px4_gets_the_bytes_and_drives_as_by_the_twin(scene, count):
    posed, rng = Posed(scene, timestep=0.002, seed=7), random.Random(4)
    file, actuators, battery, plain_battery = parts(posed, 'px4')
    states = [
        HilState(posed.simulation, posed.vehicle.name, file, Sticks(file.rc, 0.0), 'wgs84', *kind)
        for kind in ((), (PlainReadings,))
    ]
    writers = HilWriter(), HilWriter()
    exchange = px4_usual.UsualExchange(posed.simulation, states[0], actuators, battery, 0.004)
    ours, theirs = socket.socketpair()
    with ours, theirs:
        ours.setblocking(False)
        exchange.connect(ours.fileno(), writers[0])
        for i in range(1, count + 1):
            posed.simulation.step(2)
            posed.pose()
            if plain_battery is not None:
                plain_battery.draw(actuators.last[0], 0.004)
            controls = [float(np.float32(rng.uniform(-1.3, 1.3))) for _ in range(16)]
            controls[rng.randrange(16)] = rng.choice((math.nan, math.inf, 0.0, -1.0))
            theirs.send(ANSWER.pack(i % 256, 1, 1, 4000 * i, 1, *controls, 128 * (i % 2)))
            assert exchange.run(ASK | HEAR | OBSERVED, 4000 * i) == ANSWERED
            assert theirs.recv(65536) == states[1].messages(writers[1], 4000 * i)
            assert exchange.armed == (i % 2 == 1)
            check_commands(posed, actuators, controls)
            if plain_battery is not None:
                assert bytes(battery.state)[:32] == bytes(plain_battery.state)[:32]


@pytest.mark.parametrize('count', VOLUMES)
@pytest.mark.parametrize('scene', SCENES)
def test_ardupilot_gets_the_bytes_and_drives_as_by_the_twin(scene, count):
    posed, rng = Posed(scene, seed=7), random.Random(3)
    file, actuators, battery, plain_battery = parts(posed, 'ardupilot')
    sticks = Sticks(file.rc, 0.0, 12)
    writer = ReplyWriter(posed.simulation, posed.vehicle.name, sticks, battery)
    plain = StateReader(posed.simulation, posed.vehicle.name, sticks, plain_battery)
    exchange = ardupilot_usual.UsualExchange(posed.simulation, writer, actuators, battery)
    ours, theirs = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
    with ours, theirs:
        for end in (ours, theirs):
            end.bind(('127.0.0.1', 0))
        ours.setblocking(False)
        ours.connect(theirs.getsockname())
        theirs.connect(ours.getsockname())
        assert not exchange.connect(ours.fileno(), ours.getsockname(), 400, 0.0025)  # another one
        assert exchange.connect(ours.fileno(), theirs.getsockname(), 400, 0.0025)
        for i in range(1, count + 1):
            posed.simulation.step()
            posed.pose()
            if i % 100 == 50:
                sticks.move([rng.uniform(-1, 1) for _ in range(rng.randrange(1, 13))], [])
            time_s = rng.choice([0.0025 * i, rng.uniform(0, 1e5)])
            assert exchange.run(ASK | OBSERVED, time_s, i) == ANSWERED
            assert theirs.recv(65536) == write_state(plain.read(time_s)) == exchange.reply()
            pulses = [rng.choice((0, 1100, rng.randrange(65536))) for _ in range(16 << i % 2)]
            magic = 29569 if i % 2 else 18458
            theirs.send(struct.pack(f'<HHI{len(pulses)}H', magic, 400, i, *pulses))
            assert exchange.run(HEAR, time_s, i) == ANSWERED
            check_commands(posed, actuators, pulses)
            if plain_battery is not None:
                plain_battery.draw(actuators.last[0], 0.0025)
                assert bytes(battery.state)[:32] == bytes(plain_battery.state)[:32]


class Flown:
    """A flight with a peer that also does what is unusual; by one call each, or by the twin."""

    def __init__(self, scene, protocol, fly, count, usual):
        flight = BridgedFlight(scene, protocol, timestep=0.004 if scene == 'aerosonde' else None)
        self.log, self.runs = [], []
        flight.bridge._surroundings.log = self
        whole = flight.bridge._whole
        if not usual:
            whole.usable, whole.connect = False, lambda *about: False
        run = whole.run
        whole.run = lambda *about: self.runs.append(about) or run(*about)
        with flight.running():
            self.bytes = fly(flight, count)
            counters = flight.bridge.counters
            ended = 0 if protocol == 'px4' else 1
            assert waited(lambda: counters.sent + ended >= counters.answered + 1)
            self.state = flight.simulation.data.qpos.copy(), flight.simulation.data.ctrl.copy()
            self.status = flight.bridge.status()
        self.counters = {k: v for k, v in asdict(counters).items() if k[0] != '_'}
        self.reports = [line for _, line in flight.reports if ' at 127' not in line]

    def command(self, topic, data):
        self.log.append((topic, data))

    def event(self, **change):
        self.log.append(change)


def fly_px4(flight, count):
    """Answer every HIL_SENSOR, now and then in pieces, with others, twice or after rubbish."""
    rng, received = random.Random(count), []
    px4 = Px4(flight.port, silent=0)
    for i in range(count):
        sensors = px4.sensors()
        received.append(sensors)
        controls = [rng.uniform(-0.1, 1.1) for _ in range(6)] + [0.0] * 10
        time_us = sensors['time_usec']
        answer = ANSWER.pack(i % 256, 1, 1, time_us, 1, *controls, 128)
        odd = rng.randrange(40)
        if odd == 0:
            px4.socket.sendall(answer[:20])
            threading.Event().wait(0.002)
            answer = answer[20:]
        elif odd == 1:
            answer = HEARTBEAT + answer
        elif odd == 2:
            answer = bytes(12) + answer
        elif odd == 3:
            answer = ANSWER.pack(0, 1, 1, max(0, time_us - 4000), 1, *[1.0] * 16, 0) + answer
        elif odd == 4:
            answer = ANSWER.pack(0, 1, 1, time_us + 9, 1, *[1.0] * 16, 0) + answer
        elif odd == 5:
            answer = bytes([0xFE, 9, 0, 1, 1, 0]) + bytes(11) + answer
        px4.socket.sendall(answer)
    received.append(px4.sensors())
    flight.px4 = px4  # which stays connected
    return received, px4.counts, px4.latest


def fly_ardupilot(flight, count):
    """Send a packet per state; now and then another rate, 32 channels, a gap, or rubbish first."""
    rng, received, rate, number = random.Random(count), [], 400, 0
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
        peer.connect(('127.0.0.1', flight.port))
        peer.settimeout(10.0)
        for _ in range(count):
            odd = rng.randrange(40)
            if odd == 0:
                rate = rng.choice((300, 400, 1200))
            elif odd == 1:
                number += 3
            elif odd == 2:
                peer.send(rng.randbytes(rng.randrange(70)))
            pulses = [rng.randrange(1000, 2000) for _ in range(32 if odd == 3 else 16)]
            magic = 29569 if odd == 3 else 18458
            data = struct.pack(f'<HHI{len(pulses)}H', magic, rate, number, *pulses)
            peer.send(data)
            received.append(peer.recv(65536))
            if odd == 4:  # it asks again
                peer.send(data)
                received.append(peer.recv(65536))
            number += 1
    return received


@pytest.mark.parametrize('count', FLIGHTS)
@pytest.mark.parametrize(
    ('scene', 'protocol', 'fly'),
    [
        ('x500_ground', 'px4', fly_px4),
        ('aerosonde', 'px4', fly_px4),
        ('x500_ground', 'ardupilot', fly_ardupilot),
        ('bluerov2', 'ardupilot', fly_ardupilot),
    ],
)
def test_a_flight_with_what_is_unusual_is_flown_as_by_the_twin(scene, protocol, fly, count):
    usual, twin = (Flown(scene, protocol, fly, count, way) for way in (True, False))
    assert len(usual.runs) > 0.7 * count
    assert not twin.runs
    assert usual.bytes == twin.bytes
    assert usual.counters == twin.counters
    assert usual.reports == twin.reports
    assert usual.log == twin.log
    assert {**usual.status.values, 'port': 0, 'peer': '', 'answers_per_s': 0} == {
        **twin.status.values, 'port': 0, 'peer': '', 'answers_per_s': 0
    }  # fmt: skip
    for ours, theirs in zip(usual.state, twin.state, strict=True):
        np.testing.assert_array_equal(ours, theirs)


class InterruptedLoopError(Exception):
    """Raised by the handler of a signal."""


def test_a_signal_ends_the_wait_and_other_threads_run_meanwhile():
    def handle(*_):
        raise InterruptedLoopError

    flight, turns, over = BridgedFlight('x500_ground', 'px4'), [], threading.Event()

    def fly():
        px4 = Px4(flight.port, silent=0)
        for _ in range(50):
            px4.exchange([0.0] * 4)
        px4.sensors()  # which is not answered
        while not over.is_set():
            turns.append(flight.bridge.counters.sent)

    before = signal.signal(signal.SIGALRM, handle)
    thread = threading.Thread(target=fly)
    thread.start()
    try:
        with pytest.raises(InterruptedLoopError):
            signal.setitimer(signal.ITIMER_REAL, 1.0)
            flight.runner.run()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
        over.set()
        thread.join(10.0)
        flight.bridge.close()
    assert flight.bridge.counters.answered == 50
    assert turns.count(51) > 100
