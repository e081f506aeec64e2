# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sessions with the real programs through our parsers, against a decoder written by hand."""

import json
import struct

import pytest

from fluid_sim_ros.mavlink.ardupilot.json_packets import JsonState, read_servo_packet, write_state
from fluid_sim_ros.mavlink.ned import euler
from fluid_sim_ros.mavlink.px4.hil_answers import HilReader
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter, SensorReadings, dialect
from test.support.autopilots import hil_wire
from test.support.autopilots.json_reader import JsonReader
from test.support.autopilots.recordings import FROM_AUTOPILOT, TO_AUTOPILOT, portions

PX4 = 'px4_iris_hil.bin.gz'
ARDUPILOT = ('arducopter_json.bin.gz', 'ardusub_json.bin.gz')


def test_every_actuator_frame_of_px4_is_read():
    stream = portions(PX4, FROM_AUTOPILOT)
    expected, rest = hil_wire.frames(b''.join(stream))
    assert rest == b''
    reader = HilReader()
    received = [reader.receive(portion) for portion in stream]
    actuators = [a for r in received for a in r.actuators]
    controls = [fields for name, fields in expected if name == 'HIL_ACTUATOR_CONTROLS']
    assert sum(r.messages for r in received) == len(expected) == 768
    assert not [fault for r in received for fault in r.faults]
    assert len(actuators) == len(controls) == 766
    for ours, fields in zip(actuators, controls, strict=True):
        assert ours.time_us == fields['time_usec']
        assert list(ours.controls) == fields['controls']
        assert ours.armed == (fields['mode'] == 129)
        assert ours.lockstep == (fields['flags'] == 1)
    assert {a.armed for a in actuators} == {False, True}


@pytest.mark.parametrize('direction', [TO_AUTOPILOT, FROM_AUTOPILOT])
def test_the_dialect_agrees_with_the_decoder_by_hand_in_every_field(direction):
    stream = b''.join(portions(PX4, direction))
    expected, _ = hil_wire.frames(stream)
    mav = dialect.MAVLink(None)
    messages = mav.parse_buffer(stream)
    assert len(messages) == len(expected)
    for message, (name, fields) in zip(messages, expected, strict=True):
        values = message.to_dict()
        assert values.pop('mavpackettype') == name
        assert values == fields


def test_recorded_readings_are_packed_to_the_same_bytes():
    sensors = 0
    for portion in portions(PX4, TO_AUTOPILOT):
        for name, v in hil_wire.frames(portion)[0]:
            if name != 'HIL_SENSOR':
                continue
            bits = v['fields_updated']
            readings = SensorReadings(
                (v['xacc'], v['yacc'], v['zacc']),
                (v['xgyro'], v['ygyro'], v['zgyro']),
                (v['xmag'], v['ymag'], v['zmag']) if bits & 0x1C0 else None,
                v['abs_pressure'] if bits & 0x1A00 else None,
                v['pressure_alt'],
                v['temperature'],
            )
            data = HilWriter().sensors(v['time_usec'], readings)
            (ours,), rest = hil_wire.frames(data)
            if not bits & 0x1C0:
                v = v | {'xmag': 0.0, 'ymag': 0.0, 'zmag': 0.0}
            if not bits & 0x1A00:
                v = v | {'abs_pressure': 0.0}
            assert ours == ('HIL_SENSOR', v)
            assert rest == b''
            sensors += 1
    assert sensors == 774


@pytest.mark.parametrize('name', ARDUPILOT)
def test_every_servo_packet_of_ardupilot_is_read(name):
    packets = portions(name, FROM_AUTOPILOT)
    for data in packets:
        packet = read_servo_packet(data)
        magic, rate, count, *pulses = struct.unpack('<HHI16H', data)
        assert magic == 18458
        assert (packet.rate, packet.count, list(packet.pulses)) == (rate, count, pulses)
    assert len(packets) > 1000


@pytest.mark.parametrize('name', ARDUPILOT)
def test_recorded_states_are_written_as_ardupilot_read_them(name):
    theirs, ours = JsonReader(), JsonReader()
    for data in portions(name, TO_AUTOPILOT):
        state = json.loads(data)
        expected = theirs.read(data)
        written = ours.read(
            write_state(
                JsonState(
                    state['timestamp'],
                    tuple(state['imu']['gyro']),
                    tuple(state['imu']['accel_body']),
                    tuple(state['position']),
                    tuple(state['velocity']),
                    tuple(state['quaternion']),
                    range_m=state['rng_1'],
                )
            )
        )
        assert written.pop('attitude') == pytest.approx(euler(state['quaternion']), abs=1e-8)
        assert written.pop('timestamp') == pytest.approx(expected.pop('timestamp'), abs=1e-9)
        assert written == {
            key: pytest.approx(values, rel=1e-8, abs=1e-15) for key, values in expected.items()
        }


def test_the_true_state_has_the_units_that_px4_reads():
    data = HilWriter().truth(
        4000, (1.0, 0.0, 0.0, 0.0), (0.1, 0.2, 0.3), (47.1, 8.2, 430.5), (1.234, -2.0, 400.0),
        3.2, (1.5, -40.0, -9.80665),
    )  # fmt: skip
    ((name, fields),), _ = hil_wire.frames(data)
    assert name == 'HIL_STATE_QUATERNION'
    # cm/s and mm/s^2, saturated at 16 bits
    assert [fields[key] for key in ('vx', 'vy', 'vz')] == [123, -200, 32767]
    assert [fields[key] for key in ('xacc', 'yacc', 'zacc')] == [1500, -32768, -9807]
    assert fields['true_airspeed'] == 320
    assert (fields['lat'], fields['lon'], fields['alt']) == (471000000, 82000000, 430500)
