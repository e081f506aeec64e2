# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import pytest

from fluid_sim_ros import Simulation
from test.support.small_models import AMPHIBIOUS, TWO_PARTS


@pytest.fixture
def boat(tmp_path):
    path = tmp_path / 'boat.xml'
    path.write_text(TWO_PARTS)
    return Simulation(path)


@pytest.fixture
def buoy(tmp_path):
    path = tmp_path / 'buoy.xml'
    path.write_text(AMPHIBIOUS)
    return Simulation(path)
