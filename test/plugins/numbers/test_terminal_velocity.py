# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Spheres settle to the speed of our formula, near that of the standard drag curve."""

import numpy as np
import pytest

from benchmarks.plugins import plugin_terminal_velocity as bench


@pytest.fixture(scope='module')
def result():
    return bench.measure(np.geomspace(0.1, 1e5, 13))


@pytest.mark.parametrize('integrator', bench.INTEGRATORS)
def test_own_formula_and_standard_curve(result, integrator):
    assert result[integrator]['error_own_max'] <= bench.OWN_BOUND
    assert result[integrator]['error_standard_max'] <= bench.STANDARD_BOUND


def test_constant_coefficients_are_far_off(result):
    """Or the curve would not be worth having."""
    assert result['stock']['error_standard_max'] > 0.3


def test_known_points_of_the_standard_curve():
    # Morsi and Alexander (1972), J. Fluid Mech. 55:193: measured points
    curve = bench.standard_curve()
    for reynolds, drag in ((0.1, 240), (1, 26.5), (10, 4.1), (100, 1.07), (1000, 0.46)):
        assert curve(reynolds) == pytest.approx(drag, rel=0.06)


def test_terminal_speed_in_the_two_limits():
    """24/Re gives Stokes' speed, a constant Cd the quadratic one."""
    stokes = bench.terminal_speed(lambda re: 24 / re, 20.0)
    assert stokes == pytest.approx(bench.WEIGHT / (6 * np.pi * 20.0 * bench.RADIUS), rel=1e-12)
    quadratic = bench.terminal_speed(lambda re: 0.44, 0.01)
    area = np.pi * bench.RADIUS**2
    expected = np.sqrt(2 * bench.WEIGHT / (0.44 * bench.WATER * area))
    assert quadratic == pytest.approx(expected, rel=1e-12)
