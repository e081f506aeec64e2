# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What PX4's bridge refuses and reports."""

import math
import sys

import pytest

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.mavlink.px4.hil_messages import dialect
from test.support.autopilots.autopilot_peers import BridgedFlight, waited

IDLE = [0.0] * 4


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
        BridgedFlight('x500_ground', 'px4', port=flight.port)


def test_an_address_of_another_host_is_refused():
    with pytest.raises(ConfigError, match=r'cannot listen on 192\.0\.2\.1'):
        BridgedFlight('x500_ground', 'px4', address='192.0.2.1')


def test_a_timestep_that_does_not_divide_4_ms_is_refused():
    with pytest.raises(ConfigError, match=r'timestep of 0\.005 s does not divide 4 ms'):
        BridgedFlight('aerosonde', 'px4')


def test_a_missing_extra_is_named(monkeypatch):
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.px4.bridge')
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.px4.hil_answers')
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.px4.hil_messages')
    monkeypatch.delitem(sys.modules, 'fluid_sim_ros.mavlink.px4.hil_state')
    monkeypatch.setitem(sys.modules, 'pymavlink.dialects.v20', None)
    with pytest.raises(MissingExtraError, match='an autopilot needs pymavlink'):
        BridgedFlight('x500_ground', 'px4')
    BridgedFlight('x500_ground', 'ardupilot').bridge.close()  # which needs nothing


def test_a_vehicle_without_the_sensors_is_refused(tmp_path):
    path = tmp_path / 'px4_bluerov2.yaml'
    lines = [f'{{output: {i}, thruster: t{i}, input: [-1, 0, 1]}}' for i in range(1, 7)]
    path.write_text(f'protocol: px4\nairframe: none\nactuators: [{", ".join(lines)}]\n')
    with pytest.raises(ConfigError, match="vehicle 'bluerov2' has no barometer; add one under"):
        BridgedFlight('bluerov2', 'px4', mapping=str(path))
