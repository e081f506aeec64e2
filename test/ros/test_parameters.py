# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The parameter table, parameter files, and ROS_DOMAIN_ID."""

import importlib
import os
import re

import pytest
import yaml
from rclpy.parameter import Parameter

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.ros.controllers import parameters as controller_parameters
from fluid_sim_ros.ros.parameters import files
from fluid_sim_ros.ros.parameters import simulator as parameters
from fluid_sim_ros.ros.parameters.table import check
from fluid_sim_ros.ros.process.this_host import check_domain
from test.support.ros_processes import Peer

pytestmark = pytest.mark.ros


def test_every_default_passes_its_own_check():
    for name, declared in parameters.TABLE.items():
        assert check(parameters.TABLE, name, declared.default) is None, name


def test_numbers_name_their_unit():
    for name, declared in parameters.TABLE.items():
        if isinstance(declared.default, float):
            assert re.match(r'\[[^]]+\] ', declared.description), name


@pytest.mark.parametrize(
    ('name', 'value', 'fault'),
    [
        ('realtime.factor', 1, None),
        ('realtime.factor', True, 'is not a number'),
        ('realtime.factor', 'fast', 'is not a number'),
        ('realtime.factor', 0.0, 'out of range; allowed: 0.001 to 1000'),
        ('realtime.factor', float('nan'), 'out of range'),
        ('seed', 1.5, 'not of type int'),
        ('pacing', 'lock', 'allowed: realtime, free, lockstep'),
        ('integrator', 'rk4', None),
        ('odom.pose_covariance', [0, 0, 0], 'has 3 values, needs 6'),
        ('odom.pose_covariance', [0, 0, 0, 0, 0, -1], 'out of range'),
        ('odom.pose_covariance', 1.0, 'is not an array'),
        ('lockstep.wait_for', ['a', 'b'], None),
    ],
)
def test_check_names_what_is_allowed(name, value, fault):
    found = check(parameters.TABLE, name, value)
    if fault is None:
        assert found is None
    else:
        assert f"parameter '{name}'" in found
        assert fault in found


def test_physics_is_fixed_while_configured_and_pacing_is_not():
    def judge(name, value, configured=True):
        return parameters.judge_change(peer.node, [Parameter(name, value=value)], configured)

    with Peer() as peer:
        parameters.declare_all(peer.node)
        refused = judge('seed', 7)
        assert not refused.successful
        assert 'fixed while the node is configured' in refused.reason
        assert judge('seed', 7, configured=False).successful
        assert judge('seed', 0).successful  # what it is already
        assert judge('pacing', 'free').successful


PLACES = {
    'scene': '/etc/passwd', 'record.path': '/etc/profile', 'record.allow_assets_from': '/etc',
    'autopilot.mapping': '/etc/passwd', 'autopilot.address': '0.0.0.0',
}  # fmt: skip


def test_no_other_participant_sets_what_names_a_file_or_an_address():
    assert PLACES.keys() == {name for name, entry in parameters.TABLE.items() if entry.names_place}
    with Peer() as peer:
        parameters.declare_all(peer.node)
        # also where it asks for the permission in the same breath
        permission = Parameter('allow_remote_paths', value=True)
        for name, value in PLACES.items():
            for changes in ([Parameter(name, value=value)], [permission]):
                refused = parameters.judge_change(peer.node, changes, configured=False)
                assert not refused.successful
                assert 'fixed after the start' in refused.reason
            present = [peer.node.get_parameter(name)]
            assert parameters.judge_change(peer.node, present, configured=True).successful


def test_whoever_starts_the_node_may_let_others_set_them():
    with Peer(parameter_overrides=[Parameter('allow_remote_paths', value=True)]) as peer:
        parameters.declare_all(peer.node)
        for name, value in PLACES.items():
            change = [Parameter(name, value=value)]
            assert parameters.judge_change(peer.node, change, configured=False).successful
            refused = parameters.judge_change(peer.node, change, configured=True)
            assert 'fixed while the node is configured' in refused.reason
        change = [Parameter('allow_remote_paths', value=False)]
        assert not parameters.judge_change(peer.node, change, configured=False).successful


@pytest.mark.parametrize('path', sorted((config_folder() / 'params').glob('*.yaml')), ids=str)
def test_shipped_parameter_files_hold_known_flat_parameters(path):
    files.check_parameter_files(['--params-file', str(path)])
    nodes = yaml.safe_load(path.read_text())
    for name, value in nodes.pop('fluid_sim_node')['ros__parameters'].items():
        assert check(parameters.TABLE, name, value) is None
    for node, body in nodes.items():
        module = importlib.import_module(
            f'fluid_sim_ros.ros.controllers.{node.removesuffix("_controller")}'
        )
        table = {**controller_parameters.COMMON, **module.OWN}
        for name, value in body['ros__parameters'].items():
            assert check(table, name, value) is None


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('a: {ros__parameters: {schedule: [{at: 1}]}}', "'schedule' is a list of mappings"),
        ('a: {ros__parameters: {x: {y: [[1]]}}}', r"'x\.y' is a list of mappings or lists"),
        ('model: rov\nvehicles: {r: rov}', "holds no 'ros__parameters'.*scene or vehicle file"),
        ('a: [', 'not valid YAML'),
        ('7', 'needs <node name>'),
    ],
)
def test_a_file_that_ros_would_mangle_is_refused(tmp_path, text, line):
    path = tmp_path / 'p.yaml'
    path.write_text(text)
    with pytest.raises(ConfigError, match=line):
        files.check_parameter_files(['--ros-args', '--params-file', str(path)])


def test_a_missing_parameter_file_is_named():
    with pytest.raises(ConfigError, match=r'gone\.yaml: no such parameter file'):
        files.check_parameter_files(['--params-file', 'gone.yaml'])


@pytest.mark.parametrize('text', ['233', '-1', 'abc', '1.5', '99999999999'])
def test_a_wrong_domain_is_refused(monkeypatch, text):
    monkeypatch.setenv('ROS_DOMAIN_ID', text)
    with pytest.raises(ConfigError, match=f"ROS_DOMAIN_ID is '{text}'; allowed: 0 to 232"):
        check_domain()


def test_discovery_stays_on_this_host_unless_opened(monkeypatch):
    monkeypatch.delenv('ROS_AUTOMATIC_DISCOVERY_RANGE', raising=False)
    check_domain()
    assert os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] == 'LOCALHOST'
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'SUBNET')
    check_domain()
    assert os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] == 'SUBNET'
