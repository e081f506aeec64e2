# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
from importlib.util import find_spec
from pathlib import Path

import pytest

from test.packaging.layers import LEAVES, ORDER, PACKAGE, circles, dynamic_imports, violations

ROOT = Path(__file__).resolve().parents[2]
#: Modules that stand at the package's root; everything else has a folder.
AT_THE_ROOT = {'__init__', 'errors', 'resources'}


def test_the_package_keeps_its_layers():
    assert violations(ROOT) == []


def test_every_room_of_the_order_exists_and_the_other_way_round():
    package = ROOT / PACKAGE
    modules = {path.stem for path in package.glob('*.py')}
    folders = {path.parent.name for path in package.glob('*/__init__.py')}

    assert modules == AT_THE_ROOT
    assert folders | modules - {'__init__'} == set(ORDER)
    assert set(LEAVES) <= folders


def test_no_circle_of_imports():
    assert circles(ROOT) == []


def test_modules_that_are_named_by_a_string_exist():
    named = dynamic_imports(ROOT)

    assert named
    for module in named:
        # an attribute or a logger may be named below a module
        assert find_spec(module) or find_spec(module.rpartition('.')[0]), module


@pytest.mark.parametrize(
    ('file', 'line'),
    [
        ('physics/drag.py', 'import mujoco'),
        ('physics/drag.py', 'from rclpy.node import Node'),
        ('physics/drag.py', 'from fluid_sim_ros.scene import Scene'),
        ('physics/drag.py', 'from ..scene import Scene'),
        ('control/hold.py', 'import mujoco'),
        ('control/hold.py', 'from std_msgs.msg import Float64'),
        ('control/hold.py', 'from fluid_sim_ros.plugins import native'),
        ('schema/scene.py', 'from fluid_sim_ros.scene.vehicle import Vehicle'),
        ('scene/media.py', 'from fluid_sim_ros.simulation import Simulation'),
        ('simulation/engine.py', 'from fluid_sim_ros.sensors.imu import Imu'),
        ('messages/cdr.py', 'from fluid_sim_ros.loop.runner import Sink'),
        ('loop/runner.py', 'from fluid_sim_ros.recording.recorder import Recorder'),
        ('simulation/simulation.py', 'from fluid_sim_ros.ros.node import main'),
        ('simulation/simulation.py', 'from fluid_sim_ros import ros'),
        ('simulation/simulation.py', 'from fluid_sim_ros import Scene'),
        ('simulation/simulation.py', 'from .. import recording'),
        ('simulation/simulation.py', 'def f():\n    import rclpy'),
        ('simulation/simulation.py', 'import fluid_sim_ros.cli'),
        ('plugins/native.py', 'from fluid_sim_ros.lab import charts'),
        ('ros/node.py', 'from fluid_sim_ros.mavlink import bridge'),
        ('ros/node.py', 'from ..recording.log import Writer'),
        ('recording/log.py', 'from fluid_sim_ros.ros import cdr'),
        ('lab/chart.py', 'from fluid_sim_ros.sweep import flight'),
        ('sweep/flight.py', 'from fluid_sim_ros.lab import chart'),
        ('new_vehicle/files.py', 'from fluid_sim_ros.lab import chart'),
        ('ros/node.py', 'from fluid_sim_ros.demo import main'),
        ('demo/main.py', 'from fluid_sim_ros.cli.shared import Show'),
        ('errors.py', 'from fluid_sim_ros.scene import Scene'),
        ('colours.py', 'x = 1'),
    ],
)
def test_a_forbidden_import_is_found(tmp_path, file, line):
    path = tmp_path / PACKAGE / file
    path.parent.mkdir(parents=True)
    path.write_text(line + '\n')

    found = violations(tmp_path)

    assert len(found) == 1
    assert found[0].startswith(f'{PACKAGE}/{file}:')


@pytest.mark.parametrize(
    ('file', 'line'),
    [
        ('__init__.py', 'from fluid_sim_ros.simulation import Simulation'),
        ('physics/drag.py', 'from fluid_sim_ros.physics.arrays import Array'),
        ('physics/drag.py', 'from .arrays import Array'),
        ('simulation/simulation.py', 'import mujoco'),
        ('simulation/simulation.py', 'from fluid_sim_ros import __version__'),
        ('ros/node.py', 'from fluid_sim_ros.simulation import Simulation'),
        ('ros/node.py', 'from fluid_sim_ros.control.multirotor import Law'),
        ('cli/main.py', 'from fluid_sim_ros.ros.parameters import check_domain'),
        ('demo/main.py', 'from fluid_sim_ros.recording.reader import open_log'),
        ('scene/scene.py', 'from fluid_sim_ros.errors import ConfigError'),
    ],
)
def test_an_allowed_import_passes(tmp_path, file, line):
    path = tmp_path / PACKAGE / file
    path.parent.mkdir(parents=True)
    path.write_text(line + '\n')

    assert violations(tmp_path) == []


def test_a_circle_is_found(tmp_path):
    for name, other in (('engine', 'snapshot'), ('snapshot', 'engine')):
        path = tmp_path / PACKAGE / 'simulation' / f'{name}.py'
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'from {PACKAGE}.simulation.{other} import {other}\n')

    assert len(circles(tmp_path)) == 1
