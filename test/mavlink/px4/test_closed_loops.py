# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A stand-in for PX4 flies, over real sockets."""

import math

import numpy as np
import pytest

from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from test.support.autopilots.autopilot_peers import BridgedFlight
from test.support.autopilots.px4_pilots import Plane, Quad, Submarine
from test.support.autopilots.px4_plane import FixedWing
from test.support.autopilots.px4_stand_in import Px4

IDLE = [0.0] * 4


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
    with BridgedFlight('aerosonde_ground', 'px4').running() as flight:
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


def highest_and_lowest(parameters, monkeypatch, seconds=40):
    """Take off and loiter; return height after 15 s, deepest dip, last height [m]."""
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    with BridgedFlight('aerosonde_ground', 'px4').running() as flight:
        px4, plane = Px4(flight.port, silent=15), FixedWing(parameters)
        controls, heights = [0.0] * 16, []
        for _ in range(250 * seconds):
            controls = plane.controls(px4, px4.exchange(controls))
            heights.append(flight.simulation.data.qpos[2] - 0.4145)
    dips = np.maximum.accumulate(heights) - heights
    return heights[3749], dips.max(), heights[-1]


def test_with_the_shipped_parameters_it_climbs_and_loiters_without_a_dip(monkeypatch):
    file, _ = load_mapping('px4', 'aerosonde')
    parameters = {name: entry.value for name, entry in file.parameters.items()}
    early, dip, last = highest_and_lowest(parameters, monkeypatch)
    assert early > 20.0
    assert dip < 0.2
    assert last == pytest.approx(30.0, abs=1.0)


def test_with_those_of_the_airframe_it_does_not_get_off_the_ground(monkeypatch):
    early, _, _ = highest_and_lowest({}, monkeypatch, seconds=15)
    assert early < 0.1


def test_a_submarine_dives_turns_and_goes_ahead(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    with BridgedFlight('bluerov2_heavy', 'px4').running() as flight:
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
