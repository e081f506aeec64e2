# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Turbulence: spectra, covariances, von Karman as a sum, tables, exact discretisation."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import expm

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.environment.coloured_noise import (
    between_ticks,
    discretise,
    noise_samples,
    normal_numbers,
    stationary_covariance,
)
from fluid_sim_ros.physics.environment.turbulence import (
    angular_rate_spectra,
    dryden_covariance,
    dryden_spectra,
    turbulence_filters,
    turbulence_modes,
    von_karman_spectra,
)
from fluid_sim_ros.physics.environment.turbulence_scales import (
    FOOT,
    turbulence_intensity,
    turbulence_length,
)

LENGTH, AIRSPEED = np.array([180.0, 150.0, 40.0]), 15.0


def response(filters, output, omega):
    """Return the one-sided spectrum of an output, |C (i w - A)^-1 b|^2 / pi."""
    total = np.zeros(len(omega))
    for f in filters:
        if output in f.outputs:
            eye = np.eye(len(f.b))
            gain = [f.outputs[output] @ np.linalg.solve(1j * w * eye - f.a, f.b) for w in omega]
            total += np.abs(gain) ** 2 / np.pi
    return total


@pytest.mark.parametrize('spectra', [dryden_spectra, von_karman_spectra])
@pytest.mark.parametrize('which', [0, 1])
def test_spectra_hold_the_variance(spectra, which):
    def density(log_omega):
        omega = np.exp(log_omega)
        return omega * spectra(omega, 150.0, AIRSPEED)[which]

    assert quad(density, -25, 45, limit=400)[0] == pytest.approx(1.0, rel=2e-5)  # 1.339 is rounded


def test_lateral_spectra_follow_from_the_longitudinal():
    """Isotropy: Phi_v = (Phi_u - omega Phi_u')/2 (Batchelor 1953, eq. 3.4.17)."""
    omega, h = np.logspace(-3, 2, 60), 1e-5
    for spectra in (dryden_spectra, von_karman_spectra):
        along, across = spectra(omega, 150.0, AIRSPEED)
        above, below = (spectra(omega * (1 + s), 150.0, AIRSPEED)[0] for s in (h, -h))
        assert across == pytest.approx((along - (above - below) / (2 * h)) / 2, rel=1e-7)


def test_dryden_filters_have_drydens_spectra():
    omega = np.logspace(-3, 3, 80)
    filters = turbulence_filters('dryden', LENGTH, AIRSPEED)
    for output, which in ((0, 0), (1, 1), (2, 1)):
        expected = dryden_spectra(omega, LENGTH[output], AIRSPEED)[which]
        assert response(filters, output, omega) == pytest.approx(expected, rel=1e-12)


def test_the_sum_of_dryden_processes_is_von_karmans_within_a_tenth_of_a_decibel():
    filters = turbulence_filters('von_karman', LENGTH, AIRSPEED)
    for output, which in ((0, 0), (1, 1), (2, 1)):
        corner = AIRSPEED / (1.339 * LENGTH[output])
        omega = corner * np.logspace(-2, np.log10(15), 100)
        expected = von_karman_spectra(omega, LENGTH[output], AIRSPEED)[which]
        decibel = 10 * np.log10(response(filters, output, omega) / expected)
        assert np.abs(decibel).max() < 0.1
    assert turbulence_modes('von_karman')[0].sum() == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize('kind', ['dryden', 'von_karman'])
def test_angular_rates_have_their_spectra(kind):
    span, omega = 2.9, np.logspace(-2, 2, 50)
    filters = turbulence_filters(kind, LENGTH, AIRSPEED, span)
    v, w = response(filters, 1, omega), response(filters, 2, omega)
    expected = angular_rate_spectra(omega, v, w, LENGTH[2], AIRSPEED, span)
    if kind == 'dryden':  # one filter each; von Karman's modes add up power by power
        for output, spectrum in zip((3, 4, 5), expected, strict=True):
            assert response(filters, output, omega) == pytest.approx(spectrum, rel=1e-10)
    assert response(filters, 3, omega) == pytest.approx(expected[0], rel=1e-10)
    assert response(filters, 4, omega) == pytest.approx(expected[1], rel=1e-10)


@pytest.mark.parametrize('tick', [0.01, 0.1, 1.0])
@pytest.mark.parametrize('length', [10.0, 150.0, 762.0])
def test_sampled_covariance_is_the_continuous_one(tick, length):
    """C exp(A h)^k P C' of the samples against the closed covariance, lag by lag."""
    lags = np.arange(0, 400, 7)
    filters = turbulence_filters('dryden', [length] * 3, AIRSPEED)
    expected = dryden_covariance(lags * tick, length, AIRSPEED)
    for f, output, which in ((filters[0], 0, 0), (filters[1], 1, 1)):
        phi, noise = discretise(f.a, f.b, tick)
        stationary = stationary_covariance(f.a, f.b)
        # what the recursion keeps is P: phi P phi' + Q = P
        assert phi @ stationary @ phi.T + noise == pytest.approx(stationary, abs=1e-13)
        c = f.outputs[output]
        sampled = [c @ np.linalg.matrix_power(phi, k) @ stationary @ c for k in lags]
        assert sampled == pytest.approx(expected[which], abs=1e-12)


