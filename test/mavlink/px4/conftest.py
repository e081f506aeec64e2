# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import pytest

from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from test.support.autopilots.autopilot_peers import BridgedFlight
from test.support.autopilots.px4_stand_in import Px4


@pytest.fixture(autouse=True)
def patient(monkeypatch):
    """Give the stand-in time for its first answer, as this host may be busy."""
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 1.0)


@pytest.fixture
def flight():
    with BridgedFlight('x500_ground', 'px4').running() as flight:
        yield flight


@pytest.fixture
def px4(flight):
    px4 = Px4(flight.port, silent=0)
    yield px4
    px4.close()
