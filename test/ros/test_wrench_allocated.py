# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A wrench on cmd/wrench_allocated over DDS becomes thrusts, and what it lacks is reported."""

import numpy as np
import pytest
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import JointState

from test.support.ros_processes import Peer, node, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

NAME = 'bluerov2_heavy'


def wrench(force, torque, frame=f'{NAME}/base_link'):
    message = WrenchStamped()
    message.header.frame_id = frame
    for vector, values in ((message.wrench.force, force), (message.wrench.torque, torque)):
        vector.x, vector.y, vector.z = map(float, values)
    return message


def close(actual, expected):
    return np.allclose(actual, expected, rtol=1e-3, atol=1e-3)


def vector(message):
    f, t = message.wrench.force, message.wrench.torque
    return [f.x, f.y, f.z, t.x, t.y, t.z]


def test_a_body_wrench_comes_out_of_the_thrusters_and_limits_are_reported():
    with Peer() as peer:
        peer.watch_diagnostics()
        thrust = peer.collect(WrenchStamped, f'{NAME}/wrench/thrust')
        joints = peer.collect(JointState, f'{NAME}/joint_states')
        with node(scene=NAME, pacing='realtime') as process:
            publisher = peer.publisher(WrenchStamped, f'{NAME}/cmd/wrench_allocated')
            wanted = [8.0, -4.0, 6.0, 0.3, -0.2, 0.8]
            publisher.publish(wrench(wanted[:3], wanted[3:]))
            wait_until(lambda: thrust and close(vector(thrust[-1]), wanted), 'the wanted wrench')
            # rotors turn: |T| = k w^2, k = 51.4 N at 3533 rpm forward, 39.9 N at 3465 rpm reverse
            wait_until(lambda: joints and min(map(abs, joints[-1].velocity)) > 1, 'turning rotors')
            speed, force = np.array(joints[-1].velocity), np.array(joints[-1].effort)
            full = np.where(force < 0, 39.9 / 3465**2, 51.4 / 3533**2) * (30 / np.pi) ** 2
            np.testing.assert_allclose(np.abs(force), full * speed**2, rtol=1e-6)
            assert (np.sign(force) == np.sign(speed)).all()

            publisher.publish(wrench([400, 0, 0], [0, 0, 0]))
            # four vectored thrusters at 45 degrees, equal until the weaker direction limits
            reduced = [4 * 39.9 / np.sqrt(2), 0, 0, 0, 0, 0]
            wait_until(lambda: close(vector(thrust[-1]), reduced), 'the reduced wrench')
            wait_until(
                lambda: any(
                    '(113, 0, 0, 0, 0, 0) of (400, 0, 0, 0, 0, 0)' in line
                    and 'limits of the thrusters' in line
                    for line in process.lines
                ),
                'a report of the limits',
            )

            publisher.publish(wrench([1, 0, 0], [0, 0, 0], frame='map'))
            wait_until(
                lambda: any(
                    f"frame 'map' is not known; allowed: {NAME}/base_link" in line
                    for line in process.lines
                ),
                'a report of the frame',
            )
            assert close(vector(thrust[-1]), reduced)
