# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Lidar and sonar: ranges to known walls, range by absorption, messages."""

import math

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from fluid_sim_ros.messages.sensor_topics import sensor_topics
from fluid_sim_ros.physics.environment.sound_in_water import absorption, audible_range
from fluid_sim_ros.sensors import SensorSuite

STORE = get_typestore(Stores.ROS2_JAZZY)
SONAR = {'rate': 500, 'beams': 31, 'angles': [-60, 60], 'frequency': 2e5, 'loss': 110}


def updated(simulation):
    suite = SensorSuite(simulation, 'brick')
    suite.update()
    return suite


def turned(simulation, height):
    """Return the simulation with its x-y plane upright: beams turn from ahead to the floor."""
    half = math.pi / 4  # about x: y looks up
    simulation.data.qpos[2:7] = (height, math.cos(half), math.sin(half), 0, 0)
    return simulation


@pytest.mark.parametrize('kind', ['lidar', 'sonar'])
def test_ranges_to_a_floor_to_1e_6(brick, kind):
    sensor = {**SONAR, 'angles': [-150, -30]}
    if kind == 'lidar':  # the floor of the test ends 10 m away
        sensor = {'rate': 500, 'beams': 37, 'angles': [-160, -20]}
    scan = getattr(updated(turned(brick(**{kind: sensor}), 2.0)), kind)
    down = np.sin(scan.angles) < -1e-9
    expected = np.full(len(scan.angles), np.inf)
    expected[down] = 2.0 / -np.sin(scan.angles[down])
    beyond = expected > getattr(scan, 'reach', math.inf)
    expected[beyond] = np.inf
    assert down.sum() > 10
    assert scan.ranges == pytest.approx(expected, rel=1e-6)


def francois_garrison(frequency, temperature, salinity, depth, acidity=8.0):
    """Francois and Garrison (1982), J. Acoust. Soc. Am. 72(3), 896 and 72(6), 1879 [dB/m]."""
    f, t, s, d = frequency / 1e3, temperature, salinity, depth
    kelvin, c = 273.0 + t, 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * d
    boric = 2.8 * math.sqrt(s / 35.0) * 10.0 ** (4.0 - 1245.0 / kelvin)
    first = 8.86 / c * 10.0 ** (0.78 * acidity - 5.0) * boric * f * f / (boric**2 + f * f)
    magnesium = 8.17 * 10.0 ** (8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0))
    second = 21.44 * s / c * (1.0 + 0.025 * t) * (1.0 - 1.37e-4 * d + 6.2e-9 * d * d)
    second *= magnesium * f * f / (magnesium**2 + f * f)
    if t <= 20.0:
        pure = 4.937e-4 - 2.59e-5 * t + 9.11e-7 * t**2 - 1.5e-8 * t**3
    else:
        pure = 3.964e-4 - 1.146e-5 * t + 1.45e-7 * t**2 - 6.5e-10 * t**3
    return (first + second + pure * (1.0 - 3.83e-5 * d + 4.9e-10 * d * d) * f * f) / 1e3


@pytest.mark.parametrize(
    ('temperature', 'salinity', 'depth'),
    [(10, 35, 0), (-2, 35, 0), (30, 35, 0), (10, 8, 0), (10, 45, 0), (10, 35, 3000)],
)
def test_absorption_is_within_10_percent_of_the_formula_that_it_simplifies(
    temperature, salinity, depth
):
    for frequency in np.geomspace(100, 1e6, 30):
        ours = absorption(frequency, temperature, salinity, depth)
        full = francois_garrison(frequency, temperature, salinity, depth)
        assert ours == pytest.approx(full, rel=0.1), frequency


def test_fresh_water_absorbs_less_and_so_does_deep_water():
    assert absorption(1e5, 10.0, 0.0, 0.0) < 0.1 * absorption(1e5, 10.0, 35.0, 0.0)
    assert absorption(1e5, 10.0, 35.0, 1000.0) < absorption(1e5, 10.0, 35.0, 0.0)


