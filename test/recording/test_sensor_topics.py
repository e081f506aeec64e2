# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensor topics without ROS: what stands in them, when, and that a flight can be repeated."""

import math

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.recording.decode import fields
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.sensors import SensorSuite
from test.support.recorded_flights import record_flight

TOPICS = {
    'x500': ['gps/fix', 'gps/vel', 'imu/data_raw', 'imu/mag', 'pressure', 'range'],
    'rov': ['dvl/altitude', 'dvl/twist', 'imu/data_raw', 'imu/mag', 'water/pressure'],
}


def vector(found, name):
    return [found[f'{name}.{axis}'] for axis in 'xyz']


@pytest.mark.parametrize('scene', TOPICS)
def test_messages_hold_the_readings(scene):
    simulation = Simulation(scene)
    name = next(iter(simulation.vehicles))
    states = StateTopics(simulation, DEFAULTS)
    sensors = [t for t in states.topics if not t.quality.reliable and not t.new_name]
    topics = {t.name.removeprefix(f'{name}/'): t for t in sensors}
    assert sorted(topics) == TOPICS[scene]
    suite = SensorSuite(simulation, name)
    for _ in range(3):
        states.take_state()
        found = {
            key: fields(definition(topic.type).text, data)
            for key, topic in topics.items()
            if (data := states.data(topic))
        }
        simulation.step(100)
    simulation.reset()
    for _ in range(100):  # 200 steps, up to the same boundary
        suite.update()
        simulation.step(2)
    suite.update()
    for key, message in found.items():
        assert message['header.stamp.sec'] * 10**9 + message['header.stamp.nanosec'] == 400_000_000
        frame = 'map' if key == 'gps/vel' else f'{name}/{FRAMES[key]}'
        assert message['header.frame_id'] == frame
    imu, rate = found['imu/data_raw'], 100.0
    assert vector(imu, 'linear_acceleration') == suite.imu.specific_force.tolist()
    assert vector(imu, 'angular_velocity') == suite.imu.angular_velocity.tolist()
    assert imu['orientation_covariance[0]'] == -1
    gyroscope = suite.imu.config.gyroscope
    variance = gyroscope.density**2 * rate + gyroscope.resolution**2 / 12
    assert imu['angular_velocity_covariance[4]'] == pytest.approx(variance)
    assert vector(found['imu/mag'], 'magnetic_field') == suite.magnetometer.field.tolist()
    if scene == 'x500':
        assert found['pressure']['fluid_pressure'] == suite.barometer.pressure
        assert found['range']['range'] == np.float32(suite.rangefinder.distance)
        assert 'gps/fix' not in found  # its readings come 0.1 s late, at other steps than these
    else:
        assert found['water/pressure']['fluid_pressure'] == suite.pressure.pressure
        assert vector(found['dvl/twist'], 'twist.twist.linear') == suite.dvl.velocity.tolist()
        assert found['dvl/altitude']['range'] == np.float32(suite.dvl.altitude)


FRAMES = {
    'imu/data_raw': 'imu', 'imu/mag': 'magnetometer', 'pressure': 'barometer',
    'range': 'rangefinder', 'water/pressure': 'pressure', 'dvl/twist': 'dvl',
    'dvl/altitude': 'dvl', 'gps/fix': 'gnss',
}  # fmt: skip


def test_late_readings_appear_late_with_their_own_stamp(tmp_path):
    simulation = record_flight(tmp_path / 'a.mcap', 'x500', seconds=1.0)
    log = open_log(tmp_path / 'a.mcap')
    found = [
        (m.log_ns, fields(log.topic(m.topic).definition, m.data))
        for m in log.messages(['/x500/gps/fix'])
    ]
    # measured at 0, 0.1, ... and read 0.1 s later
    assert [ns for ns, _ in found] == [100_000_000 * k for k in range(1, 11)]
    stamps = [f['header.stamp.sec'] * 10**9 + f['header.stamp.nanosec'] for _, f in found]
    assert stamps == [ns - 100_000_000 for ns, _ in found]
    home = simulation.scene.home
    for _, fix in found:
        assert abs(fix['latitude'] - home.latitude) < 1e-4
        assert abs(fix['longitude'] - home.longitude) < 1e-4
        assert (fix['status.status'], fix['position_covariance_type']) == (0, 2)
        assert fix['position_covariance[0]'] == pytest.approx(0.04)


