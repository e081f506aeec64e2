# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What stands beside the model of a new vehicle: sensors, fins, and mappings for autopilots."""

from dataclasses import replace

import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.new_vehicle.files import design_vehicle, write_vehicle
from fluid_sim_ros.new_vehicle.mappings import mappings_of
from fluid_sim_ros.sensors import SensorSuite

AIR = {'medium': 'air', 'mass': 2.0, 'size': (0.4, 0.4, 0.1)}
WATER = {'medium': 'water', 'mass': 11.0, 'size': (0.5, 0.4, 0.3)}
TORPEDO = {'medium': 'water', 'mass': 30.0, 'size': (1.4, 0.2, 0.2), 'thrusters': 'torpedo'}


def written(folder, **values):
    return write_vehicle(design_vehicle('v', **values), folder)


@pytest.mark.parametrize(
    ('values', 'kinds'),
    [
        (AIR | {'thrusters': 'quad'}, ['imu', 'magnetometer', 'barometer', 'gnss']),
        (WATER | {'thrusters': 'vectored8'}, ['imu', 'magnetometer', 'pressure']),
        (AIR | {'thrusters': 'hexa', 'sensors': ['imu', 'rangefinder']}, ['imu', 'rangefinder']),
        (AIR | {'thrusters': 'hexa', 'sensors': []}, []),
    ],
)
def test_a_new_vehicle_has_sensors(tmp_path, values, kinds):
    suite = SensorSuite(Simulation(written(tmp_path, **values).scene), 'v')
    assert sorted(sensor.config.kind for sensor in suite.sensors) == sorted(kinds)


def test_a_sensor_that_is_none_is_named(tmp_path):
    with pytest.raises(ConfigError, match=r"--sensors 'gps' is none.*allowed: imu, "):
        written(tmp_path, **AIR, thrusters='quad', sensors=['gps'])


@pytest.mark.parametrize(
    ('values', 'layout', 'protocols'),
    [
        (AIR, 'quad', {'px4', 'ardupilot'}),
        (AIR, 'hexa', set()),
        (WATER, 'vectored6', {'ardupilot'}),
        (WATER, 'vectored8', {'px4', 'ardupilot'}),
    ],
)
def test_a_known_frame_comes_with_its_mappings(tmp_path, values, layout, protocols):
    made = written(tmp_path, **values, thrusters=layout)
    assert {f'v_{protocol}.yaml' for protocol in protocols} == {
        path.name for path in made.files if path.stem.startswith('v_') and path.stem != 'v_vehicle'
    }
    thrusters = Simulation(made.scene).vehicle('v').thrusters
    for protocol in protocols:
        mapping, _ = load_mapping(protocol, 'v', str(tmp_path / f'v_{protocol}.yaml'))
        assert [entry.thruster for entry in mapping.actuators] == list(thrusters)
        assert not getattr(mapping, 'battery', None)


def test_the_throttle_of_hover_is_that_of_the_design():
    strong = design_vehicle('v', **AIR, thrusters='quad', max_thrust=2.0 * 9.81)
    assert 'MPC_THR_HOVER: {value: 0.5' in mappings_of(strong)['v_px4.yaml']
    # the x500: 1.66 times the weight; its shipped mapping was found by flying
    x500 = replace(strong, hover=strong.hover * 4 / 1.66)
    assert 'MPC_THR_HOVER: {value: 0.78' in mappings_of(x500)['v_px4.yaml']
    assert 'MOT_THST_HOVER: {value: 0.66' in mappings_of(x500)['v_ardupilot.yaml']


def test_a_torpedo_has_fins_and_holds_depth_and_heading_with_them(tmp_path):
    made = written(tmp_path, **TORPEDO)
    assert made.drift < 1e-6
    simulation = Simulation(made.scene)
    assert simulation.vehicle('v').joints == ('rudder', 'planes')
    assert 'foil' in simulation.terms['v']
    assert simulation.model.body_mass.sum() == pytest.approx(30.0, rel=1e-12)
    state = run_scene(made.scene, duration=30.0, hold=True)['vehicles']['v']
    x, y, z = state['position_w_m']
    assert x > 30.0 and abs(y) < 0.1
    assert z == pytest.approx(-3.8, abs=0.3)
