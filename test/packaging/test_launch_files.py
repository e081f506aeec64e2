# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The launch files: their arguments, and what they start."""

import re
import sys
from pathlib import Path

import pytest
import yaml

from fluid_sim_ros import Simulation
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.ros.controllers.parameters import COMMON
from fluid_sim_ros.ros.parameters import simulator as parameters
from test.support import launch_double as launch
from test.support.egg_info import sections
from test.support.paths import ROOT
from test.support.urdf_links import by_urdf_parser

FILES = sorted((ROOT / 'launch').glob('*.launch.py'))
MAIN = ROOT / 'launch/fluid_sim.launch.py'
RVIZ = ROOT / 'launch/rviz.launch.py'
FOXGLOVE = ROOT / 'launch/foxglove.launch.py'
#: Packages of ROS that only arguments which are off by default need.
OPTIONAL = {'rviz2', 'foxglove_bridge', 'robot_state_publisher'}


@pytest.fixture
def start(monkeypatch, tmp_path):
    """Return a function that takes arguments, and returns the nodes that they start."""
    launch.install(monkeypatch)
    program = tmp_path / 'fluid_sim'
    program.write_text(
        f'#!{sys.executable}\nfrom fluid_sim_ros.cli import main\nraise SystemExit(main())\n'
    )
    program.chmod(0o755)
    executables = {('fluid_sim_ros', 'fluid_sim'): str(program)}

    def run(path=MAIN, **given):
        return launch.started(path, {'executables': executables, **given})

    return run


@pytest.mark.parametrize('path', FILES, ids=lambda path: path.name)
def test_every_argument_has_a_default_and_is_described(path, monkeypatch):
    launch.install(monkeypatch)
    arguments = launch.arguments_of(path)
    assert len(arguments) > 1
    for argument in arguments:
        assert isinstance(argument.default_value, str), argument.name
        assert len(argument.description) > 10, argument.name
        if argument.default_value in ('true', 'false'):
            assert argument.choices == ('false', 'true'), argument.name


def test_the_main_file_lists_the_arguments_of_the_one_that_it_includes(monkeypatch):
    launch.install(monkeypatch)
    main, included = (
        {argument.name: argument for argument in launch.arguments_of(path)}
        for path in (MAIN, RVIZ)
    )
    for name, argument in included.items():
        assert main[name].default_value == argument.default_value


def test_its_choices_are_those_of_the_node_and_the_package(monkeypatch, egg_info):
    launch.install(monkeypatch)
    arguments = {argument.name: argument for argument in launch.arguments_of(MAIN)}
    scripts = sections((egg_info / 'entry_points.txt').read_text())['console_scripts']
    commands = {line.split('=')[0].strip() for line in scripts}
    assert arguments['pacing'].choices == ('', *parameters.PACINGS)
    controllers = {name for name in commands if name.endswith('_controller')}
    assert {*arguments['controller'].choices} == controllers | {'none'}


def test_alone_it_starts_the_simulator_and_ends_with_it(start):
    (simulator,) = start()
    assert (simulator.package, simulator.executable) == ('fluid_sim_ros', 'fluid_sim_node')
    assert simulator.given == {} and simulator.namespace is None
    assert simulator.on_exit is not None


def test_arguments_become_parameters_that_there_are(start):
    (simulator,) = start(
        scene='x500', pacing='free', params_file='a.yaml', record='a.mcap', namespace='sim'
    )
    assert simulator.given == {
        'file': 'a.yaml', 'scene': 'x500', 'pacing': 'free', 'record.path': 'a.mcap',
    }  # fmt: skip
    assert simulator.given.keys() - {'file'} <= parameters.TABLE.keys()
    assert simulator.parameters[0] == 'a.yaml'  # what comes later wins
    assert simulator.namespace == 'sim'


def test_one_controller_or_one_for_each_vehicle(start):
    _, controller = start(scene='rov', controller='rov_controller')
    assert (controller.executable, controller.given) == ('rov_controller', {'scene': 'rov'})
    _, *several = start(
        scene='fleet_x500', controller='quad_controller', vehicles='one, two,three'
    )
    assert [node.name for node in several] == [
        'quad_controller_one', 'quad_controller_two', 'quad_controller_three',
    ]  # fmt: skip
    assert [node.given['vehicle'] for node in several] == ['one', 'two', 'three']
    assert several[0].given.keys() <= COMMON.keys()


