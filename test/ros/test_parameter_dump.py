# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every parameter survives ``ros2 param dump`` and ``ros2 param load``, of every node."""

import math

import pytest
import yaml
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient

from fluid_sim_ros.control.fixed_wing import FixedWingGains
from fluid_sim_ros.control.multirotor import MultirotorGains
from fluid_sim_ros.control.torpedo import TorpedoGains
from fluid_sim_ros.control.underwater import UnderwaterGains
from fluid_sim_ros.ros.controllers import auv, plane, rov
from fluid_sim_ros.ros.controllers.parameters import table_of
from fluid_sim_ros.ros.parameters.simulator import TABLE
from test.support.ros_processes import (
    NODE,
    Forked,
    Peer,
    controller,
    error_lines,
    node,
    wait_until,
)
from test.support.volumes import quick

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

KINDS = ('auv', 'plane', 'quad', 'rov')
TABLES = {
    'node': TABLE, 'auv': table_of(TorpedoGains, auv.OWN),
    'plane': table_of(FixedWingGains, plane.OWN), 'quad': table_of(MultirotorGains, {}),
    'rov': table_of(UnderwaterGains, rov.OWN),
}  # fmt: skip


def values_of(peer, name):
    """Return the values of all parameters of a node by the services that ros2 param uses."""
    names = sorted(peer.call(ListParameters, f'{name}/list_parameters').result.names)
    values = peer.call(GetParameters, f'{name}/get_parameters', names=names).values
    return {n: parameter_value_to_python(v) for n, v in zip(names, values, strict=True)}


def dumped(peer, name):
    """Return the YAML text of ``ros2 param dump``, which nests the names at their dots."""
    tree = {}
    for full, value in values_of(peer, name).items():
        *folders, leaf = full.split(PARAMETER_SEPARATOR_STRING)
        place = tree
        for folder in folders:
            place = place.setdefault(folder, {})
        # where one name is the beginning of another, a value stands here: TypeError, as in ros2cli
        place[leaf] = list(value) if hasattr(value, 'tolist') else value
    return yaml.dump({name: {'ros__parameters': tree}}, default_flow_style=False)


def same(one, other):
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    if hasattr(one, '__len__') and hasattr(other, '__len__'):
        return list(one) == list(other)
    return one == other


def assert_same(found, expected):
    assert found.keys() == expected.keys()
    for name, value in expected.items():
        assert same(found[name], value), (name, found[name], value)


def changed_text(text, **values):
    tree = yaml.safe_load(text)
    (body,) = tree.values()
    for name, value in values.items():
        *folders, leaf = name.split('__')
        place = body['ros__parameters']
        for folder in folders:
            place = place[folder]
        assert leaf in place
        place[leaf] = value
    return yaml.dump(tree, default_flow_style=False)


@pytest.mark.parametrize('name', TABLES)
def test_no_parameter_is_the_beginning_of_another(name):
    table = TABLES[name]
    for parameter in table:
        below = [other for other in table if other.startswith(f'{parameter}.')]
        assert not below, (parameter, below)


def test_every_parameter_of_the_node_survives_dump_and_start(tmp_path):
    path = tmp_path / 'p.yaml'
    settings = {'scene': 'rov', 'odom__pose_covariance': '[1e-5,0.0,0.0,0.0,0.0,0.5]'}
    with Peer() as peer, node(**settings):
        text = dumped(peer, '/fluid_sim_node')
        before = values_of(peer, '/fluid_sim_node')
        assert before['record.path'] == '' and before['scene'] == 'rov'
    path.write_text(text)
    arguments = ('--ros-args', '--params-file', str(path))
    with Peer() as peer, Forked(NODE, *arguments) as process:
        assert_same(values_of(peer, '/fluid_sim_node'), before)
        assert not error_lines(process.output)


@pytest.mark.parametrize('kind', quick(KINDS, 'quad'))
def test_every_parameter_of_a_controller_survives_dump_and_start(kind, tmp_path):
    """Also ``nan`` and an empty list of waypoints."""
    path, name = tmp_path / 'p.yaml', f'/{kind}_controller'
    with Peer() as peer, controller(kind):
        text, before = dumped(peer, name), values_of(peer, name)
    path.write_text(text)
    module = f'fluid_sim_ros.ros.controllers.{kind}'
    with Peer() as peer, Forked(module, '--ros-args', '--params-file', str(path)) as process:
        assert_same(values_of(peer, name), before)
        assert not error_lines(process.output)


def load(peer, name, path):
    """Return what ``ros2 param load`` says: the result of each parameter by its name."""
    client = AsyncParameterClient(peer.node, name)
    assert client.wait_for_services(30.0)
    future = client.load_parameter_file(str(path))
    wait_until(future.done, 'the answer to the load')
    names = list(yaml.safe_load(path.read_text())[name]['ros__parameters'])
    return future.result().results, names


READ_ONLY = 'read-only'  # rclpy's own: qos_overrides and start_type_description_service


@pytest.mark.parametrize('kind', ['node', 'rov'])
def test_a_dump_is_loaded_into_the_running_node_and_changes_what_differs(kind, tmp_path):
    start = (lambda: node(scene='rov')) if kind == 'node' else (lambda: controller('rov'))
    name = '/fluid_sim_node' if kind == 'node' else '/rov_controller'
    path = tmp_path / 'p.yaml'
    with Peer() as peer, start() as process:
        text, before = dumped(peer, name), values_of(peer, name)
        path.write_text(text)
        results, _ = load(peer, name, path)
        refused = [r.reason for r in results if not r.successful and READ_ONLY not in r.reason]
        assert not refused
        found = values_of(peer, name)
        for parameter, value in before.items():
            assert same(found[parameter], value) or str(found[parameter]) == str(value)
        change = {'realtime__factor': 2.5e-3} if kind == 'node' else {'depth': 3.0}
        path.write_text(changed_text(text, **change))
        load(peer, name, path)
        ((key, value),) = change.items()
        assert values_of(peer, name)[key.replace('__', '.')] == value
        fixed = {'seed': 7} if kind == 'node' else {'gains__position': 9.0}
        path.write_text(changed_text(text, **fixed))
        results, _ = load(peer, name, path)
        assert any('fixed while' in r.reason for r in results)
        assert process.alive


@pytest.mark.parametrize(
    ('name', 'text', 'value'),
    [('realtime.factor', '1e-2', 0.01), ('command_timeout', '25e-2', 0.25)],
)
def test_numbers_that_ros2cli_takes_for_texts_are_numbers(name, text, value):
    """YAML takes ``1e-2`` for a text, and so ``ros2 param set`` sends one."""
    with Peer() as peer, node(scene='sphere'):
        parameter = Parameter(
            name=name,
            value=ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=text),
        )
        service = '/fluid_sim_node/set_parameters'
        (result,) = peer.call(SetParameters, service, parameters=[parameter]).results
        assert result.successful, result.reason
        assert float(values_of(peer, '/fluid_sim_node')[name]) == value


def test_the_old_name_of_record_path_works_for_one_release_with_a_word(tmp_path):
    path = tmp_path / 'a.mcap'
    with node(scene='sphere', record=path, duration=0.1, pacing='free') as process:
        assert process.wait() == 0
        assert "parameter 'record' is called 'record.path' now" in process.output
    assert path.stat().st_size > 1000
    with node(scene='sphere', record=path, record__path=path) as process:
        assert process.wait() == 2
        assert "'record.path' and 'record' are the same" in process.output
