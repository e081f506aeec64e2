"""PX4's bridge over real sockets: lockstep, silence, reconnection, and closed loops."""

import math
import random
import socket
import sys
import time

import pytest

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.mavlink import px4 as px4_bridge
from fluid_sim_ros.mavlink.hil_messages import dialect
from fluid_sim_ros.resources import config_folder
from test.support.autopilots import hil_wire
from test.support.autopilots.autopilot_peers import Flight, waited
from test.support.autopilots.px4_stand_in import Plane, Px4, Quad, Submarine

IDLE = [0.0] * 4


@pytest.fixture(autouse=True)
def patient(monkeypatch):
    """Give the stand-in time for its first answer, as this host may be busy."""
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 1.0)


@pytest.fixture
def flight():
    with Flight('x500_ground', 'px4').running() as flight:
        yield flight


@pytest.fixture
def px4(flight):
    px4 = Px4(flight.port, silent=0)
    yield px4
    px4.close()


# ---- lockstep ------------------------------------------------------------------------------


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
    assert px4.counts['HIL_GPS'] == 30
    assert px4.counts['HIL_STATE_QUATERNION'] == 30
    assert px4.counts['HEARTBEAT'] == 3


def test_sticks_of_a_mapping_are_sent(tmp_path):
    path = tmp_path / 'px4_x500.yaml'
    shipped = config_folder() / 'autopilots' / 'px4_x500.yaml'
    path.write_text(shipped.read_text() + 'rc: [1500, 1500, 1000, 1500, 1900]\n')
    with Flight('x500_ground', 'px4', mapping=str(path)).running() as flight:
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
    flights = [Flight('x500_ground', 'px4') for _ in range(2)]
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
    flight.runner.requests.call(flight._reset, 2.0)
    # the message that was under way still comes; the rules refuse time that goes back
    times = [px4.exchange(IDLE)['time_usec'] for _ in range(10)]
    assert times == [last['time_usec'] + 4000 * (i + 1) for i in range(10)]
    assert flight.simulation.data.qpos[2] == pytest.approx(0.13, abs=1e-3)


def test_the_same_seed_gives_the_same_bytes():
    streams = []
    for _ in range(2):
        with Flight('x500_ground', 'px4').running() as flight:
            px4 = Px4(flight.port, silent=0)
            streams.append([px4.exchange([0.8] * 4) for _ in range(60)])
    assert streams[0] == streams[1]


def test_an_aircraft_gets_its_airspeed():
    with Flight('aerosonde', 'px4', timestep=0.004).running() as flight:
        px4, pressures = Px4(flight.port, silent=0), []
        for _ in range(50):
            sensors = px4.exchange([0.0] * 4 + [0.5])
            if sensors['fields_updated'] & 0x400:
                pressures.append(sensors['diff_pressure'])
    assert px4.rules.counts['airspeed'] == len(pressures) == 10
    # 25 m/s in the air of the model [hPa]
    assert pressures == pytest.approx([0.01 * 0.5 * 1.2682 * 25**2] * 10, rel=0.1)


# ---- what goes wrong -----------------------------------------------------------------------


def test_a_stall_is_reported_and_survived(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.02)
    with Flight('x500_ground', 'px4', timeout=0.2).running() as flight:
        px4 = Px4(flight.port, silent=0)
        px4.exchange(IDLE)
        assert waited(lambda: flight.bridge.counters.gone == 1)
        assert ('gone', 'PX4: no answer for 0.2 s; going on at real time') in flight.reports
        px4.rest = b''  # what came meanwhile is answered all together
        for _ in range(20):
            px4.exchange(IDLE)
        assert waited(lambda: flight.bridge.status().level == 'ok')


def test_a_px4_that_is_halted_stops_time_and_goes_on(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.0)
    with Flight('x500_ground', 'px4', timeout=0.2).running() as flight:
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
    for _ in range(times):
        px4 = Px4(flight.port, silent=rng.randrange(3))
        for _ in range(rng.randrange(4)):
            px4.exchange(IDLE)
        if rng.random() < 0.5:  # with bytes unread: a reset instead of an orderly end
            px4.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b'\1\0\0\0\0\0\0\0')
        px4.close()
        # one that was closed before it was accepted may be counted later
        assert waited(lambda: counters.disconnections == counters.connections)
    assert counters.connections == counters.disconnections >= times * 0.9
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


def test_outputs_from_the_future_are_refused(flight, px4):
    sensors = px4.sensors()
    px4.answer(sensors['time_usec'] + 1, [0.9] * 4)
    assert waited(lambda: flight.bridge.counters.malformed == 1)
    assert 'outputs of 4001 us, but the time is' in flight.bridge.counters.last_fault
    assert not flight.simulation.data.ctrl.any()


def test_an_answer_given_twice_counts_once(flight, px4):
    sensors = px4.sensors()
    px4.answer(sensors['time_usec'], IDLE)
    px4.answer(sensors['time_usec'], [0.9] * 4)
    px4.exchange(IDLE)
    # it was under way when the time went on
    assert waited(lambda: flight.bridge.counters.repeated == 1)
    assert not flight.simulation.data.ctrl.any()


