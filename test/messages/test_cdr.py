# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""CDR readers: equal to the middleware's own, and safe on whatever bytes arrive."""

import struct

import numpy as np
import pytest
from geometry_msgs.msg import TwistStamped, WrenchStamped
from hypothesis import given, settings
from hypothesis import strategies as st
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState, Joy
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.messages.cdr import (
    read_float64_multi_array,
    read_joint_state,
    read_joy,
    read_stamped_pair,
)

pytestmark = pytest.mark.ros

values = st.lists(st.floats(allow_nan=False), max_size=9)
# DDS strings end at a zero byte
text = st.text(st.characters(exclude_characters='\x00', codec='utf-8'), max_size=12)
stamps = st.tuples(st.integers(0, 2**31 - 1), st.integers(0, 999_999_999))


@given(values, st.lists(text, max_size=3))
def test_multi_array_reads_what_was_written(data, labels):
    message = Float64MultiArray(data=data)
    message.layout.dim = [MultiArrayDimension(label=label, size=1, stride=2) for label in labels]
    np.testing.assert_array_equal(read_float64_multi_array(serialize_message(message)), data)


@given(stamps, text, st.lists(text, max_size=3), values, values)
def test_joint_state_reads_what_was_written(stamp, frame, names, position, effort):
    message = JointState(name=names, position=position, effort=effort)
    message.header.stamp.sec, message.header.stamp.nanosec = stamp
    message.header.frame_id = frame
    command = read_joint_state(serialize_message(message))
    assert command.stamp_ns == stamp[0] * 10**9 + stamp[1]
    assert command.names == names
    np.testing.assert_array_equal(command.position, position)
    np.testing.assert_array_equal(command.effort, effort)


@given(stamps, text, st.lists(st.floats(allow_nan=False), min_size=6, max_size=6))
def test_stamped_pairs_read_what_was_written(stamp, frame, numbers):
    wrench, twist = WrenchStamped(), TwistStamped()
    for message in (wrench, twist):
        message.header.stamp.sec, message.header.stamp.nanosec = stamp
        message.header.frame_id = frame
    w, t = wrench.wrench, twist.twist
    for part, place in ((w.force, 0), (w.torque, 3), (t.linear, 0), (t.angular, 3)):
        part.x, part.y, part.z = numbers[place : place + 3]
    for message in (wrench, twist):
        command = read_stamped_pair(serialize_message(message))
        assert (command.frame, command.stamp_ns) == (frame, stamp[0] * 10**9 + stamp[1])
        np.testing.assert_array_equal(np.concatenate([command.first, command.second]), numbers)


@given(
    st.lists(st.floats(allow_nan=False, width=32), max_size=9),
    st.lists(st.integers(-(2**31), 2**31 - 1), max_size=5),
    text,
)
def test_joy_reads_what_was_written(axes, buttons, frame):
    message = Joy(axes=axes, buttons=buttons)
    message.header.frame_id = frame
    read_axes, read_buttons = read_joy(serialize_message(message))
    np.testing.assert_array_equal(read_axes, axes)
    np.testing.assert_array_equal(read_buttons, buttons)


def test_big_endian_is_read():
    header = b'\x00\x00\x00\x00'
    body = struct.pack('>III', 0, 0, 1) + b'\x00' * 4 + struct.pack('>d', 2.5)
    np.testing.assert_array_equal(read_float64_multi_array(header + body), [2.5])


@pytest.mark.parametrize(
    ('read', 'message'),
    [
        (read_float64_multi_array, Float64MultiArray(data=[1.0, 2.0])),
        (read_joint_state, JointState(name=['a', 'b'], effort=[1.0, 2.0])),
        (read_stamped_pair, WrenchStamped()),
        (read_joy, Joy(axes=[1.0, 2.0], buttons=[1])),
    ],
)
def test_a_message_cut_anywhere_is_refused(read, message):
    whole = serialize_message(message)
    payload = len(whole)
    while payload > 4 and read is not None:
        try:
            read(whole[: payload - 1])
        except CommandError:
            break
        payload -= 1  # padding at the end may be missing
    for size in range(payload):
        with pytest.raises(CommandError, match='malformed message'):
            read(whole[:size])


@settings(max_examples=300)
@given(st.binary(max_size=200), st.sampled_from([b'\x00\x01\x00\x00', b'\x00\x00\x00\x00', b'']))
def test_arbitrary_bytes_never_raise_anything_else(noise, header):
    for read in (read_float64_multi_array, read_joint_state, read_stamped_pair):
        try:
            read(header + noise)
        except CommandError as error:
            assert '\n' not in str(error)
