# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the demo's flight is described by, and the numbers and the table made of it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.table import Table

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene import Scene

SCENE, VEHICLE = 'quadrotor', 'x500'
#: x, y, z [m], yaw [rad], hold [s]: home, and after 3 s a place to the north-east, looking at it.
WAYPOINTS = ((0.0, 0.0, 1.5, 0.0, 3.0), (3.0, 2.0, 2.5, 0.6, 0.0))
#: Settling time before an error counts as that of the hold, after a waypoint or gust [s].
_SETTLED = 5.0


@dataclass(frozen=True)
class Recording:
    """
    What was recorded: rows by time, first column the time [s].

    Attributes
    ----------
    odometry
        Position [m], quaternion wxyz, velocity [m/s] and rate [rad/s] in base_link axes.
    fluid
        Force [N] and torque [N m] of the fluid on the vehicle, base_link axes.
    drag
        Its part by drag [N].
    wind
        Velocity of the air at the vehicle [m/s], world axes.
    thrust
        Thrust of each rotor [N].
    gust
        Begin and end [s].

    """

    odometry: Array
    fluid: Array
    drag: Array
    wind: Array
    thrust: Array
    gust: tuple[float, float]


def gust_of_scene() -> tuple[float, float]:
    """Return begin and end of the gust in the scene's schedule [s]."""
    events = [event for event in Scene.load(SCENE).schedule if event.wind is not None]
    return events[0].at, events[-1].at


def targets(recording: Recording) -> Array:
    """
    Return where the vehicle should be at each state.

    Parameters
    ----------
    recording
        The flight.

    Returns
    -------
    Array
        [m], world axes, shape (n, 3).

    """
    switch = WAYPOINTS[0][4]
    late = recording.odometry[:, 0] >= switch
    return np.where(late[:, None], WAYPOINTS[1][:3], WAYPOINTS[0][:3])


def summary(recording: Recording, heard: Sequence[bytes], wall: float) -> dict[str, Any]:
    """
    Return the numbers of the table, with units in their names.

    Parameters
    ----------
    recording
        The flight.
    heard
        The odometry as it came over ROS.
    wall
        Wall time of the flight [s].

    Returns
    -------
    dict
        Number by name; None where the flight ended before what it is about.

    """
    times = recording.odometry[:, 0]
    error = np.linalg.norm(recording.odometry[:, 1:4] - targets(recording), axis=1)
    begin, end = recording.gust
    settled = WAYPOINTS[0][4] + _SETTLED
    force = np.linalg.norm(recording.fluid[:, 1:4], axis=1)
    largest = int(force.argmax())
    simulated = float(times[-1] - times[0])
    return {
        'scene': SCENE,
        'simulated_s': simulated,
        'wall_s': round(wall, 3),
        'real_time_factor': round(simulated / wall, 2),
        'states': len(recording.odometry),
        'states_heard': len(set(heard)),
        'waypoint': list(WAYPOINTS[1][:3]),
        'gust_m_s': float(np.abs(recording.wind[:, 1:4]).max()),
        'error_before_gust_m': _largest(error, times, settled, begin),
        'error_in_gust_m': _largest(error, times, begin, end),
        'error_in_gust_settled_m': _largest(error, times, begin + _SETTLED, end),
        'error_after_gust_m': _largest(error, times, end, math.inf),
        'error_after_gust_settled_m': _largest(error, times, end + _SETTLED, math.inf),
        'largest_fluid_force_n': float(force[largest]),
        'largest_fluid_force_at_s': float(recording.fluid[largest, 0]),
    }


def _largest(error: Array, times: Array, begin: float, end: float) -> float | None:
    inside = (times >= begin) & (times < end)
    return float(error[inside].max()) if inside.any() else None


def table(result: dict[str, Any]) -> Table:
    """
    Return the summary as a table for the terminal.

    Parameters
    ----------
    result
        As ``summary`` returns it.

    Returns
    -------
    Table
        A rich table.

    """
    table = Table(title='Quadrotor in a gust, over ROS 2', show_header=False)
    table.add_column('quantity')
    table.add_column('value', justify='right')

    def centimetres(key: str) -> str:
        value = result[key]
        return '-' if value is None else f'{100 * value:.2f} cm'

    rows = (
        ('simulated time', f'{result["simulated_s"]:.2f} s'),
        ('wall time', f'{result["wall_s"]:.2f} s'),
        ('real-time factor', f'{result["real_time_factor"]:.1f}'),
        ('states, and heard by a third process', f'{result["states"]}, {result["states_heard"]}'),
        ('position error before the gust, settled', centimetres('error_before_gust_m')),
        (f'largest in the gust of {result["gust_m_s"]:.0f} m/s', centimetres('error_in_gust_m')),
        ('  in the gust, settled', centimetres('error_in_gust_settled_m')),
        ('largest after the gust', centimetres('error_after_gust_m')),
        ('  after the gust, settled', centimetres('error_after_gust_settled_m')),
        (
            'largest fluid force',
            f'{result["largest_fluid_force_n"]:.2f} N '
            f'at {result["largest_fluid_force_at_s"]:.2f} s',
        ),
    )
    for row in rows:
        table.add_row(*row)
    return table
