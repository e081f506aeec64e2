# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""JONSWAP seas: energy, exact period, spreading, repeatability."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.integrate import quad

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.environment.wave_spectrum import (
    jonswap_spectrum,
    jonswap_waves,
    spread_angle,
    uniforms,
)
from fluid_sim_ros.physics.environment.waves import wave_flow, wave_surface
from test.support.strategies import floats, seeds


def moment(order, low=0.0, high=np.inf, **sea):
    """Return m_n of the spectrum by adaptive quadrature (H_s 2 m, T_p 8 s)."""
    peak = 2 * np.pi / 8
    cuts = sorted({max(low, 0.05 * peak), *np.clip([0.6 * peak, peak, 2 * peak], low, high)})
    parts = [*cuts, min(high, 300 * peak)]
    return sum(
        quad(lambda w: w**order * jonswap_spectrum(w, 2.0, 8.0, **sea), a, b, epsrel=1e-10)[0]
        for a, b in itertools.pairwise(parts)
        if b > a
    )


def test_the_spectrum_holds_the_stated_energy():
    for gamma, tolerance in [(1.0, 1e-5), (3.3, 3e-3), (5.0, 3e-3), (7.0, 2e-2)]:
        assert moment(0, gamma=gamma) == pytest.approx(2.0**2 / 16, rel=tolerance)


def test_pierson_moskowitz_in_closed_form():
    """At gamma 1 the integral from 0 to w is (H_s^2/16) exp(-5/4 (w_p/w)^4)."""
    for ratio in (0.8, 1.0, 1.5, 3.0):
        expected = 0.25 * np.exp(-1.25 * ratio**-4)
        assert moment(0, high=ratio * 2 * np.pi / 8, gamma=1.0) == pytest.approx(expected, 1e-8)


@settings(max_examples=20)
@given(seeds(), floats(1, 7))
def test_the_amplitudes_hold_the_energy_of_the_spectrum(seed, gamma):
    """Sum of a^2/2 = m0 = H_s^2/16; in each half of the band as the spectrum has it, to 1e-3."""
    sea = jonswap_waves(2.0, 8.0, gamma=gamma, seed=seed, repeat=4000.0, components=100)
    assert np.sum(sea.amplitude**2 / 2) == pytest.approx(0.25, rel=1e-12)
    step, order = 2 * np.pi / 4000.0, np.argsort(sea.omega)
    np.testing.assert_array_equal(order, np.arange(100))
    # where a bin ends: the 50th starts at the multiple that the geometric rule gives
    edge = (np.floor(250 * np.sqrt(8.0) + 0.5) - 0.5) * step
    low, whole = (moment(0, high=end, gamma=gamma) for end in (edge, 4 * 2 * np.pi / 8))
    share = np.sum(sea.amplitude[:50] ** 2 / 2) / 0.25
    assert share == pytest.approx(low / whole, rel=1e-3)


@pytest.mark.parametrize('spreading', [0, 10])
@pytest.mark.parametrize('seed', [0, 1, 12345])
def test_significant_height_over_one_exact_period(seed, spreading):
    sea = jonswap_waves(2.0, 8.0, seed=seed, spreading=spreading, depth=30.0)
    assert sea.repeat == 1600.0
    times = np.arange(0, 1600.0, 0.5)
    for place in ([0.0, 0.0], [17.0, -8.0]):
        height = wave_surface(sea, place, times).height
        assert 4 * height.std() == pytest.approx(2.0, rel=1e-12)
        assert height.mean() == pytest.approx(0, abs=1e-12)


