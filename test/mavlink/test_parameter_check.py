# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An autopilot that is set otherwise than its mapping states is told of it."""

import contextlib
import socket
import struct
import threading

import pytest

from fluid_sim_ros.mavlink import parameter_check
from fluid_sim_ros.mavlink.ardupilot import station
from fluid_sim_ros.mavlink.px4 import companion
from fluid_sim_ros.resources import config_folder
from test.support.autopilots import hil_wire
from test.support.autopilots.ardupilot_stand_in import Link, padded
from test.support.autopilots.autopilot_peers import BridgedFlight, waited
from test.support.autopilots.px4_stand_in import Px4

IDLE = padded([1000] * 4)
INT32, REAL32 = 6, 9  # MAV_PARAM_TYPE


class ParameterServer:
    """MAVLink's parameter protocol on a socket: TCP as of ArduPilot, UDP as of PX4."""

    def __init__(self, kind, system):
        self.parameters, self.system, self.batteries = {}, system, []
        self.types = {}
        self.socket = socket.socket(socket.AF_INET, kind)
        self.socket.bind(('127.0.0.1', 0))
        self.port = self.socket.getsockname()[1]
        self.client, self.stopped = None, False
        if kind == socket.SOCK_STREAM:
            self.socket.listen()
        self.socket.settimeout(0.05)
        self.thread = threading.Thread(target=self._serve, daemon=True)

    def _serve(self):
        rest = b''
        while not self.stopped:
            with contextlib.suppress(TimeoutError):
                rest = self._answer(rest)

    def _answer(self, rest):
        if self.socket.type == socket.SOCK_STREAM:
            if self.client is None:
                self.client = self.socket.accept()[0]
                self.client.settimeout(0.05)
                self.client.sendall(hil_wire.pack('HEARTBEAT', autopilot=3, mavlink_version=3))
            data, reply = self.client.recv(4096), self.client.sendall
        else:
            data, sender = self.socket.recvfrom(4096)

            def reply(answer):
                self.socket.sendto(answer, sender)

        messages, rest = hil_wire.frames(rest + data)
        for name, fields in messages:
            if name == 'BATTERY_STATUS':
                self.batteries.append(fields)
                continue
            assert name == 'PARAM_REQUEST_READ'
            key = fields['param_id'].rstrip(b'\0').decode()
            # PX4 and ArduPilot answer only who names their system
            if key in self.parameters and fields['target_system'] == self.system:
                reply(self._value(key))
        return rest

    def _value(self, key):
        kind, value = self.types.get(key, REAL32), self.parameters[key]
        if kind == INT32:  # as its bytes
            (value,) = struct.unpack('<f', struct.pack('<i', int(value)))
        return hil_wire.pack(
            'PARAM_VALUE', param_id=key.encode(), param_value=value, param_count=9,
            param_type=kind,
        )  # fmt: skip

    def close(self):
        self.stopped = True
        self.thread.join(5.0)
        for each in (self.client, self.socket):
            if each is not None:
                each.close()


@pytest.fixture
def ardupilot_door(monkeypatch):
    server = ParameterServer(socket.SOCK_STREAM, 1)
    monkeypatch.setattr(station, 'SECOND_PORT', server.port)
    server.thread.start()
    yield server
    server.close()


@pytest.fixture
def px4_door(monkeypatch):
    server = ParameterServer(socket.SOCK_DGRAM, 3)
    monkeypatch.setattr(companion, 'PX4_PORT', server.port - 2)
    server.thread.start()
    yield server
    server.close()


def fly_ardupilot(door, options=None, **parameters):
    door.parameters.update(parameters)
    with BridgedFlight('x500_ground', 'ardupilot', **(options or {})).running() as flight:
        link = Link(flight.port)
        link.exchange(IDLE)
        check = flight.bridge._check
        assert waited(lambda: not check._thread.is_alive())
        for _ in range(5):
            link.exchange(IDLE)
    return [(key, line) for key, line in flight.reports if key in ('frame', 'parameters')]


def fly_px4(door, exchanges=60, options=None, **parameters):
    door.parameters.update(parameters)
    flight = BridgedFlight('x500_ground', 'px4', instance=2, **(options or {}))
    with flight.running():
        px4 = Px4(flight.port, silent=0)
        px4.exchange([0.0] * 4)
        check = flight.bridge._companion._check
        assert waited(lambda: not check._thread.is_alive())
        for _ in range(exchanges):
            px4.exchange([0.8] * 4)
        px4.close()
    return [(key, line) for key, line in flight.reports if key in ('parameters', 'unread')]


RIGHT = {
    'FRAME_CLASS': 1.0, 'FRAME_TYPE': 1.0, 'RNGFND1_TYPE': 100.0, 'RNGFND1_ORIENT': 25.0,
    'BATT_MONITOR': 4.0,
}  # fmt: skip


def test_a_plus_frame_is_named(ardupilot_door):
    assert fly_ardupilot(ardupilot_door, **RIGHT | {'FRAME_TYPE': 0.0}) == [
        ('frame', 'ArduPilot flies another frame: FRAME_TYPE is 0, and must be 1')
    ]


def test_the_right_parameters_need_no_word(ardupilot_door):
    assert fly_ardupilot(ardupilot_door, **RIGHT) == []


