# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The example controllers on vehicles of others: the axes that they have are controlled."""

import re

import pytest
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message

from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.resources import models_folder
from test.support.ros_processes import (
    Peer,
    controller,
    error_lines,
    node,
    place_of,
    reach,
    wait_until,
)

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


def test_rov_controller_on_a_rov_with_six_thrusters_holds_the_axes_that_it_has():
    with Peer() as peer:
        states = peer.collect(Odometry, 'bluerov2/odom', depth=5000)
        pilot = controller('rov', scene='bluerov2', depth=6.0, heading=1.0)
        with pilot, node(scene='bluerov2', pacing='lockstep', enable_wind=False) as simulator:
            there = reach(states, 14.0)
        output = pilot.output
        assert error_lines(simulator.output + output) == []
    assert there[2:] == pytest.approx([-6.0, 1.0], abs=0.02)
    assert "the thrusters of 'bluerov2' do not reach: pitch" in output
    assert 'its righting moment alone keeps it level' in output


def torpedo(tmp_path, rudder_only=False):
    """Write a REMUS 100 whose fins have other names and turn the other way round."""
    text = (models_folder() / 'remus100.xml').read_text()
    text = text.replace('file="parts/', f'file="{models_folder()}/parts/')
    text = text.replace('axis="0 0 -1"', 'axis="0 0 1"').replace('axis="0 -1 0"', 'axis="0 1 0"')
    text = re.sub(r'(<joint|<position) name="rudder"', r'\1 name="tail"', text)
    text = re.sub(r'(<joint|<position) name="planes"', r'\1 name="elevators"', text)
    text = text.replace('joint="rudder"', 'joint="tail"').replace(
        'joint="planes"', 'joint="elevators"'
    )
    joints = '[tail]' if rudder_only else '[elevators, tail]'
    (tmp_path / 'torpedo.xml').write_text(text)
    (tmp_path / 'torpedo.yaml').write_text(
        'model: torpedo.xml\nkeyframe: depth5\nvehicles:\n'
        f'  eel: {{body: remus100, thrusters: [propeller], joints: {joints}}}\n'
    )
    return tmp_path / 'torpedo.yaml'


@pytest.mark.full  # slow
def test_auv_controller_on_a_torpedo_of_a_user_dives_and_heads_with_its_fins(tmp_path):
    scene = torpedo(tmp_path)
    with Peer() as peer:
        states = peer.collect(Odometry, 'eel/odom', depth=5000)
        pilot = controller('auv', scene=scene, depth=8.0, heading=0.7)
        with pilot, node(scene=scene, pacing='lockstep') as simulator:
            there = reach(states, 20.0)
        assert error_lines(simulator.output + pilot.output) == []
    assert there[2] == pytest.approx(-8.0, abs=0.2)
    assert there[3] == pytest.approx(0.7, abs=0.02)
    assert re.search(r'fins elevators, tail: 0\.7\d* 1/m\^2 in pitch and yaw', pilot.output)


def test_auv_controller_says_which_axis_a_torpedo_lacks(tmp_path):
    scene, log = torpedo(tmp_path, rudder_only=True), tmp_path / 'flight.mcap'
    pilot = controller('auv', scene=scene, heading=0.5)
    # from the log: a subscriber may be found later than these 5 s take
    flight = {'pacing': 'lockstep', 'duration': 5.0, 'record__path': log}
    with pilot, node(scene=scene, **flight) as simulator:
        assert simulator.wait() == 0
    *_, last = open_log(log).messages(['/eel/odom'])
    there = place_of(deserialize_message(last.data, Odometry))
    assert last.log_ns == 5_000_000_000
    assert there[3] == pytest.approx(0.45, abs=0.1)  # later it lies on the bed
    assert "the fins of 'eel' do not turn it in pitch: the depth is not held" in pilot.output


@pytest.mark.full  # slow
def test_quad_controller_leaves_the_joints_of_its_vehicle_alone(tmp_path):
    """Such as a gripper: the answers have no values for it."""
    text = (models_folder() / 'x500.xml').read_text()
    text = text.replace('file="parts/', f'file="{models_folder()}/parts/')
    text = re.sub(r'<keyframe>.*</keyframe>', '', text, flags=re.DOTALL)
    gripper = (
        '<body name="gripper" pos="0 0 -.1"><joint name="grip" axis="0 1 0" damping=".01"/>'
        '<geom type="sphere" size=".01" mass=".02" contype="0" conaffinity="0"/></body>'
    )
    text = text.replace('</body>\n  </worldbody>', f'{gripper}</body>\n  </worldbody>')
    text = text.replace('</actuator>', '<position name="grip" joint="grip" kp=".1"/></actuator>')
    scene = tmp_path / 'gripper.xml'
    scene.write_text(text)
    with Peer() as peer:
        states = peer.collect(Odometry, 'x500/odom', depth=5000)
        with node(scene=scene) as simulator, controller('quad', scene=scene) as pilot:
            wait_until(lambda: 'waiting for' in pilot.output, 'the controller')
            there = reach(states, 8.0)
        assert error_lines(simulator.output + pilot.output) == []
    assert there[2] == pytest.approx(states[0].pose.pose.position.z, abs=0.6)
