# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from scipy.optimize import brentq

from fluid_sim_ros.physics.drag import viscous_resistance
from fluid_sim_ros.physics.reynolds import (
    blunt_coefficient,
    blunt_drag_factor,
    reynolds_drag,
    reynolds_number,
    sphere_cd_brown_lawler,
)
from test.support.strategies import axes, floats, vectors

STANDARD = np.genfromtxt(
    Path(__file__).parent / 'data' / 'sphere_cd_standard.csv', delimiter=',', skip_header=3
)
# Morsi and Alexander (1972), J. Fluid Mech. 55:193: measured points.
MORSI = {0.1: 240, 0.5: 49, 1: 26.5, 5: 6.9, 10: 4.1, 50: 1.5, 100: 1.07, 500: 0.55, 1e3: 0.46}


def sphere_force(speed, radius, density, viscosity):
    """Return the whole resistance of a sphere, drag plus Stokes."""
    r, v = [radius] * 3, np.array([speed, 0.0, 0.0])
    drag = reynolds_drag(r, v, density=density, viscosity=viscosity)
    return -float((drag + viscous_resistance(r, v, np.zeros(3), viscosity)[0])[0])


@given(floats(-1, 5))
def test_sphere_has_the_curve_without_counting_stokes_twice(log_re):
    re, radius, rho, beta = 10**log_re, 0.05, 1000.0, 1e-3
    speed = re * beta / (rho * 2 * radius)
    cd = sphere_force(speed, radius, rho, beta) / (0.5 * rho * np.pi * radius**2 * speed**2)
    assert cd == pytest.approx(float(sphere_cd_brown_lawler(re)), rel=1e-12)
    assert reynolds_number(speed, 2 * radius, rho, beta) == pytest.approx(re, rel=1e-13)


def test_curve_against_the_standard_curve():
    re, cd = STANDARD.T
    error = np.abs(sphere_cd_brown_lawler(re) / cd - 1)
    assert len(re) > 70
    assert error[(re >= 0.1) & (re <= 5.1e4)].max() < 0.053
    assert error[(re >= 0.1) & (re <= 1.01e5)].max() < 0.072


@pytest.mark.parametrize('re', MORSI)
def test_curve_against_measured_points(re):
    assert sphere_cd_brown_lawler(re) == pytest.approx(MORSI[re], rel=0.075)


def test_terminal_speed_within_four_percent_of_the_standard_curve():
    # At the weight that the standard curve carries at Re, ours settles at a speed 4 % near it.
    radius, rho, beta = 0.01, 1000.0, 1e-3
    worst = 0.0
    for re, cd in STANDARD:
        if not 0.1 <= re <= 1e5 * (1 + 1e-9):
            continue
        speed = re * beta / (rho * 2 * radius)
        weight = 0.5 * rho * np.pi * radius**2 * cd * speed**2
        ours = brentq(
            lambda v, w=weight: sphere_force(v, radius, rho, beta) - w, 0, 10 * speed, xtol=1e-14
        )
        worst = max(worst, abs(ours / speed - 1))
    assert worst < 0.04


@given(floats(1e-3, 1e6))
def test_coefficient_and_factor_agree(re):
    radius, rho, beta = 0.1, 2.0, 0.3
    speed = re * beta / (rho * 2 * radius)
    expected = rho * speed * blunt_coefficient(re)
    assert blunt_drag_factor(speed, radius, rho, beta) == pytest.approx(float(expected), rel=1e-12)


@given(axes(), vectors(), floats(0, 1))
def test_dissipates_and_is_odd(r, v, beta):
    for area in ('lemma', 'true'):
        kind = {'density': 1000.0, 'viscosity': beta, 'area': area}
        force = reynolds_drag(r, v, **kind)
        assert force @ v <= 0
        assert np.array_equal(reynolds_drag(r, -v, **kind), -force)


@pytest.mark.parametrize('beta', [0.0, 1e-3])
@pytest.mark.parametrize('rho', [0.0, 1000.0])
def test_rest_and_missing_medium_give_zero_not_nan(rho, beta):
    assert not reynolds_drag([0.1] * 3, np.zeros(3), density=rho, viscosity=beta).any()
    force = reynolds_drag([0.1] * 3, [1e-200, 0, 0], density=rho, viscosity=beta)
    assert np.isfinite(force).all()


def test_inviscid_limit_is_the_plateau():
    force = reynolds_drag([0.1] * 3, [2.0, 0, 0], density=1000.0, viscosity=0.0)
    assert -force[0] == pytest.approx(0.5 * 0.407 * 1000 * np.pi * 0.01 * 4, rel=1e-14)
