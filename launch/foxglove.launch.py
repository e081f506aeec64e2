# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Foxglove's own bridge, for the topics of all nodes; on this host alone.

The simulator alone needs none: fluid_sim.launch.py foxglove:=true, or its parameter foxglove.port.

ros2 launch fluid_sim_ros foxglove.launch.py
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    'foxglove_port': ('8766', 'TCP port that viewers connect to: ws://localhost:PORT'),
    'foxglove_address': ('127.0.0.1', 'address to listen on; 0.0.0.0 = also from other hosts'),
}


def generate_launch_description():
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=text)
        for name, (default, text) in ARGUMENTS.items()
    ]
    bridge = Node(
        package='foxglove_bridge',
        executable='foxglove_bridge',
        parameters=[
            {
                'port': LaunchConfiguration('foxglove_port'),
                'address': LaunchConfiguration('foxglove_address'),
                'use_sim_time': True,
            }
        ],
    )
    return LaunchDescription([*arguments, bridge])
