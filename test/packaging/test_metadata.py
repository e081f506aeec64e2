# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import ast
import re
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path
from xml.etree import ElementTree

import pytest

import fluid_sim_ros
from fluid_sim_ros.messages.definitions import known
from test.support.egg_info import sections

ROOT = Path(__file__).resolve().parents[2]
# Message packages and ROS libraries as package.xml names them.
MESSAGE_TYPE = re.compile(r'^(\w+)/msg/\w+$')
ROS_PACKAGE = re.compile(r'^(rclpy|launch|launch_ros|std_srvs|\w+_msgs|\w+_interfaces)$')


@pytest.fixture(scope='module')
def package_xml():
    return ElementTree.parse(ROOT / 'package.xml').getroot()


def test_package_xml_is_what_colcon_needs_for_ament_python(package_xml):
    # colcon degrades the package to plain python without a word when any of these is wrong
    assert package_xml.get('format') == '3'
    assert package_xml.findtext('name') == 'fluid_sim_ros'
    assert package_xml.findtext('export/build_type') == 'ament_python'
    assert re.fullmatch(r'\d+\.\d+\.\d+', package_xml.findtext('version'))
    assert package_xml.findtext('license') == 'Apache-2.0'
    email = package_xml.find('maintainer').get('email')
    assert re.fullmatch(r'[\w.+-]+@[\w-]+(\.[\w-]+)+', email)


def test_the_version_is_the_same_everywhere(package_xml, egg_info):
    version = fluid_sim_ros.__version__
    changelog = (ROOT / 'CHANGELOG.rst').read_text()
    releases = re.findall(r'^(\d+\.\d+\.\d+) \(\d{4}-\d{2}-\d{2}\)\n-+$', changelog, re.MULTILINE)

    assert package_xml.findtext('version') == version
    assert f'\nVersion: {version}\n' in (egg_info / 'PKG-INFO').read_text()
    assert releases[0] == version


def test_the_resource_marker_is_there():
    assert (ROOT / 'resource' / 'fluid_sim_ros').is_file()


def test_colcon_finds_pytest_in_the_test_extra(egg_info):
    extras = sections((egg_info / 'requires.txt').read_text())
    assert any(re.match(r'pytest\b(?!-)', line) for line in extras['test'])


def test_the_installing_page_lists_every_extra_that_a_user_may_want(egg_info):
    extras = set(sections((egg_info / 'requires.txt').read_text())) - {''}
    for_developers = {'test', 'peers', 'dev', 'docs', 'coverage'}
    rows = (ROOT / 'doc/install.md').read_text().partition('| Extra | For |')[2].split('\n\n')[0]
    listed = re.findall(r'`(\w+)`', '\n'.join(row.split('|')[1] for row in rows.splitlines()[2:]))
    assert sorted(listed) == sorted(extras - for_developers)


def test_the_mujoco_that_builds_is_the_mujoco_that_runs(egg_info):
    required = sections((egg_info / 'requires.txt').read_text())['']
    build = tomllib.loads((ROOT / 'pyproject.toml').read_text())['build-system']['requires']

    pins = [line for line in required if line.startswith('mujoco')]
    assert pins == ['mujoco==4.0.0']
    assert pins[0] in build


def test_every_command_can_be_imported(egg_info):
    scripts = sections((egg_info / 'entry_points.txt').read_text())['console_scripts']
    assert len(scripts) == 6
    for line in scripts:
        name, value = (part.strip() for part in line.split('='))
        assert callable(EntryPoint(name, value, 'console_scripts').load()), line


def test_package_xml_names_every_ros_package_that_is_used(package_xml):
    named = {node.text for node in package_xml.findall('exec_depend')}
    used = {message.split('/')[0] for message in known()}  # imported by the names of their types
    for path in [*(ROOT / 'fluid_sim_ros').rglob('*.py'), *(ROOT / 'launch').glob('*.py')]:
        for node in ast.walk(ast.parse(path.read_text())):
            modules = [node.module or ''] if isinstance(node, ast.ImportFrom) else []
            if isinstance(node, ast.Import):
                modules = [alias.name for alias in node.names]
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                modules = MESSAGE_TYPE.findall(node.value)  # looked up by name when it is wanted
            used |= {module.split('.')[0] for module in modules}
            # messages are found by the name of their type: 'nav_msgs/msg/Odometry'
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                used |= set(re.findall(r'^(\w+)/msg/\w+$', node.value))
    used = {name for name in used if ROS_PACKAGE.match(name)}

    assert used >= {'rclpy', 'nav_msgs'}
    assert used <= named
