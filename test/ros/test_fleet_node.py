"""A fleet in the node: topics of each vehicle, and a controller for each in one lockstep."""

import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

from test.support.ros_processes import Peer, Process, error_lines, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

FLEET = """
vehicles:
  one: {model: x500, position: [0, 0, 2], keyframe: hover}
  two: {model: x500, position: [3, 0, 2], yaw: 90, keyframe: hover}
"""


def pilot(scene, vehicle, **parameters):
    arguments = ('--ros-args', '-r', f'__node:=pilot_{vehicle}')
    return Process(
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
                lambda: all(s and stamp_ns(s[-1]) > 4e9 for s in odometry.values()), '4 s of both'
            )
        assert error_lines(simulator.output + one.output + two.output) == []
    places = {v: states[-1].pose.pose.position for v, states in odometry.items()}
    assert [places['one'].x, places['one'].y] == pytest.approx([0.0, 1.0], abs=0.1)
    assert [places['two'].x, places['two'].y] == pytest.approx([3.0, 0.0], abs=0.01)
    assert odometry['two'][-1].child_frame_id == 'two/base_link'
    assert joints[-1].name == ['m1', 'm2', 'm3', 'm4']