def test_every_filter_is_discretised_exactly():
    for kind in ('dryden', 'von_karman'):
        for f in turbulence_filters(kind, LENGTH, AIRSPEED, 1.5):
            phi, noise = discretise(f.a, f.b, 0.01)
            stationary = stationary_covariance(f.a, f.b)
            assert phi == pytest.approx(expm(f.a * 0.01), abs=1e-14)
            assert phi @ stationary @ phi.T + noise == pytest.approx(stationary, abs=1e-13)


def test_intensity_by_height():
    """Anchors of MIL-F-8785C, figures 7, 10 and 11."""
    wind = 15.0
    at_1000_ft = turbulence_intensity(1000 * FOOT, wind)[0]
    assert at_1000_ft == pytest.approx([1.5] * 3, rel=1e-12)
    low = turbulence_intensity(20 * FOOT, wind)[0]
    assert low == pytest.approx([1.5 / 0.19346**0.4] * 2 + [1.5], rel=1e-12)
    assert turbulence_intensity(3750 * FOOT, wind, '1e-3')[0] == pytest.approx([10.6 * FOOT] * 3)
    at_2000 = 9.6 + 250 / 2000 * 1.0  # between 1750 and 3750 ft
    middle = turbulence_intensity(1500 * FOOT, wind, '1e-3')[0]
    assert middle == pytest.approx([(1.5 + at_2000 * FOOT) / 2] * 3, rel=1e-12)
    assert turbulence_intensity(0.0, wind)[0] == pytest.approx(
        turbulence_intensity(10 * FOOT, wind)[0]
    )
    assert not turbulence_intensity(30e3, wind, '1e-1')[0].any()
    with pytest.raises(ConfigError, match=r'exceedance .*2e-1'):
        turbulence_intensity(10.0, wind, '3e-2')


def test_intensity_slope_is_its_derivative():
    height = np.array([5.0, 40.0, 250.0, 350.0, 500.0, 800.0, 3000.0, 12000.0])
    above, below = (turbulence_intensity(height + s, 12.0)[0] for s in (1e-4, -1e-4))
    slope = turbulence_intensity(height, 12.0)[1]
    assert slope == pytest.approx((above - below) / 2e-4, rel=1e-6, abs=1e-9)


def test_length_by_height():
    assert turbulence_length(1000 * FOOT) == pytest.approx([1000 * FOOT] * 3, rel=1e-12)
    assert turbulence_length(100 * FOOT)[0] == pytest.approx(100 * FOOT / 0.2593**1.2, rel=1e-12)
    assert turbulence_length(100 * FOOT)[2] == pytest.approx(100 * FOOT)
    assert turbulence_length(1500 * FOOT) == pytest.approx([1375 * FOOT] * 3)
    assert turbulence_length(9000.0, 'von_karman') == pytest.approx([2500 * FOOT] * 3)
    assert turbulence_length(0.0) == pytest.approx(turbulence_length(10 * FOOT))


def test_normal_numbers_are_normal_and_independent():
    numbers = normal_numbers(7, 3, 20_000, 5)
    assert numbers.mean(axis=0) == pytest.approx(np.zeros(5), abs=4 / np.sqrt(20_000))
    covariance = np.cov(numbers.T)
    assert covariance == pytest.approx(np.eye(5), abs=4 * np.sqrt(2 / 20_000))
    assert not np.array_equal(numbers, normal_numbers(8, 3, 20_000, 5))
    assert not np.array_equal(numbers, normal_numbers(7, 4, 20_000, 5))
    # counter-based: the first ticks do not depend on how many are drawn
    assert np.array_equal(numbers[:100], normal_numbers(7, 3, 100, 5))


def test_between_ticks_goes_through_the_samples_with_its_own_derivative():
    filters = turbulence_filters('dryden', [20.0] * 3, AIRSPEED)
    samples = noise_samples(filters, 3, 0.05, 1, 2, 60)
    for k in range(0, 50, 7):
        assert between_ticks(samples, 0.05, k * 0.05)[0] == pytest.approx(samples[k + 1], abs=1e-9)
    for time in (0.013, 0.0251, 0.31):
        value, rate = between_ticks(samples, 0.05, time)
        above, below = (between_ticks(samples, 0.05, time + s)[0] for s in (1e-6, -1e-6))
        assert rate == pytest.approx((above - below) / 2e-6, rel=1e-6, abs=1e-7)
        assert np.isfinite(value).all()


def test_a_cubic_is_reproduced_between_ticks():
    """Catmull-Rom is exact for quadratics."""
    t = (np.arange(40) - 1) * 0.1
    samples = np.stack([1 + 2 * t - 3 * t**2, t], axis=-1)
    value, rate = between_ticks(samples, 0.1, 1.234)
    assert value == pytest.approx([1 + 2 * 1.234 - 3 * 1.234**2, 1.234], rel=1e-12)
    assert rate == pytest.approx([2 - 6 * 1.234, 1.0], rel=1e-11)
