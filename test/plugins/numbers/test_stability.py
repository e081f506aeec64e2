# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Energy at every step, over the added-mass ratio; and why the lagged method is not used."""

import itertools

import numpy as np
import pytest

from benchmarks.plugins import plugin_stability as bench
from test.support.plugin_models import FIRST_ORDER


@pytest.mark.parametrize('ratio', [0.0, 0.5, 2.0, 10.0, 100.0])
def test_rk4_keeps_the_energy_for_a_minute(ratio):
    energy = bench.energies(ratio, 'RK4', 0.01, 60.0)
    assert energy.size == 6001
    assert np.abs(energy - 1).max() <= 1e-3


@pytest.mark.parametrize('drag', bench.DRAGS)
@pytest.mark.parametrize('integrator', FIRST_ORDER)
@pytest.mark.parametrize('ratio', [0.5, 10.0, 100.0])
def test_with_drag_the_energy_never_exceeds_the_start(ratio, integrator, drag):
    energy = bench.energies(ratio, integrator, 0.01, 15.0, **bench.DRAGS[drag])
    assert energy.size == 1501
    assert energy.max() <= 1
    assert np.diff(energy).max() <= 0
    assert energy[-1] < 0.05


@pytest.mark.parametrize('ratio', [0.5, 10.0, 100.0])
def test_a_tenth_of_the_damping_is_enough(ratio):
    damping = 0.1 * np.array(bench.DAMPING)
    energy = bench.energies(ratio, 'implicitfast', 0.01, 60.0, quadratic_damping=damping)
    assert energy.max() <= 1


@pytest.mark.parametrize('integrator', FIRST_ORDER)
def test_without_drag_first_order_integrators_gain_energy(integrator):
    run = bench.summary(bench.energies(10.0, integrator, 0.01, 10.0))
    assert 2 < run.doubles_after_s < 5
    assert run.diverged


def test_energy_gain_falls_with_the_timestep():
    """First order: the gain over the same time is in proportion to the timestep."""
    gain = [
        bench.energies(10.0, 'implicitfast', timestep, 0.5)[-1] - 1
        for timestep in (0.001, 0.0005, 0.00025)
    ]
    assert np.log2(np.divide(gain[:-1], gain[1:])) == pytest.approx([1, 1], abs=0.1)


@pytest.mark.parametrize('timestep', bench.LAGGED_STEPS)
def test_the_lagged_method_diverges_above_ratio_one_at_any_timestep(timestep):
    assert bench.lagged_steps(1.62, timestep, 400) < 40
    assert bench.lagged_steps(10.0, timestep, 400) < 10
    assert bench.lagged_steps(0.9, timestep, 400) == 400


def test_below_ratio_one_the_lagged_method_comes_near_the_plugin():
    """It is the same physics, one step late: at a short timestep both agree."""
    lagged = np.fromiter(itertools.islice(bench.lagged(0.5, 1e-4), 2001), dtype=float)
    assert np.abs(lagged[20:] - lagged[20]).max() < 1e-2
    assert lagged[-1] == pytest.approx(1, abs=0.05)
