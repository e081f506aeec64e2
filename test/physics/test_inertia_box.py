# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.inertia_box import (
    equivalent_inertia_box,
    inertia_box_drag,
    inertia_box_viscous,
    inertia_box_wrench,
    sphere_resistance,
)
from test.support.strategies import CYCLE, axes, floats, vectors


@given(axes(), floats(0.1, 100))
def test_box_of_a_box_is_the_box(half, mass):
    inertia = mass / 3 * ((half**2).sum() - half**2)
    # The smallest half-length is a small difference of large moments: eps (r_max / r_min)^2.
    tolerance = 1e-14 * (half.max() / half.min()) ** 2
    assert equivalent_inertia_box(mass, inertia) == pytest.approx(half, rel=tolerance)


def test_impossible_inertia_is_refused():
    with pytest.raises(ConfigError, match='inertia'):
        equivalent_inertia_box(1.0, [1.0, 1.0, 2.1])


def test_drag_closed_form():
    force, torque = inertia_box_drag([1.0, 2.0, 3.0], [2.0, -1.0, 0.5], [1.0, 2.0, -3.0], 10.0)
    assert force == pytest.approx([-2 * 10 * 6 * 4, 2 * 10 * 3 * 1, -2 * 10 * 2 * 0.25], rel=1e-15)
    expected = [-5 * (16 + 81) * 1, -5 * 2 * (81 + 1) * 4, 5 * 3 * (1 + 16) * 9]
    assert torque == pytest.approx(expected, rel=1e-15)


def test_drag_torque_is_the_integral_over_the_faces():
    # A strip of a face at distance y from the axis moves at w y and bears the pressure of the
    # translational law, f = 2 rho r_j r_k v^2 = 1/2 rho area v^2.
    half, omega, rho = np.array([0.3, 0.5, 0.7]), 2.0, 3.0
    y = (np.arange(20000) + 0.5) / 20000 * half[1]
    z = (np.arange(20000) + 0.5) / 20000 * half[2]
    # Turn about x: faces normal to z push at arm y, faces normal to y at arm z.
    moment = (
        0.5
        * rho
        * omega**2
        * (4 * half[0] * (y**3).mean() * half[1] + 4 * half[0] * (z**3).mean() * half[2])
    )
    torque = inertia_box_drag(half, np.zeros(3), [omega, 0, 0], rho)[1]
    assert torque[0] == pytest.approx(-moment, rel=1e-8)


def test_viscous_is_stokes_of_the_mean_radius():
    v, omega = np.array([1.0, -2.0, 3.0]), np.array([0.5, 0.1, -4.0])
    force, torque = inertia_box_viscous([1.0, 2.0, 3.0], v, omega, 0.01)
    assert force == pytest.approx(-6 * np.pi * 0.01 * 2 * v, rel=1e-15)
    assert torque == pytest.approx(-8 * np.pi * 0.01 * 8 * omega, rel=1e-15)


@given(axes(), vectors(), vectors())
def test_each_term_dissipates_and_is_odd(half, v, omega):
    terms = inertia_box_wrench(half, v, omega, density=1000.0, viscosity=0.1)
    back = inertia_box_wrench(half, -v, -omega, density=1000.0, viscosity=0.1)
    for name, (force, torque) in terms.items():
        assert force @ v <= 0 and torque @ omega <= 0
        assert np.array_equal(back[name][0], -force) and np.array_equal(back[name][1], -torque)


@given(axes(), vectors(), vectors())
def test_relabelling_the_axes_relabels_the_wrench(half, v, omega):
    here = inertia_box_drag(half, v, omega, 2.0)
    there = inertia_box_drag(CYCLE @ half, CYCLE @ v, CYCLE @ omega, 2.0)
    for a, b in zip(here, there, strict=True):
        assert b == pytest.approx(CYCLE @ a, rel=1e-13)


def test_rest_gives_zero_and_batches_agree(rng):
    half, v, omega = rng.uniform(0.1, 1, (5, 4, 3)), rng.normal(size=(5, 4, 3)), np.zeros(3)
    rho = rng.uniform(1, 10, (5, 4))
    force, torque = inertia_box_drag(half, v, omega, rho)
    assert not torque.any()
    assert force[2, 3] == pytest.approx(
        inertia_box_drag(half[2, 3], v[2, 3], omega, rho[2, 3])[0], rel=1e-15
    )


@pytest.mark.parametrize('bad', [[1.0, 1.0], [1.0, -1.0, 1.0], [1.0, np.nan, 1.0], [0.0, 1, 1]])
def test_bad_shape_is_refused(bad):
    with pytest.raises(ConfigError, match='half-lengths'):
        inertia_box_drag(bad, np.zeros(3), np.zeros(3), 1.0)


def test_negative_viscosity_is_refused():
    with pytest.raises(ConfigError, match='viscosity'):
        sphere_resistance(1.0, np.zeros(3), np.zeros(3), -1.0)
