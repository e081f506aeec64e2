# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A layout of Foxglove and Lichtblick for a vehicle, made from the topics that it has.

The format is that of the viewers' "Import layout": panels by their identity, and a tree that
shares the window among them. It has no published schema; the keys are those that both viewers
write for the panels 3D, Plot and DiagnosticSummary.
"""

from collections.abc import Sequence
from typing import Any

from fluid_sim_ros.messages.cdr import read_joint_state
from fluid_sim_ros.messages.state_topics import StateTopics

_WORLD = (('x', 'east x'), ('y', 'north y'), ('z', 'up z'))
_BODY = (('x', 'forward x'), ('y', 'left y'), ('z', 'up z'))
#: Share of the left side that the scene has [%].
_SCENE_SHARE = 65
#: A plot with more curves than this is two plots to the reader, so the rest is left out.
_MOST_CURVES = 12

Panels = dict[str, dict[str, Any]]


def vehicle_layout(topics: StateTopics, vehicle: str) -> dict[str, Any]:
    """
    Return the layout for one vehicle: the scene, diagnostics, and plots of what it has.

    Parameters
    ----------
    topics
        State topics of a simulation.
    vehicle
        Name of one of its vehicles.

    Returns
    -------
    dict
        To be written as JSON.

    """
    names = {topic.name for topic in topics.topics}
    plots = _plots(topics, vehicle, names)
    panels: Panels = {
        '3D!scene': _scene([f'/{vehicle}/markers', f'/{vehicle}/odom']),
        **plots,
        'DiagnosticSummary!node': {
            'minLevel': 0, 'pinnedIds': [], 'hardwareIdFilter': '',
            'topicToRender': '/diagnostics', 'sortByLevel': True,
        },
    }  # fmt: skip
    return {
        'configById': panels,
        'globalVariables': {},
        'userNodes': {},
        'playbackConfig': {'speed': 1},
        'layout': {
            'direction': 'row',
            'first': {
                'direction': 'column', 'first': '3D!scene', 'second': 'DiagnosticSummary!node',
                'splitPercentage': _SCENE_SHARE,
            },
            'second': _column(list(plots)),
            'splitPercentage': 50,
        },
    }  # fmt: skip


def _plots(topics: StateTopics, vehicle: str, names: set[str]) -> Panels:
    """Return the plots of a vehicle, from above."""
    odometry = f'/{vehicle}/odom'
    panels = {
        'Plot!position': _plot('position [m]', _vector(f'{odometry}.pose.pose.position', _WORLD)),
        'Plot!velocity': _plot(
            'velocity, body axes [m/s]', _vector(f'{odometry}.twist.twist.linear', _BODY)
        ),
        'Plot!force': _plot(
            'fluid force, body axes [N]',
            _vector(f'/{vehicle}/wrench/total.wrench.force', _BODY),
        ),
    }
    panels |= _actuators(topics, vehicle)
    for stream in ('wind', 'current'):
        if f'{vehicle}/medium/{stream}' in names:
            path = f'/{vehicle}/medium/{stream}.twist.linear'
            panels[f'Plot!{stream}'] = _plot(f'{stream} [m/s]', _vector(path, _WORLD))
    if f'{vehicle}/imu/data_raw' in names:
        path = f'/{vehicle}/imu/data_raw.angular_velocity'
        panels['Plot!imu'] = _plot('gyroscope, body axes [rad/s]', _vector(path, _BODY))
    return panels


def _actuators(topics: StateTopics, vehicle: str) -> Panels:
    """Return plots of thrusts and of joint positions, where there are some."""
    name = f'{vehicle}/joint_states'
    states = next((topic for topic in topics.topics if topic.name == name), None)
    if states is None:
        return {}
    entries = read_joint_state(states.template.bytes()).names
    count = len(topics.thrusters(vehicle))
    joints = entries[: len(entries) - count]
    panels = {}
    if count:
        panels['Plot!thrust'] = _plot('thrust [N]', [
            (f'/{name}.effort[{len(joints) + i}]', entry)
            for i, entry in enumerate(entries[len(joints) :][:_MOST_CURVES])
        ])  # fmt: skip
    if joints:
        panels['Plot!joints'] = _plot('joint positions [rad, m]', [
            (f'/{name}.position[{i}]', entry) for i, entry in enumerate(joints[:_MOST_CURVES])
        ])  # fmt: skip
    return panels


def _vector(path: str, axes: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    return [(f'{path}.{axis}', label) for axis, label in axes]


def _plot(title: str, curves: Sequence[tuple[str, str]]) -> dict[str, Any]:
    """Return a plot of (message path, label) against time."""
    return {
        'title': title,
        'paths': [
            {'value': path, 'enabled': True, 'timestampMethod': 'receiveTime', 'label': label}
            for path, label in curves
        ],
        'showXAxisLabels': True, 'showYAxisLabels': True, 'showLegend': True,
        'legendDisplay': 'floating', 'isSynced': True, 'xAxisVal': 'timestamp',
    }  # fmt: skip


def _scene(topics: Sequence[str]) -> dict[str, Any]:
    return {
        'layers': {
            'grid': {
                'layerId': 'foxglove.Grid', 'instanceId': 'grid', 'visible': True, 'size': 20,
                'divisions': 20,
            },
        },
        'followTf': 'map',
        'topics': {topic: {'visible': True} for topic in topics},
        'scene': {},
        'transforms': {},
    }  # fmt: skip


def _column(panels: Sequence[str]) -> Any:
    """Return a tree that stacks panels of the same height."""
    if len(panels) == 1:
        return panels[0]
    half = len(panels) // 2
    return {
        'direction': 'column', 'first': _column(panels[:half]), 'second': _column(panels[half:]),
        'splitPercentage': round(100 * half / len(panels)),
    }  # fmt: skip
