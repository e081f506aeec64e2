# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.falling_plate import (
    PlateParams,
    falling_plate_rhs,
    fixed_point_speeds,
)


def fall(inertia, duration=150.0):
    start = [0, 0, 0.1, 0, -1.0, 0]
    found = solve_ivp(
        falling_plate_rhs,
        (0, duration),
        start,
        args=(PlateParams(inertia),),
        method='DOP853',
        rtol=1e-9,
        atol=1e-11,
    )
    return found.t, found.y


def tumbles(inertia):
    """Return whether the plate turns over and over once the start has died out."""
    t, y = fall(inertia)
    return np.ptp(y[2][t > 75]) > 2 * np.pi


def test_fixed_points():
    edge_on, broadside = fixed_point_speeds(PlateParams(1.0))
    assert edge_on == pytest.approx(2.80250, abs=5e-6)
    assert broadside == pytest.approx(1.14411, abs=5e-6)
    for state in ([0, 0, 0, 0, -broadside, 0], [0, 0, -np.pi / 2, edge_on, 0, 0]):
        rate = falling_plate_rhs(0.0, np.array(state), PlateParams(1.3))
        assert rate[2:] == pytest.approx(np.zeros(4), abs=1e-15)
        assert rate[1] < 0  # and it falls


def test_no_nan_at_rest():
    rate = falling_plate_rhs(0.0, np.zeros(6), PlateParams(1.0))
    assert rate == pytest.approx([0, 0, 0, 0, -0.5, 0])  # gravity over I* + 1, broadside


def test_ideal_fluid_conserves_energy():
    # Without circulation, drag and torque: Kirchhoff's equations under gravity.
    ideal = PlateParams(1.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

    def energy(y):
        _, height, _, vx, vy, w = y
        kinetic = 0.5 * (1.3 * vx**2 + 2.3 * vy**2 + 1.8 / 4 * w**2)
        return kinetic + height

    start = np.array([0, 0, 0.4, 0.3, -0.5, 0.2])
    found = solve_ivp(
        falling_plate_rhs, (0, 5), start, args=(ideal,), method='DOP853', rtol=1e-12, atol=1e-12
    )
    assert energy(found.y[:, -1]) == pytest.approx(energy(start), abs=1e-9)


def test_mirror_symmetry():
    state = np.array([0.1, 0.2, 0.3, 0.4, -0.5, 0.6])
    mirror = np.array([-1, 1, -1, -1, 1, -1.0])
    params = PlateParams(1.3)
    left = falling_plate_rhs(0.0, mirror * state, params)
    assert left == pytest.approx(mirror * falling_plate_rhs(0.0, state, params), rel=1e-14)


def test_regimes():
    t, y = fall(1.1)
    late = t > 75
    assert np.ptp(y[2][late]) < np.pi  # flutter: swings, never turns over
    assert np.ptp(y[2][late]) > 1
    t, y = fall(1.4)
    turns = np.abs(np.diff(y[2][[np.argmax(t > 75), -1]]))[0]
    assert turns > 10 * np.pi  # tumbles steadily one way


def test_flutter_turns_into_tumbling_at_the_published_inertia():
    # Paper: at I* = 1.2191, by a heteroclinic bifurcation.
    low, high = 1.20, 1.24
    assert not tumbles(low) and tumbles(high)
    while high - low > 5e-4:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if tumbles(middle) else (middle, high)
    assert 0.5 * (low + high) == pytest.approx(1.2191, abs=1e-3)