@pytest.mark.parametrize(
    ('data', 'line'),
    [
        (bytes([0xFE, 9, 0, 1, 1, 0]) + bytes(11), 'MAVLink 1: this autopilot is too old'),
        (bytes(20), 'are no MAVLink message'),
        (
            dialect.MAVLink_hil_controls_message(*[0] * 11).pack(dialect.MAVLink(None)),
            'HIL_CONTROLS: this PX4 is too old; it needs 1.9 or later',
        ),
    ],
)
def test_an_autopilot_of_another_kind_is_named(flight, px4, data, line):
    px4.socket.sendall(data)
    px4.exchange(IDLE)
    assert waited(lambda: flight.bridge.counters.malformed > 0)
    assert any(line in text for _, text in flight.reports)


def test_a_px4_without_lockstep_is_named(flight, px4):
    time_us = px4.sensors()['time_usec']
    px4.send('HIL_ACTUATOR_CONTROLS', time_usec=time_us, mode=1)
    assert waited(lambda: ('lockstep', 'this PX4 was built without lockstep') in flight.reports)


def test_a_motor_too_many_is_reported_once(flight, px4):
    px4.exchange(IDLE)
    for _ in range(100):
        px4.exchange([0.0, 0.0, 0.0, 0.0, 0.5, 0.5])
    assert waited(lambda: flight.bridge.counters.answered == 101)
    lines = [line for key, line in flight.reports if key.startswith('output')]
    assert lines == [f'PX4 moves output {i}, which drives nothing' for i in (5, 6)]


def test_outputs_that_are_no_numbers_are_rest(flight, px4):
    px4.exchange([math.nan] * 4)
    px4.exchange([math.inf] * 4)
    px4.exchange([-math.inf] * 4)
    px4.sensors()
    assert not flight.simulation.data.ctrl.any()


def test_a_port_in_use_is_refused(flight):
    with pytest.raises(ConfigError, match=rf'port {flight.port}: Address already in use; end the'):
        Flight('x500_ground', 'px4', port=flight.port)


def test_an_address_of_another_host_is_refused():
    with pytest.raises(ConfigError, match=r'cannot listen on 192\.0\.2\.1'):
        Flight('x500_ground', 'px4', address='192.0.2.1')


def test_a_timestep_that_does_not_divide_4_ms_is_refused():
    with pytest.raises(ConfigError, match=r'timestep of 0\.005 s does not divide 4 ms'):
        Flight('aerosonde', 'px4')


def test_a_missing_extra_is_named(monkeypatch):
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.px4')
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.hil_answers')
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.hil_messages')
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.hil_state')
    monkeypatch.setitem(sys.modules, 'pymavlink.dialects.v20', None)
    with pytest.raises(MissingExtraError, match='an autopilot needs pymavlink'):
        Flight('x500_ground', 'px4')
    Flight('x500_ground', 'ardupilot').bridge.close()  # which needs nothing


def test_a_vehicle_without_the_sensors_is_refused(tmp_path):
    path = tmp_path / 'px4_bluerov2.yaml'
    lines = [f'{{output: {i}, thruster: t{i}, input: [-1, 0, 1]}}' for i in range(1, 7)]
    path.write_text(f'protocol: px4\nairframe: none\nactuators: [{", ".join(lines)}]\n')
    with pytest.raises(ConfigError, match="vehicle 'bluerov2' has no barometer; add one under"):
        Flight('bluerov2', 'px4', mapping=str(path))


# ---- closed loops --------------------------------------------------------------------------


def test_a_quadrotor_takes_off_and_holds_its_place(flight, monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    px4, quad = Px4(flight.port), Quad((2.0, 1.0, -3.0), hover=0.77)
    controls = IDLE
    for _ in range(2200):
        controls = quad.controls(px4, px4.exchange(controls))
    position = flight.simulation.data.qpos[:3]  # east, north, up
    assert position == pytest.approx([1.0, 2.0, 3.13], abs=0.1)
    assert flight.bridge.counters.missed == 0


def test_an_aircraft_waits_on_its_wheels_and_takes_off(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    with Flight('aerosonde_ground', 'px4').running() as flight:
        px4, plane = Px4(flight.port, silent=15), Plane()
        for _ in range(250):
            px4.exchange([0.0] * 16, armed=False)
        east, north, up = flight.simulation.data.qpos[:3]
        assert (east, north, up) == pytest.approx((0, 0, 0.4145), abs=1e-3)
        controls = [0.0] * 16
        for _ in range(3000):
            controls = plane.controls(px4, px4.exchange(controls))
        east, north, up = flight.simulation.data.qpos[:3]
        assert up > 30.0
        assert east > 200.0
        assert abs(north) < 20.0
        assert flight.bridge.counters.missed == 0


def test_a_submarine_dives_turns_and_goes_ahead(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    with Flight('bluerov2_heavy', 'px4').running() as flight:
        px4 = Px4(flight.port, silent=30)
        submarine = Submarine(6.0, math.pi / 2 + 0.5)
        controls = [0.0] * 8
        for i in range(2400):
            if i == 1900:
                submarine.forward = 0.6
                start = list(submarine.estimate.position)
            controls = submarine.controls(px4, px4.exchange(controls))
        place = submarine.estimate.position
        assert place[2] == pytest.approx(6.0, abs=0.15)
        # 50 of 250 exchanges per second, those of the free-wheeling start included
        assert abs(px4.counts['ODOMETRY'] - px4.rules.counts['accel'] / 5) <= 1
        assert 'HIL_GPS' not in px4.counts
        course = math.atan2(place[1] - start[1], place[0] - start[0])
        assert course == pytest.approx(math.pi / 2 + 0.5, abs=0.3)
