# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node as a process: signals, exit codes, two of them, and wrong starts."""

import signal
from itertools import product

import pytest
from nav_msgs.msg import Odometry

from test.support.ros_processes import (
    NODE,
    Forked,
    Peer,
    Process,
    error_lines,
    node,
    wait_until,
)
from test.support.volumes import quick

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


PACINGS, SIGNALS = ('realtime', 'free', 'lockstep'), (signal.SIGINT, signal.SIGTERM)
ENDS = quick(
    product(PACINGS, SIGNALS), ('realtime', signal.SIGINT), ('free', signal.SIGTERM),
    ('lockstep', signal.SIGINT),
)  # fmt: skip


@pytest.mark.parametrize('end', ENDS, ids=str)
def test_a_signal_ends_the_node_with_exit_code_0(end):
    pacing, number = end
    with Peer() as peer:
        odometry = peer.collect(Odometry, 'x500/odom')
        with node(Process, scene='quadrotor', pacing=pacing) as process:
            wait_until(lambda: odometry, 'odometry')
            process.signal(number)
            assert process.wait(10) == 0
            assert not error_lines(process.output)


def test_two_instances_in_namespaces_do_not_meet():
    arguments = ('--ros-args', '-r', '__ns:=/one')
    with Peer() as peer:
        one = peer.collect(Odometry, '/one/sphere/odom')
        two = peer.collect(Odometry, '/sphere/odom')
        with Forked(NODE, *arguments, scene='sphere'), node(scene='sphere'):
            wait_until(lambda: len(one) > 3 and len(two) > 3, 'both odometries')


@pytest.mark.parametrize(
    ('parameters', 'words'),
    [
        ({'scene': 'atlantis'}, "scene 'atlantis' is not known; scenes: "),
        (
            {'scnee': 'rov'},
            "parameter 'scnee' is not known; did you mean 'scene'? parameters: ",
        ),
        ({'pacing': 'lock'}, 'allowed: realtime, free, lockstep'),
        ({'use_sim_time': True}, 'must be false for this node'),
        (
            {'scene': 'sphere', 'odom__rate': 600.0, 'tf__rate': 700.0},
            "parameter 'odom.rate': rate 600 Hz is above the step rate; allowed is at most 500 "
            "Hz, or a timestep of at most 0.001667 s; parameter 'tf.rate': rate 700 Hz",
        ),
        ({'scene': 'sphere', 'pacing': 'lockstep'}, 'lockstep needs a topic to wait for'),
        (
            {'scene': 'quadrotor', 'pacing': 'lockstep', 'lockstep__wait_for': '[a/b]'},
            "'a/b' is no command topic of this scene; it has: x500/cmd/thrust",
        ),
        (
            {'scene': 'quadrotor', 'pacing': 'lockstep', 'odom__rate': 50.0},
            'not a multiple of the',
        ),
    ],
)
def test_a_wrong_start_is_one_line_and_exit_code_2(parameters, words):
    with node(**parameters) as process:
        assert process.wait() == 2
    (line,) = [line for line in process.lines if line.startswith('fluid_sim_node: error:')]
    assert words in line
    assert 'Traceback' not in process.output


def test_a_wrong_domain_is_one_line(monkeypatch):
    monkeypatch.setenv('ROS_DOMAIN_ID', 'seven')
    with node(scene='sphere') as process:
        assert process.wait() == 2
    assert process.lines == ["fluid_sim_node: error: ROS_DOMAIN_ID is 'seven'; allowed: 0 to 232"]


def test_a_scene_file_as_parameter_file_is_refused(tmp_path):
    path = tmp_path / 'scene.yaml'
    path.write_text('model: rov\nschedule: [{at: 1}]\n')
    with Forked(NODE, '--ros-args', '--params-file', str(path)) as process:
        assert process.wait() == 2
    assert "belongs in the parameter 'scene'" in process.output
