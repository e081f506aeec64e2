# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A PX4 that has answered and is silent: halted, in flight termination, or gone for good."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

from fluid_sim_ros.errors import AutopilotError
from fluid_sim_ros.mavlink import silence
from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from fluid_sim_ros.mavlink.px4 import reading
from test.support.autopilots.autopilot_peers import BridgedFlight, free_port, waited
from test.support.autopilots.px4_stand_in import Px4
from test.support.paths import ROOT

HOVER = [0.77] * 4


@pytest.fixture
def quick(monkeypatch):
    """Judge a silence in tenths of the usual time."""
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    monkeypatch.setattr(reading, '_QUIET', 0.5)
    for module in (reading, silence):
        monkeypatch.setattr(module, 'REPORT_AFTER', 0.1)


def said(flight, words):
    return [line for _, line in flight.reports if words in line]


@pytest.mark.full  # slow
def test_a_px4_stopped_for_3_s_in_hover_finds_its_vehicle_where_it_was():
    port = free_port('px4')
    command = [sys.executable, '-m', 'test.support.autopilots.px4_program', '-i', str(port - 4560)]
    environment = {**os.environ, 'PYTHONPATH': str(ROOT), 'PX4_SYS_AUTOSTART': '10016'}
    with BridgedFlight('x500_ground', 'px4', port=port).running() as flight:
        px4 = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
        try:
            height = flight.simulation.data.qpos
            assert waited(lambda: height[2] > 2.0, 60.0)
            px4.send_signal(signal.SIGSTOP)
            assert waited(lambda: flight.bridge.status().level == 'error')
            step, before = flight.simulation.step_count, height[2]
            time.sleep(2.0)
            assert flight.simulation.step_count == step
            px4.send_signal(signal.SIGCONT)
            assert waited(lambda: flight.bridge.status().level == 'ok')
            assert waited(lambda: flight.simulation.step_count > step + 500, 30.0)
            assert height[2] > before - 0.1
        finally:
            px4.kill()
            px4.wait()
    assert said(flight, 'PX4: no answer for 1 s; simulated time waits')
    assert float(said(flight, 'PX4 answers again after')[0].split()[-2]) > 2.0
    assert flight.bridge.counters.gone == 1
    assert flight.bridge.counters.missed == 0


def test_one_that_does_not_read_is_waited_for(quick):
    with BridgedFlight('x500_ground', 'px4').running() as flight:
        px4 = Px4(flight.port, silent=0)
        px4.exchange(HOVER)
        assert waited(lambda: flight.bridge.status().level == 'error')
        step = flight.simulation.step_count
        time.sleep(1.5)  # longer than one that reads
        assert 'it does not read: halted?' in flight.bridge.status().message
        assert flight.simulation.step_count == step
        for _ in range(20):
            px4.exchange(HOVER)
        assert flight.bridge.status().level == 'ok'


@pytest.mark.usefixtures('quick')
def test_flight_termination_puts_thrust_to_rest():
    with BridgedFlight('x500_ground', 'px4').running() as flight:
        px4 = Px4(flight.port, silent=0)
        for _ in range(50):
            px4.exchange([0.9] * 4)
        step = flight.simulation.step_count
        end = time.monotonic() + 3.0
        while time.monotonic() < end and flight.simulation.step_count < step + 100:
            if not px4.nothing_comes(0.02):
                px4.rest += px4.socket.recv(65536)  # it reads, and sends nothing
        assert flight.simulation.step_count >= step + 100
        assert not flight.simulation.data.ctrl.any()
        line = 'PX4: takes its sensors, but sends no outputs (flight termination?)'
        assert len(said(flight, line)) == 1
        assert flight.bridge.status().message == 'PX4 sends no outputs: going on at real time'


@pytest.mark.usefixtures('quick')
def test_rule_continue_puts_thrust_to_rest_and_goes_on():
    with BridgedFlight('x500_ground', 'px4', timeout=0.3).running() as flight:
        px4 = Px4(flight.port, silent=0)
        for _ in range(50):
            px4.exchange([0.9] * 4)
        step = flight.simulation.step_count
        assert waited(lambda: flight.simulation.step_count > step + 20)
        assert not flight.simulation.data.ctrl.any()
        assert said(flight, 'no answer for 0.3 s: thrust to rest, going on at real time')
        px4.rest = b''
        while flight.bridge.status().level != 'ok':
            px4.exchange([0.9] * 4)
        assert said(flight, 'PX4 answers again after')
        assert flight.bridge.counters.missed == 1


@pytest.mark.usefixtures('quick')
def test_rule_continue_goes_on_beyond_what_a_halted_px4_can_be_sent(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.0)
    with BridgedFlight('x500_ground', 'px4', timeout=0.2).running() as flight:
        px4 = Px4(flight.port, silent=0)
        px4.exchange(HOVER)
        assert waited(lambda: flight.bridge._server.stuck, 30.0)
        step = flight.simulation.step_count
        assert waited(lambda: flight.simulation.step_count > step + 1000)


@pytest.mark.usefixtures('quick')
def test_rule_hold_waits_on():
    with BridgedFlight('x500_ground', 'px4', timeout=0.2, on_timeout='hold').running() as flight:
        px4 = Px4(flight.port, silent=0)
        px4.exchange(HOVER)
        assert waited(lambda: said(flight, 'no answer for 0.2 s: still waiting'))
        step = flight.simulation.step_count
        time.sleep(0.2)
        assert flight.simulation.step_count == step
        px4.exchange(HOVER)
        px4.exchange(HOVER)
        assert waited(lambda: flight.simulation.step_count > step)
    assert len(said(flight, 'still waiting')) == 1


@pytest.mark.usefixtures('quick')
@pytest.mark.parametrize('closed', [False, True])
def test_rule_stop_ends_the_run(closed):
    flight = BridgedFlight('x500_ground', 'px4', timeout=0.3, on_timeout='stop')
    thread = threading.Thread(target=flight._run, args=(10**6,))
    thread.start()
    px4 = Px4(flight.port, silent=0)
    px4.exchange(HOVER)
    if closed:
        px4.close()
    thread.join(10.0)
    flight.bridge.close()
    assert isinstance(flight.error, AutopilotError)
    line = 'PX4: gone for 0.3 s: stopped' if closed else 'PX4: no answer for 0.3 s: stopped'
    assert str(flight.error) == line


# ---- what PX4 stamps -----------------------------------------------------------------------


def test_a_fix_is_as_old_as_px4_takes_it_for():
    """EKF2_GPS_DELAY is 10 ms; at 8 m/s each 2 ms more are 16 mm."""
    with BridgedFlight('x500_ground', 'px4').running() as flight:
        px4, places = Px4(flight.port, silent=0), {}
        flight.bridge._state._gnss.errors.apply = lambda index, row: 0  # without noise
        for _ in range(500):
            fields = px4.sensors()
            data = flight.simulation.data  # which stands still until it is answered
            places[fields['time_usec']] = data.qpos[2], data.qvel[2]
            px4.answer(fields['time_usec'], [1.0] * 4)
        gps = px4.latest['HIL_GPS']
    z, speed = places[gps['time_usec']]
    assert speed > 8.0
    assert gps['alt'] / 1000 == pytest.approx(z - 0.010 * speed, abs=0.002)
