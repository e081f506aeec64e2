# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Lockstep with topic controllers: deterministic, patient, no answer lost or taken twice."""

import os
import subprocess
import sys
import textwrap

import numpy as np
import pytest
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

from test.support.ros_processes import Forked, Peer, Process, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

HOVER = 5.0  # [N], near a quarter of the x500's weight


def altitude_feedback(message):
    """Return a thrust that depends on everything in an odometry."""
    position, twist = message.pose.pose.position, message.twist.twist
    common = HOVER - 2.0 * (position.z - 1.0) - 1.5 * twist.linear.z
    tilt = 0.1 * message.pose.pose.orientation.x + 0.02 * twist.angular.x
    return [common - tilt, common + tilt, common + tilt, common - tilt]


class Controller:
    """Answers each odometry by its stamp, in a callback."""

    def __init__(self, peer, answer=altitude_feedback, copies=1):
        self.received = []
        self._answer = answer
        self._copies = copies
        self._publisher = peer.node.create_publisher(JointState, 'x500/cmd/thrust_stamped', 10)
        peer.node.create_subscription(Odometry, 'x500/odom', self._on_odometry, 10)

    def _on_odometry(self, message):
        self.received.append(message)
        answer = JointState(effort=self._answer(message))
        answer.header.stamp = message.header.stamp
        for _ in range(self._copies):
            self._publisher.publish(answer)


def run(answer=altitude_feedback, copies=1, extra=False, start=Forked, **parameters):
    """Return the odometry that a controller saw in one simulated second of lockstep."""
    with Peer() as peer:
        controller = Controller(peer, answer, copies)
        if extra:
            for topic in ('odom', 'wrench/total'):
                peer.collect(Odometry if topic == 'odom' else WrenchStamped, f'x500/{topic}')
        settings = {'scene': 'quadrotor', 'pacing': 'lockstep', 'duration': 1.0, **parameters}
        with node(start, **settings) as process:
            assert process.wait() == 0
    by_stamp = {stamp_ns(m): m for m in controller.received}
    return [by_stamp[stamp] for stamp in sorted(by_stamp)]


def numbers(messages):
    rows = []
    for m in messages:
        p, q, t = m.pose.pose.position, m.pose.pose.orientation, m.twist.twist
        rows.append([
            p.x, p.y, p.z, q.x, q.y, q.z, q.w,
            t.linear.x, t.linear.y, t.linear.z, t.angular.x, t.angular.y, t.angular.z,
        ])  # fmt: skip
    return np.array(rows)


def test_two_runs_are_equal_to_the_bit_with_extra_subscribers_and_a_publishing_thread():
    first = run()
    second = run(extra=True, copies=2, start=Process, publish__thread='always')
    stamps = [stamp_ns(m) for m in first]
    assert stamps[:100] == list(range(0, 1_000_000_000, 10_000_000))
    both = min(len(first), len(second))
    assert both >= 100
    np.testing.assert_array_equal(numbers(first[:both]), numbers(second[:both]))
    assert np.ptp(numbers(first)[:, 2]) > 0  # it moved at all


def test_a_longer_period_waits_less_often():
    messages = run(**{'lockstep__period': 0.05})
    # odometry goes on at its own rate; of what follows the last answer, at 0.95 s, the end of the
    # node may come first
    stamps = [stamp_ns(m) for m in messages]
    assert stamps[:96] == list(range(0, 960_000_000, 10_000_000))


def test_a_late_controller_is_served_the_state_that_waits():
    with node(scene='quadrotor', pacing='lockstep', duration=0.5) as process, Peer() as peer:
        peer.watch_diagnostics()
        wait_until(
            lambda: (
                'no answer on x500/cmd/thrust_stamped' in peer.diagnostics.get('loop', (0, ''))[1]
            ),
            'the report of the missing answer',
        )
        assert peer.diagnostics['loop'][2]['step'] == '0'
        controller = Controller(peer)
        assert process.wait() == 0
        assert stamp_ns(controller.received[0]) == 0


def test_an_answer_from_the_future_or_of_wrong_length_does_not_count():
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene='quadrotor', pacing='lockstep', duration=0.5) as process:
            publisher = peer.publisher(JointState, 'x500/cmd/thrust_stamped')
            answer = JointState(effort=[1.0] * 4)
            answer.header.stamp.sec = 7

            def last_error():
                values = peer.diagnostics.get('commands', (0, '', {}))[2]
                return values.get('x500/cmd/thrust_stamped last error', '')

            publisher.publish(answer)
            wait_until(lambda: 'ahead of the simulation' in last_error(), 'the refusal')
            publisher.publish(JointState(effort=[1.0] * 3))
            wait_until(lambda: 'needs 4' in last_error(), 'the second refusal')
            assert peer.diagnostics['loop'][2]['step'] == '0'
            assert process.alive


def test_without_answers_continue_goes_on_and_stop_ends():
    with node(
        scene='quadrotor', pacing='lockstep', duration=0.03,
        lockstep__on_timeout='continue', lockstep__timeout=0.05,
    ) as process:  # fmt: skip
        assert process.wait() == 0
        assert 'going on, not deterministic' in process.output
    with node(
        scene='quadrotor', pacing='lockstep', lockstep__on_timeout='stop', lockstep__timeout=0.05
    ) as process:
        assert process.wait() == 2
        assert 'no answer on x500/cmd/thrust_stamped within 0.05 s: stopped' in process.output


