# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A configuration of RViz for the vehicles of a scene, made from their names.

RViz has no published schema; the keys are those that RViz 2 of ROS 2 Jazzy writes for the displays
Grid, RobotModel, MarkerArray, Odometry and TF. What it does not find, it sets to its default.
"""

from collections.abc import Mapping, Sequence
from typing import Any

_FRAMES, _TRAIL = 15.0, 1000  # how long a frame is shown without news [s], and poses kept


def rviz_config(vehicles: Sequence[str], namespace: str = '') -> dict[str, Any]:
    """
    Return the configuration: each vehicle's model, forces and path, seen from beside the first.

    Parameters
    ----------
    vehicles
        Their names.
    namespace
        Of the simulator's node.

    Returns
    -------
    dict
        To be written as YAML.

    """
    before = '/'.join(['', *filter(None, namespace.split('/'))])
    displays = [_display('Grid', 'Grid', {'Plane Cell Count': 20, 'Cell Size': 1})]
    for vehicle in vehicles:
        topics = f'{before}/{vehicle}'
        displays += [
            _display(
                'RobotModel', vehicle,
                {
                    'Description Source': 'Topic', 'Visual Enabled': True,
                    'Collision Enabled': False, 'TF Prefix': '',
                    'Description Topic': _topic(f'{topics}/robot_description', latched=True),
                },
            ),
            _display(
                'MarkerArray', f'{vehicle} forces',
                {
                    # the model shows the geoms
                    'Namespaces': {'forces': True, f'{vehicle}/geoms': False},
                    'Topic': _topic(f'{topics}/markers', latched=True),
                },
            ),
            _display(
                'Odometry', f'{vehicle} path',
                {
                    'Keep': _TRAIL, 'Position Tolerance': 0.2, 'Angle Tolerance': 3.2,
                    'Covariance': {'Value': False},
                    'Shape': {'Value': 'Axes', 'Axes Length': 0.1, 'Axes Radius': 0.01},
                    'Topic': _topic(f'{topics}/odom'),
                },
            ),
        ]  # fmt: skip
    displays.append(_display('TF', 'frames', {'Frame Timeout': _FRAMES}, enabled=False))
    return {
        'Panels': [
            {'Class': 'rviz_common/Displays', 'Name': 'Displays'},
            {'Class': 'rviz_common/Time', 'Name': 'Time'},
            {'Class': 'rviz_common/Views', 'Name': 'Views'},
        ],
        'Visualization Manager': {
            'Class': '',
            'Displays': displays,
            'Enabled': True,
            'Global Options': {'Fixed Frame': 'map', 'Frame Rate': 30},
            'Tools': [
                {'Class': f'rviz_default_plugins/{name}'}
                for name in ('MoveCamera', 'Select', 'FocusCamera', 'Measure')
            ],
            'Value': True,
            'Views': {
                'Current': {
                    # follows the place of its target, not its turns
                    'Class': 'rviz_default_plugins/Orbit', 'Name': 'Current View',
                    'Target Frame': f'{vehicles[0]}/base_link', 'Distance': 4.0,
                    'Pitch': 0.4, 'Yaw': 0.8, 'Value': 'Orbit (rviz)',
                },
                'Saved': None,
            },
        },
    }  # fmt: skip


def _display(
    kind: str, name: str, properties: Mapping[str, Any], enabled: bool = True
) -> dict[str, Any]:
    return {
        'Class': f'rviz_default_plugins/{kind}', 'Name': name, 'Enabled': enabled,
        'Value': enabled, **properties,
    }  # fmt: skip


def _topic(name: str, latched: bool = False) -> dict[str, Any]:
    return {
        'Value': name, 'Depth': 5, 'History Policy': 'Keep Last',
        'Reliability Policy': 'Reliable',
        'Durability Policy': 'Transient Local' if latched else 'Volatile',
    }  # fmt: skip
