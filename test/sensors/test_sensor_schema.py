# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensors in vehicle files: what is read, presets, and the one line of each fault."""

import pytest

from fluid_sim_ros import Scene, Simulation, scene_names
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.schema.base import parse
from fluid_sim_ros.schema.scene import VehicleFile
from fluid_sim_ros.schema.sensors import SensorFile, SensorsFile, presets
from fluid_sim_ros.sensors import SensorSuite


def leaves(cls):
    """Return the classes below a class that have none below them."""
    below = [leaf for other in cls.__subclasses__() for leaf in leaves(other)]
    return below or [cls]


KINDS = {cls.kind: cls for cls in leaves(SensorFile)}


@pytest.mark.parametrize(
    ('kind', 'name'), [(kind, name) for kind in KINDS for name in presets(kind)]
)
def test_every_preset_is_read_and_has_a_source(kind, name):
    file = KINDS[kind].model_validate({'preset': name, 'rate': 10})
    assert file.source
    assert SensorsFile.model_validate({kind: {'preset': name, 'rate': 10}}) == SensorsFile(
        **{kind: file}
    )


def test_every_kind_has_a_preset():
    assert all(presets(kind) for kind in KINDS)


def test_what_is_stated_comes_before_the_preset():
    file = SensorsFile.model_validate(
        {'imu': {'preset': 'icm20948', 'rate': 100, 'gyroscope': {'density': 1}, 'latency': 0.01}}
    )
    assert (file.imu.gyroscope.density, file.imu.gyroscope.range) == (1, None)
    assert file.imu.latency == 0.01
    assert file.imu.accelerometer.range == [-156.9, 156.9]


SHIPPED = (
    'x500', 'quadrotor', 'crazyflie', 'bluerov2', 'rov', 'bluerov2_heavy', 'aerosonde', 'remus100',
    'amphibious',
)  # fmt: skip


@pytest.mark.parametrize('scene', SHIPPED)
def test_shipped_vehicles_have_sensors(scene):
    simulation = Simulation(scene)
    suite = SensorSuite(simulation, next(iter(simulation.vehicles)))
    assert suite.imu.specific_force.shape == (3,)
    assert suite.barometer or suite.pressure
    suite.update()
    assert suite.imu.fresh


@pytest.mark.parametrize('scene', scene_names())
def test_every_scene_has_suites(scene):
    simulation = Simulation(scene)
    for vehicle in simulation.vehicles:
        SensorSuite(simulation, vehicle).update()


@pytest.mark.parametrize(
    ('sensors', 'line'),
    [
        ({'radar': {}}, "unknown key 'sensors.radar'; allowed: imu, magnetometer, barometer, "),
        ({'imu': {}}, "missing key 'sensors.imu.rate'"),
        ({'imu': {'rate': 0}}, "key 'sensors.imu.rate': must be greater than 0 (got 0)"),
        (
            {'imu': {'rate': 1, 'gyroscope': {'noise': 1}}},
            "unknown key 'sensors.imu.gyroscope.noise'; allowed: density, deviation, bias_walk, "
            'resolution, range',
        ),
        (
            {'imu': {'rate': 1, 'gyroscope': {'density': -1}}},
            "key 'sensors.imu.gyroscope.density': must be greater than or equal to 0 (got -1)",
        ),
        (
            {'barometer': {'rate': 1, 'pressure': {'range': [2, 1]}}},
            "key 'sensors.barometer.pressure': range: the first number must be below the second",
        ),
        (
            {'imu': {'preset': 'best', 'rate': 1}},
            "key 'sensors.imu': preset 'best' is not known; presets: bmi088, icm20948",
        ),
        (
            {'imu': {'preset': '../imu/bmi088', 'rate': 1}},
            "key 'sensors.imu': preset '../imu/bmi088' is not known; ",
        ),
    ],
)
def test_faults(tmp_path, sensors, line):
    path = tmp_path / 'v.yaml'
    with pytest.raises(ConfigError) as error:
        parse(VehicleFile, {'body': 'b', 'sensors': sensors}, path)
    assert str(error.value).startswith(f'{path}: {line}')
    assert '\n' not in str(error.value)


@pytest.mark.parametrize(
    ('home', 'line'),
    [
        ('{latitude: 91}', "key 'home.latitude': must be less than or equal to 90"),
        ('{lat: 1}', "unknown key 'home.lat'; allowed: latitude, longitude, altitude, year"),
    ],
)
def test_faults_of_home(tmp_path, home, line):
    path = tmp_path / 's.yaml'
    path.write_text(f'model: x500\nhome: {home}\n')
    with pytest.raises(ConfigError, match=line):
        Scene.load(path)


def test_home_is_read(tmp_path):
    path = tmp_path / 's.yaml'
    path.write_text('model: x500\nhome: {latitude: 1, longitude: 2, altitude: 3}\n')
    assert Scene.load(path).home.altitude == 3
