# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.environment.medium import (
    blended,
    flow_acceleration,
    flow_velocity,
    layered,
    logarithmic_profile,
    power_law_profile,
    slew_limited,
    table_profile,
)
from test.support.strategies import floats, vectors

PROFILES = [
    lambda z: power_law_profile(z, 10.0, 1 / 7),
    lambda z: logarithmic_profile(z, 10.0, 0.03),
    lambda z: table_profile(z, [0.0, 5.0, 10.0, 20.0], [0.0, 0.7, 1.0, 1.2]),
]


@pytest.mark.parametrize('profile', PROFILES)
def test_reference_height_has_factor_one(profile):
    assert profile(10.0)[0] == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize('profile', PROFILES)
def test_slope_is_the_derivative(profile):
    z = np.array([0.5, 1.7, 4.0, 7.7, 12.3, 18.0])
    difference = (profile(z + 1e-6)[0] - profile(z - 1e-6)[0]) / 2e-6
    assert profile(z)[1] == pytest.approx(difference, rel=1e-6)


@pytest.mark.parametrize('profile', PROFILES)
def test_nothing_moves_in_the_ground(profile):
    factor, slope = profile(np.array([-3.0, -1e-9]))
    assert not factor.any() and not slope.any()


def test_known_values():
    assert power_law_profile(20.0, 10.0, 0.5)[0] == pytest.approx(np.sqrt(2), rel=1e-15)
    assert logarithmic_profile(0.3, 3.0, 0.03)[0] == pytest.approx(0.5, rel=1e-14)
    assert table_profile(2.5, [0.0, 5.0], [0.0, 1.0])[0] == 0.5
    assert table_profile(9.0, [0.0, 5.0], [0.0, 1.0])[0] == 1.0


@pytest.mark.parametrize(
    ('call', 'message'),
    [
        (lambda: power_law_profile(1.0, 0.0, 0.1), 'reference'),
        (lambda: power_law_profile(1.0, 1.0, -0.1), 'exponent'),
        (lambda: logarithmic_profile(1.0, 0.1, 0.1), 'reference'),
        (lambda: table_profile(1.0, [0.0, 0.0], [1.0, 1.0]), 'rising'),
        (lambda: table_profile(1.0, [0.0, 1.0], [1.0]), 'one factor each'),
        (lambda: slew_limited(np.zeros(3), np.ones(3), 0.0, 1.0), 'rate'),
    ],
)
def test_bad_profiles_are_refused(call, message):
    with pytest.raises(ConfigError, match=message):
        call()


@given(vectors(), vectors(), floats(0.1, 5), floats(0, 20))
def test_slew_stays_within_its_rate_and_arrives(start, target, rate, elapsed):
    velocity, derivative = slew_limited(start, target, rate, elapsed)
    assert np.linalg.norm(derivative) <= rate * (1 + 1e-12)
    assert np.linalg.norm(velocity - start) <= rate * elapsed * (1 + 1e-12) + 1e-14
    arrival = np.linalg.norm(target - start) / rate
    after, rest = slew_limited(start, target, rate, arrival * (1 + 1e-12) + 1e-12)
    assert np.array_equal(after, target) and not rest.any()


@given(vectors(), vectors(), floats(0, 3))
def test_slew_integrates_its_derivative(start, target, elapsed):
    # Constant derivative until the arrival: start + derivative * time, to rounding.
    velocity, _ = slew_limited(start, target, 2.0, elapsed)
    arrival = np.linalg.norm(target - start) / 2.0
    first = slew_limited(start, target, 2.0, 0.0)[1]
    assert velocity == pytest.approx(start + first * min(elapsed, arrival), abs=1e-13)


def test_slew_continues_where_it_is():
    start, target = np.zeros(3), np.array([3.0, 4.0, 0])
    middle, _ = slew_limited(start, target, 1.0, 2.0)
    assert slew_limited(middle, target, 1.0, 1.5)[0] == pytest.approx(
        slew_limited(start, target, 1.0, 3.5)[0], rel=1e-14
    )


def test_towing_through_a_steady_profile_feels_no_acceleration():
    factor, slope = power_law_profile(4.0, 10.0, 1 / 7)
    assert slope > 0
    assert not flow_acceleration(factor, slope, [5.0, 2.0, 0], np.zeros(3)).any()


def test_material_acceleration_follows_a_particle():
    # dx/dt = u(x, t): the acceleration along the particle's own path, by differences.
    velocity, rate = np.array([2.0, -1.0, 0.6]), np.array([0.3, 0.2, -0.1])

    def u(z, t):
        return flow_velocity(power_law_profile(z, 10.0, 0.3)[0], velocity + rate * t)

    z, h = 6.0, 1e-4
    w = u(z, 0.0)[2]
    # Second order in h: the path is z + w h to first order, its curvature cancels.
    difference = (u(z + w * h, h) - u(z - w * h, -h)) / (2 * h)
    ours = flow_acceleration(*power_law_profile(z, 10.0, 0.3), velocity, rate)
    assert ours == pytest.approx(difference, rel=1e-6)


def test_layers():
    assert layered([-1.0, 0.0, 1.0], 0.0, 1000.0, 1.2).tolist() == [1000.0, 1000.0, 1.2]
    assert blended([0.0, 0.5, 1.0], 1000.0, 2.0).tolist() == [2.0, 501.0, 1000.0]
