# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node as its users meet it: a process of its own, with real topics."""

import numpy as np
import pytest
from geometry_msgs.msg import TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import SetBool
from visualization_msgs.msg import MarkerArray

from fluid_sim_ros import Scene, Simulation, scene_names
from test.support.ros_processes import Peer, node, stamp_ns, wait_until
from test.support.volumes import quick

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


@pytest.mark.parametrize('scene', quick(scene_names(), 'amphibious', 'rov', 'x500_turbulence'))
def test_every_scene_publishes_at_its_rates_to_another_process(scene):
    vehicle = next(iter(Scene.load(scene).compile().vehicles))
    rates = {'odom__rate': 50.0, 'wrench__rate': 25.0, 'clock__rate': 50.0}
    timestep = Simulation(scene).timestep
    if (0.02 / timestep) % 1 > 1e-9:  # a model whose timestep does not divide 20 ms
        rates = dict.fromkeys(rates, 1 / (10 * timestep))
    with Peer() as peer:
        odometry = peer.collect(Odometry, f'{vehicle}/odom')
        wrenches = peer.collect(WrenchStamped, f'{vehicle}/wrench/total')
        clocks = peer.collect(Clock, '/clock')
        with node(scene=scene, pacing='realtime', realtime__factor=4.0, **rates):
            wait_until(lambda: len(odometry) > 25 and len(wrenches) > 12, f'{scene} on its topics')
        for messages, rate in ((odometry, 'odom__rate'), (wrenches, 'wrench__rate')):
            gaps = np.diff([stamp_ns(m) for m in messages])
            np.testing.assert_allclose(gaps, 1e9 / rates[rate], atol=1.0)
        assert clocks
        assert odometry[0].header.frame_id == f'{vehicle}/odom'
        assert odometry[0].child_frame_id == f'{vehicle}/base_link'
        assert wrenches[0].header.frame_id == f'{vehicle}/base_link'


def test_odometry_and_wrench_are_those_of_the_simulation():
    with Peer() as peer:
        odometry = peer.collect(Odometry, 'sphere/odom')
        total = peer.collect(WrenchStamped, 'sphere/wrench/total')
        drag = peer.collect(WrenchStamped, 'sphere/wrench/drag')
        viscous = peer.collect(WrenchStamped, 'sphere/wrench/viscous')
        lists = (odometry, total, drag, viscous)
        with node(scene='sphere', realtime__factor=5.0):
            wait_until(lambda: min(map(len, lists)) > 100, 'odometry and wrenches')
        last = odometry[-1]
        simulation = Simulation('sphere')
        simulation.step(round(stamp_ns(last) * 1e-9 / simulation.timestep))
        state = simulation.snapshot().vehicles['sphere']
        pose, twist = last.pose.pose, last.twist.twist
        assert [pose.position.x, pose.position.y, pose.position.z] == state.position_w.tolist()
        o = pose.orientation
        assert [o.w, o.x, o.y, o.z] == state.quat_wb_wxyz.tolist()
        assert [twist.linear.x, twist.linear.y, twist.linear.z] == state.velocity_b.tolist()
        forces = {stamp_ns(m): m.wrench.force.z for m in viscous}
        drags = {stamp_ns(m): m.wrench.force.z for m in drag}
        totals = {stamp_ns(m): m.wrench.force.z for m in total}
        shared = forces.keys() & drags.keys() & totals.keys()
        assert len(shared) > 50
        terms = simulation.wrench('sphere')
        for name in set(terms) - {'drag', 'viscous'}:
            assert not terms[name][0].any()  # a sphere that falls straight in stock fluid
        for time in shared:
            assert totals[time] == pytest.approx(forces[time] + drags[time], rel=1e-12)


