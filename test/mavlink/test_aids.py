# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What vehicles have besides: distance, optical flow, radio control, battery."""

import math

import numpy as np
import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.resources import config_folder
from test.support.autopilots.ardupilot_stand_in import Copter, Link, padded
from test.support.autopilots.autopilot_peers import BridgedFlight
from test.support.autopilots.px4_pilots import Quad
from test.support.autopilots.px4_stand_in import Px4

IDLE = padded([1000] * 4)


def fly_px4(flight, exchanges, target):
    px4, quad, controls = Px4(flight.port, silent=0), Quad(target, hover=0.77), [0.0] * 4
    flows, data = [], flight.simulation.data
    for _ in range(exchanges):
        px4.latest.pop('HIL_OPTICAL_FLOW', None)
        controls = quad.controls(px4, px4.exchange(controls))
        if 'HIL_OPTICAL_FLOW' in px4.latest:  # with the true velocity to the east and north
            flows.append(px4.latest['HIL_OPTICAL_FLOW'] | {'true': data.qvel[:2] / data.qpos[2]})
    return px4, flows


def with_flow(folder, vehicle):
    path = folder / 'px4.yaml'
    shipped = (config_folder() / 'autopilots' / f'px4_{vehicle}.yaml').read_text()
    path.write_text(shipped + 'optical_flow: true\n')
    return str(path)


def test_px4_gets_the_distance_to_the_ground():
    with BridgedFlight('x500_ground', 'px4').running() as flight:
        px4, _ = fly_px4(flight, 1500, (0.0, 0.0, -3.0))
        height = flight.simulation.data.qpos[2]
    sensor = px4.latest['DISTANCE_SENSOR']
    assert px4.counts['DISTANCE_SENSOR'] == 300
    assert (sensor['min_distance'], sensor['max_distance']) == (10, 1200)
    assert (sensor['orientation'], sensor['signal_quality']) == (25, 100)
    assert sensor['current_distance'] == pytest.approx(100 * height, abs=15)


def test_an_echo_that_is_too_far_has_no_quality():
    flight = BridgedFlight('x500_ground', 'px4')
    flight.simulation.data.qpos[2] = 40.0
    with flight.running():
        px4, _ = fly_px4(flight, 20, (0.0, 0.0, -40.0))
    sensor = px4.latest['DISTANCE_SENSOR']
    assert (sensor['current_distance'], sensor['signal_quality']) == (1201, 1)


def test_optical_flow_is_turn_and_velocity_by_distance(tmp_path):
    mapping = with_flow(tmp_path, 'x500')
    with BridgedFlight('x500_ground', 'px4', mapping=mapping).running() as flight:
        _, flows = fly_px4(flight, 1250, (6.0, 4.0, -3.0))
    seen = [flow for flow in flows if flow['quality'] == 255][-60:]
    assert len(seen) == 60
    duration = sum(flow['integration_time_us'] for flow in seen) * 1e-6
    assert duration == pytest.approx(60 * 0.02)
    # to the north and east with the nose to the east: ahead and to the left
    ahead = sum(f['integrated_y'] - f['integrated_ygyro'] for f in seen) / duration
    right = -sum(f['integrated_x'] - f['integrated_xgyro'] for f in seen) / duration
    east, north = np.mean([flow['true'] for flow in seen], axis=0)
    assert min(east, north) > 0.05
    assert [ahead, -right] == pytest.approx([east, north], abs=0.02)


def test_flow_needs_a_rangefinder(tmp_path):
    with pytest.raises(ConfigError, match="vehicle 'aerosonde' has no rangefinder"):
        BridgedFlight('aerosonde_ground', 'px4', mapping=with_flow(tmp_path, 'aerosonde'))


def test_ardupilot_gets_distance_wind_and_battery():
    with BridgedFlight('x500_ground', 'ardupilot').running() as flight:
        link, copter = Link(flight.port), Copter((0.0, 0.0, -3.0), hover=0.77)
        full = link.exchange(IDLE)
        flight.simulation.set_wind((2.0, 0.0, 0.0))
        state = full
        for _ in range(2000):
            state = link.exchange(copter.pulses(state))
    assert state['rng_1'][0] == pytest.approx(3.0, abs=0.15)
    assert abs(state['direction'][0]) == pytest.approx(math.pi, abs=0.2)  # from behind
    assert state['speed'][0] == pytest.approx(2.0, abs=0.5)
    assert full['voltage'][0] == pytest.approx(16.8, abs=0.02)
    # 18 min of hover with 5 Ah
    assert state['current'][0] == pytest.approx(5 * 60 / 18, rel=0.1)
    assert 16.2 < state['voltage'][0] < 16.5


def test_a_battery_runs_down_to_empty():
    file, _ = load_mapping('ardupilot', 'bluerov2')
    battery = Battery(file.battery, [50.0] * 6)
    assert (battery.voltage, battery.current) == (16.8, 1.5)
    voltages = []
    for _ in range(3600):
        battery.draw([50.0] * 6, 1.0)
        voltages.append(battery.voltage)
    assert battery.current == 145.5
    assert np.all(np.diff(voltages) <= 0)
    assert voltages[-1] == pytest.approx(13.2 - 0.02 * 145.5)
    battery.draw([-50.0] + [0.0] * 5, 1.0)  # backwards it draws as much
    assert battery.current == pytest.approx(1.5 + 144 / 6)


def test_ardupilot_gets_sticks_by_the_json():
    with BridgedFlight('x500_ground', 'ardupilot', sticks_timeout=0.0).running() as flight:
        link = Link(flight.port)
        assert 'rc_1' not in link.exchange(IDLE)
        flight.bridge.set_sticks([0.5, -1.0, 0.0, 0.1], [1, 0])
        link.exchange(IDLE)
        state = link.exchange(IDLE)
    assert [state[f'rc_{i}'] for i in range(1, 7)] == [
        [1750], [1000], [1500], [1550], [2000], [1000]
    ]  # fmt: skip
    assert 'rc_7' not in state
