# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every format gives back the motion that was written: no axis, sign, unit or order is wrong."""

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from fluid_sim_ros.flights.checks.consistency import check_flight
from fluid_sim_ros.flights.mapping import FlightMap
from fluid_sim_ros.flights.reader import read_flight
from test.support import flight_logs as logs

FLIGHT = logs.motion()
#: Names of arrays as pyulog has them, from those that ``flight_logs`` writes.
PX4 = {
    'signals': {
        'position': {
            'stream': 'vehicle_local_position', 'columns': ['x', 'y', 'z'], 'axes': 'ned',
        },
        'velocity': {
            'stream': 'vehicle_local_position', 'columns': ['vx', 'vy', 'vz'], 'axes': 'ned',
        },
        'attitude': {
            'stream': 'vehicle_attitude', 'columns': ['q_0', 'q_1', 'q_2', 'q_3'],
            'axes': 'ned_frd',
        },
        'rates': {
            'stream': 'sensor_combined', 'columns': ['gyro_0', 'gyro_1', 'gyro_2'], 'axes': 'frd',
        },
        'specific_force': {
            'stream': 'sensor_combined', 'columns': ['acc_0', 'acc_1', 'acc_2'], 'axes': 'frd',
        },
        'normalized': {'stream': 'actuator_motors', 'columns': ['control_*']},
    },
}  # fmt: skip


def turned_by(first, second):
    """Return the angles between attitudes [rad]."""
    return 2 * np.arccos(np.clip(np.abs(np.sum(first * second, axis=1)), 0, 1))


def holds(flight, step, names=('position', 'velocity', 'rates', 'specific_force')):
    """Assert that a flight is the motion that was written, to its quantisation."""
    for name in names:
        signal = flight.signals[name]
        wanted = getattr(FLIGHT, name)
        assert len(signal.times) == len(wanted)
        assert np.abs(signal.values - wanted).max() < step.get(name, 1e-5), name
        np.testing.assert_allclose(signal.times, FLIGHT.times, atol=step.get('time', 1e-6))
    assert turned_by(flight.signals['attitude'].values, FLIGHT.attitude).max() < 2e-3
    for check in check_flight(flight):
        assert check.finding == '', check
        assert check.error is None or check.error < 0.05 or 'after' in check.what
        if check.offset is not None and 'after' not in check.what:
            assert abs(check.offset) < 0.003


@pytest.mark.parametrize(('version', 'tick'), [(1, 6e-4), (2, 1e-6)])
def test_a_uSD_log_of_both_versions(tmp_path, version, tick):
    path = tmp_path / 'log00'
    path.write_bytes(logs.usd(FLIGHT, version))

    flight = read_flight(path)

    holds(flight, {'time': tick})
    assert flight.raw.faults == ()
    speed = flight.signals['rotor_speed']
    assert speed.names == ('m1', 'm2', 'm3', 'm4')
    assert np.abs(speed.values - FLIGHT.rotor_speed).max() < 0.5 * np.pi / 30 + 1e-9
    assert flight.missing == ()


def test_a_log_of_PX4(tmp_path):
    path = tmp_path / 'flight.ulg'
    path.write_bytes(logs.ulog(logs.px4(FLIGHT)))

    flight = read_flight(path, FlightMap.model_validate(PX4))

    holds(flight, {})
    np.testing.assert_allclose(
        flight.signals['normalized'].values, FLIGHT.rotor_speed / 2000, atol=1e-6
    )
    assert flight.raw.about['software'] == 'PX4'


def test_of_a_simulated_flight_the_truth_is_taken(tmp_path):
    truth = logs.px4(FLIGHT)['vehicle_local_position']
    off = (truth[0], {name: (letter, 1 + v) for name, (letter, v) in truth[1].items()})
    path = tmp_path / 'flight.ulg'
    path.write_bytes(
        logs.ulog({'vehicle_local_position': off, 'vehicle_local_position_groundtruth': truth})
    )

    signal = read_flight(path).signals['position']

    assert signal.truth
    assert np.abs(signal.values - FLIGHT.position).max() < 1e-5


