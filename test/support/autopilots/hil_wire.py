# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
MAVLink 2 read and written by hand, from its specification: the oracle of the codec.

Frame: 0xFD, payload length, two flags, sequence, system, component, id (3 bytes), payload without
its trailing zeros, CRC-16/MCRF4XX of all but the first byte and of an extra byte per message
(https://mavlink.io/en/guide/serialization.html). Fields stand by size, extensions behind.
"""

import struct
from typing import NamedTuple


class Layout(NamedTuple):
    name: str
    crc_extra: int
    format: str
    fields: tuple[str, ...]


def _layout(name: str, crc_extra: int, form: str, fields: str) -> Layout:
    return Layout(name, crc_extra, '<' + form.replace(' ', ''), tuple(fields.split()))


LAYOUTS = {
    0: _layout(
        'HEARTBEAT', 50, 'I 5B',
        'custom_mode type autopilot base_mode system_status mavlink_version',
    ),
    20: _layout(
        'PARAM_REQUEST_READ', 214, 'h BB 16s',
        'param_index target_system target_component param_id',
    ),
    22: _layout(
        'PARAM_VALUE', 220, 'f HH 16s B',
        'param_value param_count param_index param_id param_type',
    ),
    65: _layout(
        'RC_CHANNELS', 118, 'I 18H BB',
        'time_boot_ms ' + ' '.join(f'chan{i}_raw' for i in range(1, 19)) + ' chancount rssi',
    ),
    76: _layout(
        'COMMAND_LONG', 152, '7f H BBB',
        'param1 param2 param3 param4 param5 param6 param7 command target_system '
        'target_component confirmation',
    ),
    93: _layout('HIL_ACTUATOR_CONTROLS', 47, 'Q Q 16f B', 'time_usec flags controls:16 mode'),
    107: _layout(
        'HIL_SENSOR', 108, 'Q 13f I B',
        'time_usec xacc yacc zacc xgyro ygyro zgyro xmag ymag zmag abs_pressure diff_pressure '
        'pressure_alt temperature fields_updated id',
    ),
    113: _layout(
        'HIL_GPS', 124, 'Q 3i 3H 3h H BB B H',
        'time_usec lat lon alt eph epv vel vn ve vd cog fix_type satellites_visible id yaw',
    ),
    115: _layout(
        'HIL_STATE_QUATERNION', 4, 'Q 4f 3f 3i 3h 2H 3h',
        'time_usec attitude_quaternion:4 rollspeed pitchspeed yawspeed lat lon alt vx vy vz '
        'ind_airspeed true_airspeed xacc yacc zacc',
    ),
    114: _layout(
        'HIL_OPTICAL_FLOW', 237, 'Q I 5f I f h BB',
        'time_usec integration_time_us integrated_x integrated_y integrated_xgyro '
        'integrated_ygyro integrated_zgyro time_delta_distance_us distance temperature sensor_id '
        'quality',
    ),
    132: _layout(
        'DISTANCE_SENSOR', 85, 'I 3H 4B 2f 4f B',
        'time_boot_ms min_distance max_distance current_distance type id orientation covariance '
        'horizontal_fov vertical_fov quaternion:4 signal_quality',
    ),
    147: _layout(
        'BATTERY_STATUS', 154, 'i i h 10H h BBB b',
        'current_consumed energy_consumed temperature voltages:10 current_battery id '
        'battery_function type battery_remaining',
    ),
    331: _layout(
        'ODOMETRY', 91, 'Q 3f 4f 3f 3f 21f 21f BB BBb',
        'time_usec x y z q:4 vx vy vz rollspeed pitchspeed yawspeed pose_covariance:21 '
        'velocity_covariance:21 frame_id child_frame_id reset_counter estimator_type quality',
    ),
}  # fmt: skip
IDS = {layout.name: identity for identity, layout in LAYOUTS.items()}


def checksum(data: bytes) -> int:
    """CRC-16/MCRF4XX."""
    crc = 0xFFFF
    for byte in data:
        low = byte ^ (crc & 0xFF)
        low = (low ^ (low << 4)) & 0xFF
        crc = (crc >> 8) ^ (low << 8) ^ (low << 3) ^ (low >> 4)
    return crc & 0xFFFF


def frames(stream: bytes) -> tuple[list[tuple[str, dict]], bytes]:
    """Return every message of a stream and the unfinished rest; any other byte is an error."""
    found, at = [], 0
    while at + 12 <= len(stream) and at + 12 + stream[at + 1] <= len(stream):
        assert stream[at] == 0xFD, f'byte {stream[at]:#x} where a message should begin'
        length = stream[at + 1]
        assert stream[at + 2] == 0, 'no signature was agreed on'
        identity = int.from_bytes(stream[at + 7 : at + 10], 'little')
        layout = LAYOUTS[identity]
        end = at + 10 + length
        (crc,) = struct.unpack_from('<H', stream, end)
        assert crc == checksum(stream[at + 1 : end] + bytes([layout.crc_extra])), layout.name
        found.append((layout.name, fields(layout, stream[at + 10 : end])))
        at = end + 2
    return found, stream[at:]


def fields(layout: Layout, payload: bytes) -> dict:
    size = struct.calcsize(layout.format)
    values = iter(struct.unpack(layout.format, payload.ljust(size, b'\0')))
    decoded = {}
    for field in layout.fields:
        name, _, count = field.partition(':')
        decoded[name] = [next(values) for _ in range(int(count))] if count else next(values)
    return decoded


def pack(name: str, sequence: int = 0, system: int = 1, component: int = 1, **values) -> bytes:
    """Return a message; what is not given is zero."""
    layout = LAYOUTS[IDS[name]]
    flat = []
    for field in layout.fields:
        key, _, count = field.partition(':')
        if count:
            flat += values.pop(key, [0] * int(count))
        else:
            flat.append(values.pop(key, 0))
    assert not values, f'{name} has no {list(values)}'
    payload = struct.pack(layout.format, *flat).rstrip(b'\0') or b'\0'
    head = bytes([len(payload), 0, 0, sequence % 256, system, component])
    body = head + IDS[name].to_bytes(3, 'little') + payload
    return b'\xfd' + body + struct.pack('<H', checksum(body + bytes([layout.crc_extra])))
