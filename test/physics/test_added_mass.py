# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.added_mass import (
    accelerating_flow_wrench,
    added_mass_coriolis,
    added_mass_wrench,
    ellipsoid_added_mass_wrench,
    momentum,
    relative_acceleration,
)
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from fluid_sim_ros.physics.matrix6 import (
    added_mass_matrix,
    frd_to_flu_matrix,
    matrix6,
    rotate_matrix6,
    shift_reference_point,
)
from test.support.strategies import positive_matrix, rotation, seeds, vectors


def test_order_of_6_21_and_36_numbers():
    assert np.array_equal(matrix6(range(1, 7), 'a'), np.diag(range(1, 7)))
    full = matrix6(range(36), 'a')
    assert full[1, 2] == 8
    upper = matrix6(range(21), 'a')
    assert upper[0].tolist() == [0, 1, 2, 3, 4, 5]
    assert upper[1].tolist() == [1, 6, 7, 8, 9, 10] and upper[5, 5] == 20
    assert np.array_equal(upper, upper.T)


@given(seeds())
def test_21_numbers_are_the_upper_triangle_of_36(seed):
    a = positive_matrix(seed)
    assert np.array_equal(added_mass_matrix(a[np.triu_indices(6)]), added_mass_matrix(a))


@pytest.mark.parametrize(
    ('values', 'message'),
    [
        (range(7), '6, 21 or 36'),
        ([1, 1, np.nan, 1, 1, 1], 'finite'),
        ([1, 1, -1, 1, 1, 1], 'eigenvalue'),
        (np.eye(6) + np.eye(6, k=1), 'symmetric'),
        (np.eye(6) + 2 * (np.eye(6, k=3) + np.eye(6, k=-3)), 'eigenvalue'),
    ],
)
def test_bad_matrices_are_refused(values, message):
    with pytest.raises(ConfigError, match=message) as error:
        added_mass_matrix(values, "body 'hull' added_mass")
    assert str(error.value).startswith("body 'hull' added_mass: ")


def test_massless_is_allowed():
    assert not added_mass_matrix(np.zeros(6)).any()


@given(seeds(), vectors(), vectors())
def test_coriolis_does_no_work(seed, v, omega):
    a = positive_matrix(seed)
    force, torque = added_mass_coriolis(a, v, omega)
    size = np.linalg.norm(a) * (v @ v + omega @ omega) ** 1.5
    assert abs(force @ v + torque @ omega) <= 1e-14 * size


@given(seeds(), vectors(), vectors())
def test_coriolis_matrix_of_fossen(seed, v, omega):
    # Fossen (2021), ch. 6: C = [[0, -S(p)], [-S(p), -S(l)]], the wrench is -C nu.
    a = positive_matrix(seed)
    p, ang = momentum(a, v, omega)
    force, torque = added_mass_coriolis(a, v, omega)
    assert force == pytest.approx(np.cross(p, omega), rel=1e-12)
    expected = np.cross(p, v) + np.cross(ang, omega)
    assert torque == pytest.approx(expected, rel=1e-12)


@given(seeds(), vectors(), vectors(), vectors(), vectors())
def test_diagonal_matrix_is_the_ellipsoid_form(seed, v, omega, v_dot, omega_dot):
    diagonal = np.random.default_rng(seed).uniform(0.1, 5, 6)
    full = added_mass_wrench(np.diag(diagonal), v, omega, v_dot, omega_dot)
    compact = ellipsoid_added_mass_wrench(diagonal[:3], diagonal[3:], v, omega, v_dot, omega_dot)
    for a, b in zip(full, compact, strict=True):
        assert a == pytest.approx(b, rel=1e-12, abs=1e-10)


@given(seeds(), vectors(2), vectors(), vectors(), vectors(), vectors())
def test_shift_of_reference_point_keeps_energy_and_wrench(
    seed, offset, v, omega, v_dot, omega_dot
):
    a = positive_matrix(seed)
    shifted = shift_reference_point(a, offset)
    # The same motion seen at the new point: v' = v + w x offset, components in the same axes.
    v_new, v_dot_new = v + np.cross(omega, offset), v_dot + np.cross(omega_dot, offset)
    nu, nu_new = np.r_[v, omega], np.r_[v_new, omega]
    energy = nu @ a @ nu
    assert nu_new @ shifted @ nu_new == pytest.approx(energy, rel=1e-11, abs=1e-11)
    force, torque = added_mass_wrench(a, v, omega, v_dot, omega_dot)
    force_new, torque_new = added_mass_wrench(shifted, v_new, omega, v_dot_new, omega_dot)
    assert force_new == pytest.approx(force, rel=1e-9, abs=1e-8)
    assert torque_new == pytest.approx(torque - np.cross(offset, force), rel=1e-9, abs=1e-8)


def test_shift_and_back(rng):
    a, offset = positive_matrix(1), rng.normal(size=3)
    back = shift_reference_point(shift_reference_point(a, offset), -offset)
    assert back == pytest.approx(a, rel=1e-12)


