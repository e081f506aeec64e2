# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Logs as PX4 and ArduPilot write them: their own message definitions, filled by name.

The definitions are those of logs of the real programs: PX4 main of March 2026, ArduCopter 4.7-dev.
"""

import struct

import numpy as np

#: Fields after the timestamp; of arrays, each element.
PX4 = {
    'vehicle_local_position_groundtruth': (
        'uint64_t timestamp_sample;uint64_t ref_timestamp;double ref_lat;double ref_lon;float x;'
        'float y;float z;float[2] delta_xy;float delta_z;float vx;float vy;float vz;float z_deriv;'
        'float[2] delta_vxy;float delta_vz;float ax;float ay;float az;float heading;'
    ),
    'vehicle_attitude_groundtruth': (
        'uint64_t timestamp_sample;float[4] q;float[4] delta_q_reset;uint8_t quat_reset_counter;'
        'uint8_t[7] _padding0;'
    ),
    'sensor_combined': (
        'float[3] gyro_rad;uint32_t gyro_integral_dt;int32_t accelerometer_timestamp_relative;'
        'float[3] accelerometer_m_s2;uint32_t accelerometer_integral_dt;'
        'uint8_t accelerometer_clipping;uint8_t gyro_clipping;uint8_t accel_calibration_count;'
        'uint8_t gyro_calibration_count;'
    ),
    'actuator_motors': (
        'uint64_t timestamp_sample;float[12] control;uint16_t reversible_flags;'
        'uint8_t[6] _padding0;'
    ),
}  # fmt: skip
_ULOG = {'uint64_t': 'Q', 'uint32_t': 'I', 'int32_t': 'i', 'uint16_t': 'H', 'uint8_t': 'B',
         'double': 'd', 'float': 'f'}  # fmt: skip
#: Name -> (number, format, columns).
ARDUPILOT = {
    'SIM': (77, 'QccCfLLffff', 'TimeUS,Roll,Pitch,Yaw,Alt,Lat,Lng,Q1,Q2,Q3,Q4'),
    'SIM2': (252, 'QdddfffffI', 'TimeUS,PN,PE,PD,VN,VE,VD,As,ASpdU,UFC'),
    'ATT': (72, 'QffffffB', 'TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw,AEKF'),
    'XKF1': (44, 'QBccCfffffffccce',
             'TimeUS,C,Roll,Pitch,Yaw,VN,VE,VD,dPD,PN,PE,PD,GX,GY,GZ,OH'),
    'IMU': (164, 'QBffffffIIfBBHH',
            'TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz'),
    'RCOU': (62, 'QHHHHHHHHHHHHHH', 'TimeUS,C1,C2,C3,C4,C5,C6,C7,C8,C9,C10,C11,C12,C13,C14'),
}  # fmt: skip
#: Letter of DataFlash -> letter of struct and factor; c and e: hundredths.
_DATAFLASH = {
    'Q': ('Q', 1), 'd': ('d', 1), 'f': ('f', 1), 'B': ('B', 1), 'H': ('H', 1), 'I': ('I', 1),
    'L': ('i', 1e7), 'c': ('h', 100), 'C': ('H', 100), 'e': ('i', 100),
}  # fmt: skip


def _fields(definition):
    """Yield letter and name of each number of a definition."""
    for field in definition.rstrip(';').split(';'):
        kind, name = field.split()
        plain, _, count = kind.partition('[')
        if not count:
            yield _ULOG[plain], name
            continue
        for i in range(int(count.rstrip(']'))):
            yield _ULOG[plain], f'{name}[{i}]'


def px4_log(topics):
    """Return a ULog; topics: name -> (times [s], {element: numbers}); what is not named is 0."""

    def message(kind, body):
        return struct.pack('<HB', len(body), ord(kind)) + body

    key = b'char[3] sys_name'
    content = b'ULog\x01\x12\x35\x01' + struct.pack('<Q', 0) + message('B', bytes(40))
    content += message('I', bytes([len(key)]) + key + b'PX4')
    for name in topics:
        content += message('F', f'{name}:uint64_t timestamp;{PX4[name]}'.encode())
    for number, name in enumerate(topics):
        content += message('A', struct.pack('<BH', 0, number) + name.encode())
    rows = []
    for number, (name, (times, numbers)) in enumerate(topics.items()):
        # what only fills a struct up at its end is described, and not logged
        fields = [field for field in _fields(PX4[name]) if not field[1].startswith('_padding')]
        assert set(numbers) <= {field for _, field in fields}, name
        packed = struct.Struct('<HQ' + ''.join(letter for letter, _ in fields))
        for i, time in enumerate(times):
            values = [_whole(letter, numbers[field][i]) if field in numbers else 0
                      for letter, field in fields]  # fmt: skip
            rows.append((time, packed.pack(number, round(time * 1e6), *values)))
    return content + b''.join(message('D', row) for _, row in sorted(rows, key=lambda r: r[0]))


def _whole(letter, number):
    return float(number) if letter in 'fd' else round(float(number))


def ardupilot_log(messages):
    """Return a DataFlash log; messages: name -> (times [s], {column: numbers})."""

    def described(number, length, name, letters, columns):
        return struct.pack(
            '<BBBBB4s16s64s', 0xA3, 0x95, 128, number, length, name.encode(), letters.encode(),
            columns.encode(),
        )  # fmt: skip

    content = described(128, 89, 'FMT', 'BBnNZ', 'Type,Length,Name,Format,Columns')
    rows = []
    for name, (times, numbers) in messages.items():
        number, letters, columns = ARDUPILOT[name]
        kinds = [_DATAFLASH[letter] for letter in letters]
        packed = struct.Struct('<BBB' + ''.join(letter for letter, _ in kinds))
        content += described(number, packed.size, name, letters, columns)
        names = columns.split(',')
        assert set(numbers) <= set(names), name
        for i, time in enumerate(times):
            values = [
                _whole(letter, factor * numbers[column][i]) if column in numbers else 0
                for (letter, factor), column in zip(kinds[1:], names[1:], strict=True)
            ]
            rows.append((time, packed.pack(0xA3, 0x95, number, round(time * 1e6), *values)))
    return content + b''.join(row for _, row in sorted(rows, key=lambda r: r[0]))


def named(names, values):
    """Return {name: column} of a table, shape (n, k)."""
    return dict(zip(names, np.asarray(values, dtype=float).T, strict=True))
