# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Logs of PX4 and ArduPilot of a flight of ours agree with our own log of it, to their quantisation.

The logs are written here from our MCAP, by the message definitions of the real programs and with
turns of axes that are written out; a real log with our MCAP of the same flight beside it does not
exist. Below, each axis, sign, order and unit by itself, with what it means written by hand.
"""

import math

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.reality.compare import Part, compare
from fluid_sim_ros.resources import models_folder
from test.support.autopilot_logs import ardupilot_log, named, px4_log
from test.support.flight_logs import frd, ned, ned_frd

#: Rounding of a float of 32 bits, over its size, and of a stamp [s].
FLOAT, TICK = 2.0**-23, 1e-6
XYZ = ('x', 'y', 'z')


@pytest.fixture(scope='module')
def ours(tmp_path_factory):
    folder = tmp_path_factory.mktemp('ours')
    scene = folder / 'x500.yaml'
    scene.write_text(
        f'model: {models_folder() / "x500"}.xml\nvehicles: {{x500: x500}}\nkeyframe: hover\n'
        'duration: 1.6\nschedule:\n'
        '  - {at: 0.0, thrust: {x500: [5.2, 5.2, 5.25, 5.25]}}\n'
        '  - {at: 0.4, thrust: {x500: [5.9, 5.2, 5.3, 5.6]}}\n'
        '  - {at: 0.6, thrust: {x500: [4.9, 5.6, 5.5, 5.0]}}\n'
    )
    assert main(['run', str(scene), '--record', str(folder / 'log.mcap')]) == 0
    return read_flight(next(folder.rglob('*.mcap')))


def px4_of(flight, begin=7.3):
    signal = flight.signals
    times = signal['position'].times
    force, speeds = signal['specific_force'], signal['rotor_speed']
    place = named(XYZ, ned(signal['position'].values))
    place |= named(('vx', 'vy', 'vz'), ned(signal['velocity'].values))
    felt = frd(force.between(times))
    motors = np.full((len(speeds.times), 12), np.nan)
    motors[:, :4] = speeds.values / 1000
    return px4_log({
        'vehicle_local_position_groundtruth': (begin + times, place),
        'vehicle_attitude_groundtruth': (
            begin + times, named([f'q[{i}]' for i in range(4)], ned_frd(signal['attitude'].values))
        ),
        'sensor_combined': (
            begin + times,
            named([f'gyro_rad[{i}]' for i in range(3)], frd(signal['rates'].values))
            | named([f'accelerometer_m_s2[{i}]' for i in range(3)], felt),
        ),
        'actuator_motors': (
            begin + speeds.times, named([f'control[{i}]' for i in range(12)], motors)
        ),
    })  # fmt: skip


def ardupilot_of(flight, begin=41.0):
    signal = flight.signals
    times = signal['position'].times
    felt = frd(signal['specific_force'].between(times))
    pulses = np.zeros((len(times), 14))
    pulses[:, :4] = 1000 + signal['rotor_speed'].between(times)
    return ardupilot_log({
        'SIM2': (
            begin + times,
            named(('PN', 'PE', 'PD'), ned(signal['position'].values))
            | named(('VN', 'VE', 'VD'), ned(signal['velocity'].values)),
        ),
        'SIM': (begin + times, named(('Q1', 'Q2', 'Q3', 'Q4'),
                                     ned_frd(signal['attitude'].values))),
        'IMU': (
            begin + times,
            named(('GyrX', 'GyrY', 'GyrZ'), frd(signal['rates'].values))
            | named(('AccX', 'AccY', 'AccZ'), felt),
        ),
        'RCOU': (begin + times, named([f'C{i}' for i in range(1, 15)], pulses)),
    })  # fmt: skip


@pytest.mark.parametrize(('ending', 'written'), [('ulg', px4_of), ('bin', ardupilot_of)])
def test_a_log_of_our_flight_is_our_own_log_to_its_quantisation(tmp_path, ours, ending, written):
    path = tmp_path / f'flight.{ending}'
    path.write_bytes(written(ours))

    flight = read_flight(path)

    assert flight.missing == ()
    for name in ('position', 'velocity', 'rates', 'specific_force'):
        found, wanted = flight.signals[name], ours.signals[name]
        times = ours.signals['position'].times
        assert np.ptp(wanted.values, axis=0).min() > 1e-3, name  # an axis at rest tells nothing
        np.testing.assert_allclose(found.times, times, atol=TICK)
        for axis, (a, b) in enumerate(zip(found.values.T, wanted.between(times).T, strict=True)):
            # of an angle's sine and cosine: what turns axes rounds, too
            assert np.abs(a - b).max() <= FLOAT * np.abs(b).max() + 1e-12, (name, axis)
    turned = rotations(flight.signals['attitude'].values).inv() * rotations(
        ours.signals['attitude'].values
    )
    assert turned.magnitude().max() < 4 * FLOAT
    assert flight.signals['position'].truth
    assert flight.signals['attitude'].truth
    drives = flight.actuators
    share = drives.values if ending == 'ulg' else (drives.values - 1000) / 1000
    speeds = ours.signals['rotor_speed'].between(ours.signals['position'].times)
    assert share.shape[1] == 4
    np.testing.assert_allclose(1000 * share, speeds, atol=1e-3 if ending == 'ulg' else 0.51)


def test_a_comparison_with_such_a_log_is_one_with_our_own(tmp_path, ours):
    """Outputs of PX4 by speed, on the model's own curve: the rotors lag once more, and no more."""
    path = tmp_path / 'flight.ulg'
    path.write_bytes(px4_of(ours))

    found = compare(read_flight(path), 'x500', part=Part(horizons=(0.1, 0.25)))

    assert found.numbers['driven_by'] == 'speed_share'
    assert np.median(found.errors['position_m'][:, 0]) < 2e-3
    assert np.median(found.errors['attitude_deg'][:, 0]) < 3.0


