# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import pytest

from test.support.autopilots.ardupilot_stand_in import (
    Link,
)
from test.support.autopilots.autopilot_peers import BridgedFlight


@pytest.fixture
def flight():
    with BridgedFlight('x500_ground', 'ardupilot').running() as flight:
        yield flight


@pytest.fixture
def link(flight):
    link = Link(flight.port)
    yield link
    link.close()
