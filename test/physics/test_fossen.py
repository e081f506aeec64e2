# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra.numpy import arrays

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.added_mass import added_mass_coriolis
from fluid_sim_ros.physics.fossen import (
    CrossTerm,
    cross_damping_wrench,
    damping_wrench,
    linear_damping_matrix,
    quadratic_damping_matrix,
    secant_damping,
    without_convection,
)
from test.support.strategies import floats, positive_matrix, seeds

NU = arrays(float, 6, elements=floats(-5, 5))


def test_each_coefficient_acts_on_its_own():
    # Peers had a pitch coefficient overwritten for years: try all 36 of both matrices.
    nu = np.array([1.0, -2.0, 3.0, -0.5, 0.25, 0.75])
    for i in range(6):
        for j in range(6):
            one = np.zeros((6, 6))
            one[i, j] = 2.0
            expected = np.zeros(6)
            expected[i] = -2.0 * nu[j]
            assert damping_wrench(one, np.zeros((6, 6)), nu) == pytest.approx(expected)
            expected[i] = -2.0 * abs(nu[j]) * nu[j]
            assert damping_wrench(np.zeros((6, 6)), one, nu) == pytest.approx(expected)


@given(NU, seeds())
def test_dissipates_and_is_odd(nu, seed):
    linear = positive_matrix(seed)
    quadratic = np.diag(np.random.default_rng(seed).uniform(0, 5, 6))
    wrench = damping_wrench(linear, quadratic, nu)
    assert wrench @ nu <= 0
    assert np.array_equal(damping_wrench(linear, quadratic, -nu), -wrench)


def test_cross_terms():
    nu = np.array([1.0, -2.0, 0, 0, 0, 3.0])
    sway_yaw = [CrossTerm(1, 1, 5, 0.5), CrossTerm(5, 5, 1, 2.0)]
    wrench = cross_damping_wrench(sway_yaw, nu)
    assert wrench == pytest.approx([0, -0.5 * 2 * 3, 0, 0, 0, -2.0 * 3 * -2.0])
    assert np.array_equal(cross_damping_wrench(sway_yaw, -nu), -wrench)
    # A cross term of a velocity with itself is the diagonal quadratic damping.
    same = cross_damping_wrench([CrossTerm(1, 1, 1, 4.0)], nu)
    assert same == pytest.approx(
        damping_wrench(np.zeros((6, 6)), np.diag([0, 4.0, 0, 0, 0, 0]), nu)
    )


@given(seeds())
def test_cross_terms_less_the_convection_and_the_convection_are_the_totals(seed):
    rng, added = np.random.default_rng(seed), positive_matrix(seed)
    row, first, second = rng.integers(6), *rng.permutation(6)[:2]
    total = CrossTerm(row, first, second, rng.normal())
    (rest,) = without_convection([total], added)

    def force(nu):
        convected = np.concatenate(added_mass_coriolis(added, nu[:3], nu[3:]))
        return (cross_damping_wrench([rest], nu) + convected)[row]

    ahead, across = 2.0 * np.eye(6)[first], 3.0 * np.eye(6)[second]
    mixed = (force(ahead + across) - force(ahead - across)) / 2
    assert mixed == pytest.approx(-total.coef * 2.0 * 3.0, abs=1e-9)


@given(NU, seeds())
def test_secant_keeps_the_power_of_a_dissipative_set(nu, seed):
    linear = positive_matrix(seed)
    quadratic = np.diag(np.random.default_rng(seed).uniform(0, 5, 6))
    secant = secant_damping(linear, quadratic, nu)
    assert secant == pytest.approx(secant.T)
    assert np.linalg.eigvalsh(secant)[0] >= -1e-12
    power = -damping_wrench(linear, quadratic, nu) @ nu
    assert nu @ secant @ nu == pytest.approx(power, rel=1e-10, abs=1e-12)


@given(NU, seeds())
def test_secant_never_damps_less(nu, seed):
    rng = np.random.default_rng(seed)
    linear, quadratic = rng.normal(size=(2, 6, 6))
    secant = secant_damping(linear, quadratic, nu)
    scale = 1 + np.linalg.norm(secant)
    assert np.linalg.eigvalsh(secant)[0] >= -1e-13 * scale
    power = -damping_wrench(linear, quadratic, nu) @ nu
    assert nu @ secant @ nu >= power - 1e-12 * scale * (1 + nu @ nu)


@pytest.mark.parametrize('step', [1e-3, 1.0, 100.0])
def test_secant_step_solves_quadratic_drag_exactly(step):
    # (m + h D |v|)(v' - v) = -h D |v| v gives v/(1 + h D |v|/m), the exact solution at any h.
    mass, drag, v = 2.0, 30.0, np.array([1.5, 0, 0, 0, 0, 0])
    d_quadratic = drag * np.eye(6)
    force = damping_wrench(np.zeros((6, 6)), d_quadratic, v)
    effective = mass * np.eye(6) + step * secant_damping(np.zeros((6, 6)), d_quadratic, v)
    after = v + step * np.linalg.solve(effective, force)
    assert after[0] == pytest.approx(1.5 / (1 + step * drag * 1.5 / mass), rel=1e-12)


def test_rest():
    assert not damping_wrench(np.eye(6), np.eye(6), np.zeros(6)).any()


@pytest.mark.parametrize(
    ('make', 'values', 'message'),
    [
        (linear_damping_matrix, [1, 1, 1, -1, 1, 1], 'eigenvalue'),
        (linear_damping_matrix, range(21), '6 or 36'),
        (linear_damping_matrix, [1, 1, np.inf, 1, 1, 1], 'finite'),
        (quadratic_damping_matrix, [1, 1, 1, -1, 1, 1], 'diagonal'),
        (quadratic_damping_matrix, range(5), '6 or 36'),
    ],
)
def test_bad_damping_is_refused(make, values, message):
    with pytest.raises(ConfigError, match=message):
        make(values)


def test_skew_part_is_allowed():
    skew = np.eye(6)
    skew[1, 5], skew[5, 1] = 3.0, -3.0  # lift-like: no power
    assert np.array_equal(linear_damping_matrix(skew), skew)
