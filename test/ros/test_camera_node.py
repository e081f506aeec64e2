# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pictures of the node over real DDS, in lockstep, recorded and flown again."""

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, JointState

from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.camera_scene import camera_scene
from test.support.ros_processes import Peer, node, stamp_ns

pytestmark = [pytest.mark.ros, pytest.mark.full, pytest.mark.usefixtures('ros_domain')]

HOVER = [5.05] * 4  # [N]


def flown(scene, look, **parameters):
    """Return (odometry, pictures, infos) of a second of lockstep."""
    with Peer() as peer:
        odometry, pictures, infos = [], [], []
        if look:
            pictures = peer.collect(Image, 'x500/camera/depth/image_raw', reliable=False)
            infos = peer.collect(CameraInfo, 'x500/camera/depth/camera_info', reliable=False)
        answers = peer.node.create_publisher(JointState, 'x500/cmd/thrust_stamped', 10)

        def answer(message):
            odometry.append(message)
            reply = JointState(effort=HOVER)
            reply.header.stamp = message.header.stamp
            answers.publish(reply)

        peer.node.create_subscription(Odometry, 'x500/odom', answer, 10)
        with node(scene=str(scene), pacing='lockstep', duration=1.0, **parameters) as process:
            assert process.wait() == 0
    return {stamp_ns(m): m.pose for m in odometry}, pictures, infos


def test_pictures_in_lockstep_and_in_the_log_leave_the_flight_as_it_is(tmp_path):
    scene = camera_scene(tmp_path)
    bare, *_ = flown(scene, look=False)
    log = tmp_path / 'a.mcap'
    seen, pictures, infos = flown(scene, look=True, record=str(log))
    assert seen == bare
    assert len(infos) >= 5 and len(pictures) >= 5
    info, picture = infos[0], pictures[0]
    assert picture.header.frame_id == info.header.frame_id == 'x500/camera_optical_frame'
    assert (picture.width, picture.height, picture.encoding) == (64, 48, '32FC1')
    assert info.k[0] == pytest.approx(32 / np.tan(np.radians(30)))
    # a picture is of its stamp, and appears 20 ms later
    assert {stamp_ns(m) % 100_000_000 for m in pictures} == {0}
    recorded = [m for m in open_log(log).messages() if m.topic.endswith('depth/image_raw')]
    assert len(recorded) == 10
    assert {m.log_ns % 100_000_000 for m in recorded} == {20_000_000}
    again = resimulate(open_log(log))
    assert again.difference is None and again.compared > 500
    assert any('not drawn again' in note for note in again.notes)
