# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from fluid_sim_ros.physics.kirchhoff import (
    impulses,
    kinetic_energy,
    kirchhoff_rhs,
    rigid_body_matrix,
    rotation_wb,
)
from fluid_sim_ros.physics.matrix6 import rotate_matrix6, shift_reference_point
from test.support.strategies import positive_matrix, rotation

START = np.array([0.3, -0.2, 0.1, 0.8, 0.2, -0.4, 0.4, 1.0, 0.5, 0.3, 1.0, 2.0, 1.5])
START[3:7] /= np.linalg.norm(START[3:7])


def run(matrix, start=START, duration=2.0, flow=(0.0, 0, 0), wrench=None, rtol=1e-12):
    return solve_ivp(
        kirchhoff_rhs,
        (0, duration),
        start,
        args=(matrix, flow, wrench),
        method='DOP853',
        rtol=rtol,
        atol=1e-13,
    ).y[:, -1]


def ellipsoid_matrix(axes=(0.5, 0.2, 0.1), rho=1000.0):
    axes = np.array(axes)
    mass = rho * float(ellipsoid_volume(axes))
    body = rigid_body_matrix(mass, mass / 5 * ((axes**2).sum() - axes**2), np.zeros(3))
    return body + np.diag(np.r_[ellipsoid_added_mass(axes, rho)])


@pytest.mark.parametrize('seed', range(4))
def test_energy_and_impulses_are_kept_by_any_matrix_at_any_point(seed):
    rng = np.random.default_rng(seed)
    body = rigid_body_matrix(3.0, positive_matrix(seed + 50, 3), rng.normal(size=3))
    matrix = body + 3 * positive_matrix(seed)
    flow = rng.normal(size=3)
    end = run(matrix, flow=flow)
    energy = kinetic_energy(START, matrix, flow)
    assert kinetic_energy(end, matrix, flow) == pytest.approx(energy, rel=1e-10)
    before, after = impulses(0.0, START, matrix, flow), impulses(2.0, end, matrix, flow)
    for a, b in zip(before, after, strict=True):
        assert b == pytest.approx(a, rel=1e-9, abs=1e-9 * np.linalg.norm(a))


def test_ellipsoid_is_lambs_diagonal_case():
    matrix = ellipsoid_matrix()
    m, i = np.diag(matrix)[:3], np.diag(matrix)[3:]
    rate = kirchhoff_rhs(0.0, START, matrix)
    v, w = START[7:10], START[10:]
    assert rate[7:10] == pytest.approx(np.cross(m * v, w) / m, rel=1e-12)
    assert rate[10:] == pytest.approx((np.cross(i * w, w) + np.cross(m * v, v)) / i, rel=1e-12)


def test_uniform_current_is_a_change_of_frame():
    matrix, flow = ellipsoid_matrix() + 5 * positive_matrix(2), np.array([0.4, -0.7, 0.2])
    still = run(matrix)
    boosted = START.copy()
    boosted[7:10] += rotation_wb(START[3:7]).T @ flow
    moved = run(matrix, boosted, flow=flow)
    assert moved[:3] - 2.0 * flow == pytest.approx(still[:3], abs=1e-9)
    assert moved[3:7] == pytest.approx(still[3:7], abs=1e-9)


def test_reference_point_is_free():
    matrix, offset = ellipsoid_matrix() + 5 * positive_matrix(3), np.array([0.2, -0.1, 0.3])
    start = START.copy()
    start[:3] += rotation_wb(START[3:7]) @ offset
    start[7:10] += np.cross(START[10:], offset)
    end, other = run(matrix), run(shift_reference_point(matrix, offset), start)
    assert other[3:7] == pytest.approx(end[3:7], abs=1e-9)
    assert other[:3] - rotation_wb(other[3:7]) @ offset == pytest.approx(end[:3], abs=1e-9)


def test_body_axes_are_free():
    matrix, turn = ellipsoid_matrix(), rotation(8)  # turn: components b -> b'
    quat_rate = kirchhoff_rhs(0.0, START, matrix)
    turned = kirchhoff_rhs(
        0.0,
        np.r_[START[:7], turn @ START[7:10], turn @ START[10:]],
        rotate_matrix6(matrix, turn),
    )
    assert turned[7:10] == pytest.approx(turn @ quat_rate[7:10], rel=1e-9)
    assert turned[10:] == pytest.approx(turn @ quat_rate[10:], rel=1e-9)


def test_rigid_body_off_the_centre_of_mass_falls_freely():
    # In a vacuum the centre of mass moves on a straight line at constant speed.
    center = np.array([0.1, -0.2, 0.3])
    matrix = rigid_body_matrix(2.0, [0.3, 0.4, 0.5], center)
    end = run(matrix)

    def center_state(y):
        rot = rotation_wb(y[3:7])
        return y[:3] + rot @ center, rot @ (y[7:10] + np.cross(y[10:], center))

    (x0, v0), (x1, v1) = center_state(START), center_state(end)
    assert v1 == pytest.approx(v0, rel=1e-10)
    assert x1 == pytest.approx(x0 + 2.0 * v0, rel=1e-10)


def test_pushed_body_is_slower_by_its_added_mass():
    # a m / F = 1/(1 + k), k = 1/2 for a sphere.
    matrix = ellipsoid_matrix((0.1, 0.1, 0.1))
    mass = 1000 * float(ellipsoid_volume([0.1] * 3))
    rest = np.r_[np.zeros(3), 1, np.zeros(9)]
    rate = kirchhoff_rhs(0.0, rest, matrix, wrench=lambda t, y: np.r_[7.0, np.zeros(5)])
    assert rate[7] * mass / 7.0 == pytest.approx(1 / 1.5, rel=1e-13)


def test_munk_moment_turns_a_body_broadside():
    # Growth of a small yaw: sigma^2 = (m_z - m_x)(m + m_x) U^2 / ((m + m_z)(I + I_A)).
    axes, speed = np.array([0.4, 0.1, 0.1]), 1.0
    matrix = ellipsoid_matrix(axes)
    total = np.diag(matrix)
    added = np.r_[ellipsoid_added_mass(axes, 1000.0)]
    sigma = np.sqrt((added[2] - added[0]) * total[0] * speed**2 / (total[2] * total[4]))
    # Linear system for (w, q) about U: (m + m_z) w' = (m + m_x) U q, I q' = -(m_z - m_x)(-U w)...
    h, base = 1e-7, np.r_[np.zeros(3), 1, np.zeros(3), speed, 0, 0, 0, 0, 0]
    jacobian = np.zeros((2, 2))
    for column, index in enumerate((9, 11)):
        step = np.zeros(13)
        step[index] = h
        change = kirchhoff_rhs(0.0, base + step, matrix) - kirchhoff_rhs(0.0, base - step, matrix)
        jacobian[:, column] = change[[9, 11]] / (2 * h)
    assert np.linalg.eigvals(jacobian).real.max() == pytest.approx(sigma, rel=1e-7)
