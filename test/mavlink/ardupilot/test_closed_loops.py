# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A stand-in for ArduPilot flies, over real sockets."""

import math

import pytest

from fluid_sim_ros.mavlink.mapping import load_mapping
from test.support.autopilots.ardupilot_stand_in import (
    VECTORED,
    VECTORED_6DOF,
    Copter,
    DepthSensor,
    Link,
    Plane,
    Submarine,
    padded,
)
from test.support.autopilots.autopilot_peers import BridgedFlight

IDLE = padded([1000] * 4)


def test_a_copter_takes_off_and_holds_its_place(flight, link):
    copter = Copter((2.0, 1.0, -3.0), hover=0.77)
    state = link.exchange(IDLE)
    for _ in range(4000):
        state = link.exchange(copter.pulses(state))
    assert state['position'] == pytest.approx([2.0, 1.0, -3.0], abs=0.03)
    assert [math.degrees(a) for a in state['attitude']] == pytest.approx([0, 0, 90], abs=0.5)


def test_an_aircraft_waits_on_its_wheels_and_takes_off():
    with BridgedFlight('aerosonde_ground', 'ardupilot').running() as flight:
        link, plane = Link(flight.port), Plane()
        flight.simulation.set_wind((-5.0, 0.0, 0.0))  # ahead
        for _ in range(4000):  # before ArduPlane is armed it sends its least throttle
            state = link.exchange(padded([1500, 1500, 1100, 1500]))
        assert state['position'] == pytest.approx([0, 0, -0.4145], abs=3e-3)
        flight.simulation.set_wind((0.0, 0.0, 0.0))
        for _ in range(4800):
            state = link.exchange(plane.pulses(state))
        north, east, down = state['position']
        assert flight.simulation.data.ctrl[0] == pytest.approx(88.07, rel=1e-3)  # full thrust
        assert down < -30.0
        assert east > 200.0
        assert abs(north) < 20.0


@pytest.mark.parametrize(
    ('scene', 'factors'), [('bluerov2', VECTORED), ('bluerov2_heavy', VECTORED_6DOF)]
)
def test_a_submarine_dives_turns_and_goes_ahead(scene, factors):
    yaw = math.pi / 2 + 0.5
    with BridgedFlight(scene, 'ardupilot').running() as flight:
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


@pytest.mark.parametrize('vehicle', ['bluerov2', 'bluerov2_heavy'])
def test_from_the_surface_a_submarine_holds_its_depth(vehicle):
    file, _ = load_mapping('ardupilot', vehicle)
    sensor = DepthSensor(file.parameters['SIM_BARO_RND'].value)
    factors = VECTORED if vehicle == 'bluerov2' else VECTORED_6DOF
    with BridgedFlight(f'{vehicle}_surface', 'ardupilot').running() as flight:
        link, submarine = Link(flight.port), Submarine(factors, 3.0, math.pi / 2)
        state, depths = link.exchange(padded([1500] * 8)), []
        assert abs(state['position'][2]) < 0.1
        for _ in range(8000):
            depths.append(state['position'][2])
            state['position'][2] = sensor.read(depths[-1])
            state = link.exchange(submarine.pulses(state))
    assert depths[4000:] == pytest.approx([3.0] * 4000, abs=0.3)


def test_from_5_m_and_with_the_default_noise_it_rises():
    sensor = DepthSensor(0.2)
    with BridgedFlight('bluerov2', 'ardupilot').running() as flight:
        link = Link(flight.port)
        state = link.exchange(padded([1500] * 8))
        submarine = Submarine(VECTORED, 0.0, math.pi / 2)  # it holds what it takes for its depth
        for _ in range(8000):
            down = state['position'][2]
            state['position'][2] = sensor.read(down)
            state = link.exchange(submarine.pulses(state))
    assert down < 3.0
