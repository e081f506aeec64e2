# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Parameters of the example controllers: common ones, their own, and their gains."""

import math
from dataclasses import fields
from typing import TypeVar

from rclpy.node import Node

from fluid_sim_ros.control.gains import Gains, describe
from fluid_sim_ros.ros.parameters.table import Declared, Table

GainSet = TypeVar('GainSet', bound=Gains)

_GAINS = 'gains.'

#: What ``nan`` means for a target.
OF_FIRST = 'nan = that of the first odometry; a waypoint takes its place'
DEPTH = Declared(
    math.nan, f'[m] depth to hold, below z = 0; {OF_FIRST}', live=True, may_be_nan=True
)
HEADING = Declared(
    math.nan, f'[rad] heading to hold, counter-clockwise from east; {OF_FIRST}',
    live=True, may_be_nan=True,
)  # fmt: skip
COMMON: dict[str, Declared] = {
    'scene': Declared('', "scene name or path, the same as the simulator's"),
    'vehicle': Declared('', "vehicle name; empty = the scene's only vehicle with thrusters"),
    'waypoints': Declared(
        [], '[m, m, m, rad, s] x, y, z, yaw, hold of each waypoint, one after another; '
        'empty = hold the pose of the first odometry'
    ),
    'cmd_vel.timeout': Declared(
        0.5, '[s] of simulated time without a message on <v>/cmd_vel after which the velocity '
        'asked for is 0; 0 = never', low=0, high=3600, live=True,
    ),
    'waypoint_radius': Declared(0.25, '[m] distance at which a waypoint counts as reached', low=0),
}  # fmt: skip


def table_of(gains: type[Gains], own: Table) -> dict[str, Declared]:
    """
    Return the whole table of a controller: the common part, its own, and its gains.

    Parameters
    ----------
    gains
        Class of the gains; each of its fields becomes a parameter ``gains.<field>``.
    own
        Parameters of this controller beside the common ones, or in their place.

    Returns
    -------
    dict
        Parameter by name.

    """
    table = {**COMMON, **own}
    for entry in fields(gains):
        table[_GAINS + entry.name] = Declared(entry.default, describe(entry), low=0)
    return table


def number(node: Node, name: str) -> float:
    """
    Return a numeric parameter.

    Parameters
    ----------
    node
        Its node.
    name
        Its name.

    Returns
    -------
    float
        Its value, also where it was given as an integer.

    """
    return float(node.get_parameter(name).value)


def gains(node: Node, kind: type[GainSet]) -> GainSet:
    """
    Return the gains as the parameters have them.

    Parameters
    ----------
    node
        Node with parameters ``gains.<field>``.
    kind
        Class of the gains.

    Returns
    -------
    Gains
        An object of that class.

    Raises
    ------
    ConfigError
        If a gain is out of range.

    """
    return kind(**{entry.name: number(node, _GAINS + entry.name) for entry in fields(kind)})