@pytest.mark.parametrize('frequency', [2e4, 2e5, 7e5])
def test_the_range_is_where_the_loss_is(frequency):
    reach = audible_range(110.0, frequency, 10.0, 35.0, 5.0)
    rate = absorption(frequency, 10.0, 35.0, 5.0)
    assert 2 * (20 * math.log10(reach) + rate * reach) == pytest.approx(110.0, abs=1e-6)


def test_a_higher_frequency_reaches_less_far(brick):
    low, high = (
        updated(brick(sonar={**SONAR, 'frequency': f})).sonar.reach for f in (2e5, 7e5)
    )  # fmt: skip
    assert low > 1.5 * high


def test_noise_and_range_of_a_scan(brick):
    distance = {'deviation': 0.05, 'range': [0.1, 3.0]}
    sensor = {'rate': 500, 'beams': 2000, 'angles': [-91, -89], 'distance': distance}
    ranges = updated(turned(brick(lidar=sensor), 2.0)).lidar.ranges
    assert np.std(ranges) == pytest.approx(0.05, rel=0.1)
    assert np.mean(ranges) == pytest.approx(2.0, abs=0.01)
    far = updated(turned(brick(lidar=sensor), 4.0)).lidar.ranges
    assert np.isinf(far).all()


def test_the_message_holds_the_fan(brick):
    simulation = turned(brick(lidar={'rate': 500, 'beams': 5, 'angles': [-120, -60]}), 2.0)
    suite = SensorSuite(simulation, 'brick')
    topic, cloud = sensor_topics(simulation, suite, 'brick')
    assert (topic.name, topic.type) == ('brick/scan', 'sensor_msgs/msg/LaserScan')
    simulation.observe(forces=True)
    data = topic.data()
    ranges = np.frombuffer(data, '<f4')
    expected = 2.0 / np.sin(np.radians([120, 105, 90, 75, 60]))
    places = [i for i in range(len(ranges) - 4) if np.allclose(ranges[i : i + 5], expected)]
    assert len(places) == 1
    points = STORE.deserialize_cdr(cloud.data(), cloud.type)
    assert [(f.name, f.offset, f.datatype) for f in points.fields] == [
        ('x', 0, 7), ('y', 4, 7), ('z', 8, 7)
    ]  # fmt: skip
    assert (points.width, points.height, points.point_step, points.row_step) == (5, 1, 12, 60)
    assert (cloud.name, points.header.frame_id) == ('brick/points', 'brick/lidar')
    # a floor 2 m below: in its axes the points lie on y = -2
    xyz = points.data.view('<f4').reshape(5, 3)
    assert xyz[:, 1] == pytest.approx([-2.0] * 5, rel=1e-6)
    assert xyz[:, 0] == pytest.approx(
        2 / np.tan(np.radians([60, 75, 90, 105, 120])) * -1, abs=1e-6
    )
    assert math.radians(15) in [pytest.approx(float(x), rel=1e-6) for x in ranges]


@pytest.mark.parametrize(
    ('kind', 'sensor', 'words'),
    [
        ('lidar', {'beams': 1}, 'beams'),
        ('lidar', {'angles': [10, -10]}, 'angles'),
        ('lidar', {'angles': [-400, 10]}, 'angles'),
        ('sonar', {'loss': -3}, 'loss'),
        ('sonar', {'distance': {'range': [500, 600]}, 'frequency': 7e5}, 'lowest range'),
    ],
)
def test_wrong_input_is_named(brick, kind, sensor, words):
    with pytest.raises(Exception, match=words):
        updated(brick(**{kind: {'rate': 500, **sensor}}))


def test_a_loss_that_the_first_metre_takes_reaches_nothing():
    assert audible_range(0.01, 2e5, 10.0, 35.0, 5.0) == 0.0  # 0.1 dB there and back
