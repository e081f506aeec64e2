# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
RViz for a simulation that runs: each vehicle's model, forces and path.

ros2 launch fluid_sim_ros rviz.launch.py scene:=x500
"""

import subprocess
import tempfile
from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.substitutions import ExecutableInPackage

ARGUMENTS = {
    'scene': ('', 'name or path of the scene that runs; from it the configuration is made'),
    'namespace': ('', "namespace of the simulator's node"),
    'rviz_config': ('', 'file of RViz to use instead of one that is made'),
}


def config_of(context, scene, namespace):
    """Return the path of a configuration of RViz, made for the vehicles of a scene."""
    if not scene:
        raise RuntimeError('give scene:=NAME, as to the simulator, or rviz_config:=FILE')
    path = Path(tempfile.mkdtemp(prefix='fluid_sim_rviz_')) / 'vehicles.rviz'
    program = ExecutableInPackage(package='fluid_sim_ros', executable='fluid_sim')
    command = [program.perform(context), 'layout', scene, '--rviz', '--out', str(path)]
    done = subprocess.run(
        [*command, '--namespace', namespace], capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stderr.strip() or f'fluid_sim layout {scene} failed')
    return str(path)


def nodes(context):
    """Return RViz, now that the arguments have values."""
    values = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    config = values['rviz_config'] or config_of(context, values['scene'], values['namespace'])
    return [
        Node(
            package='rviz2',
            executable='rviz2',
            arguments=['-d', config],
            parameters=[{'use_sim_time': True}],
        )
    ]


def generate_launch_description():
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=text)
        for name, (default, text) in ARGUMENTS.items()
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=nodes)])
