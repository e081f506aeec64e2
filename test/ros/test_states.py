# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What controllers read from an odometry's bytes and write into an answer's."""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.ros.controllers.states import read_odometry

numbers = st.lists(st.floats(-1e6, 1e6), min_size=13, max_size=13)


def odometry(frame: str, child: str, values: list[float], stamp_ns: int = 0) -> Odometry:
    message = Odometry()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
    message.header.frame_id, message.child_frame_id = frame, child
    pose, twist = message.pose.pose, message.twist.twist
    fields = [(pose.position, 'xyz'), (pose.orientation, 'wxyz')]
    fields += [(twist.linear, 'xyz'), (twist.angular, 'xyz')]
    source = iter(values)
    for part, names in fields:
        for name in names:
            setattr(part, name, next(source))
    message.pose.covariance = np.arange(36.0)
    message.twist.covariance = -np.arange(36.0)
    return message


@given(st.text('abc/_', max_size=20), st.text('abc/_', max_size=20), numbers,
       st.integers(0, 2**31 * 1_000_000_000 - 1))  # fmt: skip
def test_reads_what_was_serialised(
    frame: str, child: str, values: list[float], stamp_ns: int
) -> None:
    found_ns, state = read_odometry(serialize_message(odometry(frame, child, values, stamp_ns)))
    assert (found_ns, state.time) == (stamp_ns, stamp_ns * 1e-9)
    found = [*state.position_w, *state.quat_wb_wxyz, *state.velocity_b, *state.omega_b]
    assert found == values


def test_reads_big_endian_too() -> None:
    little = serialize_message(odometry('', '', [float(i) for i in range(13)], 1_500_000_002))
    head = struct.unpack('<iI', little[4:12])
    # behind the stamp: two strings of one zero byte each, padded; then 85 doubles
    doubles = np.frombuffer(little[28 : 28 + 8 * 85], '<f8')
    text = struct.pack('>I', 1) + b'\x00\x00\x00\x00'
    big = b'\x00\x00\x00\x00' + struct.pack('>iI', *head) + 2 * text
    big += doubles.astype('>f8').tobytes()
    stamp_ns, state = read_odometry(big)
    assert stamp_ns == 1_500_000_002
    assert state.position_w == (0.0, 1.0, 2.0) and state.omega_b == (10.0, 11.0, 12.0)


@pytest.mark.parametrize(
    ('place', 'value', 'sound'),
    [
        (None, 0.0, True), (0, float('nan'), False), (5, float('inf'), False),
        (7, float('-inf'), False), (12, float('nan'), False), (3, 0.0, False), (3, 9.0, False),
    ],
)  # fmt: skip
def test_soundness(place: int | None, value: float, sound: bool) -> None:
    values = [0.1, 0.2, 0.3, 1.0, *[0.0] * 9]
    if place is not None:
        values[place] = value
    state = read_odometry(serialize_message(odometry('a', 'b', values))).state
    assert state.is_sound() is sound


def test_a_truncated_message_is_one_clear_error_at_every_length() -> None:
    whole = serialize_message(odometry('x500/odom', 'x500/base_link', [1.0] * 13))
    for size in range(len(whole) - 1):
        with pytest.raises(CommandError, match='malformed odometry'):
            read_odometry(whole[:size])


def test_a_length_that_lies_is_an_error() -> None:
    whole = bytearray(serialize_message(odometry('x500/odom', 'b', [1.0] * 13)))
    whole[12:16] = struct.pack('<I', 0xFFFFFFF0)
    with pytest.raises(CommandError, match='malformed odometry'):
        read_odometry(bytes(whole))