def test_shift_of_a_point_mass_is_steiner():
    a = np.diag([2.0, 2, 2, 0, 0, 0])
    shifted = shift_reference_point(a, [0.0, 0.0, 3.0])
    assert np.diag(shifted) == pytest.approx([2, 2, 2, 18, 18, 0])
    # Seen from 3 m above: pitching (about +y) at 1 rad/s moves the mass along -x.
    assert momentum(shifted, np.zeros(3), [0, 1.0, 0])[0] == pytest.approx([-6.0, 0, 0])


@given(seeds(), seeds(), vectors(), vectors())
def test_rotation_covariance(seed, turn, v, omega):
    a, r = positive_matrix(seed), rotation(turn)
    here = added_mass_coriolis(a, v, omega)
    there = added_mass_coriolis(rotate_matrix6(a, r), r @ v, r @ omega)
    for x, y in zip(here, there, strict=True):
        assert y == pytest.approx(r @ x, rel=1e-9, abs=1e-9)


@given(seeds(), vectors(), vectors())
def test_frd_and_flu_give_the_same_physics(seed, v_flu, omega_flu):
    a_frd = positive_matrix(seed)
    flip = np.array([1.0, -1.0, -1.0])
    frd = added_mass_coriolis(a_frd, flip * v_flu, flip * omega_flu)
    flu = added_mass_coriolis(frd_to_flu_matrix(a_frd), v_flu, omega_flu)
    for x, y in zip(frd, flu, strict=True):
        assert y == pytest.approx(flip * x, rel=1e-12, abs=1e-12)
    assert np.array_equal(frd_to_flu_matrix(frd_to_flu_matrix(a_frd)), a_frd)


def test_signs_of_frd_coupling():
    # REMUS-like sway-yaw coupling (rows y and yaw) keeps its sign, surge-pitch changes it.
    a = np.eye(6) * 10
    a[1, 5] = a[5, 1] = -1.93
    a[0, 4] = a[4, 0] = 0.7
    flu = frd_to_flu_matrix(a)
    assert flu[1, 5] == -1.93 and flu[0, 4] == -0.7
    assert np.array_equal(np.diag(flu), np.diag(a))


def test_relative_acceleration_by_differences():
    # A point on a circle in a steadily accelerating flow, body turning with it.
    rate, radius, du = 1.3, 2.0, np.array([0.2, -0.1, 0.4])

    def v_rel_b(t):
        c, s = np.cos(rate * t), np.sin(rate * t)
        rot = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
        return rot.T @ (radius * rate * np.array([-s, c, 0]) - du * t), rot

    t, h = 0.7, 1e-5
    v, rot = v_rel_b(t)
    accel_w = -radius * rate**2 * np.array([np.cos(rate * t), np.sin(rate * t), 0])
    ours = relative_acceleration(rot.T @ accel_w, v, [0, 0, rate], rot.T @ du)
    difference = (v_rel_b(t + h)[0] - v_rel_b(t - h)[0]) / (2 * h)
    assert ours == pytest.approx(difference, abs=1e-8)


def test_neutral_body_goes_with_an_accelerating_flow():
    # m a = (rho V + A) du - A a: a = du for m = rho V, whatever A is.
    r, rho, du = [0.3, 0.2, 0.1], 1000.0, np.array([0.5, -0.2, 0.1])
    displaced = float(rho * ellipsoid_volume(r))
    a = np.diag(np.r_[ellipsoid_added_mass(r, rho)])
    force, torque = accelerating_flow_wrench(a, displaced, np.zeros(3), du)
    acceleration = np.linalg.solve(displaced * np.eye(3) + a[:3, :3], force)
    assert acceleration == pytest.approx(du, rel=1e-14)
    assert not torque.any()
    # A heavy sphere lags, a bubble runs ahead by a factor of three.
    sphere = np.diag(np.r_[ellipsoid_added_mass([0.1] * 3, rho)])
    displaced = float(rho * ellipsoid_volume([0.1] * 3))
    force = accelerating_flow_wrench(sphere, displaced, np.zeros(3), du)[0]
    assert force / np.diag(sphere)[:3] == pytest.approx(3 * du, rel=1e-13)


def test_pressure_gradient_acts_at_the_centre_of_volume():
    force, torque = accelerating_flow_wrench(np.zeros((6, 6)), 2.0, [0, 0, 1.0], [3.0, 0, 0])
    assert force == pytest.approx([6.0, 0, 0]) and torque == pytest.approx([0, 6.0, 0])


def test_batch(rng):
    a = np.stack([positive_matrix(s) for s in range(4)])
    v, omega = rng.normal(size=(4, 3)), rng.normal(size=(4, 3))
    force, torque = added_mass_coriolis(a, v, omega)
    one = added_mass_coriolis(a[2], v[2], omega[2])
    assert force[2] == pytest.approx(one[0]) and torque[2] == pytest.approx(one[1])
    assert shift_reference_point(a, v)[3] == pytest.approx(shift_reference_point(a[3], v[3]))
