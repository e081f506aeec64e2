# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Words on the command line that nobody takes, and parameters that are for another node."""

import re

import pytest
import rclpy
from rclpy.context import Context

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.ros.parameters.files import lost_parameters
from fluid_sim_ros.ros.process.command_line import start_ros
from fluid_sim_ros.ros.raw import parameter_overrides
from test.support.ros_processes import NODE, Forked, Peer, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['--scene', 'rov'], "argument '--scene' is not known; parameters are given as"),
        (['--hlep'], "did you mean '--help'?"),
        (['rov.yaml'], "argument 'rov.yaml' is not known"),
        (['--ros-args', '--bogus', '3'], "cannot use ['--bogus', '3']"),
        (['--ros-args', '-p'], 'cannot use trailing -p flag'),
        (['--ros-args', '-p', 'scene'], "parameter override rule: '-p scene'"),
        (['--ros-args', '-p', 'a:=[1,2.5]'], 'Sequence should be of same type'),
        (['--ros-args', '-r', '__node:=1'], "remap rule: '-r __node:=1'"),
        (['--ros-args', '--log-level', 'silly'], "log level: '--log-level silly'"),
    ],
)
def test_a_word_that_nobody_takes_is_named(arguments, words):
    with pytest.raises(ConfigError, match=re.escape(words)):
        start_ros(['fluid_sim_node', *arguments])


def test_a_wrong_command_line_is_one_line_and_exit_code_2():
    with Forked(NODE, '--ros-args', '-p', 'a:=[1,2.5]') as process:
        assert process.wait() == 2
    (line,) = process.lines
    assert line.startswith('fluid_sim_node: error: command line: cannot use parameter')


FILE = '{name}:\n  ros__parameters:\n    scene: sphere\n    pacing: free\n'


@pytest.mark.parametrize(
    ('name', 'namespace', 'known'),
    [
        ('fluid_sim_node', '', True),
        ('/fluid_sim_node', '', True),
        ('/**', '', True),
        ('/*', '', True),
        ('/tank/fluid_sim_node', 'tank', True),
        ('/*/fluid_sim_node', 'tank', True),
        ('/**/fluid_sim_node', 'tank', True),
        ('/**/fluid_sim_node', '', True),
        ('fluid_sim', '', False),
        ('fluid_sim_node', 'tank', False),
        ('/*', 'tank', False),
        ('/tank/*', '', False),
    ],
)
def test_a_file_for_another_node_is_named_where_ros_itself_does_not_take_it(
    tmp_path, name, namespace, known
):
    path = tmp_path / 'p.yaml'
    path.write_text(FILE.format(name=name))
    remap = ['-r', f'__ns:=/{namespace}'] if namespace else []
    arguments = ['x', '--ros-args', '--params-file', str(path), *remap]
    context = Context()
    rclpy.init(args=arguments, context=context)
    node = rclpy.create_node('fluid_sim_node', context=context)
    try:
        assert ('scene' in parameter_overrides(node)) == known
        assert bool(lost_parameters(arguments, node.get_fully_qualified_name())) != known
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)


def test_a_file_for_another_node_stands_in_diagnostics(tmp_path):
    path = tmp_path / 'p.yaml'
    path.write_text(FILE.format(name='fluid_sim'))
    with Peer() as peer:
        peer.watch_diagnostics()
        with Forked(NODE, '--ros-args', '--params-file', str(path)):
            wait_until(
                lambda: str(path) in peer.diagnostics.get('start', (0, ''))[1], 'the warning'
            )
    level, line, _ = peer.diagnostics['start']
    assert level == 1
    assert 'call it /fluid_sim_node' in line


def test_namespaces_that_are_nested_are_read(tmp_path):
    path = tmp_path / 'p.yaml'
    path.write_text('tank: {fluid_sim_node: {ros__parameters: {scene: sphere}}}')
    arguments = ['--params-file', str(path)]
    assert lost_parameters(arguments, '/tank/fluid_sim_node') == []
    (line,) = lost_parameters(arguments, '/fluid_sim_node')
    assert 'it is for: /tank/fluid_sim_node' in line


def test_a_parameter_for_another_node_is_named():
    lines = lost_parameters(['--ros-args', '-p', 'sim:scene:=rov', '-p', 'seed:=1'], '/sim2')
    assert lines == [
        "parameter 'scene' is set for another node, 'sim', and not for this one, /sim2"
    ]
    assert not lost_parameters(['--ros-args', '-p', 'sim2:scene:=rov'], '/sim2')
