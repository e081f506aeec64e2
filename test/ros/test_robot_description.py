# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``<v>/robot_description`` on the graph, as RViz's RobotModel subscribes to it, and in logs."""

import pytest
from rosbags.typesys import Stores, get_typestore
from std_msgs.msg import String

from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight
from test.support.ros_processes import Peer, node, wait_until
from test.support.urdf_links import by_urdf_parser

pytestmark = pytest.mark.ros


def test_who_comes_later_gets_the_description_and_its_links_are_frames_of_tf():
    with Peer() as peer, node(scene='remus100'):
        for _ in range(2):
            received = peer.collect(String, 'remus100/robot_description', latched=True)
            wait_until(lambda received=received: received, 'the description')
        robot, _ = by_urdf_parser(received[0].data, {})
    links = {link.name for link in robot.links}
    assert {'remus100/base_link', 'remus100/rudder', 'remus100/planes'} <= links
    assert 'remus100/imu' in links or 'remus100/dvl' in links


def test_a_log_holds_it_for_viewers(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'fleet_mixed', seconds=0.05, piloted=False)
    log, kinds = open_log(tmp_path / 'a.mcap'), get_typestore(Stores.ROS2_JAZZY)
    names = [f'/{name}/robot_description' for name in ('one', 'two', 'rov')]
    messages = list(log.messages(names))
    assert [m.topic for m in messages] == names
    for message, name in zip(messages, ('one', 'two', 'rov'), strict=True):
        text = kinds.deserialize_cdr(message.data, 'std_msgs/msg/String').data
        assert by_urdf_parser(text, {})[0].name == name


@pytest.mark.full  # one more node
def test_what_urdf_cannot_say_is_said(tmp_path):
    path = tmp_path / 'a.xml'
    path.write_text(
        '<mujoco><worldbody><body name="a"><freejoint/><geom size=".1"/><body name="b">'
        '<joint name="neck" type="ball"/><geom size=".1"/></body></body></worldbody></mujoco>'
    )
    with Peer() as peer, node(scene=path) as process:
        wait_until(
            lambda: "robot_description: joint 'neck' is a ball joint" in process.output, 'the note'
        )
        wait_until(lambda: peer.node.get_publishers_info_by_topic('/a/odom'), 'the node')