R, S, C = math.sqrt(0.5), math.sin(0.1), math.cos(0.1)
TURN = {'nose': (1.0, 0, 0), 'left': (0, 1.0, 0), 'up': (0, 0, 1.0)}
#: What the log has (north, east, down; forward, right, down; w x y z), and what it means here.
VECTORS = [
    ('position', (2, 0, 0), (0, 2, 0)), ('position', (0, 2, 0), (2, 0, 0)),
    ('position', (0, 0, 2), (0, 0, -2)),
    ('velocity', (3, 0, 0), (0, 3, 0)), ('velocity', (0, 3, 0), (3, 0, 0)),
    ('velocity', (0, 0, 3), (0, 0, -3)),
    ('rates', (1, 0, 0), (1, 0, 0)), ('rates', (0, 1, 0), (0, -1, 0)),
    ('rates', (0, 0, 1), (0, 0, -1)),
    ('specific_force', (5, 0, 0), (5, 0, 0)), ('specific_force', (0, 5, 0), (0, -5, 0)),
    ('specific_force', (0, 0, -9.81), (0, 0, 9.81)),
]  # fmt: skip
#: Attitude in the log; roll, pitch, yaw [deg]; where nose and top point: east, north, up.
ATTITUDES = [
    ('level, heading north', (1, 0, 0, 0), (0, 0, 0), (0, 1, 0), (0, 0, 1)),
    ('level, heading east', (R, 0, 0, R), (0, 0, 90), (1, 0, 0), (0, 0, 1)),
    ('level, heading west', (R, 0, 0, -R), (0, 0, 270), (-1, 0, 0), (0, 0, 1)),
    ('rolled right', (C, S, 0, 0), (math.degrees(0.2), 0, 0), (0, 1, 0),
     (math.sin(0.2), 0, math.cos(0.2))),
    ('pitched up', (C, 0, S, 0), (0, math.degrees(0.2), 0), (0, math.cos(0.2), math.sin(0.2)),
     (0, -math.sin(0.2), math.cos(0.2))),
    ('heading east, rolled right', (R * C, R * S, R * S, R * C),
     (math.degrees(0.2), 0, 90), (1, 0, 0), (0, -math.sin(0.2), math.cos(0.2))),
]  # fmt: skip
TIMES = 5.0 + 0.01 * np.arange(4)
PLACES = {
    'px4': {
        'position': ('vehicle_local_position_groundtruth', XYZ),
        'velocity': ('vehicle_local_position_groundtruth', ('vx', 'vy', 'vz')),
        'rates': ('sensor_combined', [f'gyro_rad[{i}]' for i in range(3)]),
        'specific_force': ('sensor_combined', [f'accelerometer_m_s2[{i}]' for i in range(3)]),
    },
    'SIM': {
        'position': ('SIM2', ('PN', 'PE', 'PD')), 'velocity': ('SIM2', ('VN', 'VE', 'VD')),
        'rates': ('IMU', ('GyrX', 'GyrY', 'GyrZ')),
        'specific_force': ('IMU', ('AccX', 'AccY', 'AccZ')),
    },
    'XKF1': {'position': ('XKF1', ('PN', 'PE', 'PD')), 'velocity': ('XKF1', ('VN', 'VE', 'VD'))},
}  # fmt: skip


def read(tmp_path, kind, stream, columns, values):
    path = tmp_path / ('flight.ulg' if kind == 'px4' else 'flight.bin')
    numbers = named(columns, np.tile(values, (len(TIMES), 1)))
    write = px4_log if kind == 'px4' else ardupilot_log
    path.write_bytes(write({stream: (TIMES, numbers)}))
    return read_flight(path)


@pytest.mark.parametrize(
    ('kind', 'quantity', 'there', 'here'),
    # an estimate has no sensors in it
    [(kind, *vector) for kind in PLACES for vector in VECTORS if vector[0] in PLACES[kind]],
)
def test_each_axis_of_each_vector(tmp_path, kind, quantity, there, here):
    flight = read(tmp_path, kind, *PLACES[kind][quantity], there)

    np.testing.assert_allclose(flight.signals[quantity].values, np.tile(here, (4, 1)), atol=1e-6)


@pytest.mark.parametrize(('stream', 'columns'), [
    ('vehicle_attitude_groundtruth', [f'q[{i}]' for i in range(4)]),
    ('SIM', ('Q1', 'Q2', 'Q3', 'Q4')), ('ATT', ('Roll', 'Pitch', 'Yaw')),
])  # fmt: skip
@pytest.mark.parametrize(('what', 'wxyz', 'rpy', 'nose', 'top'), ATTITUDES)
def test_each_attitude(tmp_path, stream, columns, what, wxyz, rpy, nose, top):
    kind = 'px4' if stream.startswith('vehicle') else 'ardupilot'
    flight = read(tmp_path, kind, stream, columns, rpy if stream == 'ATT' else wxyz)

    turn = rotations(flight.signals['attitude'].values[0])
    np.testing.assert_allclose(turn.apply([1, 0, 0]), nose, atol=1e-6, err_msg=what)
    np.testing.assert_allclose(turn.apply([0, 0, 1]), top, atol=1e-6, err_msg=what)