def test_rviz_shows_the_vehicles_of_the_scene_on_topics_that_there_are(start):
    _, rviz = start(scene='fleet_mixed', rviz='true', namespace='sim')
    assert (rviz.package, rviz.given) == ('rviz2', {'use_sim_time': True})
    flag, path = rviz.arguments
    assert flag == '-d'
    config = yaml.safe_load(Path(path).read_text(encoding='utf-8'))
    shown = config['Visualization Manager']['Displays']
    named = [
        display[key]['Value']
        for display in shown
        for key in ('Topic', 'Description Topic')
        if key in display
    ]
    simulation = Simulation('fleet_mixed')
    topics = {f'/sim/{t.name}': t for t in StateTopics(simulation, DEFAULTS).topics}
    assert set(named) <= topics.keys() and len(named) == 3 * len(simulation.vehicles)
    for display in shown:
        for key in ('Topic', 'Description Topic'):
            if key in display:
                latched = topics[display[key]['Value']].quality.transient_local
                wanted = display[key]['Durability Policy'] == 'Transient Local'
                assert wanted == latched, display
    assert config['Visualization Manager']['Global Options']['Fixed Frame'] == 'map'


def test_rviz_takes_a_file_of_the_user_without_a_scene(start):
    (rviz,) = start(RVIZ, rviz_config='mine.rviz')
    assert rviz.arguments == ['-d', 'mine.rviz']
    with pytest.raises(RuntimeError, match='give scene:=NAME'):
        start(RVIZ)
    with pytest.raises(RuntimeError, match="scene 'moon' is not known"):
        start(RVIZ, scene='moon')


def test_foxglove_is_served_by_the_simulator_or_by_its_own_bridge_on_this_host(start):
    (simulator,) = start(foxglove='true')
    assert simulator.given == {'foxglove.port': 8765}
    assert simulator.given.keys() <= parameters.TABLE.keys()
    (simulator,) = start(foxglove='true', foxglove_port='9000')
    assert simulator.given == {'foxglove.port': 9000}
    (bridge,) = start(FOXGLOVE)
    assert bridge.package == 'foxglove_bridge'
    assert bridge.given['address'] == '127.0.0.1' and bridge.given['use_sim_time'] is True
    (bridge,) = start(FOXGLOVE, foxglove_port='9000', foxglove_address='0.0.0.0')
    assert (bridge.given['port'], bridge.given['address']) == ('9000', '0.0.0.0')


def test_state_publishers_have_the_urdf_and_the_links_to_themselves(start):
    simulator, publisher = start(scene='remus100', state_publisher='true')
    assert simulator.given['tf.links'] is False
    assert publisher.namespace == 'remus100'
    robot, _ = by_urdf_parser(publisher.given['robot_description'], {})
    assert robot.name == 'remus100'
    with pytest.raises(RuntimeError, match='needs scene:=NAME'):
        start(state_publisher='true')


@pytest.mark.full  # each vehicle is a program of its own
def test_state_publishers_of_a_fleet_are_named_one_by_one(start):
    _, *several = start(
        scene='fleet_mixed', state_publisher='true', vehicles='one,rov', namespace='sim'
    )
    assert [node.namespace for node in several] == ['sim/one', 'sim/rov']
    with pytest.raises(RuntimeError, match='--vehicle: names one of'):
        start(scene='fleet_mixed', state_publisher='true')


def test_a_word_that_is_not_allowed_is_refused(start):
    with pytest.raises(RuntimeError, match='pacing: slow'):
        start(pacing='slow')


def test_packages_that_only_arguments_need_are_told_of():
    page = (ROOT / 'doc/ros_conventions.md').read_text(encoding='utf-8')
    used = {
        name
        for path in FILES
        for name in re.findall(r"package='(\w+)'", path.read_text(encoding='utf-8'))
    }
    assert used - {'fluid_sim_ros'} == OPTIONAL
    assert all(f'`{name}`' in page for name in OPTIONAL)


def test_real_launch_reads_them():
    """With an installed ROS 2: ``ros2 launch ... --show-args`` lists every argument."""
    try:
        from launch import LaunchContext, LaunchDescription
        from launch.launch_description_sources import (
            get_launch_description_from_python_launch_file,
        )
    except ImportError:
        pytest.skip('the package launch is not among the wheels of ROS 2: needs an installed one')
    for path in FILES:
        description = get_launch_description_from_python_launch_file(str(path))
        assert isinstance(description, LaunchDescription)
        arguments = description.get_launch_arguments()
        assert all(argument.description for argument in arguments)
        context = LaunchContext()
        for argument in arguments:
            argument.execute(context)
        assert set(context.launch_configurations) == {argument.name for argument in arguments}
