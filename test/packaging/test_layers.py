from pathlib import Path

import pytest
from layers import violations

ROOT = Path(__file__).resolve().parents[2]


def test_the_package_keeps_its_layers():
    assert violations(ROOT) == []


def test_the_walk_sees_the_package():
    assert len(list((ROOT / 'fluid_sim_ros').rglob('*.py'))) > 20


@pytest.mark.parametrize(
    ('file', 'line'),
    [
        ('physics/drag.py', 'import mujoco'),
        ('physics/drag.py', 'from rclpy.node import Node'),
        ('physics/drag.py', 'from fluid_sim_ros.scene import Scene'),
        ('physics/drag.py', 'from ..scene import Scene'),
        ('control/hold.py', 'import mujoco'),
        ('control/hold.py', 'from std_msgs.msg import Float64'),
        ('simulation.py', 'from fluid_sim_ros.ros.node import main'),
        ('simulation.py', 'from fluid_sim_ros import ros'),
        ('simulation.py', 'from . import recording'),
        ('simulation.py', 'def f():\n    import rclpy'),
        ('simulation.py', 'import fluid_sim_ros.cli'),
        ('plugins/native.py', 'from fluid_sim_ros.lab import charts'),
        ('ros/node.py', 'from fluid_sim_ros.mavlink import bridge'),
        ('ros/node.py', 'from ..recording.log import Writer'),
        ('recording/log.py', 'from fluid_sim_ros.ros import cdr'),
        ('errors.py', 'from fluid_sim_ros.scene import Scene'),
    ],
)
def test_a_forbidden_import_is_found(tmp_path, file, line):
    path = tmp_path / 'fluid_sim_ros' / file
    path.parent.mkdir(parents=True)
    path.write_text(line + '\n')

    found = violations(tmp_path)

    assert len(found) == 1
    assert found[0].startswith(f'fluid_sim_ros/{file}:')


@pytest.mark.parametrize(
    ('file', 'line'),
    [
        ('physics/drag.py', 'from fluid_sim_ros.physics.arrays import Array'),
        ('physics/drag.py', 'from .arrays import Array'),
        ('simulation.py', 'import mujoco'),
        ('ros/node.py', 'from fluid_sim_ros.simulation import Simulation'),
        ('ros/node.py', 'from fluid_sim_ros.control.multirotor import Law'),
        ('cli.py', 'from fluid_sim_ros.ros.parameters import check_domain'),
        ('demo/main.py', 'from fluid_sim_ros.recording.reader import open_log'),
        ('scene.py', 'from fluid_sim_ros.errors import ConfigError'),
    ],
)
def test_an_allowed_import_passes(tmp_path, file, line):
    path = tmp_path / 'fluid_sim_ros' / file
    path.parent.mkdir(parents=True)
    path.write_text(line + '\n')

    assert violations(tmp_path) == []
