# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The fish swims by its caudal fin, as fish do; its forces and powers balance."""

import mujoco
import numpy as np
import pytest

from benchmarks.vehicles.fish import STROUHAL, swim
from fluid_sim_ros import Simulation
from test.support.plugin_models import kinetic_energy

#: Drag along the body [N s^2/m^2]: the links' first quadratic coefficients, models/fish.xml.
ALONG = 0.145 + 0.0471 + 0.0242


@pytest.fixture(scope='module')
def swum():
    return swim(2.0)


def test_it_swims_straight_and_at_its_depth(swum):
    assert swum['lengths_per_s'] == pytest.approx(2.1, abs=0.1)  # as doc/vehicles/fish.md states
    assert abs(swum['climb']) < 0.01 * swum['speed']
    assert 0.9 * STROUHAL[0] < swum['strouhal'] < STROUHAL[1]


def test_the_thrust_of_the_fin_is_the_drag_of_the_body(swum):
    # a little more: the drag of the keels, and of the links' sway
    ratio = swum['thrust'] / (ALONG * swum['speed'] ** 2)
    assert 0.97 < ratio < 1.2


def test_its_servos_give_more_than_the_thrust_takes(swum):
    assert 0.5 < swum['efficiency'] < 0.85  # flapping foils: up to 0.87 (Anderson et al. 1998)


def test_without_servos_it_only_loses_energy():
    """Body and water together, from a bent body in motion: no term may feed it."""
    simulation = Simulation('fish')
    model, data = simulation.model, simulation.data
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    model.opt.gravity[:] = 0
    data.qpos[7:], data.qvel[0] = (0.2, -0.3, 0.1), 0.8
    energies = []
    for _ in range(100):
        mujoco.mj_step(model, data, 5)
        energies.append(kinetic_energy(model, data).sum())
    assert np.diff(energies).max() < 1e-3 * energies[0]
    assert energies[-1] < 0.9 * energies[0]
