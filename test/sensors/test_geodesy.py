# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Geodesy against published pairs."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.schema.scene import Home
from fluid_sim_ros.sensors.geodesy import LocalFrame, ecef_to_geodetic, geodetic_to_ecef


def dms(degrees, minutes, seconds):
    return degrees + minutes / 60 + seconds / 3600


# IOGP publication 373-7-2 (EPSG guidance note 7-2), geographic/geocentric example
LATITUDE, LONGITUDE, HEIGHT = dms(53, 48, 33.820), dms(2, 7, 46.380), 73.0
GEOCENTRIC = (3_771_793.968, 140_253.342, 5_124_304.349)
PAIRS = [
    ((LATITUDE, LONGITUDE, HEIGHT), GEOCENTRIC),
    ((0.0, 0.0, 0.0), (6_378_137.0, 0.0, 0.0)),
    ((0.0, 90.0, 10.0), (0.0, 6_378_147.0, 0.0)),
    ((90.0, 0.0, 0.0), (0.0, 0.0, 6_356_752.3142)),
    ((-90.0, 0.0, -3.0), (0.0, 0.0, -6_356_749.3142)),
]


@pytest.mark.parametrize(('geodetic', 'geocentric'), PAIRS)
def test_published_pairs(geodetic, geocentric):
    latitude, longitude, height = geodetic
    found = geodetic_to_ecef(math.radians(latitude), math.radians(longitude), height)
    assert found == pytest.approx(geocentric, abs=1e-3)
    back = ecef_to_geodetic(*geocentric)
    assert math.degrees(back[0]) == pytest.approx(latitude, abs=1e-8)
    assert back[2] == pytest.approx(height, abs=1e-3)
    if abs(latitude) < 90:
        assert math.degrees(back[1]) == pytest.approx(longitude, abs=1e-8)


def test_the_published_topocentric_example():
    # the same guidance note: origin 55 N, 5 E, 200 m; east, north, up of the point above
    frame = LocalFrame(Home(latitude=55, longitude=5, altitude=200))
    point = (-189_013.869, -128_642.040, -4_220.171)
    assert frame.ecef(*point) == pytest.approx(GEOCENTRIC, abs=2e-3)
    latitude, longitude, height = frame.geodetic(*point)
    assert latitude == pytest.approx(LATITUDE, abs=2e-8)
    assert longitude == pytest.approx(LONGITUDE, abs=2e-8)
    assert height == pytest.approx(HEIGHT, abs=2e-3)


@given(
    st.floats(-math.pi / 2, math.pi / 2),
    st.floats(-math.pi + 1e-9, math.pi - 1e-9),
    st.floats(-11_000, 100_000),
)
def test_there_and_back(latitude, longitude, height):
    back = ecef_to_geodetic(*geodetic_to_ecef(latitude, longitude, height))
    assert back[0] == pytest.approx(latitude, abs=1e-14)
    assert back[2] == pytest.approx(height, abs=2e-8)
    if abs(latitude) < math.pi / 2 - 1e-6:
        assert back[1] == pytest.approx(longitude, abs=1e-14)


def test_home_is_where_the_world_begins():
    home = Home(latitude=-33.5, longitude=151.2, altitude=12.5)
    assert LocalFrame(home).geodetic(0, 0, 0) == pytest.approx((-33.5, 151.2, 12.5), abs=1e-8)


@pytest.mark.parametrize(
    ('move', 'moved'), [((100, 0, 0), 'longitude'), ((0, 100, 0), 'latitude'),
                        ((0, 0, 100), 'altitude')],
)  # fmt: skip
def test_east_north_up(move, moved):
    after = LocalFrame(Home(latitude=45, longitude=7, altitude=0)).geodetic(*move)
    # 100 m of longitude and latitude at 45 degrees [deg]: radii of curvature 6388.8 and 6367.4 km
    expected = {'latitude': 45.0, 'longitude': 7.0, 'altitude': 0.0}
    expected[moved] += {'longitude': 1.26828e-3, 'latitude': 8.9983e-4, 'altitude': 100.0}[moved]
    assert after[:2] == pytest.approx((expected['latitude'], expected['longitude']), abs=1e-8)
    assert after[2] == pytest.approx(expected['altitude'], abs=1e-3)
