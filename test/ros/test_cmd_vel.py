# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``cmd_vel`` of the example controllers, over real topics."""

import math

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from nav_msgs.msg import Odometry

from fluid_sim_ros.control.guidance.velocity import Velocity
from fluid_sim_ros.control.state import State
from fluid_sim_ros.ros.controllers.velocity_commands import Reach, VelocityCommands
from test.support.closed_loop import STILL
from test.support.ros_processes import Peer, controller, node, reach, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


def twist(x=0.0, y=0.0, z=0.0, turn=0.0):
    message = Twist()
    message.linear.x, message.linear.y, message.linear.z = map(float, (x, y, z))
    message.angular.z = float(turn)
    return message


def stamped(frame, **velocity):
    message = TwistStamped()
    message.header.frame_id, message.twist = frame, twist(**velocity)
    return message


def settles(states, velocity, tolerance=0.05):
    """Wait until the mean velocity (body axes) and turn rate of a second are as asked for."""

    def mean():
        recent = list(states)[-100:]  # at 100 Hz
        rows = [[*xyz(s.twist.twist.linear), s.twist.twist.angular.z] for s in recent]
        return np.mean(rows, axis=0)

    # simulated time runs far ahead of the wall: no moment of it can be named
    wait_until(lambda: np.abs(mean() - velocity).max() < tolerance, f'{velocity}, not {mean()}')


def xyz(vector):
    return vector.x, vector.y, vector.z


def test_an_rov_follows_twists_and_stamped_twists_until_a_waypoint_comes():
    vehicle = 'bluerov2_heavy'
    with Peer() as peer:
        states = peer.collect(Odometry, f'{vehicle}/odom', depth=5000)
        settings = {'scene': 'rov', 'cmd_vel.timeout': 0.0}
        with controller('rov', **settings) as pilot, node(scene='rov', pacing='lockstep'):
            commands = peer.publisher(Twist, f'{vehicle}/cmd_vel')
            with_stamps = peer.publisher(TwistStamped, f'{vehicle}/cmd_vel_stamped')
            waypoints = peer.publisher(PoseStamped, f'{vehicle}/cmd/waypoint')
            reach(states, 1.0)
            commands.publish(twist(x=0.4, turn=0.2))
            settles(states, [0.4, 0.0, 0.0, 0.2])
            with_stamps.publish(stamped(f'{vehicle}/base_link', y=0.3))
            settles(states, [0.0, 0.3, 0.0, 0.0])
            goal = PoseStamped()
            x, y, _ = xyz(states[-1].pose.pose.position)
            goal.pose.position.x, goal.pose.position.y = x + 2.0, y
            goal.pose.position.z, goal.pose.orientation.w = -4.0, 1.0
            waypoints.publish(goal)

            def distance():
                return np.abs(np.subtract(xyz(states[-1].pose.pose.position), (x + 2.0, y, -4.0)))

            wait_until(lambda: distance().max() < 0.1, 'the waypoint')
        assert 'rejected' not in pilot.output


def test_what_is_wrong_or_beyond_its_reach_is_said():
    with Peer() as peer, controller('quad') as pilot:
        commands = peer.publisher(Twist, 'x500/cmd_vel')
        with_stamps = peer.publisher(TwistStamped, 'x500/cmd_vel_stamped')
        for publish, message, words in (
            (commands, twist(x=math.nan), 'cmd_vel rejected: every number must be finite'),
            (commands, twist(x=99.0), 'linear.x 99 is limited to 4'),
            (commands, tilted(), 'angular.x is ignored: the vehicle is held level'),
        ):
            publish.publish(message)
            wait_until(lambda words=words: words in pilot.output, words)
        with_stamps.publish(stamped('map', x=1.0))
        words = "frame 'map' is not that of the vehicle; allowed: base_link, x500/base_link"
        again = lambda: with_stamps.publish(stamped('map', x=1.0)) or words in pilot.output  # noqa: E731
        wait_until(again, words)  # errors are said once a second at most


def tilted():
    message = twist()
    message.angular.x = 1.0
    return message


@pytest.mark.full  # slow to start
@pytest.mark.parametrize(
    ('kind', 'vehicle', 'scene'),
    [('auv', 'remus100', 'remus100'), ('plane', 'aerosonde', 'aerosonde')],
)
def test_an_axis_that_a_vehicle_does_not_have_is_ignored_with_a_word(kind, vehicle, scene):
    with Peer() as peer, controller(kind, scene=scene) as pilot:
        commands = peer.publisher(Twist, f'{vehicle}/cmd_vel')
        commands.publish(twist(x=1.0, y=1.0))
        words = 'linear.y is ignored: the vehicle does not move that way'
        wait_until(lambda: words in pilot.output, words)


def test_silence_stops_the_vehicle_after_the_timeout_of_simulated_time():
    """The clock is that of the states: no wall time is in it."""
    timeout = [0.5]
    reach = Reach(Velocity(4.0, 4.0, 2.0, 4.0), 2.0)
    with Peer() as peer, Peer('pilot') as pilot:
        velocities = VelocityCommands(peer.node, 'v', reach, lambda: timeout[0], print)
        assert velocities.target(state_at(0.0)) is None
        publisher = pilot.publisher(Twist, 'v/cmd_vel')

        def velocity_at(seconds):
            velocities.take()
            found = velocities.target(state_at(seconds))
            return None if found is None else found[0].ahead

        publisher.publish(twist(x=1.0))
        wait_until(lambda: velocity_at(10.0) == 1.0, 'the message')
        assert [velocity_at(t) for t in (10.4, 10.5, 10.6, 20.0)] == [1.0, 1.0, 0.0, 0.0]
        timeout[0] = 0.0  # never
        assert velocity_at(99.0) == 1.0
        timeout[0] = 0.5
        publisher.publish(twist(x=2.0))
        wait_until(lambda: velocity_at(99.0) == 2.0, 'the next message')
        assert velocity_at(99.6) == 0.0
        velocities.forget()
        assert velocity_at(100.0) is None


def state_at(seconds):
    return State(seconds, STILL, (1.0, 0.0, 0.0, 0.0), STILL, STILL)
