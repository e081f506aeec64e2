# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Magnetometer, pressure, GNSS and airspeed: frames, closed forms, what they refuse."""

import math

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.environment.atmosphere import standard_pressure
from fluid_sim_ros.schema.scene import Home
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.magnetometer import earth_field

RATE = {'rate': 500}
#: Turns by 90 degrees as wxyz: from facing east to what the name says.
HALF = math.sqrt(0.5)
FACING = {'east': (1, 0, 0, 0), 'north': (HALF, 0, 0, HALF), 'west': (0, 0, 0, 1),
          'up': (HALF, 0, -HALF, 0)}  # fmt: skip


def updated(simulation, **options):
    suite = SensorSuite(simulation, next(iter(simulation.vehicles)), **options)
    suite.update()
    return suite


def test_field_at_a_known_place():
    # what PX4's simulators take for this home [G], north, east, down: an older model year
    field = earth_field(Home(latitude=47.3977, longitude=8.5456)) * 1e4
    known = np.array([0.0090, 0.2142, -0.4297])
    assert np.linalg.norm(field) == pytest.approx(np.linalg.norm(known), rel=0.01)
    cosine = field @ known / np.linalg.norm(field) / np.linalg.norm(known)
    assert math.degrees(math.acos(cosine)) < 1.0


# test values of the WMM2025 report (NOAA/NCEI, BGS), height 0: year, latitude, longitude, then
# X (north), Y (east), Z (down) [nT]
@pytest.mark.parametrize(
    ('year', 'latitude', 'longitude', 'xyz'),
    [
        (2025.0, 80, 0, (6521.6, 145.9, 54791.5)),
        (2025.0, 0, 120, (39677.8, -109.6, -10580.2)),
        (2025.0, -80, -120, (6117.5, 15751.9, -52022.5)),
        (2027.5, 80, 0, (6500.8, 294.5, 54869.4)),
    ],
)
def test_published_values_of_the_model(year, latitude, longitude, xyz):
    home = Home(latitude=latitude, longitude=longitude, altitude=0, year=year)
    east, north, up = earth_field(home) * 1e9
    assert (north, east, -up) == pytest.approx(xyz, abs=0.06)


def test_a_year_without_a_model():
    with pytest.raises(ConfigError, match='home: year 1900: '):
        earth_field(Home(year=1900))


@pytest.mark.parametrize(
    ('facing', 'axes'),
    [  # which of (east, north, up) of the field x, y and z read
        ('east', ('+e', '+n', '+u')),
        ('north', ('+n', '-e', '+u')),
        ('west', ('-e', '-n', '+u')),
        ('up', ('+u', '+n', '-e')),
    ],
)
def test_magnetometer_axes(brick, facing, axes):
    simulation = brick(magnetometer=RATE)
    simulation.data.qpos[3:7] = FACING[facing]
    sensor = updated(simulation).magnetometer
    part = dict(zip('enu', sensor.field_w, strict=True))
    expected = [float(f'{axis[0]}1') * part[axis[1]] for axis in axes]
    np.testing.assert_allclose(sensor.field, expected, atol=1e-18)


@pytest.mark.parametrize('altitude', [0.0, 488.0, 3000.0])
def test_barometer(brick, altitude):
    simulation = brick(barometer=RATE, home=Home(altitude=altitude))
    simulation.data.qpos[2] = 120.0
    sensor = updated(simulation).barometer
    assert sensor.pressure == standard_pressure(altitude + 120.0)
    assert sensor.altitude == pytest.approx(altitude + 120.0, abs=1e-6)
    assert sensor.temperature == pytest.approx(288.15 - 0.0065 * (altitude + 120.0), abs=0.02)


def test_pressure_at_depth():
    simulation = Simulation('rov')
    file = SensorsFile.model_validate({'pressure': RATE, 'barometer': RATE})
    for depth in (0.01, 1.0, 5.0, 9.9):
        simulation.data.qpos[2] = -depth
        suite = updated(simulation, config=file)
        # fresh water of the scene, 1000 kg/m^3
        assert suite.pressure.pressure == pytest.approx(101_325 + 1000 * 9.81 * depth, abs=1e-6)
        assert suite.pressure.depth == pytest.approx(depth, abs=1e-9)
        assert suite.barometer.pressure == suite.pressure.pressure
    simulation.data.qpos[2] = 2.0
    suite = updated(simulation, config=file)
    assert suite.pressure.pressure == standard_pressure(2.0)


def test_pressure_at_the_place_of_the_sensor(brick):
    simulation = brick(density=1000, pressure={'rate': 500, 'site': 'ahead'})  # .1 m higher
    simulation.data.qpos[2] = -5.0
    assert updated(simulation).pressure.depth == pytest.approx(4.9)