def test_the_sea_repeats_after_its_period_and_not_before():
    sea = jonswap_waves(2.0, 8.0, seed=5)
    times = np.arange(0, 1600.0, 0.5)
    first = wave_surface(sea, [3.0, 4.0], times).height
    np.testing.assert_allclose(
        wave_surface(sea, [3.0, 4.0], times + 1600).height, first, atol=1e-9
    )
    spectrum = np.abs(np.fft.rfft(first)) ** 2
    likeness = np.fft.irfft(spectrum)[: len(first) // 2] / spectrum.sum() * len(first) / 2
    assert np.max(likeness[100:]) < 0.8 * likeness[0]  # from 50 s to half the period


def test_zero_crossings_and_accelerations_follow_the_moments_of_the_spectrum():
    """Expected over the draws within the bins: m2 and m4 over the band, here within 2 %."""
    high = 4 * 2 * np.pi / 8
    expected = [moment(order, high=high) / moment(0, high=high) for order in (2, 4)]
    found = np.mean(
        [
            [np.sum(sea.omega**order * sea.amplitude**2) / 2 / 0.25 for order in (2, 4)]
            for sea in (jonswap_waves(2.0, 8.0, seed=seed) for seed in range(40))
        ],
        axis=0,
    )
    np.testing.assert_allclose(found, expected, rtol=2e-2)


def test_spreading_is_the_stated_distribution():
    """Moments of cos^2s(chi/2): the mean of cos(chi) is s/(s + 1)."""
    share = (np.arange(20000) + 0.5) / 20000
    for s in (1.0, 4.0, 25.0, 70.0):
        angle = spread_angle(share, s)
        assert np.all(np.diff(angle) > 0)
        assert np.cos(angle).mean() == pytest.approx(s / (s + 1), rel=1e-5)
        assert np.sin(angle).mean() == pytest.approx(0, abs=1e-9)
        second = s * (s - 1) / ((s + 1) * (s + 2))
        assert np.cos(2 * angle).mean() == pytest.approx(second, abs=1e-5)


def test_short_crested_waves_spread_about_their_direction():
    sea = jonswap_waves(2.0, 8.0, direction=[0.0, -3.0], spreading=15, seed=2, components=200)
    np.testing.assert_allclose(np.linalg.norm(sea.direction, axis=1), 1.0)
    assert (-sea.direction[:, 1]).mean() == pytest.approx(15 / 16, abs=0.03)
    assert sea.direction[:, 0].mean() == pytest.approx(0, abs=0.06)


def test_seeds_give_other_seas_of_the_same_energy():
    one, same, other = (jonswap_waves(2.0, 8.0, seed=seed) for seed in (7, 7, 8))
    np.testing.assert_array_equal(one.phase, same.phase)
    assert not np.any(one.phase == other.phase)
    np.testing.assert_array_equal(one.amplitude, other.amplitude)


def test_uniforms_are_splitmix64():
    """First outputs of SplitMix64 in exact integers; then their statistics."""

    def mix(state):
        state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        state = (state ^ (state >> 27)) * 0x94D049BB133111EB % 2**64
        return state ^ (state >> 31)

    for seed in (0, 1, 2**53):
        start = mix(seed)
        exact = [mix((start + i * 0x9E3779B97F4A7C15) % 2**64) for i in range(1, 6)]
        assert uniforms(seed, 5).tolist() == [(value >> 11) * 2.0**-53 for value in exact]
    # a known answer: the generator's reference output for the state 0
    assert mix(0x9E3779B97F4A7C15) == 0xE220A8397B1DCDAF
    draws = uniforms(3, 100000)
    assert draws.mean() == pytest.approx(0.5, abs=4 * np.sqrt(1 / 12 / 1e5))
    assert np.corrcoef(draws[:-1], draws[1:])[0, 1] == pytest.approx(0, abs=4 / np.sqrt(1e5))


def test_many_components_cost_no_accuracy_of_the_flow():
    """The variance of the vertical velocity at z = 0 is m2 of the components."""
    sea = jonswap_waves(2.0, 8.0, seed=9, components=128)
    times = np.arange(0, 1600.0, 0.5)
    rise = wave_flow(sea, [1.0, 2.0, 0.0], times).velocity[:, 2]
    assert rise.var() == pytest.approx(np.sum((sea.omega * sea.amplitude) ** 2) / 2, rel=1e-10)


@pytest.mark.parametrize(
    ('options', 'words'),
    [
        ({'gamma': 0.5}, 'gamma'),
        ({'spreading': -1}, 'spreading'),
        ({'components': 0}, 'components'),
        ({'cutoff': 1.0}, 'cutoff'),
        ({'repeat': 80.0}, r'repeat: 10 peak periods; allowed: >= 60\.5'),
        ({'seed': -1}, 'seed'),
        ({'seed': 2**53 + 1}, 'seed'),
    ],
)
def test_wrong_options_are_one_line(options, words):
    with pytest.raises(ConfigError, match=words) as caught:
        jonswap_waves(2.0, 8.0, **options)
    assert '\n' not in str(caught.value)
