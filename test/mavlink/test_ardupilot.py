"""ArduPilot's bridge over real sockets: lockstep, odd packets, and closed loops."""

import math
import random
import socket
import time
from fractions import Fraction
from functools import partial

import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings, open_bridge
from fluid_sim_ros.loop.pacing import RealTime
from fluid_sim_ros.simulation import Simulation
from test.support.autopilots.ardupilot_stand_in import (
    VECTORED,
    VECTORED_6DOF,
    Copter,
    Link,
    Plane,
    Submarine,
    padded,
)
from test.support.autopilots.autopilot_peers import Flight, waited

IDLE = padded([1000] * 4)


@pytest.fixture
def flight():
    with Flight('x500_ground', 'ardupilot').running() as flight:
        yield flight


@pytest.fixture
def link(flight):
    link = Link(flight.port)
    yield link
    link.close()


# ---- lockstep ------------------------------------------------------------------------------


def lockstep(flight, frames, seed=0):
    """Exchange frames at changing rates; time must be the exact sum of their lengths."""
    rng = random.Random(seed)
    link, elapsed, steps = Link(flight.port), Fraction(0), 0
    for frame in range(frames):
        if frame < 400:
            link.rate = 1200 - frame  # as ArduPilot does at its start
        elif frame % 100 == 0:
            link.rate = rng.choice((50, 100, 300, 400, 800, 1000))
        state = link.exchange(IDLE)
        elapsed += Fraction(1, link.rate)
        steps += math.ceil(Fraction(1, link.rate) / Fraction(1, 500))
        assert state['timestamp'] == [pytest.approx(float(elapsed), abs=6e-10)]
    counters = flight.bridge.counters
    assert waited(lambda: counters.sent == frames)
    assert (counters.answered, counters.repeated, link.repeats) == (frames, 0, 0)
    assert (counters.missed, counters.malformed) == (0, 0)
    assert flight.simulation.step_count == steps
    assert flight.simulation.time_ns == round(elapsed * 10**9)
    link.close()


def test_no_frame_is_lost_or_simulated_twice(flight):
    lockstep(flight, 3000)


@pytest.mark.full
@pytest.mark.timeout(1800)
def test_no_frame_of_100000_is_lost_or_simulated_twice(flight):
    lockstep(flight, 100_000)


def test_32_channels_are_read(flight, link):
    assert link.exchange(padded([1000] * 4, 32))['timestamp'] == [0.0025]


def test_a_packet_asked_for_again_gets_the_same_answer_without_a_step(flight, link):
    link.exchange(IDLE)
    first = link.exchange(IDLE)
    link.count -= 1
    link.socket.send(link.packet(IDLE))
    link.reader.time = -1.0
    assert link.reader.read(link.socket.recv(4096)) == first
    assert flight.bridge.counters.repeated == 1
    assert flight.simulation.step_count == 4


def test_questions_repeated_in_a_pause_get_one_answer(flight, link):
    link.exchange(IDLE)
    flight.runner.paused = True
    time.sleep(0.06)  # the loop looks at the port no longer
    for _ in range(4):
        link.socket.send(link.packet(IDLE))
    flight.runner.paused = False
    link.reader.read(link.socket.recv(4096))
    link.count += 1
    assert flight.bridge.counters.repeated == 3
    for _ in range(3):  # an answer too many would be taken for that of the next frame
        assert link.exchange(IDLE)['timestamp'][0] == pytest.approx(link.count / 400)
    assert flight.simulation.step_count == 10


def test_a_restarted_autopilot_finds_its_vehicle_at_the_start(flight, link):
    for _ in range(50):
        link.exchange(padded([1900] * 4))
    assert flight.simulation.data.qpos[2] > 0.13
    link.count, link.reader.time = 0, -1.0
    state = link.exchange(IDLE)
    assert flight.resets == 1
    assert state['timestamp'] == [0.0025]
    assert state['position'] == pytest.approx([0, 0, -0.13], abs=1e-4)
    assert flight.bridge.counters.restarts == 1
    assert any(key == 'restarted' for key, _ in flight.reports)


def test_a_reset_by_the_user_sets_the_state_back_and_time_goes_on(flight, link):
    for _ in range(50):
        before = link.exchange(padded([1900] * 4))
    flight.runner.requests.call(flight._reset, 2.0)
    state = link.exchange(IDLE)  # the reader refuses time that goes back
    assert state['timestamp'][0] == pytest.approx(before['timestamp'][0] + 1 / 400, abs=1e-9)
    assert state['position'] == pytest.approx([0, 0, -0.13], abs=1e-4)


def test_a_reset_within_the_first_frame_keeps_the_frames_length():
    flight = Flight('x500_ground', 'ardupilot')
    simulation, bridge, link = flight.simulation, flight.bridge, Link(flight.port, rate=400)
    link.socket.send(link.packet(IDLE))
    assert bridge.meet(simulation)
    simulation.step()  # one of two
    flight._reset()
    assert not bridge.meet(simulation)  # it answers, and waits
    assert link.reader.read(link.socket.recv(4096))['timestamp'] == [0.0]
    link.count += 1
    link.socket.send(link.packet(IDLE))
    assert bridge.meet(simulation)
    assert simulation.model.opt.timestep == 1 / 800
    assert bridge.steps_left(simulation) == 2
    bridge.close()