def test_a_log_of_ArduPilot(tmp_path):
    path = tmp_path / 'flight.bin'
    path.write_bytes(logs.dataflash(logs.ardupilot(FLIGHT)))

    flight = read_flight(path)

    holds(flight, {})
    assert flight.signals['attitude'].stated == 'rpy ned_frd'
    pulse = flight.signals['pulse']  # the four channels that nothing is connected to are left out
    assert pulse.values.shape == (len(FLIGHT.times), 4)
    assert np.abs(pulse.values - 1000 - FLIGHT.rotor_speed / 4).max() <= 0.5


def odometry(store, index):
    t = store.types
    position, wxyz = FLIGHT.position[index], FLIGHT.attitude[index]
    body = logs.Rotation.from_quat(np.roll(wxyz, -1)).inv().apply(FLIGHT.velocity[index])
    w, x, y, z = wxyz
    vector = t['geometry_msgs/msg/Vector3']
    return t['nav_msgs/msg/Odometry'](
        header=header(store, index),
        child_frame_id='base_link',
        pose=t['geometry_msgs/msg/PoseWithCovariance'](
            pose=t['geometry_msgs/msg/Pose'](
                position=t['geometry_msgs/msg/Point'](*position),
                orientation=t['geometry_msgs/msg/Quaternion'](x=x, y=y, z=z, w=w),
            ),
            covariance=np.zeros(36),
        ),
        twist=t['geometry_msgs/msg/TwistWithCovariance'](
            twist=t['geometry_msgs/msg/Twist'](
                linear=vector(*body), angular=vector(*FLIGHT.rates[index])
            ),
            covariance=np.zeros(36),
        ),
    )


def header(store, index):
    nanoseconds = round((1000 + FLIGHT.times[index]) * 1e9)
    stamp = store.types['builtin_interfaces/msg/Time'](
        sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9
    )
    return store.types['std_msgs/msg/Header'](stamp=stamp, frame_id='map')


def joints(store, index):
    return store.types['sensor_msgs/msg/JointState'](
        header=header(store, index), name=['m3', 'm1', 'm2', 'm4'],
        position=np.zeros(0), velocity=FLIGHT.rotor_speed[index], effort=np.zeros(0),
    )  # fmt: skip


def imu(store, index):
    t = store.types
    vector = t['geometry_msgs/msg/Vector3']
    return t['sensor_msgs/msg/Imu'](
        header=header(store, index),
        orientation=t['geometry_msgs/msg/Quaternion'](x=0.0, y=0.0, z=0.0, w=1.0),
        orientation_covariance=-np.ones(9),
        angular_velocity=vector(*FLIGHT.rates[index]),
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector(*FLIGHT.specific_force[index]),
        linear_acceleration_covariance=np.zeros(9),
    )


@pytest.mark.parametrize('storage', [StoragePlugin.SQLITE3, StoragePlugin.MCAP])
def test_a_bag_of_ROS_2_in_both_storages(tmp_path, storage):
    store = get_typestore(Stores.ROS2_JAZZY)
    bag = tmp_path / 'bag'
    topics = {
        '/drone/odometry': ('nav_msgs/msg/Odometry', odometry),
        '/drone/rotors': ('sensor_msgs/msg/JointState', joints),
        '/drone/imu': ('sensor_msgs/msg/Imu', imu),
    }
    with Writer(bag, version=8, storage_plugin=storage) as writer:
        for topic, (kind, make) in topics.items():
            connection = writer.add_connection(topic, kind, typestore=store)
            for index in range(len(FLIGHT.times)):
                # logged 30 ms late: the stamp of the header counts
                log_ns = round((1000.03 + FLIGHT.times[index]) * 1e9)
                writer.write(connection, log_ns, store.serialize_cdr(make(store, index), kind))
    path = bag if storage == StoragePlugin.SQLITE3 else next(bag.glob('*.mcap'))

    flight = read_flight(path)

    holds(flight, {})
    assert flight.signals['rotor_speed'].names == ('m3', 'm1', 'm2', 'm4')


