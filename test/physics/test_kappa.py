# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from scipy.integrate import quad

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.kappa import (
    ellipsoid_added_mass,
    ellipsoid_volume,
    kappa,
    kappa_divided_difference,
)
from test.support.printed_formulas import added_inertia_as_printed
from test.support.strategies import CYCLE, axes

TABLE = np.genfromtxt(
    Path(__file__).parent / 'data' / 'added_mass_ellipsoid.csv', delimiter=',', skip_header=4
)


def test_table_is_whole():
    assert TABLE.shape == (21, 9)


@pytest.mark.parametrize('row', TABLE, ids=lambda row: ':'.join(f'{a:g}' for a in row[:3]))
def test_exact_table(row):
    axes_, k, k_prime = row[:3], row[3:6], row[6:]
    mass, inertia = ellipsoid_added_mass(axes_, 1.0)
    volume = ellipsoid_volume(axes_)
    assert mass / volume == pytest.approx(k, rel=1e-9)  # the table has 10 digits
    squares = axes_**2
    box = volume / 5 * (squares.sum() - squares)
    assert inertia / box == pytest.approx(k_prime, rel=1e-9, abs=1e-15)


def test_sphere():
    mass, inertia = ellipsoid_added_mass([0.2, 0.2, 0.2], 1000.0)
    assert mass == pytest.approx(np.full(3, 1000 * 2 / 3 * np.pi * 0.008), rel=1e-14)
    assert not inertia.any()
    assert kappa([3.0, 3, 3]) == pytest.approx(np.full(3, 2 / 3), rel=1e-14)
    divided, moment = kappa_divided_difference([3.0, 3, 3])
    assert divided == pytest.approx(np.full(3, 2 / 45), rel=1e-13)
    assert moment == pytest.approx(np.full(3, 4 / 15), rel=1e-13)


@pytest.mark.parametrize('ratio', [1.1, 2.0, 7.0, 100.0])
def test_prolate_spheroid_closed_form(ratio):
    # Lamb (1932) art. 114: alpha_0 = 2 (1 - e^2)/e^3 (1/2 ln((1 + e)/(1 - e)) - e).
    e2 = 1 - ratio**-2
    e = np.sqrt(e2)
    alpha = 2 * (1 - e2) / e**3 * (np.arctanh(e) - e)
    assert kappa([ratio, 1, 1])[0] == pytest.approx(alpha, rel=1e-13 * 300 / e**3)
    assert kappa([ratio, 1, 1])[1] == pytest.approx(1 - alpha / 2, rel=1e-12)


def test_thin_disc_limit():
    # Lamb (1932), ch. 5: 8/3 rho a^3 broadside, 16/45 rho a^5 about a diameter.
    mass, inertia = ellipsoid_added_mass([1.0, 1.0, 1e-6], 1.0)
    assert mass[2] == pytest.approx(8 / 3, rel=2e-6)
    assert inertia[:2] == pytest.approx([16 / 45, 16 / 45], rel=3e-6)


def test_long_cylinder_limit():
    # Strip theory: the fluid displaced per length, pi rho b^2, moves with the body.
    mass, _ = ellipsoid_added_mass([1e4, 1.0, 1.0], 1.0)
    assert mass[1] == pytest.approx(ellipsoid_volume([1e4, 1.0, 1.0]), rel=1e-6)


@pytest.mark.parametrize('eps', [1e-3, 1e-5, 1e-8, 1e-12])
def test_near_sphere_inertia_has_no_cancellation(eps):
    # r = (1, 1 + eps, 1): (r_j^2 - r_k^2)^2 D / (kappa + 2 E) -> 4 eps^2 (2/5)/(6/5) of rho V/5.
    eps = (1 + eps) - 1  # the value that the axis really has
    inertia = ellipsoid_added_mass([1.0, 1.0 + eps, 1.0], 1.0)[1]
    limit = 4 / 3 * np.pi / 5 * 4 / 3 * eps**2
    assert inertia[[0, 2]] == pytest.approx([limit, limit], rel=5 * eps + 1e-13)
    assert inertia[1] == 0


def test_printed_quotient_loses_half_of_the_digits_near_the_sphere():
    near = np.array([1.0, 1.0 + 1e-8, 1.0])
    exact = ellipsoid_added_mass(near, 1.0)[1]
    printed = added_inertia_as_printed(near, 1.0)
    assert abs(printed[0] / exact[0] - 1) > 1e-9


@given(axes(0.02, 1.0))
def test_printed_quotient_agrees_where_axes_differ(r):
    r = np.sort(r) * [1.0, 1.5, 2.25]
    exact = ellipsoid_added_mass(r, 1.0)[1]
    thinness = (r.max() / r.min()) ** 2
    assert added_inertia_as_printed(r, 1.0) == pytest.approx(exact, rel=1e-11 * thinness)


@given(axes(1e-4, 1.0))
def test_sum_is_two_and_divided_difference_is_one(r):
    k = kappa(r)
    assert k.sum() == pytest.approx(2, rel=1e-13)
    divided, moment = kappa_divided_difference(r)
    j2, k2 = np.roll(r, -1) ** 2, np.roll(r, -2) ** 2
    k_j, k_k = np.roll(k, -1), np.roll(k, -2)
    assert divided * (j2 - k2) == pytest.approx(k_k - k_j, rel=1e-9, abs=1e-13)
    assert moment + k2 * divided == pytest.approx(k_j, rel=1e-12)


def test_kappa_against_adaptive_quadrature():
    r = np.array([0.3, 0.2, 0.05])

    def integrand(t, i):
        lam = np.exp(t)
        return lam * r.prod() / (r[i] ** 2 + lam) / np.sqrt((r**2 + lam).prod())

    for i in range(3):
        value = quad(integrand, -45, 30, args=(i,), epsabs=1e-14, epsrel=1e-13, limit=200)[0]
        assert kappa(r)[i] == pytest.approx(value, rel=1e-11)


@given(axes())
def test_scale_and_relabelling(r):
    mass, inertia = ellipsoid_added_mass(r, 3.0)
    bigger = ellipsoid_added_mass(2 * r, 3.0)
    assert bigger[0] == pytest.approx(8 * mass, rel=1e-12)
    assert bigger[1] == pytest.approx(32 * inertia, rel=1e-12)
    turned = ellipsoid_added_mass(CYCLE @ r, 3.0)
    assert turned[0] == pytest.approx(CYCLE @ mass, rel=1e-12)
    assert turned[1] == pytest.approx(CYCLE @ inertia, rel=1e-12)


@given(axes())
def test_inertia_is_not_negative(r):
    mass, inertia = ellipsoid_added_mass(r, 1.0)
    assert (mass > 0).all() and (inertia >= 0).all()


def test_batch(rng):
    r, rho = rng.uniform(0.1, 1, (4, 2, 3)), rng.uniform(1, 5, (4, 2))
    mass, inertia = ellipsoid_added_mass(r, rho)
    one = ellipsoid_added_mass(r[3, 1], rho[3, 1])
    assert mass[3, 1] == pytest.approx(one[0], rel=1e-14)
    assert inertia[3, 1] == pytest.approx(one[1], rel=1e-14)


def test_flat_body_is_refused():
    with pytest.raises(ConfigError, match='semi-axes'):
        kappa([1.0, 1.0, 0.0])