# a part of the topics leaves steps out at which a late sensor measures
@pytest.mark.parametrize('topics', [('*',), ('*/gps/fix',), ('*/gps/*', '/clock')])
def test_a_flight_with_sensors_is_repeated_to_the_last_bit(tmp_path, topics):
    path = tmp_path / 'a.mcap'
    record_flight(path, 'x500', seconds=1.5, seed=4, topics=topics)
    result = resimulate(open_log(path))
    assert result.compared > 10
    assert result.difference is None


def test_readings_do_not_depend_on_what_else_is_recorded(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'x500', seconds=0.6, piloted=False)
    record_flight(
        tmp_path / 'b.mcap',
        'x500',
        seconds=0.6,
        piloted=False,
        topics=('*/imu/data_raw', '*/gps/vel'),
    )
    for topic in ('/x500/imu/data_raw', '/x500/gps/vel'):
        first, second = (
            [(m.step, m.data) for m in open_log(tmp_path / name).messages([topic])]
            for name in ('a.mcap', 'b.mcap')
        )
        assert first and first == second


def test_a_log_states_the_quality_of_sensors(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'x500', seconds=0.1, piloted=False)
    topics = open_log(tmp_path / 'a.mcap').topics.values()
    offered = {t.name: t.metadata['offered_qos_profiles'] for t in topics}
    assert 'reliability: best_effort' in offered['/x500/imu/data_raw']
    assert 'reliability: reliable' in offered['/x500/odom']


def test_frames_of_sensors_stand_on_the_vehicle(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'x500', seconds=0.1, piloted=False)
    log = open_log(tmp_path / 'a.mcap')
    message = next(iter(log.messages(['/tf_static'])))
    found = fields(log.topic('/tf_static').definition, message.data)
    children = {found[f'transforms[{i}].child_frame_id']: i for i in range(6)}
    i = children['x500/rangefinder']
    assert found[f'transforms[{i}].header.frame_id'] == 'x500/base_link'
    w, x, y, z = (found[f'transforms[{i}].transform.rotation.{a}'] for a in 'wxyz')
    # x of a range's frame lies along its ray, here straight down
    forward = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]
    assert forward == pytest.approx([0, 0, -1], abs=1e-15)
    i = children['x500/imu']
    assert found[f'transforms[{i}].transform.rotation.w'] == 1.0
    assert not math.isnan(found[f'transforms[{i}].transform.translation.x'])


def test_the_former_name_of_imu_data_raw_is_recorded_only_where_it_is_asked_for(tmp_path):
    """Such as in logs of the last release, which are flown again as before."""
    for patterns in (('*',), ('!*/odom',), ('*/imu/*',)):
        path = tmp_path / f'{len(list(tmp_path.iterdir()))}.mcap'
        record_flight(path, 'x500', seconds=0.1, piloted=False, topics=patterns)
        names = open_log(path).topics.values()
        assert '/x500/imu/data_raw' in [topic.name for topic in names]
        assert '/x500/imu/data' not in [topic.name for topic in names]
    path = tmp_path / 'old.mcap'
    record_flight(
        path, 'x500', seconds=0.3, piloted=False, topics=('*/imu/data', '*/imu/data_raw')
    )
    log = open_log(path)
    messages = {name: [m.data for m in log.messages([name])] for name in (
        '/x500/imu/data', '/x500/imu/data_raw'
    )}  # fmt: skip
    assert messages['/x500/imu/data'] == messages['/x500/imu/data_raw'] != []
    outcome = resimulate(log)
    assert outcome.compared and outcome.difference is None
