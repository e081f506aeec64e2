# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Rangefinder and DVL: distances to known planes, ranges, frames."""

import math

import numpy as np
import pytest

from fluid_sim_ros.sensors import SensorSuite

RATE = {'rate': 500}


def updated(simulation):
    suite = SensorSuite(simulation, 'brick')
    suite.update()
    return suite


def rolled(simulation, degrees):
    half = math.radians(degrees) / 2
    simulation.data.qpos[3:7] = (math.cos(half), math.sin(half), 0, 0)
    return simulation


@pytest.mark.parametrize('height', [0.5, 1.0, 7.25])
def test_range_over_a_floor(brick, height):
    simulation = brick(rangefinder=RATE)
    simulation.data.qpos[2] = height
    assert updated(simulation).rangefinder.distance == pytest.approx(height)


def test_range_on_a_slant_from_a_site(brick):
    simulation = rolled(brick(rangefinder={'rate': 500, 'site': 'ahead'}), 40)
    simulation.data.qpos[2] = 3.0
    c, s = math.cos(math.radians(40)), math.sin(math.radians(40))
    height = 3.0 + 0.1 * c - 0.2 * s  # the site (.3, -.2, .1), right side down
    assert updated(simulation).rangefinder.distance == pytest.approx(height / c)


def test_direction_and_turned_site(brick):
    ahead = brick(rangefinder={'rate': 500, 'site': 'down', 'direction': [0, 0, 2]})
    assert updated(ahead).rangefinder.distance == pytest.approx(0.9)  # z of that site looks down
    up = brick(rangefinder={'rate': 500, 'direction': [0, 0, 1]})
    assert updated(up).rangefinder.distance == math.inf


def test_beyond_the_range(brick):
    sensor = {'rate': 500, 'distance': {'range': [0.5, 2.0], 'deviation': 1e-3}}
    for height, expected in ((0.3, -math.inf), (4.0, math.inf)):
        simulation = brick(rangefinder=sensor)
        simulation.data.qpos[2] = height
        rangefinder = updated(simulation).rangefinder
        assert rangefinder.distance == expected
        assert rangefinder.saturated == 1


def test_the_range_is_that_of_the_boundary(brick, readings):
    simulation = brick(rangefinder=RATE)
    simulation.data.qvel[2] = 4.0
    suite = SensorSuite(simulation, 'brick')
    for _ in range(20):
        simulation.step()
        suite.update()
        assert suite.rangefinder.distance == pytest.approx(simulation.data.qpos[2], abs=1e-12)


def test_dvl_over_a_flat_bed(brick):
    simulation = brick(density=1000, floor=-20, dvl=RATE)
    simulation.data.qpos[2] = -8.0
    simulation.data.qvel[:3] = (0.5, -0.2, 0.1)
    dvl = updated(simulation).dvl
    np.testing.assert_allclose(dvl.velocity, (0.5, -0.2, 0.1), atol=1e-15)
    assert dvl.altitude == pytest.approx(12.0)


def test_dvl_axes_and_lever_arm(brick):
    simulation = brick(density=1000, floor=-1, dvl={'rate': 500, 'site': 'turned'})
    simulation.data.qvel[:] = (1, 0, 0, 0, 0, 2)
    suite = updated(simulation)
    site = simulation.model.site('turned')
    w, x, y, z = site.quat
    R = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    velocity_b = np.array([1, 0, 0]) + np.cross((0, 0, 2), site.pos)
    np.testing.assert_allclose(suite.dvl.velocity, R.T @ velocity_b, atol=1e-12)


@pytest.mark.parametrize(
    ('roll', 'height', 'lock'),
    [(0, 9.9, True), (0, 10.1, False), (0, 0.1, False), (60, 3.0, False)],
)
def test_bottom_lock(brick, roll, height, lock):
    # at 60 degrees two beams miss the bed, or meet it beyond the range
    simulation = rolled(
        brick(density=1000, dvl={'rate': 500, 'altitude': {'range': [0.2, 10]}}), roll
    )
    simulation.data.qpos[2] = height
    suite = updated(simulation)
    assert suite.dvl.fresh == lock
