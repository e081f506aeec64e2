# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The IMU: frames, lever arm, the boundary's own acceleration."""

import math

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite

G = 9.81
S, C = math.sin(math.radians(30)) * G, math.cos(math.radians(30)) * G


def read(simulation, **options):
    suite = SensorSuite(simulation, 'brick', **options)
    suite.update()
    return suite.imu


# nose, left and top are x, y and z of base_link
@pytest.mark.parametrize(
    ('motion', 'axis', 'force'),
    [
        ('level', (0, 0, 0), (0, 0, G)),
        ('pitch up', (0, -30, 0), (S, 0, C)),
        ('pitch down', (0, 30, 0), (-S, 0, C)),
        ('roll right', (30, 0, 0), (0, S, C)),
        ('roll left', (-30, 0, 0), (0, -S, C)),
        ('yaw left', (0, 0, 30), (0, 0, G)),
    ],
)
def test_attitude_at_rest(brick, motion, axis, force):
    simulation = brick(fixed=True, imu={'rate': 500})
    quat = np.empty(4)
    angle = math.radians(np.linalg.norm(axis))
    mujoco.mju_axisAngle2Quat(quat, np.array(axis) / (np.linalg.norm(axis) or 1.0), angle)
    simulation.model.body('brick').quat[:] = quat
    np.testing.assert_allclose(read(simulation).specific_force, force, atol=1e-12)


@pytest.mark.parametrize(
    ('motion', 'rates'),
    [('roll right', (1, 0, 0)), ('pitch up', (0, -1, 0)), ('yaw right', (0, 0, -1))],
)
def test_rates(brick, motion, rates):
    simulation = brick(imu={'rate': 500})
    simulation.data.qvel[3:] = rates
    np.testing.assert_array_equal(read(simulation).angular_velocity, rates)


@pytest.mark.parametrize(
    ('push', 'force'),
    [
        ('forward, facing east', (3, 0, 0)),
        ('to the left, that is north', (0, 3, 0)),
        ('up', (0, 0, 3)),
    ],
)
def test_a_push_adds_to_free_fall(brick, push, force):
    simulation = brick(imu={'rate': 500})
    assert read(simulation).specific_force == pytest.approx((0, 0, 0), abs=1e-12)
    simulation.data.qfrc_applied[:3] = 2.0 * np.array(force)
    np.testing.assert_allclose(read(simulation).specific_force, force, atol=1e-12)


def test_centripetal_lever_arm(brick):
    simulation = brick(gravity=0, imu={'rate': 500, 'site': 'ahead'})
    simulation.data.qvel[5] = 4.0
    expected = (-16 * 0.3, -16 * -0.2, 0)  # -w^2 r
    np.testing.assert_allclose(read(simulation).specific_force, expected, atol=1e-12)


def test_tangential_lever_arm(brick):
    simulation = brick(gravity=0, imu={'rate': 500, 'site': 'ahead'})
    simulation.data.qfrc_applied[5] = 0.04 * 5.0  # 5 rad/s^2 about z
    expected = (5 * 0.2, 5 * 0.3, 0)  # a x r
    np.testing.assert_allclose(read(simulation).specific_force, expected, atol=1e-12)


def test_equals_mujocos_own_sensors_at_the_boundary(brick):
    simulation = brick(density=1000, imu={'rate': 500, 'site': 'turned'})
    rng = np.random.default_rng(2)
    simulation.data.qvel[:] = rng.normal(size=6)
    suite = SensorSuite(simulation, 'brick')
    bare = mujoco.MjData(simulation.model)
    for _ in range(20):
        simulation.data.qfrc_applied[:] = rng.normal(size=6)
        suite.update()
        mujoco.mj_copyState(
            simulation.model, simulation.data, bare, mujoco.mjtState.mjSTATE_INTEGRATION
        )
        mujoco.mj_forward(simulation.model, bare)
        np.testing.assert_allclose(suite.imu.values, bare.sensordata, rtol=1e-11, atol=1e-11)
        simulation.step()


def test_hovering_vehicle_reads_its_weight():
    simulation = Simulation('x500')
    suite = SensorSuite(simulation, 'x500', SensorsFile.model_validate({'imu': {'rate': 250}}))
    suite.update()
    np.testing.assert_allclose(suite.imu.specific_force, (0, 0, G), atol=2e-3)


def test_reading_never_changes_the_trajectory(brick):
    ends = []
    for read_it in (False, True):
        simulation = brick(density=1000, imu={'rate': 250, 'gyroscope': {'density': 1e-3}})
        simulation.data.qvel[:] = 0.7
        suite = SensorSuite(simulation, 'brick')
        for _ in range(50):
            if read_it:
                suite.update()
            simulation.step(2)
        ends.append(simulation.data.qpos.copy())
    np.testing.assert_array_equal(*ends)


@pytest.mark.parametrize(
    ('imu', 'line'),
    [
        (
            {'rate': 600},
            "brick: vehicle 'brick': sensors.imu.rate: rate 600 Hz is above the step rate; "
            'allowed is at most 500 Hz, or a timestep of at most 0.001667 s',
        ),
        (
            {'rate': 250, 'site': 'elsewhere'},
            "brick: vehicle 'brick': sensors.imu: site 'elsewhere' is not on the base body; it "
            'has: ahead, turned, down',
        ),
    ],
)
def test_what_does_not_fit_the_model(brick, imu, line):
    with pytest.raises(ConfigError) as error:
        SensorSuite(brick(imu=imu), 'brick')
    assert str(error.value) == line