def test_what_is_no_frame_is_named_too(ardupilot_door):
    ((key, line),) = fly_ardupilot(ardupilot_door, **RIGHT | {'BATT_MONITOR': 0.0})
    assert key == 'parameters'
    assert line.startswith('ArduPilot is not set as its mapping states: BATT_MONITOR is 0')


def test_what_the_user_wants_instead_is_compared(ardupilot_door):
    own = {'parameters': {'FRAME_TYPE': 0.0}}
    assert fly_ardupilot(ardupilot_door, own, **RIGHT | {'FRAME_TYPE': 0.0}) == []


def test_a_px4_that_was_started_by_hand_is_compared(px4_door):
    ((key, line),) = fly_px4(px4_door, MPC_THR_HOVER=0.5, SIM_BAT_DRAIN=60.0)
    assert key == 'parameters'
    assert line == (
        'PX4 is not set as its mapping states: SIM_BAT_DRAIN is 60, and must be 0; '
        'MPC_THR_HOVER is 0.5, and must be 0.77; set it there, or state your own value in a '
        'mapping of your own'
    )


def test_values_of_32_bits_are_equal_to_those_of_the_mapping(px4_door):
    single = struct.unpack('<f', struct.pack('<f', 0.77))[0]
    assert fly_px4(px4_door, MPC_THR_HOVER=single, SIM_BAT_DRAIN=0.0) == []


def test_integers_of_px4_are_read_from_their_bytes(px4_door):
    px4_door.types['COM_RC_IN_MODE'] = INT32
    own = {'parameters': {'COM_RC_IN_MODE': 4.0}}
    right = {'MPC_THR_HOVER': 0.77, 'SIM_BAT_DRAIN': 0.0}
    assert fly_px4(px4_door, options=own, COM_RC_IN_MODE=4, **right) == []
    ((_, line),) = fly_px4(px4_door, options=own, COM_RC_IN_MODE=3, **right)
    assert 'COM_RC_IN_MODE is 3, and must be 4' in line


def test_a_px4_that_does_not_say_is_told_of(px4_door, monkeypatch):
    monkeypatch.setattr(parameter_check, '_PATIENCE', 0.1)
    monkeypatch.setattr(parameter_check, '_PERIOD', 0.1)
    ((key, line),) = fly_px4(px4_door, SIM_BAT_DRAIN=0.0)
    assert key == 'unread'
    assert line == (
        f'PX4 did not say on UDP port {px4_door.port} what it is set to; not compared with the '
        'mapping: MPC_THR_HOVER'
    )


def test_px4_gets_the_battery_of_the_mapping(px4_door):
    fly_px4(px4_door, exchanges=500, MPC_THR_HOVER=0.77, SIM_BAT_DRAIN=0.0)
    assert waited(lambda: len(px4_door.batteries) >= 19)  # 2 s at 10 Hz, the last may be under way
    first, last = px4_door.batteries[0], px4_door.batteries[-1]
    # rotor speed 0.8: thrust 0.64 of full, current 0.7 + 34 * 0.64^1.5 A; 16.8 V less 0.02 ohm
    current = 0.7 + 34.0 * 0.64**1.5
    assert last['current_battery'] == pytest.approx(100 * current, rel=0.02)
    assert last['voltages'][0] == pytest.approx(1000 * (16.8 - 0.02 * current), abs=10)
    assert last['voltages'][1:] == [65535] * 9
    assert (first['battery_remaining'], first['id'], first['battery_function']) == (100, 0, 1)
    assert last['current_consumed'] == pytest.approx(1000 * current * 2.0 / 3600, abs=1)


def test_a_battery_above_65_v_needs_a_second_field(px4_door, tmp_path):
    path = tmp_path / 'px4.yaml'
    text = (config_folder() / 'autopilots' / 'px4_x500.yaml').read_text()
    path.write_text(text.replace('full: 16.8, empty: 13.2', 'full: 90, empty: 80'))
    options = {'mapping': str(path)}
    fly_px4(px4_door, 60, options, MPC_THR_HOVER=0.77, SIM_BAT_DRAIN=0.0)
    assert waited(lambda: px4_door.batteries)
    cells = px4_door.batteries[-1]['voltages']
    assert (cells[0], cells[2:]) == (65534, [65535] * 8)
    assert 89000 < sum(cells[:2]) < 90000


def test_an_instance_without_a_mavlink_system_of_its_own_is_told_of():
    flight = BridgedFlight('x500_ground', 'px4', instance=60000)
    with flight.running():
        px4 = Px4(flight.port, silent=0)
        for _ in range(30):
            px4.exchange([0.8] * 4)
        px4.close()
    (line,) = [line for key, line in flight.reports if key == 'unread']
    assert line.startswith('instance 60000 has no MAVLink system of its own (they end at 250)')


def test_the_second_link_is_open_to_this_host_only(px4_door, monkeypatch):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(('127.0.0.1', 0))
        own = probe.getsockname()[1]
    monkeypatch.setattr(companion, 'OUR_PORT', own - 2)
    flight = BridgedFlight('x500_ground', 'px4', instance=2)
    with flight.running():
        px4 = Px4(flight.port, silent=0)
        px4.exchange([0.0] * 4)
        assert flight.bridge._companion._socket.getsockname() == ('127.0.0.1', own)
        px4.close()
