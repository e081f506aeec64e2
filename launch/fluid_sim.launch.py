# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The simulator, and beside it what is asked for: controllers, RViz, Foxglove, state publishers.

ros2 launch fluid_sim_ros fluid_sim.launch.py scene:=quadrotor controller:=quad_controller
ros2 launch fluid_sim_ros fluid_sim.launch.py scene:=rov controller:=rov_controller rviz:=true
ros2 launch fluid_sim_ros fluid_sim.launch.py scene:=fleet_x500 controller:=quad_controller \
    vehicles:=one,two,three,four
ros2 launch fluid_sim_ros fluid_sim.launch.py --show-args
"""

import json
import os
import subprocess

from launch import LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    IncludeLaunchDescription,
    OpaqueFunction,
    SetEnvironmentVariable,
    Shutdown,
)
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import ExecutableInPackage

CONTROLLERS = ('none', 'quad_controller', 'rov_controller', 'auv_controller', 'plane_controller')
PACINGS = ('', 'realtime', 'free', 'lockstep')
SWITCH = ('false', 'true')
#: Name -> default, what it is, and what is allowed.
ARGUMENTS = {
    'scene': ('', 'name, or path of a scene YAML or MJCF file; empty: as params_file says', None),
    'pacing': ('', 'how fast simulated time passes; empty: as params_file says', PACINGS),
    'controller': ('none', 'which example controller commands', CONTROLLERS),
    'vehicles': ('', 'a controller and a state publisher for each: one,two,...', None),
    'namespace': ('', 'before every relative topic', None),
    'params_file': (
        '',
        'YAML file of flat ROS parameters, for simulator and controllers',
        None,
    ),
    'record': ('', 'MCAP file (.mcap) to record to, or a folder that becomes a bag', None),
    'rviz': ('false', 'RViz with the vehicles of the scene (package rviz2)', SWITCH),
    'rviz_config': ('', 'file of RViz to use instead of one that is made', None),
    'foxglove': ('false', 'the simulator serves Foxglove and Lichtblick on this host', SWITCH),
    'foxglove_port': ('8765', 'TCP port that viewers connect to: ws://localhost:PORT', None),
    'state_publisher': (
        'false',
        'a robot_state_publisher for each vehicle; the simulator leaves links on /tf to it',
        SWITCH,
    ),
}


def nodes(context):
    """Return the nodes, now that the arguments have values."""
    values = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    # An argument that is not given leaves the word to the file, and the file to the node.
    files = [values['params_file']] if values['params_file'] else []
    scene = [{'scene': text(values['scene'])}] if values['scene'] else []
    common = {
        'package': 'fluid_sim_ros',
        'namespace': values['namespace'] or None,
        'output': 'screen',
    }
    given = [*files, *scene]
    given += [{'pacing': values['pacing']}] if values['pacing'] else []
    given += [{'record.path': text(values['record'])}] if values['record'] else []
    if values['foxglove'] == 'true':
        given += [{'foxglove.port': int(values['foxglove_port'])}]
    publishers = state_publishers(context, values) if values['state_publisher'] == 'true' else []
    given += [{'tf.links': False}] if publishers else []
    simulator = Node(
        executable='fluid_sim_node',
        parameters=given,
        # the others have nothing to do without it
        on_exit=Shutdown(reason='the simulator ended'),
        **common,
    )
    return [simulator, *controllers(values, [*files, *scene], common), *publishers]


def controllers(values, given, common):
    """Return the controllers: one, or one for each of several vehicles."""
    executable = values['controller']
    if executable == 'none':
        return []
    if not values['vehicles']:
        return [Node(executable=executable, parameters=given, **common)]
    return [
        Node(
            executable=executable,
            name=f'{executable}_{vehicle}',
            parameters=[*given, {'vehicle': text(vehicle)}],
            **common,
        )
        for vehicle in named(values['vehicles'])
    ]


def state_publishers(context, values):
    """Return a robot_state_publisher for each vehicle, with its URDF as parameter."""
    if not values['scene']:
        raise RuntimeError('state_publisher:=true needs scene:=NAME')
    made = []
    for vehicle in named(values['vehicles']) or [None]:
        name, urdf = described(context, values['scene'], vehicle)
        made.append(
            Node(
                package='robot_state_publisher',
                executable='robot_state_publisher',
                namespace='/'.join(filter(None, [values['namespace'], name])),
                parameters=[{'robot_description': text(urdf), 'use_sim_time': True}],
                # the topic of this name is the simulator's, with the same text
                remappings=[('robot_description', 'robot_description_of_publisher')],
            )
        )
    return made


def described(context, scene, vehicle):
    """Return the name of a vehicle, by default of the only one, and its URDF."""
    program = ExecutableInPackage(package='fluid_sim_ros', executable='fluid_sim')
    command = [program.perform(context), 'urdf', scene, '--json', '-']
    command += ['--vehicle', vehicle] if vehicle else []
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip() or f'fluid_sim urdf {scene} failed')
    result = json.loads(done.stdout)
    return result['vehicle'], result['urdf']


def named(vehicles):
    """Return the names of a list with commas."""
    return vehicles.replace(' ', '').split(',') if vehicles else []


def text(value):
    """Return a parameter that is a text, whatever it looks like in YAML."""
    return ParameterValue(value, value_type=str)


def generate_launch_description():
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=words, choices=allowed)
        for name, (default, words, allowed) in ARGUMENTS.items()
    ]
    # Nothing leaves this host unless the user opened it.
    reach = os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    return LaunchDescription(
        [
            SetEnvironmentVariable('ROS_AUTOMATIC_DISCOVERY_RANGE', reach),
            *arguments,
            OpaqueFunction(function=nodes),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource([ThisLaunchFileDir(), '/rviz.launch.py']),
                launch_arguments=[
                    (name, LaunchConfiguration(name))
                    for name in ('scene', 'namespace', 'rviz_config')
                ],
                condition=IfCondition(LaunchConfiguration('rviz')),
            ),
        ]
    )
