# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whole frames without message objects are the dialect's own, byte by byte."""

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.mavlink.px4.hil_aids import distance_sensor
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.wire import Frame

numbers = st.floats(width=32, allow_nan=False)
times = st.integers(0, 2**64 - 1)
SENSORS, ANSWER = dialect.MAVLink_hil_sensor_message, dialect.MAVLink_hil_actuator_controls_message


def packed(message, sequence=0):
    mav = dialect.MAVLink(None, srcSystem=3, srcComponent=7)
    mav.seq = sequence
    return bytes(message.pack(mav))


@given(
    times, st.lists(numbers, min_size=13, max_size=13), st.integers(0, 2**32 - 1),
    st.integers(0, 255), st.integers(0, 255),
)  # fmt: skip
def test_a_frame_is_packed_as_by_the_dialect(time_us, values, bits, identity, sequence):
    fields = (time_us, *values, bits, identity)
    expected = packed(SENSORS(*fields), sequence)
    assert Frame(SENSORS).pack(sequence, 3, 7, *fields) == expected


@given(
    times, st.lists(numbers, min_size=16, max_size=16), st.integers(0, 255),
    st.integers(0, 2**64 - 1),
)  # fmt: skip
def test_a_frame_is_read_as_by_the_dialect(time_us, controls, mode, flags):
    data = packed(ANSWER(time_us, controls, mode, flags))
    assert Frame(ANSWER).read(data) == (time_us, flags, *controls, mode)


@given(st.data())
def test_a_frame_with_a_wrong_byte_is_not_read(data):
    whole = packed(ANSWER(4000, [0.5] * 16, 129, 1))
    place = data.draw(st.integers(0, len(whole) - 1))
    wrong = data.draw(st.integers(1, 255))
    # the sequence, the ids and the compatible flags are the sender's business, but in the checksum
    broken = bytearray(whole)
    broken[place] ^= wrong
    assert Frame(ANSWER).read(bytes(broken)) is None


@pytest.mark.parametrize('size', range(0, 80, 7))
def test_a_part_of_a_frame_is_not_read(size):
    whole = packed(ANSWER(4000, [0.5] * 16, 129, 1))
    assert Frame(ANSWER).read(whole[:size]) is None
    assert Frame(ANSWER).read(whole + bytes(size + 1)) is None


def test_another_message_and_a_signed_one_are_not_read():
    other = packed(dialect.MAVLink_heartbeat_message(6, 8, 0, 0, 0, 3))
    assert Frame(ANSWER).read(other) is None
    signed = bytearray(packed(ANSWER(4000, [0.5] * 16, 129, 1)))
    signed[2] = 1  # MAVLINK_IFLAG_SIGNED
    signed[-2:] = struct.pack('<H', dialect.x25crc(bytes(signed[1:-2]) + b'\x2f').crc)
    assert Frame(ANSWER).read(bytes(signed)) is None


@given(st.integers(0, 2**32 - 1), st.floats(0, 655) | st.just(math.inf), st.integers(0, 255))
def test_a_distance_is_packed_as_by_the_dialect(time_ms, distance, sequence):
    writer = HilWriter(3, 7)
    for _ in range(sequence):
        writer.number()
    measured, quality = (round(100 * distance), 100) if distance < 655.1 else (5001, 1)
    message = dialect.MAVLink_distance_sensor_message(
        time_ms, 20, 5000, measured, 0, 0, 25, 255, signal_quality=quality
    )
    assert distance_sensor(writer, time_ms, distance, 0.2, 50.0) == packed(message, sequence)
