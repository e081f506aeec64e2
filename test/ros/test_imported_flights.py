# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A quadrotor and an ROV from their URDF files fly over topics: import, node, controller."""

import pytest
from nav_msgs.msg import Odometry

from fluid_sim_ros.cli import main
from fluid_sim_ros.resources import models_folder
from test.support.ros_processes import Peer, controller, error_lines, node, reach

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]
pytest.importorskip('capytaine')
EXAMPLES = models_folder() / 'examples'


def imported(name, folder, *options):
    """Import an example; return its scene."""
    file, answers = EXAMPLES / f'{name}.urdf', EXAMPLES / f'{name}_answers.yaml'
    words = ['import', str(file), '--answers', str(answers), '--out', str(folder), *options]
    assert main(words) == 0
    return folder / f'{name}.yaml'


def test_the_quadrotor_of_a_urdf_flies_to_a_waypoint(tmp_path):
    scene = imported('small_quad', tmp_path)
    with Peer() as peer:
        states = peer.collect(Odometry, 'small_quad/odom', depth=5000)
        pilot = controller('quad', scene=scene, waypoints='[1.0, 0.5, 2.0, 0.5, 0.0]')
        with pilot, node(scene=scene, pacing='lockstep') as simulator:
            there = reach(states, 8.0)
        assert error_lines(simulator.output + pilot.output) == []
    assert there == pytest.approx([1.0, 0.5, 2.0, 0.5], abs=0.03)


@pytest.mark.full
def test_the_rov_of_a_urdf_dives_and_turns(tmp_path):
    scene = imported('frame_rov', tmp_path, '--panels', '60')
    with Peer() as peer:
        states = peer.collect(Odometry, 'frame_rov/odom', depth=5000)
        pilot = controller('rov', scene=scene, depth=4.0, heading=1.0)
        with pilot, node(scene=scene, pacing='lockstep') as simulator:
            there = reach(states, 14.0)
        assert error_lines(simulator.output + pilot.output) == []
    assert there[2:] == pytest.approx([-4.0, 1.0], abs=0.02)
