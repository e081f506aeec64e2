# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""PX4's bridge over real sockets: lockstep, time, reset, what it sends."""

import time

import pytest

from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from fluid_sim_ros.resources import config_folder
from test.support.autopilots.autopilot_peers import BridgedFlight, waited
from test.support.autopilots.px4_stand_in import Px4

IDLE = [0.0] * 4


def lockstep(flight, px4, exchanges):
    """Every message is 4 ms after the one before, and each is answered once."""
    for i in range(exchanges):
        assert px4.exchange(IDLE)['time_usec'] == 4000 * (i + 1)
    counters = flight.bridge.counters
    assert waited(lambda: counters.answered == exchanges)
    assert (counters.late, counters.repeated, counters.missed, counters.malformed) == (0,) * 4
    assert px4.sensors()['time_usec'] == 4000 * (exchanges + 1)  # it waits for this one's answer
    assert flight.simulation.step_count == 2 * (exchanges + 1)


def test_no_step_is_lost_or_taken_twice(flight, px4):
    lockstep(flight, px4, 1500)


@pytest.mark.full
@pytest.mark.timeout(1800)
def test_no_step_of_100000_is_lost_or_taken_twice(flight, px4):
    lockstep(flight, px4, 100_000)


def test_groups_come_at_the_rates_that_px4_wants(flight, px4):
    for _ in range(750):
        px4.exchange(IDLE)
    assert px4.rules.counts == {'accel': 750, 'gyro': 750, 'mag': 250, 'baro': 150, 'airspeed': 0}
    assert px4.counts['HIL_GPS'] == 29  # the fix of the last exchange is under way
    assert px4.counts['HIL_STATE_QUATERNION'] == 30
    assert px4.counts['HEARTBEAT'] == 3


def test_sticks_of_a_mapping_are_sent(tmp_path):
    path = tmp_path / 'px4_x500.yaml'
    shipped = config_folder() / 'autopilots' / 'px4_x500.yaml'
    path.write_text(shipped.read_text() + 'rc: [1500, 1500, 1000, 1500, 1900]\n')
    with BridgedFlight('x500_ground', 'px4', mapping=str(path)).running() as flight:
        px4 = Px4(flight.port, silent=0)
        for _ in range(50):
            px4.exchange(IDLE)
    assert px4.counts['RC_CHANNELS'] == 2
    sticks = px4.latest['RC_CHANNELS']
    assert sticks['chancount'] == 5
    assert [sticks[f'chan{i}_raw'] for i in range(1, 7)] == [1500, 1500, 1000, 1500, 1900, 65535]


def test_time_stands_still_until_px4_connects(flight):
    time.sleep(0.1)
    assert flight.simulation.step_count == 0
    assert flight.bridge.status().message == f'waiting for PX4 on TCP port {flight.port}'
    px4 = Px4(flight.port)
    px4.sensors()
    assert flight.bridge.status().level == 'warn'
    assert 'no answer yet' in flight.bridge.status().message


def test_before_its_first_answer_time_goes_on_at_real_time(flight, monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    px4 = Px4(flight.port, silent=50)
    px4.sensors()
    begin = time.perf_counter()
    for _ in range(49):
        px4.exchange(IDLE)
    assert time.perf_counter() - begin > 0.9 * 48 * 0.004
    px4.silent = 0
    first = px4.sensors()['time_usec']
    px4.answer(first, IDLE)
    for i in range(1, 100):
        assert px4.exchange(IDLE)['time_usec'] == first + 4000 * i


def test_an_answer_that_comes_late_locks_the_loop(flight, monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.2)
    px4 = Px4(flight.port, silent=0)
    first = px4.sensors()
    second = px4.sensors()  # free-wheeling has gone on
    px4.answer(first['time_usec'], IDLE)
    assert waited(lambda: flight.bridge.counters.late == 1)
    assert px4.nothing_comes(0.1)
    px4.answer(second['time_usec'], IDLE)
    px4.exchange(IDLE)
    assert flight.bridge.status().level == 'ok'


def test_two_instances_fly_side_by_side():
    flights = [BridgedFlight('x500_ground', 'px4') for _ in range(2)]
    with flights[0].running(), flights[1].running():
        autopilots = [Px4(flight.port, silent=0) for flight in flights]
        for _ in range(100):
            autopilots[0].exchange([0.9] * 4)
            autopilots[1].exchange(IDLE)
    assert flights[0].simulation.data.qpos[2] > 0.14
    assert flights[1].simulation.data.qpos[2] == pytest.approx(0.13, abs=1e-3)


def test_a_reset_by_the_user_sets_the_state_back_and_time_goes_on(flight, px4):
    for _ in range(100):
        last = px4.exchange([0.9] * 4)
    # the message under way is read first: read with the next one, it would not be seen alone
    times = [px4.sensors()['time_usec']]
    flight.runner.requests.call(flight._reset, 2.0)
    # the rules refuse time that goes back
    times += [px4.exchange(IDLE)['time_usec'] for _ in range(9)]
    assert times == [last['time_usec'] + 4000 * (i + 1) for i in range(10)]
    assert flight.simulation.data.qpos[2] == pytest.approx(0.13, abs=1e-3)


def test_the_same_seed_gives_the_same_bytes():
    streams = []
    for _ in range(2):
        with BridgedFlight('x500_ground', 'px4').running() as flight:
            px4 = Px4(flight.port, silent=0)
            streams.append([px4.exchange([0.8] * 4) for _ in range(60)])
    assert streams[0] == streams[1]


def test_an_aircraft_gets_its_airspeed():
    with BridgedFlight('aerosonde', 'px4', timestep=0.004).running() as flight:
        px4, pressures = Px4(flight.port, silent=0), []
        for _ in range(50):
            sensors = px4.exchange([0.0] * 4 + [0.5])
            if sensors['fields_updated'] & 0x400:
                pressures.append(sensors['diff_pressure'])
    assert px4.rules.counts['airspeed'] == len(pressures) == 10
    # 25 m/s in the air of the model [hPa]
    assert pressures == pytest.approx([0.01 * 0.5 * 1.2682 * 25**2] * 10, rel=0.1)
