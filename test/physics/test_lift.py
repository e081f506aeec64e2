# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from fluid_sim_ros.physics.lift import kutta_force, magnus_force
from test.support.printed_formulas import kutta_force_as_printed
from test.support.strategies import CYCLE, FLIPS, axes, floats, vectors

ONE = {'density': 1.0, 'c_kutta': 1.0}


def test_magnus_closed_form_and_sign():
    # Top spin (about +y, moving along +x) pushes a ball down.
    force = magnus_force([0.1] * 3, [2.0, 0, 0], [0, 5.0, 0], density=1.2, c_magnus=1.0)
    assert force == pytest.approx([0, 0, -1.2 * 4 / 3 * np.pi * 1e-3 * 10], rel=1e-14)


@given(axes(), vectors(), vectors())
def test_lift_is_normal_to_the_velocity_and_odd(r, v, omega):
    magnus = magnus_force(r, v, omega, density=2.0, c_magnus=1.0)
    kutta = kutta_force(r, v, **ONE)
    volume_scale = 2 * ellipsoid_volume(r) * np.linalg.norm(v) * np.linalg.norm(omega)
    area_scale = np.pi * r.max() ** 2 * (v @ v)
    assert abs(magnus @ v) <= 1e-14 * volume_scale * np.linalg.norm(v)
    assert abs(kutta @ v) <= 1e-14 * area_scale * np.linalg.norm(v)
    assert np.array_equal(magnus_force(r, -v, omega, density=2.0, c_magnus=1.0), -magnus)
    assert np.array_equal(magnus_force(r, v, -omega, density=2.0, c_magnus=1.0), -magnus)
    assert np.array_equal(kutta_force(r, -v, **ONE), -kutta)


def test_net_spin_force_of_a_sphere_is_magnus_less_half():
    # The convective added mass of a sphere is 1/2 rho V v x w: it takes 0.5 off the coefficient.
    r, v, omega = [0.1] * 3, np.array([1.0, 2, 3]), np.array([-2.0, 1, 0.5])
    mass = ellipsoid_added_mass(r, 1.0)[0]
    total = magnus_force(r, v, omega, density=1.0, c_magnus=1.0) + np.cross(mass * v, omega)
    assert total == pytest.approx(0.5 * ellipsoid_volume(r) * np.cross(omega, v), rel=1e-12)


@given(axes(), vectors())
def test_both_forms_of_the_kutta_force(r, v):
    direct, decomposed = kutta_force(r, v, **ONE), kutta_force_as_printed(r, v, **ONE)
    scale = np.pi * r.max() ** 2 * (v @ v) + 1e-300
    assert np.abs(direct - decomposed).max() <= 1e-13 * scale


@given(floats(-np.pi, np.pi))
def test_thin_plate_lift_is_the_sine_of_twice_the_angle(alpha):
    # C_L = 2 F / (rho A v^2), A = pi r^2: 2 sin a cos a = sin 2a for no thickness.
    r, v = np.array([1.0, 1.0, 1e-5]), np.array([np.cos(alpha), 0, np.sin(alpha)])
    lift = kutta_force(r, v, **ONE) @ [-np.sin(alpha), 0, np.cos(alpha)]
    # Moving nose-down of the plate (v_z > 0) the plate meets the flow from above: lift is down.
    assert lift == pytest.approx(-0.5 * np.pi * np.sin(2 * alpha), abs=1e-4)


@given(floats(0.01, 10), vectors())
def test_sphere_has_no_kutta_lift(radius, v):
    scale = radius**2 * (v @ v) + 1e-300
    assert np.abs(kutta_force([radius] * 3, v, **ONE)).max() <= 1e-14 * scale


@given(axes(), vectors())
def test_covariance_under_the_symmetries_of_the_ellipsoid(r, v):
    force = kutta_force(r, v, **ONE)
    tolerance = 1e-13 * (np.pi * r.max() ** 2 * (v @ v) + 1e-300)
    for flip in FLIPS:
        assert kutta_force(r, flip @ v, **ONE) == pytest.approx(flip @ force, abs=tolerance)
    assert kutta_force(CYCLE @ r, CYCLE @ v, **ONE) == pytest.approx(CYCLE @ force, abs=tolerance)


def test_small_bodies_keep_their_coefficient():
    # Engine versions before 3.14 lost the Kutta force of bodies of centimetres.
    v = np.array([1.0, 0.0, 0.5])
    large = kutta_force([1.0, 0.5, 0.1], v, **ONE)
    for scale in (1e-2, 1e-4, 1e-6):
        small = kutta_force(scale * np.array([1.0, 0.5, 0.1]), v, **ONE)
        assert small / scale**2 == pytest.approx(large, rel=1e-12)


@given(floats(1e-6, 1e3))
def test_kutta_scales_with_the_square_of_speed(speed):
    direction = np.array([0.6, 0.0, 0.8])
    force = kutta_force([0.5, 0.2, 0.1], speed * direction, **ONE)
    one = kutta_force([0.5, 0.2, 0.1], direction, **ONE)
    assert force == pytest.approx(speed**2 * one, rel=1e-12)


def test_rest_has_no_lift():
    assert not kutta_force([1.0, 2, 3], np.zeros(3), **ONE).any()
    zero = np.zeros(3)
    assert not magnus_force([1.0, 2, 3], zero, zero, density=1.0, c_magnus=1.0).any()
