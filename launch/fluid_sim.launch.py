"""
The simulator, and optionally one of the example controllers, on an installed ROS 2.

ros2 launch fluid_sim_ros fluid_sim.launch.py scene:=quadrotor controller:=quad_controller
ros2 launch fluid_sim_ros fluid_sim.launch.py scene:=fleet_x500 controller:=quad_controller \
    vehicles:=one,two,three,four
"""

import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction, SetEnvironmentVariable, Shutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

CONTROLLERS = ('none', 'quad_controller', 'rov_controller', 'auv_controller', 'plane_controller')
PACINGS = ('', 'realtime', 'free', 'lockstep')


def nodes(context):
    """Return the nodes, now that the arguments have values."""
    values = {
        name: LaunchConfiguration(name).perform(context)
        for name in ('scene', 'pacing', 'controller', 'vehicles', 'namespace', 'params_file')
    }
    # An argument that is not given leaves the word to the file, and the file to the node.
    files = [values['params_file']] if values['params_file'] else []
    scene = [{'scene': values['scene']}] if values['scene'] else []
    pacing = [{'pacing': values['pacing']}] if values['pacing'] else []
    common = {
        'package': 'fluid_sim_ros',
        'namespace': values['namespace'] or None,
        'output': 'screen',
    }
    simulator = Node(
        executable='fluid_sim_node',
        parameters=[*files, *scene, *pacing],
        # the controllers have nothing to do without it
        on_exit=Shutdown(reason='the simulator ended'),
        **common,
    )
    if values['controller'] == 'none':
        return [simulator]
    executable, vehicles = values['controller'], values['vehicles'].replace(' ', '')
    if not vehicles:
        controller = Node(executable=executable, parameters=[*files, *scene], **common)
        return [simulator, controller]
    controllers = [
        Node(
            executable=executable,
            name=f'{executable}_{vehicle}',
            parameters=[*files, *scene, {'vehicle': vehicle}],
            **common,
        )
        for vehicle in vehicles.split(',')
    ]
    return [simulator, *controllers]


def generate_launch_description():
    arguments = [
        DeclareLaunchArgument(
            'scene', default_value='', description='name, or path of a scene YAML or MJCF file'
        ),
        DeclareLaunchArgument(
            'pacing', default_value='', choices=PACINGS, description='how fast time passes'
        ),
        DeclareLaunchArgument(
            'controller', default_value='none', choices=CONTROLLERS, description='who commands'
        ),
        DeclareLaunchArgument(
            'vehicles', default_value='', description='one controller for each: one,two,...'
        ),
        DeclareLaunchArgument('namespace', default_value='', description='before every topic'),
        DeclareLaunchArgument(
            'params_file', default_value='', description='YAML file of flat ROS parameters'
        ),
    ]
    # Nothing leaves this host unless the user opened it.
    reach = os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    return LaunchDescription(
        [
            SetEnvironmentVariable('ROS_AUTOMATIC_DISCOVERY_RANGE', reach),
            *arguments,
            OpaqueFunction(function=nodes),
        ]
    )