def test_commands_are_applied_and_bad_ones_counted_and_survived():
    with Peer() as peer:
        peer.watch_diagnostics()
        joints = peer.collect(JointState, 'x500/joint_states')
        with node(scene='quadrotor', command_timeout=0.0) as process:
            thrust = peer.publisher(Float64MultiArray, 'x500/cmd/thrust')
            stamped = peer.publisher(JointState, 'x500/cmd/thrust_stamped')
            wrench = peer.publisher(WrenchStamped, 'x500/cmd/wrench')
            wind = peer.publisher(TwistStamped, 'wind')
            current = peer.publisher(TwistStamped, 'current')

            def errors(topic):
                values = peer.diagnostics.get('commands', (0, '', {}))[2]
                return values.get(f'{topic} last error', '')

            def refused(publisher, message, topic, words):
                publisher.publish(message)
                wait_until(lambda: words in errors(topic), f"'{words}' on {topic}")

            refused(thrust, Float64MultiArray(data=[1.0]), 'x500/cmd/thrust', 'needs 4')
            nan = Float64MultiArray(data=[1.0, float('nan'), 1.0, 1.0])
            refused(thrust, nan, 'x500/cmd/thrust', 'not finite')
            inf = Float64MultiArray(data=[1.0, float('inf'), 1.0, 1.0])
            refused(thrust, inf, 'x500/cmd/thrust', 'inf')
            names = JointState(name=['a', 'b', 'c', 'd'], effort=[1.0] * 4)
            refused(stamped, names, 'x500/cmd/thrust_stamped', 'names must be the thrusters m1')
            message = WrenchStamped()
            message.header.frame_id = 'moon'
            refused(wrench, message, 'x500/cmd/wrench', 'allowed: x500/base_link, map')
            refused(current, TwistStamped(), 'current', 'command the wind')
            message = TwistStamped()
            message.twist.linear.x = float('nan')
            refused(wind, message, 'wind', 'not finite')

            thrust.publish(Float64MultiArray(data=[1.0, 2.0, 3.0, 99.0]))
            limit = Scene.load('quadrotor').compile().vehicles['x500'].thrust_range[3, 1]
            expected = [1.0, 2.0, 3.0, limit]
            wait_until(lambda: joints and joints[-1].effort.tolist() == expected, 'the thrust')
            wait_until(
                lambda: peer.diagnostics['commands'][2]['saturated values'] == '1', 'saturation'
            )
            assert process.alive


def test_a_stale_command_becomes_zero_thrust_and_is_reported():
    with Peer() as peer:
        peer.watch_diagnostics()
        joints = peer.collect(JointState, 'x500/joint_states')
        with node(scene='quadrotor', command_timeout=0.2):
            thrust = peer.publisher(Float64MultiArray, 'x500/cmd/thrust')
            thrust.publish(Float64MultiArray(data=[2.0] * 4))
            wait_until(lambda: joints and joints[-1].effort[0] == 2.0, 'the thrust')
            wait_until(lambda: joints[-1].effort[0] == 0.0, 'zero thrust')
            wait_until(
                lambda: 'stale: x500' in peer.diagnostics.get('commands', (0, ''))[1], 'stale'
            )


def test_markers_show_the_vehicle_without_tf():
    with Peer() as peer:
        markers = peer.collect(MarkerArray, 'x500/markers', latched=True)
        with node(scene='quadrotor'):
            wait_until(lambda: len(markers) > 2, 'markers')
        names = {marker.ns for marker in markers[-1].markers}
        assert names == {'x500/geoms', 'forces'}
        assert {marker.header.frame_id for marker in markers[-1].markers} == {'map'}


def test_markers_are_shown_while_the_node_is_paused():
    with Peer() as peer, node(scene='quadrotor'):
        peer.call(SetBool, 'fluid_sim_node/pause', data=True)
        markers = peer.collect(MarkerArray, 'x500/markers')
        wait_until(lambda: len(markers) > 2, 'markers')
        assert len({stamp_ns(message.markers[0]) for message in markers}) == 1
