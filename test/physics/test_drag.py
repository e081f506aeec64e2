# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.drag import (
    angular_drag,
    blunt_slender_drag,
    swept_inertia,
    viscous_resistance,
)
from test.support.printed_formulas import angular_drag_as_printed, blunt_slender_drag_as_printed
from test.support.strategies import CYCLE, FLIPS, axes, floats, vectors

COEF = {'density': 1000.0, 'c_blunt': 0.5, 'c_slender': 0.25}
SPIN = {'density': 1000.0, 'c_angular': 1.5, 'c_slender': 0.25}


def test_sphere_closed_form():
    force = blunt_slender_drag([0.1] * 3, [3.0, 0, 0], **COEF)
    assert force == pytest.approx([-1000 * 0.5 * np.pi * 0.01 * 9, 0, 0], rel=1e-14)
    torque = angular_drag([0.1] * 3, [0, 2.0, 0], **SPIN)
    assert torque == pytest.approx([0, -1000 * 1.5 * 8 * np.pi / 15 * 1e-5 * 4, 0], rel=1e-14)


@pytest.mark.parametrize('area', ['lemma', 'true'])
def test_along_an_axis_both_areas_give_the_engine_formula(area):
    r = np.array([0.3, 0.2, 0.1])
    force = blunt_slender_drag(r, [2.0, 0, 0], area=area, **COEF)
    shadow, largest = np.pi * 0.2 * 0.1, np.pi * 0.3 * 0.2
    expected = -1000 * (0.5 * shadow + 0.25 * (largest - shadow)) * 4
    assert force == pytest.approx([expected, 0, 0], rel=1e-14)


@given(axes(), vectors(), floats(0, 2), floats(0, 2))
def test_drag_dissipates_and_is_odd(r, v, c_blunt, c_slender):
    for area in ('lemma', 'true'):
        kind = {'density': 3.0, 'c_blunt': c_blunt, 'c_slender': c_slender, 'area': area}
        force = blunt_slender_drag(r, v, **kind)
        assert force @ v <= 0
        assert np.array_equal(blunt_slender_drag(r, -v, **kind), -force)


@given(axes(), vectors(), floats(0, 2), floats(0, 2))
def test_angular_drag_dissipates_and_is_odd(r, omega, c_angular, c_slender):
    kind = {'density': 3.0, 'c_angular': c_angular, 'c_slender': c_slender}
    torque = angular_drag(r, omega, **kind)
    assert torque @ omega <= 0
    assert np.array_equal(angular_drag(r, -omega, **kind), -torque)


def test_printed_angular_drag_feeds_energy_in_half_of_the_samples(rng):
    r, omega = rng.uniform(0.1, 1, (4000, 3)), rng.normal(size=(4000, 3))
    power = np.sum(angular_drag_as_printed(r, omega, **SPIN) * omega, axis=-1)
    assert 0.45 < (power > 0).mean() < 0.55
    assert (np.sum(angular_drag(r, omega, **SPIN) * omega, axis=-1) <= 0).all()


def test_printed_maximal_area_differs_and_can_push():
    sphere = [0.1] * 3
    v = np.array([1.0, 0, 0])
    engine, printed = (
        blunt_slender_drag(sphere, v, **COEF),
        blunt_slender_drag_as_printed(sphere, v, **COEF),
    )
    assert printed[0] / engine[0] == pytest.approx(2.5, rel=1e-13)  # (.5 + .25 (4 - 1)) / .5
    slender_only = {'density': 1.0, 'c_blunt': 0.0, 'c_slender': 1.0}
    plate, broadside = [1.0, 1.0, 0.01], np.array([0, 0, 1.0])
    assert blunt_slender_drag_as_printed(plate, broadside, **slender_only)[2] > 0
    assert blunt_slender_drag(plate, broadside, **slender_only)[2] == 0


@given(axes(), vectors())
def test_covariance_under_the_symmetries_of_the_ellipsoid(r, v):
    force, torque = blunt_slender_drag(r, v, **COEF), angular_drag(r, v, **SPIN)
    for flip in FLIPS:
        assert np.array_equal(blunt_slender_drag(r, flip @ v, **COEF), flip @ force)
        assert np.array_equal(angular_drag(r, flip @ v, **SPIN), flip @ torque)
    turned = blunt_slender_drag(CYCLE @ r, CYCLE @ v, **COEF)
    assert turned == pytest.approx(CYCLE @ force, rel=1e-12)
    assert angular_drag(CYCLE @ r, CYCLE @ v, **SPIN) == pytest.approx(CYCLE @ torque, rel=1e-12)


@given(axes())
def test_largest_swept_inertia_is_the_engine_expression(r):
    low, mid, high = np.sort(r)
    assert swept_inertia(r).max() == pytest.approx(8 * np.pi / 15 * mid * high**4, rel=1e-13)
    assert low <= mid


def test_slender_coefficient_dominates_the_spin_of_a_needle():
    needle, spin = [1.0, 0.03, 0.03], [1.0, 0, 0]
    with_slender = angular_drag(needle, spin, **SPIN)[0]
    without = angular_drag(needle, spin, density=1000.0, c_angular=1.5, c_slender=0.0)[0]
    assert with_slender / without > 1000


def test_viscous_closed_form():
    force, torque = viscous_resistance([1.0, 2.0, 3.0], [1.0, 0, 0], [0, 1.0, 0], 0.1)
    assert force == pytest.approx([-6 * np.pi * 2 * 0.1, 0, 0], rel=1e-15)
    assert torque == pytest.approx([0, -8 * np.pi * 8 * 0.1, 0], rel=1e-15)


def test_unknown_area_is_refused():
    with pytest.raises(ConfigError, match="'lemma', 'true'"):
        blunt_slender_drag([1.0] * 3, np.zeros(3), area='shadow', **COEF)