@pytest.mark.parametrize(
    ('sensors', 'density', 'line'),
    [
        ({'pressure': RATE}, 1.2, 'sensors.pressure: the scene has no water, or no gravity'),
        ({'airspeed': RATE}, 1000, 'sensors.airspeed: the scene has no air'),
        ({'rangefinder': {'rate': 500, 'direction': [0, 0, 0]}}, 1, 'must not be zero'),
    ],
)
def test_refused(brick, sensors, density, line):
    with pytest.raises(ConfigError, match=line):
        SensorSuite(brick(density=density, **sensors), 'brick')


@pytest.mark.parametrize(
    ('motion', 'velocity', 'signs'),
    [
        ('north', (0, 5, 0), (1, 0, 0)), ('south', (0, -5, 0), (-1, 0, 0)),
        ('east', (5, 0, 0), (0, 1, 0)), ('west', (-5, 0, 0), (0, -1, 0)),
        ('up', (0, 0, 5), (0, 0, 1)), ('down', (0, 0, -5), (0, 0, -1)),
    ],
)  # fmt: skip
@pytest.mark.parametrize('facing', ['east', 'north'])
def test_gnss_axes(brick, motion, velocity, signs, facing):
    simulation = brick(gravity=0, gnss=RATE)
    simulation.data.qpos[2] = 100.0
    simulation.data.qpos[3:7] = FACING[facing]
    simulation.data.qvel[:3] = velocity
    suite = SensorSuite(simulation, 'brick')
    suite.update()
    before = (suite.gnss.latitude, suite.gnss.longitude, suite.gnss.altitude)
    np.testing.assert_allclose(suite.gnss.velocity_w, velocity, atol=1e-12)
    simulation.step(500)
    suite.update()
    after = (suite.gnss.latitude, suite.gnss.longitude, suite.gnss.altitude)
    changes = [round((b - a) * scale) for a, b, scale in zip(before, after, (4e4, 3e4, 0.2),
                                                            strict=True)]  # fmt: skip
    assert [int(np.sign(change)) for change in changes] == list(signs)


def test_gnss_lever_arm(brick):
    simulation = brick(gravity=0, gnss={'rate': 500, 'site': 'ahead'})
    simulation.data.qvel[5] = 2.0  # turns left
    gnss = updated(simulation).gnss
    np.testing.assert_allclose(gnss.velocity_w, (0.4, 0.6, 0), atol=1e-12)  # w x (.3, -.2, .1)
    np.testing.assert_allclose(gnss.position_w, (0.3, -0.2, 1.1), atol=1e-12)


def test_gnss_has_no_reading_under_water(brick):
    simulation = brick(density=1000, gnss=RATE)
    simulation.data.qpos[2] = -0.1
    suite = updated(simulation)
    assert not suite.gnss.fresh
    assert suite.gnss.time_ns == -1
    assert not suite.gnss.values.any()  # the truth does not leak


@pytest.mark.parametrize(
    ('velocity', 'wind', 'speed'),
    [
        ((10, 0, 0), (0, 0, 0), 10), ((10, 0, 0), (-5, 0, 0), 15), ((0, 0, 0), (8, 0, 0), -8),
        ((0, 10, 0), (0, -3, 0), 0),
    ],
)  # fmt: skip
def test_airspeed_with_wind(brick, velocity, wind, speed):
    simulation = brick(density=1.1, airspeed=RATE)
    simulation.data.qvel[:3] = velocity
    simulation.set_wind(wind)
    sensor = updated(simulation).airspeed
    assert sensor.differential_pressure == pytest.approx(0.5 * 1.1 * speed * abs(speed))
    assert sensor.airspeed == pytest.approx(speed * math.sqrt(1.1 / 1.225))


def test_airspeed_facing_north(brick):
    simulation = brick(density=1.225, airspeed=RATE)
    simulation.data.qpos[3:7] = FACING['north']
    simulation.set_wind((3, -12, 0))
    assert updated(simulation).airspeed.airspeed == pytest.approx(12)


def test_dither_keeps_readings_moving(brick, readings):
    fixed = {'rate': 500}
    file = SensorsFile.model_validate(
        {'imu': fixed, 'magnetometer': fixed, 'barometer': fixed, 'dither': True}
    )
    for kind in ('imu', 'magnetometer', 'barometer'):
        rows, _ = readings(brick(fixed=True), kind, 200, config=file)
        single = np.float32(rows)
        assert (np.diff(single, axis=0) != 0).mean() > 0.98
