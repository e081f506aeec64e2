# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A fleet in the node: topics of each vehicle, and a controller for each in one lockstep."""

import signal
import threading

import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

from test.support.autopilots.autopilot_peers import free_port
from test.support.autopilots.fleet_peers import Pilot
from test.support.autopilots.px4_pilots import Quad
from test.support.autopilots.px4_stand_in import Px4
from test.support.ros_processes import Forked, Peer, error_lines, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

FLEET = """
vehicles:
  one: {model: x500, position: [0, 0, 2], keyframe: hover}
  two: {model: x500, position: [3, 0, 2], yaw: 90, keyframe: hover}
"""


def pilot(scene, vehicle, **parameters):
    arguments = ('--ros-args', '-r', f'__node:=pilot_{vehicle}')
    return Forked(
        'fluid_sim_ros.ros.controllers.quad',
        *arguments,
        scene=scene,
        vehicle=vehicle,
        **parameters,
    )


def test_two_controllers_fly_two_vehicles_in_one_lockstep(tmp_path):
    scene = tmp_path / 'fleet.yaml'
    scene.write_text(FLEET)
    with Peer() as peer:
        odometry = {v: peer.collect(Odometry, f'{v}/odom', depth=5000) for v in ('one', 'two')}
        joints = peer.collect(JointState, 'two/joint_states')
        one = pilot(scene, 'one', waypoints='[0.0, 1.0, 2.0, 0.0, 0.0]')
        two = pilot(scene, 'two')
        with node(scene=scene, pacing='lockstep') as simulator, one, two:
            wait_until(
                lambda: all(s and stamp_ns(s[-1]) > 0.6e9 for s in odometry.values()),
                '0.6 s of both',
            )
        assert error_lines(simulator.output + one.output + two.output) == []
    places = {v: states[-1].pose.pose.position for v, states in odometry.items()}
    assert places['one'].x == pytest.approx(0.0, abs=0.02) and places['one'].y > 0.01
    assert [places['two'].x, places['two'].y] == pytest.approx([3.0, 0.0], abs=0.01)
    assert odometry['two'][-1].child_frame_id == 'two/base_link'
    assert joints[-1].name == ['m1', 'm2', 'm3', 'm4']


def px4(port, done):
    """Fly one of them until ``done``."""

    def fly():
        peer, quad, controls = Px4(port), Quad((0.0, 0.0, -2.0), 0.77), [0.0] * 4
        while not done.is_set():
            controls = quad.controls(peer, peer.exchange(controls))
        peer.close()

    return Pilot(fly)


def test_the_scenes_autopilots_fly_in_the_node(tmp_path):
    scene, done = tmp_path / 'fleet.yaml', threading.Event()
    ports = free_port('px4'), free_port('px4')
    text = FLEET.replace('[0, 0, 2], keyframe: hover', '[0, 0], keyframe: ground')
    text = text.replace('[3, 0, 2], yaw: 90, keyframe: hover', '[3, 0], yaw: 90, keyframe: ground')
    for port in ports:
        text = text.replace('ground}', f'ground, autopilot: {{protocol: px4, port: {port}}}}}', 1)
    scene.write_text(text)
    with Peer() as peer:
        peer.watch_diagnostics()
        odometry = {v: peer.collect(Odometry, f'{v}/odom') for v in ('one', 'two')}
        with node(scene=scene, pacing='free') as process:
            wait_until(lambda: 'autopilot two' in peer.diagnostics, 'diagnostics')
            pilots = [px4(port, done) for port in ports]
            wait_until(
                lambda: all(s and s[-1].pose.pose.position.z > 1.0 for s in odometry.values()),
                'both to take off',
            )
            wait_until(lambda: peer.diagnostics['autopilot one'][1] == 'in lockstep', 'lockstep')
            topics = dict(peer.node.get_topic_names_and_types())
            assert {'/one/cmd/sticks', '/two/cmd/sticks'} <= topics.keys()
            done.set()
            process.signal(signal.SIGINT)
            assert process.wait() == 0
    assert any('one: PX4 at 127.0.0.1' in line for line in process.lines)
    assert len(pilots) == 2
