# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs of flights as the programs of others write them, made from one known motion."""

import struct
import zlib
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline

GRAVITY = 9.80665


@dataclass(frozen=True)
class Motion:
    """A motion in SI, ENU and FLU: quaternions w x y z, rates and specific force in the body."""

    times: np.ndarray
    position: np.ndarray
    attitude: np.ndarray
    velocity: np.ndarray
    rates: np.ndarray
    specific_force: np.ndarray
    rotor_speed: np.ndarray


def motion(seconds=6.0, rate=200.0, seed=0):
    """Return a smooth motion on all axes, its derivatives exact."""
    times = np.arange(int(seconds * rate) + 1) / rate
    rng = np.random.default_rng(seed)
    knots = np.linspace(0, seconds, 3 * int(seconds) + 1)
    path = CubicSpline(knots, np.cumsum(rng.normal(0, 0.4, (len(knots), 3)), axis=0))
    turn = RotationSpline(
        knots, Rotation.from_rotvec(np.cumsum(rng.normal(0, 0.25, (len(knots), 3)), axis=0))
    )
    attitude = turn(times)
    force = attitude.inv().apply(path(times, 2) + np.array([0, 0, GRAVITY]))
    wxyz = np.roll(attitude.as_quat(), 1, axis=1)
    return Motion(
        times, path(times), wxyz, path(times, 1), turn(times, 1), force,
        1500 + 100 * np.sin(np.outer(times, [1.0, 1.3, 1.7, 2.1])),
    )  # fmt: skip


def ned(vectors):
    """North, east, down of ENU, written out."""
    return np.stack([vectors[:, 1], vectors[:, 0], -vectors[:, 2]], axis=1)


def frd(vectors):
    """Forward, right, down of FLU, written out."""
    return np.stack([vectors[:, 0], -vectors[:, 1], -vectors[:, 2]], axis=1)


def ned_frd(wxyz):
    """Attitude of FRD in NED: by what it does to three body axes."""
    matrix = Rotation.from_quat(np.roll(wxyz, -1, axis=1)).as_matrix()
    ahead, left, up = (matrix[:, :, i] for i in range(3))
    axes = np.stack([ned(ahead), ned(-left), ned(-up)], axis=2)
    return np.roll(Rotation.from_matrix(axes).as_quat(), 1, axis=1)


def usd(flight, version=2, damage=None):
    """Return the bytes of a log of the uSD deck; ``damage`` cuts so many bytes off its end."""
    names = [
        f'stateEstimate.{n}(f)' for n in ('x', 'y', 'z', 'qx', 'qy', 'qz', 'qw', 'vx', 'vy', 'vz')
    ]
    names += [f'{k}.{n}(f)' for k in ('gyro', 'acc') for n in 'xyz']
    names += [f'rpm.m{i}(H)' for i in range(1, 5)]
    content = struct.pack('<BHH', 0xBC, version, 1)
    content += struct.pack('<H', 0xFFFF) + b'fixedFrequency\0' + struct.pack('<H', len(names))
    content += b''.join(name.encode() + b'\0' for name in names)
    letter, ticks = {1: ('I', 1e3), 2: ('Q', 1e6)}[version]
    xyzw = np.roll(flight.attitude, -1, axis=1)
    rows = np.hstack([
        flight.position, xyzw, flight.velocity, np.degrees(flight.rates),
        flight.specific_force / GRAVITY,
    ])  # fmt: skip
    for time, row, speed in zip(flight.times, rows, flight.rotor_speed, strict=True):
        content += struct.pack(f'<H{letter}', 0xFFFF, round((10 + time) * ticks))
        content += struct.pack('<16f4H', *row, *np.rint(speed * 30 / np.pi).astype(int))
    content += struct.pack('<I', zlib.crc32(content))
    return content if damage is None else content[:-damage]


def ulog(topics):
    """Return the bytes of a ULog; topics: name -> (times [s], {field: (letter, values)})."""
    kinds = {'f': 'float', 'Q': 'uint64_t', 'B': 'uint8_t', 'd': 'double'}
    content = b'ULog\x01\x12\x35\x01' + struct.pack('<Q', 0)

    def message(kind, body):
        return struct.pack('<HB', len(body), ord(kind)) + body

    key = b'char[3] sys_name'
    content += message('B', bytes(40))
    content += message('I', bytes([len(key)]) + key + b'PX4')
    for name, (_, fields) in topics.items():
        parts = ''.join(f'{kinds[letter]} {field};' for field, (letter, _) in fields.items())
        content += message('F', f'{name}:uint64_t timestamp;{parts}'.encode())
    for number, name in enumerate(topics):
        content += message('A', struct.pack('<BH', 0, number) + name.encode())
    for number, (times, fields) in enumerate(topics.values()):
        letters = '<HQ' + ''.join(letter for letter, _ in fields.values())
        table = np.stack([values for _, values in fields.values()], axis=1)
        for time, row in zip(times, table.tolist(), strict=True):
            content += message('D', struct.pack(letters, number, round(time * 1e6), *row))
    return content


