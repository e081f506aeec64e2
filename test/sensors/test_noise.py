# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Errors of readings: Allan deviation, rounding, saturation, dither, and what they depend on."""

import numpy as np
import pytest

from fluid_sim_ros.schema.sensors import Channel
from fluid_sim_ros.sensors.noise import BLOCK, Errors

RATE = 200.0


def sequence(count, name='test/imu', seed=1, axes=1, truth=0.0, dither=(), **channel):
    errors = Errors([(Channel(**channel), axes)], RATE, seed, name, dither)
    rows = np.full((count, axes), truth, dtype=float)
    saturated = sum(errors.apply(k, row) for k, row in enumerate(rows))
    return rows, saturated


def allan_deviation(readings, size):
    """Overlapping Allan deviation of averages of ``size`` readings (IEEE Std 952, annex C)."""
    total = np.concatenate([[0.0], np.cumsum(readings)])
    means = (total[size:] - total[:-size]) / size
    return np.sqrt(0.5 * np.mean((means[size:] - means[:-size]) ** 2))


@pytest.mark.parametrize('density', [2.6e-4, 2.3e-3])
def test_allan_deviation_of_white_noise_is_the_density(density):
    readings = sequence(200_000, density=density)[0][:, 0]
    for tau in (0.05, 0.5, 5.0):  # N / sqrt(tau)
        deviation = allan_deviation(readings, round(tau * RATE))
        assert deviation == pytest.approx(density / np.sqrt(tau), rel=0.1)


def test_allan_deviation_of_the_bias_is_its_walk():
    walk = 3e-5
    readings = sequence(400_000, bias_walk=walk, axes=8)[0]
    for tau in (1.0, 10.0, 50.0):  # K sqrt(tau / 3)
        deviations = [allan_deviation(axis, round(tau * RATE)) for axis in readings.T]
        mean = np.sqrt(np.mean(np.square(deviations)))
        assert mean == pytest.approx(walk * np.sqrt(tau / 3), rel=0.1)


def test_both_together_cross_where_they_should():
    density, walk = 1e-3, 1e-3
    readings = sequence(100_000, density=density, bias_walk=walk, axes=8)[0]
    tau = np.sqrt(3) * density / walk  # where the two parts of the variance are equal
    mean = np.mean([allan_deviation(axis, round(tau * RATE)) ** 2 for axis in readings.T])
    assert np.sqrt(mean) == pytest.approx(np.sqrt(2 * density**2 / tau), rel=0.1)


def test_deviation_of_a_reading_and_of_white_noise_add_up():
    readings, _ = sequence(100_000, density=0.3 / np.sqrt(RATE), deviation=0.4)
    assert readings.std() == pytest.approx(0.5, rel=0.01)
    assert Channel(density=0.3, deviation=0.4, resolution=0.6).variance(4.0) == pytest.approx(
        0.09 * 4 + 0.16 + 0.03
    )


def test_off_is_exact():
    truth = np.random.default_rng(0).normal(size=300)
    for k, value in enumerate(truth):
        row = np.array([value])
        assert Errors([(Channel(), 1)], RATE, 1, 'x').apply(k, row) == 0
        assert row[0] == value


def test_axes_and_seeds_and_names_are_independent():
    a = sequence(50_000, density=1.0, axes=3)[0]
    others = [sequence(50_000, density=1.0, **k)[0][:, 0] for k in ({'seed': 2}, {'name': 'y'})]
    correlation = np.corrcoef([*a.T, *others])
    assert np.abs(correlation - np.eye(5)).max() < 0.02


def test_a_reading_does_not_depend_on_those_before():
    channel = Channel(density=1e-3, bias_walk=1e-2, resolution=1e-5)
    rows = np.zeros((5 * BLOCK, 2))
    errors = Errors([(channel, 2)], RATE, 7, 'x')
    for k, row in enumerate(rows):
        errors.apply(k, row)
    for k in (4 * BLOCK + 3, 17, 2 * BLOCK - 1, 2 * BLOCK):
        row = np.zeros(2)
        Errors([(channel, 2)], RATE, 7, 'x').apply(k, row)
        np.testing.assert_array_equal(row, rows[k])
        again = np.zeros(2)
        errors.apply(k, again)
        np.testing.assert_array_equal(again, rows[k])


def test_dither_leaves_white_noise_and_bias_as_they_are():
    plain = sequence(500, density=1e-3, bias_walk=1e-3)[0]
    dithered = sequence(500, density=1e-3, bias_walk=1e-3, dither=(1e-6,))[0]
    assert 0 < np.abs(dithered - plain).max() <= 1e-6


def test_resolution():
    truth = np.linspace(-1, 1, 101)
    errors = Errors([(Channel(resolution=0.25), 1)], RATE, 0, 'x')
    for value in truth:
        row = np.array([value])
        errors.apply(0, row)
        assert row[0] in np.arange(-4, 5) * 0.25
        assert abs(row[0] - value) <= 0.125


def test_one_quantum_of_dither():
    readings = sequence(20_000, truth=0.5, resolution=0.25, dither=(1.0,))[0][:, 0]
    values, counts = np.unique(readings, return_counts=True)
    np.testing.assert_array_equal(values, [0.25, 0.5, 0.75])
    np.testing.assert_allclose(counts / 20_000, [0.25, 0.5, 0.25], atol=0.02)


def test_a_resolution_of_next_to_nothing_changes_nothing():
    errors = Errors([(Channel(resolution=1e-310), 1)], RATE, 0, 'x')
    values = np.array([1013.25])
    assert errors.apply(0, values) == 0 and values[0] == 1013.25


def test_dither_without_resolution_never_repeats():
    readings = sequence(20_000, truth=0.5, dither=(1e-3,))[0][:, 0]
    assert len(np.unique(readings)) == 20_000
    assert np.abs(readings - 0.5).max() <= 1e-3


def test_saturation_is_counted():
    errors = Errors([(Channel(range=[-2, 3]), 3), (Channel(), 1)], RATE, 0, 'x')
    row = np.array([-2.5, 1.0, 3.5, 99.0])
    assert errors.apply(0, row) == 2
    np.testing.assert_array_equal(row, [-2, 1, 3, 99])
    assert errors.apply(1, row) == 0
