# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Signals of fluid_sim.medium, and bad weather that is refused."""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from test.support.plugin_models import (
    refusal,
    world,
)
from test.support.weather_models import AIR, DRYDEN, PROBE, at, flow, weather


def test_ramp_sine_and_gust_have_their_values_and_derivatives():
    signals = 'ramp 2 0 0 1 4 sine 0 3 0 5 .7 gust 0 0 4 2 1.5 gust 1 0 0 3 2 1'
    model, data = weather(AIR | {'wind': [6, 0, 0], 'wind_signal': signals})
    for t in (0.0, 0.9, 1.3, 2.2, 3.1, 3.6, 4.9, 5.2, 6.4, 7.7, 8.5, 12.0):
        ramp = np.clip((t - 1) / 4, 0, 1)
        gust = (1 - np.cos(np.pi * np.clip((t - 2) / 1.5, 0, 1))) / 2
        rise, fall = np.clip((t - 3) / 2, 0, 1), np.clip((t - 6) / 2, 0, 1)
        pulse = (np.cos(np.pi * fall) - np.cos(np.pi * rise)) / 2
        expected = [6 + 2 * ramp + pulse, 3 * np.sin(2 * np.pi * t / 5 + 0.7), 4 * gust]
        velocity, rate, _ = at(model, data, t)
        np.testing.assert_allclose(velocity, expected, rtol=1e-14, atol=1e-14)
        difference = (at(model, data, t + 1e-6)[0] - at(model, data, t - 1e-6)[0]) / 2e-6
        np.testing.assert_allclose(rate, difference, rtol=1e-6, atol=1e-8)


def test_a_series_is_a_cubic_hermite_spline_with_held_ends():
    times = np.array([0.0, 0.7, 1.1, 2.5, 3.0])
    rows = np.random.default_rng(2).normal(size=(5, 3))
    words = np.column_stack([times, rows]).reshape(-1)
    model, data = weather(AIR | {'current_series': words})
    slopes = np.zeros((5, 3))
    for i in range(1, 4):  # the parabola through three rows
        coefficients = np.polyfit(times[i - 1 : i + 2] - times[i], rows[i - 1 : i + 2], 2)
        slopes[i] = coefficients[1]
    spline = CubicHermiteSpline(times, rows, slopes)
    for t in (0.0, 0.3, 0.7, 1.0, 1.9, 2.9):
        np.testing.assert_allclose(at(model, data, t)[0], spline(t), atol=1e-12)
        np.testing.assert_allclose(at(model, data, t)[1], spline.derivative()(t), atol=1e-11)
    for t, row in ((-1.0, rows[0]), (99.0, rows[-1])):
        np.testing.assert_array_equal(at(model, data, t)[0], row)
        assert not at(model, data, t)[1].any()


def test_a_signal_goes_with_the_profile():
    medium = AIR | {
        'wind': [6, 0, 0], 'wind_profile': 'power .5 10', 'wind_signal': 'ramp 0 2 0 0 4'
    }  # fmt: skip
    model, data = weather(medium)
    data.time = 2.0
    velocity, rate, _ = flow(model, data, [0, 0, 2.5])
    np.testing.assert_allclose(velocity, [3, 0.5, 0], rtol=1e-14)
    np.testing.assert_allclose(rate, [0, 0.25, 0], rtol=1e-14)


@pytest.mark.parametrize(
    ('keys', 'words'),
    [
        ({'wind_signal': 'ramp 1 0 0 0 0'}, ['wind_signal', 'DURATION']),
        ({'wind_signal': 'gost 1 0 0 0 1'}, ['wind_signal', 'gost', 'gust']),
        ({'wind_signal': 'sine 1 0 0 5'}, ['wind_signal', 'PERIOD PHASE']),
        ({'wind_series': '0 1 0 0'}, ['wind_series', 'two or more rows']),
        ({'wind_series': '1 1 0 0 0 1 0 0'}, ['wind_series', 'rising']),
        ({'current_gauss_markov': '1 1 1 0'}, ['current_gauss_markov', 'TIME > 0']),
        ({'current_gauss_markov': '1 -1 1 3'}, ['current_gauss_markov', '>= 0']),
        ({'turbulence': 'dreyden'}, ['turbulence', 'dreyden', 'dryden, von_karman']),
        ({'turbulence': 'dryden'}, ['turbulence_airspeed']),
        (DRYDEN | {'turbulence_airspeed': [0]}, ['turbulence_airspeed', '> 0']),
        (DRYDEN | {'turbulence_length': '10 -3 2'}, ['turbulence_length', '> 0']),
        (DRYDEN | {'turbulence_sigma': '1 -3 2'}, ['turbulence_sigma', '>= 0']),
        (DRYDEN | {'turbulence_wind_6m': [3]}, ['either', 'turbulence_wind_6m']),
        (DRYDEN | {'turbulence_height': [3]}, ['either', 'turbulence_height']),
        (DRYDEN | {'turbulence_exceedance': '3e-2'}, ['turbulence_exceedance', '1e-2']),
        (DRYDEN | {'turbulence_direction': [0, 0, 1]}, ['turbulence_direction', 'vertical']),
        (DRYDEN | {'turbulence_follow': 'vehicle'}, ['turbulence_follow', 'turbulence_length']),
        (DRYDEN | {'turbulence_span': [1], 'rotational_gust': 'curl'}, ['curl', 'either']),
        ({'seed': [1.5]}, ['seed', 'whole']),
        ({'seed': [-1]}, ['seed', '>= 0']),
    ],
)
def test_bad_weather_is_refused_in_one_line(keys, words):
    line = refusal(world(PROBE, medium=AIR | keys), 'fluid_sim.medium')
    for word in words:
        assert word in line, line
