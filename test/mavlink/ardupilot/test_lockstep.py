# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ArduPilot's bridge over real sockets: frames, repeated packets, restarts."""

import math
import random
import time
from fractions import Fraction

import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.pacing import RealTime
from test.support.autopilots.ardupilot_stand_in import (
    Link,
    padded,
)
from test.support.autopilots.autopilot_peers import BridgedFlight, waited

IDLE = padded([1000] * 4)


def lockstep(flight, frames, seed=0):
    """Exchange frames at changing rates; both clocks must be the sum of whole microseconds."""
    rng = random.Random(seed)
    link, elapsed, steps = Link(flight.port), Fraction(0), 0
    for frame in range(frames):
        if frame < 400:
            link.rate = 1200 - frame  # as ArduPilot does where SIM_RATE_HZ is 800
        elif frame % 100 == 0:
            link.rate = rng.choice((50, 100, 300, 400, 800, 1000))
        state = link.exchange(IDLE)
        elapsed += Fraction(1_000_000 // link.rate, 1_000_000)
        steps += math.ceil(Fraction(1, link.rate) / Fraction(1, 500))
        assert state['timestamp'] == [pytest.approx(float(elapsed), abs=2e-10 * frames)]
        assert link.reader.clock_us == elapsed * 1_000_000
    counters = flight.bridge.counters
    assert waited(lambda: counters.sent == frames)
    assert (counters.answered, counters.repeated, link.repeats) == (frames - 1, 0, 0)
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
    assert link.exchange(padded([1000] * 4, 32))['timestamp'] == pytest.approx([0.0025])


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
    assert state['timestamp'] == pytest.approx([0.0025])
    assert state['position'] == pytest.approx([0, 0, -0.13], abs=1e-4)
    assert flight.bridge.counters.restarts == 1
    assert ('', 'ArduPilot has restarted: back to the start') in flight.reports


def test_a_reset_by_the_user_sets_the_state_back_and_time_goes_on(flight, link):
    for _ in range(50):
        before = link.exchange(padded([1900] * 4))
    flight.runner.requests.call(flight._reset, 2.0)
    state = link.exchange(IDLE)  # the reader refuses time that goes back
    assert state['timestamp'][0] == pytest.approx(before['timestamp'][0] + 1 / 400, abs=1e-9)
    assert state['position'] == pytest.approx([0, 0, -0.13], abs=1e-4)


def test_a_reset_within_the_first_frame_keeps_the_frames_length():
    flight = BridgedFlight('x500_ground', 'ardupilot')
    simulation, bridge, link = flight.simulation, flight.bridge, Link(flight.port, rate=400)
    link.socket.send(link.packet(IDLE))
    assert bridge.meet(simulation)
    simulation.step()  # one of two
    flight._reset()
    assert not bridge.meet(simulation)  # it answers, and waits
    assert link.reader.read(link.socket.recv(4096))['timestamp'] == pytest.approx([0.0], abs=1e-9)
    link.count += 1
    link.socket.send(link.packet(IDLE))
    assert bridge.meet(simulation)
    assert simulation.model.opt.timestep == 1 / 800
    assert bridge.steps_left(simulation) == 2
    bridge.close()


def test_two_instances_fly_side_by_side():
    flights = [BridgedFlight('x500_ground', 'ardupilot') for _ in range(2)]
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
        BridgedFlight('x500_ground', 'ardupilot', port=0, instance=5654)


def test_real_time_holds_the_autopilot_back():
    with BridgedFlight(
        'x500_ground', 'ardupilot', RealTime(factor=2.0, tick=5)
    ).running() as flight:
        link = Link(flight.port)
        link.exchange(IDLE)
        begin = time.perf_counter()
        for _ in range(80):
            link.exchange(IDLE)
        assert time.perf_counter() - begin > 0.07  # 0.2 s at twice real time, less a slice