BURST = textwrap.dedent("""
    import sys, time
    import rclpy
    from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
    from std_msgs.msg import Float64MultiArray
    count = int(sys.argv[1])
    rclpy.init()
    node = rclpy.create_node('burst')
    qos = QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.RELIABLE)
    publisher = node.create_publisher(Float64MultiArray, 'x500/cmd/thrust', qos)
    while not publisher.get_subscription_count():
        time.sleep(0.01)
    for i in range(count):
        publisher.publish(Float64MultiArray(data=[5.0 + 1e-4 * i] * 4))
    sys.stdin.read()
""")


def test_every_one_of_a_burst_of_counted_commands_is_taken_once():
    """The executor must not take messages from the stepping thread: none may be missing."""
    count = 2000
    with Peer() as peer:
        efforts = peer.collect(JointState, 'x500/joint_states', depth=count)
        with node(
            scene='quadrotor', pacing='lockstep', lockstep__match='count', command_timeout=0.0,
        ) as process:  # fmt: skip
            wait_until(lambda: efforts, 'the node')
            burst = subprocess.Popen(
                [sys.executable, '-c', BURST, str(count)], stdin=subprocess.PIPE, env=os.environ
            )
            period = 10_000_000
            wait_until(lambda: stamp_ns(efforts[-1]) >= count * period, 'all steps')
            burst.communicate()
            last = {stamp_ns(m): m.effort[0] for m in efforts}
            assert max(last) == count * period
            for stamp, effort in last.items():
                if stamp:
                    assert effort == pytest.approx(5.0 + 1e-4 * (stamp // period - 1), abs=1e-12)
            assert process.alive


FINNED = """<mujoco><option timestep=".002" gravity="0 0 0" density="1000"/><worldbody>
<body name="fish"><freejoint/><geom type="ellipsoid" size=".3 .1 .1" fluidshape="ellipsoid"/>
<site name="screw" pos="-.3 0 0"/>
<body name="tail" pos="-.3 0 0"><joint name="fin" axis="0 0 1" damping=".1"/>
<geom type="ellipsoid" size=".1 .01 .1" fluidshape="ellipsoid"/></body></body></worldbody>
<actuator><motor name="screw" site="screw" gear="1 0 0 0 0 0"/>
<position name="fin" joint="fin" kp="2"/></actuator></mujoco>"""


def swim(path, copies=1):
    """Return the odometry of half a second in which thrust and fin answer each state."""
    with Peer() as peer:
        states = []
        screw = peer.node.create_publisher(JointState, 'fish/cmd/thrust_stamped', 10)
        fin = peer.node.create_publisher(JointState, 'fish/cmd/joints', 10)

        def answer(message):
            states.append(message)
            x = message.pose.pose.position.x
            both = JointState(effort=[20.0 - x]), JointState(position=[0.4 - 0.3 * x])
            for publisher, command in zip((screw, fin), both, strict=True):
                command.header.stamp = message.header.stamp
                for _ in range(copies):  # as to a state that was published again
                    publisher.publish(command)

        peer.node.create_subscription(Odometry, 'fish/odom', answer, 10)
        with node(scene=path, pacing='lockstep', duration=0.5) as process:
            assert process.wait() == 0
    by_stamp = {stamp_ns(m): m for m in states}
    return numbers([by_stamp[stamp] for stamp in sorted(by_stamp)][:50])


def test_thrust_and_joints_of_one_state_are_both_waited_for(tmp_path):
    path = tmp_path / 'fish.xml'
    path.write_text(FINNED)
    first, second = swim(path), swim(path, copies=2)
    assert len(first) == 50
    np.testing.assert_array_equal(first, second)
    assert abs(first[-1, 5]) > 1e-3  # the fin turned it
    with node(scene=path, pacing='lockstep') as process, Peer() as peer:
        peer.watch_diagnostics()
        peer.publisher(JointState, 'fish/cmd/thrust_stamped').publish(JointState(effort=[1.0]))
        wait_until(
            lambda: 'no answer on fish/cmd/joints' in peer.diagnostics.get('loop', (0, ''))[1],
            'the report that the joints are missing',
        )
        assert process.alive and peer.diagnostics['loop'][2]['step'] == '0'
        # by stamp, a joint command has to answer as a thrust does
        joints = peer.publisher(JointState, 'fish/cmd/joints')
        ahead = JointState(position=[0.1])
        ahead.header.stamp.sec = 7
        joints.publish(ahead)

        def last_error():
            values = peer.diagnostics.get('commands', (0, '', {}))[2]
            return values.get('fish/cmd/joints last error', '')

        wait_until(lambda: 'ahead of the simulation' in last_error(), 'the refusal')
        assert peer.diagnostics['loop'][2]['step'] == '0'
        joints.publish(JointState(position=[0.1]))
        wait_until(lambda: peer.diagnostics['loop'][2]['step'] != '0', 'the first step')