def test_two_instances_fly_side_by_side():
    flights = [Flight('x500_ground', 'ardupilot') for _ in range(2)]
    with flights[0].running(), flights[1].running():
        links = [Link(flight.port) for flight in flights]
        for _ in range(100):
            links[0].exchange(padded([1800] * 4))
            links[1].exchange(IDLE)
    assert [flight.bridge.counters.sent for flight in flights] == [100, 100]
    assert flights[0].simulation.data.qpos[2] > 0.14
    assert flights[1].simulation.data.qpos[2] == pytest.approx(0.13, abs=1e-3)


def test_the_instance_chooses_the_port():
    with pytest.raises(ConfigError, match=r'port 65542: '):
        Flight('x500_ground', 'ardupilot', port=0, instance=5654)


def test_real_time_holds_the_autopilot_back():
    with Flight('x500_ground', 'ardupilot', RealTime(factor=2.0, tick=5)).running() as flight:
        link = Link(flight.port)
        link.exchange(IDLE)
        begin = time.perf_counter()
        for _ in range(80):
            link.exchange(IDLE)
        assert time.perf_counter() - begin > 0.07  # 0.2 s at twice real time, less a slice


# ---- what goes wrong -----------------------------------------------------------------------


def test_a_silent_autopilot_is_reported_and_waited_for():
    with Flight('x500_ground', 'ardupilot', timeout=0.2).running() as flight:
        link = Link(flight.port)
        link.exchange(IDLE)
        assert waited(lambda: flight.bridge.counters.gone == 1)
        assert flight.bridge.status().level == 'error'
        assert ('gone', f'ArduPilot: nothing for 0.2 s; waiting on port {flight.port}') in (
            flight.reports
        )
        step = flight.simulation.step_count
        link.exchange(IDLE)
        assert flight.simulation.step_count == step + 2
        assert flight.bridge.status().level == 'ok'
        assert flight.reports[-1] == ('back', 'ArduPilot answers again')


def test_a_stranger_is_not_answered_while_the_autopilot_is_there(flight, link):
    link.exchange(IDLE)
    stranger = Link(flight.port)
    stranger.count = 7
    stranger.socket.settimeout(0.05)
    stranger.socket.send(stranger.packet(padded([2000] * 4)))
    assert waited(lambda: flight.bridge.counters.strangers == 1)
    with pytest.raises(TimeoutError):
        stranger.socket.recv(4096)
    link.exchange(IDLE)
    assert flight.bridge.counters.answered == 2


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
    assert counters.answered == 10


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
            Flight('x500_ground', 'ardupilot', port=port)


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


# ---- closed loops --------------------------------------------------------------------------


def test_a_copter_takes_off_and_holds_its_place(flight, link):
    copter = Copter((2.0, 1.0, -3.0), hover=0.77)
    state = link.exchange(IDLE)
    for _ in range(4000):
        state = link.exchange(copter.pulses(state))
    assert state['position'] == pytest.approx([2.0, 1.0, -3.0], abs=0.03)
    assert [math.degrees(a) for a in state['attitude']] == pytest.approx([0, 0, 90], abs=0.5)


def test_an_aircraft_waits_on_its_wheels_and_takes_off():
    with Flight('aerosonde_ground', 'ardupilot').running() as flight:
        link, plane = Link(flight.port), Plane()
        for _ in range(400):
            state = link.exchange(padded([1500, 1500, 1000, 1500]))
        assert state['position'] == pytest.approx([0, 0, -0.4145], abs=1e-3)
        for _ in range(4800):
            state = link.exchange(plane.pulses(state))
        north, east, down = state['position']
        assert down < -30.0
        assert east > 200.0
        assert abs(north) < 20.0


@pytest.mark.parametrize(
    ('scene', 'factors'), [('bluerov2', VECTORED), ('bluerov2_heavy', VECTORED_6DOF)]
)
def test_a_submarine_dives_turns_and_goes_ahead(scene, factors):
    yaw = math.pi / 2 + 0.5
    with Flight(scene, 'ardupilot').running() as flight:
        link = Link(flight.port)
        state = link.exchange(padded([1500] * 8))
        submarine = Submarine(factors, 6.0, yaw)
        for _ in range(3200):
            state = link.exchange(submarine.pulses(state))
        assert state['position'][2] == pytest.approx(6.0, abs=0.15)
        assert state['attitude'][0] == pytest.approx(0.0, abs=0.02)
        assert state['attitude'][2] == pytest.approx(yaw, abs=0.2)  # dead zone
        submarine.forward = 0.4
        before = state['position']
        for _ in range(800):
            state = link.exchange(submarine.pulses(state))
        north, east = (b - a for a, b in zip(before[:2], state['position'][:2], strict=True))
        assert math.atan2(east, north) == pytest.approx(state['attitude'][2], abs=0.2)
        assert math.hypot(north, east) > 0.3
