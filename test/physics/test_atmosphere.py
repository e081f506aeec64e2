# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The standard atmosphere against the tables of ISO 2533."""

import math

import pytest

from fluid_sim_ros.physics.environment import atmosphere


# geometric altitude [m], temperature [K], pressure [hPa]: ISO 2533:1975, table 5 (geometric)
@pytest.mark.parametrize(
    ('altitude', 'temperature', 'pressure'),
    [
        (-1000, 294.651, 1139.29),
        (0, 288.150, 1013.25),
        (500, 284.900, 954.61),
        (1000, 281.651, 898.76),
        (5000, 255.676, 540.48),
        (10_000, 223.252, 264.99),
        (15_000, 216.650, 121.11),
    ],
)
def test_table(altitude, temperature, pressure):
    assert atmosphere.standard_temperature(altitude) == pytest.approx(temperature, abs=1e-3)
    assert atmosphere.standard_pressure(altitude) / 100 == pytest.approx(pressure, rel=1e-4)


@pytest.mark.parametrize('altitude', [-400, 0, 0.1, 488, 3000, 10_900])
def test_pressure_altitude_is_the_inverse(altitude):
    pressure = atmosphere.standard_pressure(altitude)
    assert atmosphere.pressure_altitude(pressure) == pytest.approx(altitude, abs=1e-7)


def test_pressure_falls_by_the_weight_of_the_air():
    for altitude in (10.0, 4000.0, 10_999.0, 12_000.0):
        step = 1.0
        slope = (
            atmosphere.standard_pressure(altitude + step)
            - atmosphere.standard_pressure(altitude - step)
        ) / (2 * step)
        density = atmosphere.standard_pressure(altitude) / (
            atmosphere.GAS_CONSTANT * atmosphere.standard_temperature(altitude)
        )
        shrink = (atmosphere.EARTH_RADIUS / (atmosphere.EARTH_RADIUS + altitude)) ** 2
        assert slope == pytest.approx(-density * atmosphere.GRAVITY * shrink, rel=1e-6)


def test_no_pressure_at_all_has_an_altitude():
    assert math.isfinite(atmosphere.pressure_altitude(-5.0))
