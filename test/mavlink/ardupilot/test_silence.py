# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An ArduPilot that is silent, comes back, starts anew, or waits before its first packet."""

import socket
import threading
import time

import pytest

from fluid_sim_ros.errors import AutopilotError
from fluid_sim_ros.mavlink import silence
from fluid_sim_ros.mavlink.ardupilot import bridge as ardupilot_bridge
from fluid_sim_ros.mavlink.ardupilot import station
from test.support.autopilots.ardupilot_stand_in import Link, padded
from test.support.autopilots.autopilot_peers import BridgedFlight, waited

IDLE = padded([1000] * 4)
FULL = padded([1900] * 4)


@pytest.fixture
def _quick(monkeypatch):
    """Judge a silence in tenths of the usual time."""
    for module in (ardupilot_bridge, silence):
        monkeypatch.setattr(module, 'REPORT_AFTER', 0.1)


def said(flight, words):
    return [line for _, line in flight.reports if words in line]


@pytest.mark.usefixtures('_quick')
def test_a_silent_autopilot_is_reported_and_waited_for():
    with BridgedFlight('x500_ground', 'ardupilot').running() as flight:
        link = Link(flight.port)
        link.exchange(IDLE)
        assert flight.reports == [('', f'ArduPilot at 127.0.0.1:{link.socket.getsockname()[1]}')]
        assert waited(lambda: flight.bridge.counters.gone == 1)
        assert flight.bridge.status().level == 'error'
        assert ('gone', 'ArduPilot: no answer for 0.1 s; simulated time waits') in flight.reports
        step = flight.simulation.step_count
        time.sleep(0.1)
        link.exchange(IDLE)
        assert flight.simulation.step_count == step + 2
        assert flight.bridge.status().level == 'ok'
        assert 'ArduPilot answers again after 0.' in flight.reports[-1][1]


@pytest.mark.usefixtures('_quick')
def test_a_restart_is_said_before_the_answer():
    with BridgedFlight('x500_ground', 'ardupilot').running() as flight:
        link = Link(flight.port)
        for _ in range(3):
            link.exchange(IDLE)
        assert waited(lambda: flight.bridge.counters.gone == 1)
        again = Link(flight.port)
        again.exchange(IDLE)
        lines = [line.split(' at ')[0].split(' after ')[0] for _, line in flight.reports[2:]]
        assert lines == [
            'ArduPilot', 'ArduPilot has restarted: back to the start', 'ArduPilot answers again'
        ]  # fmt: skip


@pytest.mark.usefixtures('_quick')
def test_rule_continue_puts_thrust_to_rest_and_its_clock_goes_on_without_a_jump():
    with BridgedFlight('x500_ground', 'ardupilot', timeout=0.3).running() as flight:
        link = Link(flight.port)
        for _ in range(50):
            before = link.exchange(FULL)
        step = flight.simulation.step_count
        assert waited(lambda: flight.simulation.step_count > step + 100)
        assert not flight.simulation.data.ctrl.any()
        assert flight.bridge.status().message == 'ArduPilot is silent: going on at real time'
        after = link.exchange(FULL)
        assert after['timestamp'][0] == pytest.approx(before['timestamp'][0] + 1 / 400, abs=1e-8)
        assert flight.bridge.status().level == 'ok'
        for _ in range(10):
            link.exchange(FULL)
        assert link.reader.clock_us == 61 * 2500


@pytest.mark.usefixtures('_quick')
def test_rule_stop_ends_the_run():
    flight = BridgedFlight('x500_ground', 'ardupilot', timeout=0.3, on_timeout='stop')
    thread = threading.Thread(target=flight._run, args=(10**6,))
    thread.start()
    Link(flight.port).exchange(IDLE)
    thread.join(10.0)
    flight.bridge.close()
    assert isinstance(flight.error, AutopilotError)
    assert str(flight.error) == 'ArduPilot: no answer for 0.3 s: stopped'


def test_one_that_waits_for_a_ground_station_is_named_within_3_s(monkeypatch):
    with socket.socket() as listener:
        listener.bind(('127.0.0.1', 0))
        listener.listen()
        port = listener.getsockname()[1]
        monkeypatch.setattr(station, 'STATION_PORT', port)
        with BridgedFlight('x500_ground', 'ardupilot').running() as flight:
            assert waited(lambda: said(flight, f'TCP port {port}'), 3.0)
            assert 'start it with --serial0 tcp:0' in flight.reports[0][1]
            assert flight.bridge.reasons()[0] == flight.reports[0][1]
            assert len(flight.reports) == 1