@pytest.mark.parametrize('kind', ['csv', 'parquet'])
def test_a_table(tmp_path, kind):
    path = tmp_path / f'flight.{kind}'
    columns = logs.table(FLIGHT)
    if kind == 'csv':
        path.write_text(logs.csv_text(columns))
    else:
        import pyarrow as pa
        import pyarrow.parquet as pq

        pq.write_table(pa.table(columns), path)

    flight = read_flight(path)

    holds(flight, {}, ('position', 'velocity', 'rates', 'specific_force', 'rotor_speed'))


def test_a_table_with_names_and_units_of_its_own(tmp_path):
    path = tmp_path / 'flight.csv'
    blocks = {'p': logs.ned(FLIGHT.position) * 1e3, 'w': np.degrees(logs.frd(FLIGHT.rates))}
    columns = {'stamp': FLIGHT.times * 1e3}
    columns |= {f'{n}{i}': v for n, b in blocks.items() for i, v in enumerate(b.T)}
    path.write_text(logs.csv_text(columns))
    mapping = {
        'time': {'column': 'stamp', 'unit': 'ms'},
        'signals': {
            'position': {
                'stream': 'table', 'columns': ['p0', 'p1', 'p2'], 'unit': 'mm', 'axes': 'ned',
            },
            'rates': {
                'stream': 'table', 'columns': ['w0', 'w1', 'w2'], 'unit': 'deg/s', 'axes': 'frd',
            },
        },
    }  # fmt: skip

    flight = read_flight(path, FlightMap.model_validate(mapping))

    np.testing.assert_allclose(flight.signals['position'].values, FLIGHT.position, atol=1e-9)
    np.testing.assert_allclose(flight.signals['rates'].values, FLIGHT.rates, atol=1e-9)
    np.testing.assert_allclose(flight.signals['rates'].times, FLIGHT.times, atol=1e-9)


def two_vehicles(folder):
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(folder, version=8, storage_plugin=StoragePlugin.MCAP) as writer:
        for name in ('a', 'b'):
            for topic, (kind, make) in {
                f'/{name}/odometry': ('nav_msgs/msg/Odometry', odometry),
                f'/{name}/rotors': ('sensor_msgs/msg/JointState', joints),
            }.items():
                connection = writer.add_connection(topic, kind, typestore=store)
                for index in range(100):
                    log_ns = round((1000 + FLIGHT.times[index]) * 1e9)
                    message = store.serialize_cdr(make(store, index), kind)
                    writer.write(connection, log_ns, message)
    return folder


def test_of_two_vehicles_in_a_bag_the_named_one_is_taken_and_else_it_is_said(tmp_path):
    bag = two_vehicles(tmp_path / 'bag')

    assert any('2 topics would do (/a/odometry, /b/odometry)' in n for n in read_flight(bag).notes)
    flight = read_flight(bag, FlightMap(vehicle='b'))
    assert flight.notes == ()
    assert flight.signals['position'].source.startswith('/b/odometry')
    assert flight.signals['rotor_speed'].source.startswith('/b/rotors')


def test_info_of_a_bag_of_others_shows_its_signals_and_no_damage(tmp_path, capsys):
    from fluid_sim_ros.cli import main

    bag = two_vehicles(tmp_path / 'bag')

    assert main(['info', str(bag)]) == 0
    shown = capsys.readouterr().out
    assert 'rotor_speed' in shown
    assert 'damaged' not in shown
    # a writer that makes no checksums has damaged nothing
    from fluid_sim_ros.recording.reader import open_log

    assert open_log(next(bag.glob('*.mcap'))).faults == []


def test_a_bag_that_was_cut_off_is_read_up_to_there(tmp_path):
    file = next(two_vehicles(tmp_path / 'bag').glob('*.mcap'))
    content = file.read_bytes()
    file.write_bytes(content[: len(content) - 5000])

    flight = read_flight(file)

    assert len(flight.signals['position'].times) == 100
    assert 'damaged' in flight.raw.faults[0]
