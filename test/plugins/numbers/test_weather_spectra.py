# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Turbulence of the plugin against the spectra and variances of theory, over many seeds."""

import pytest

from benchmarks.weather.weather_spectra import MINUTES, SEEDS, measure


@pytest.mark.parametrize('kind', ['dryden', 'von_karman'])
def test_a_few_seeds_are_near_the_theory(kind):
    """Bands of 3 x 8 min scatter by some decibels; the mean squares know their own error."""
    found = measure(kind, 3, 8.0)
    upper = [max(map(abs, row[7:])) for row in found['bands_db'].values()]
    assert max(upper) < 2.5
    assert found['worst_sigmas_off'] < 4


@pytest.mark.full
@pytest.mark.parametrize('kind', ['dryden', 'von_karman'])
def test_64_seeds_of_20_minutes_are_within_a_decibel(kind):
    found = measure(kind, SEEDS, MINUTES)
    assert found['worst_band_db'] < 1.0
    assert found['worst_sigmas_off'] < 4