def px4(flight, **others):
    """Return the topics of a PX4 log of a motion."""

    def of(names, values):
        return {name: ('f', column) for name, column in zip(names, values.T, strict=True)}

    local = of(('x', 'y', 'z'), ned(flight.position)) | of(
        ('vx', 'vy', 'vz'), ned(flight.velocity)
    )
    return {
        'vehicle_local_position': (flight.times, local),
        'vehicle_attitude': (
            flight.times, of([f'q_{i}' for i in range(4)], ned_frd(flight.attitude)),
        ),
        'sensor_combined': (
            flight.times,
            of([f'gyro_{i}' for i in range(3)], frd(flight.rates))
            | of([f'acc_{i}' for i in range(3)], frd(flight.specific_force)),
        ),
        'actuator_motors': (
            flight.times, of([f'control_{i}' for i in range(4)], flight.rotor_speed / 2000),
        ),
    } | others  # fmt: skip


def dataflash(messages):
    """Return the bytes of a DataFlash log; messages: (name, format, columns, rows of numbers)."""
    sizes = {'Q': 8, 'f': 4, 'B': 1, 'H': 2, 'd': 8}
    content = b''

    def describe(number, length, name, letters, columns):
        return struct.pack(
            '<BBBBB4s16s64s', 0xA3, 0x95, 128, number, length, name.encode(), letters.encode(),
            columns.encode(),
        )  # fmt: skip

    content += describe(128, 89, 'FMT', 'BBnNZ', 'Type,Length,Name,Format,Columns')
    timed = []
    for number, (name, letters, columns, rows) in enumerate(messages, 130):
        length = 3 + sum(sizes[letter] for letter in letters)
        content += describe(number, length, name, letters, columns)
        head = struct.pack('<BBB', 0xA3, 0x95, number)
        timed += [(row[0], head + struct.pack(f'<{letters}', *row)) for row in rows]
    return content + b''.join(data for _, data in sorted(timed, key=lambda pair: pair[0]))


def ardupilot(flight):
    """Return the messages of an ArduPilot log of a motion."""
    micro = np.rint((20 + flight.times) * 1e6).astype(int).tolist()

    def rows(*blocks):
        table = np.hstack(blocks).tolist()
        return [(time, *row) for time, row in zip(micro, table, strict=True)]

    core = [[0.0]] * len(micro)
    pulses = np.rint(1000 + 500 * flight.rotor_speed / 2000).astype(int)
    euler = Rotation.from_quat(np.roll(ned_frd(flight.attitude), -1, axis=1)).as_euler('ZYX')
    return [
        ('XKF1', 'Qffffff', 'TimeUS,PN,PE,PD,VN,VE,VD',
         rows(ned(flight.position), ned(flight.velocity))),
        ('ATT', 'Qfff', 'TimeUS,Roll,Pitch,Yaw', rows(np.degrees(euler[:, ::-1]))),
        ('IMU', 'Qfffffff', 'TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ',
         rows(core, frd(flight.rates), frd(flight.specific_force))),
        ('RCOU', 'QHHHHHHHH', 'TimeUS,C1,C2,C3,C4,C5,C6,C7,C8',
         [(time, *row, 0, 0, 0, 0) for time, row in zip(micro, pulses.tolist(), strict=True)]),
    ]  # fmt: skip


def table(flight, **changed):
    """Return the columns of a table of a motion; ``changed`` replaces some."""
    columns = {'time': flight.times}
    blocks = {
        'position': ('xyz', flight.position), 'attitude': ('wxyz', flight.attitude),
        'velocity': ('xyz', flight.velocity), 'rates': ('xyz', flight.rates),
        'specific_force': ('xyz', flight.specific_force),
        'rotor_speed': ('1234', flight.rotor_speed),
    }  # fmt: skip
    for name, (endings, values) in blocks.items():
        for ending, column in zip(endings, values.T, strict=True):
            columns[f'{name}_{ending}'] = column
    return columns | changed


def csv_text(columns):
    """Return columns as CSV; a number that is none becomes an empty cell."""
    lines = [','.join(columns)]
    for row in zip(*columns.values(), strict=True):
        lines.append(','.join('' if value != value else repr(float(value)) for value in row))
    return '\n'.join(lines) + '\n'
