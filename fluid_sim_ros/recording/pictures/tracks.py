# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the pictures of a log are drawn from: each vehicle's states as arrays."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.recording.damage import LogError, reading
from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.log import Log, Series
from fluid_sim_ros.schema.limits import check_limit

#: Larger numbers than this are not drawn; lines that are drawn of one topic.
_LARGEST, _MOST_LINES = 1e30, 64
_ODOMETRY, _WRENCH = 'nav_msgs/msg/Odometry', 'geometry_msgs/msg/WrenchStamped'


@dataclass
class Track:
    """
    One vehicle's part of a log.

    Attributes
    ----------
    name
        Vehicle name, its namespace included.
    times
        Of the odometry [s], shape (n,).
    position_w, velocity_b, omega_b
        [m], [m/s] and [rad/s], shape (n, 3).
    quat_wb_wxyz
        Shape (n, 4).
    wrenches
        Term -> times [s], force [N] and torque [N m] side by side, shape (m, 7).
    commands
        What was commanded: label -> times [s] and values, shape (k, 1 + values).

    """

    name: str
    times: Array
    position_w: Array
    quat_wb_wxyz: Array
    velocity_b: Array
    omega_b: Array
    wrenches: dict[str, Array] = field(default_factory=dict)
    commands: dict[str, Array] = field(default_factory=dict)

    @property
    def euler(self) -> Array:
        """
        Roll, pitch and yaw (z-y-x order, FLU against ENU) [rad], shape (n, 3).

        Roll and yaw go on beyond half a turn, without a jump; nan where there is no attitude.
        """
        xyzw = np.roll(self.quat_wb_wxyz, -1, axis=1)
        there = np.linalg.norm(xyzw, axis=1) > 0  # not zeros (no attitude), not nan
        angles = np.full((len(xyzw), 3), np.nan)
        with warnings.catch_warnings():
            # straight up or down only the sum of roll and yaw is known: all of it is yaw
            warnings.filterwarnings('ignore', 'Gimbal lock')
            yaw, pitch, roll = Rotation.from_quat(xyzw[there]).as_euler('ZYX').T
        angles[there] = np.column_stack([np.unwrap(roll), pitch, np.unwrap(yaw)])
        return angles


@dataclass
class Tracks:
    """Every vehicle of a log, and how fast simulated time went by: (time [s], factor)."""

    vehicles: list[Track]
    real_time_factor: Array


def track_of(name: str, times: Array, definition: str, messages: Sequence[bytes]) -> Track:
    """
    Return a track from odometry messages.

    Parameters
    ----------
    name
        Of the vehicle.
    times
        Simulated times of the messages [s], shape (n,).
    definition
        Text of nav_msgs/Odometry.
    messages
        CDR bytes of the messages.

    Returns
    -------
    Track
        The vehicle's motion, without wrenches and commands.

    """
    table = columns(definition, messages)

    def pick(prefix: str, parts: str) -> Array:
        names = [f'{prefix}.{part}' for part in parts]
        if missing := [name for name in names if name not in table]:
            raise LogError(f"its messages lack '{missing[0]}'")
        return _drawable(np.column_stack([table[name] for name in names]).astype(float))

    return Track(
        name, times, pick('pose.pose.position', 'xyz'), pick('pose.pose.orientation', 'wxyz'),
        pick('twist.twist.linear', 'xyz'), pick('twist.twist.angular', 'xyz'),
    )  # fmt: skip


def read_tracks(log: Log) -> Tracks:
    """
    Return what a log says of its vehicles.

    Parameters
    ----------
    log
        The log.

    Returns
    -------
    Tracks
        All vehicles with odometry.

    Raises
    ------
    LogError
        If it holds no odometry, or messages that do not fit their definition.

    """
    found = log.series({
        topic.name for topic in log.topics.values()
        if topic.type == _ODOMETRY or '/wrench/' in topic.name or '/cmd/' in topic.name
    })  # fmt: skip
    flown = [t for t in log.topics.values() if t.type == _ODOMETRY and found[t.name].data]
    check_limit('drawn_vehicles', len(flown), f'{log.path}: vehicles')
    vehicles, factor = [], np.empty((0, 2))
    for topic in flown:
        series = found[topic.name]
        name = topic.name.strip('/').rpartition('/')[0]
        seconds = series.log_ns / 1e9
        with reading(log.path, f"topic '{topic.name}'"):
            track = track_of(name, seconds, topic.definition, series.data)
        _add_rest(track, log, found)
        vehicles.append(track)
        factor = _factor(seconds, series.publish_ns / 1e9)
    if not vehicles:
        raise LogError(f'{log.path}: no odometry in it, nothing to draw')
    return Tracks(vehicles, factor)


def _add_rest(track: Track, log: Log, found: Mapping[str, Series]) -> None:
    """Add the wrenches and commands of a vehicle."""
    for topic in log.topics.values():
        head, _, tail = topic.name.strip('/').partition(f'{track.name}/')
        kind, _, leaf = tail.partition('/')
        series = found.get(topic.name)
        if head or kind not in ('wrench', 'cmd') or series is None or not series.data:
            continue
        table = log.table(topic, series.data)
        numbers = [
            name for name, values in table.items()
            if values.dtype.kind == 'f' and name.startswith(('wrench.', 'data', 'effort', 'pos'))
        ]  # fmt: skip
        if not numbers:
            continue
        chosen = [_drawable(table[name]) for name in numbers[:_MOST_LINES]]
        rows = np.column_stack([series.log_ns / 1e9, *chosen])
        if kind == 'cmd':
            track.commands[leaf] = rows
        elif rows.shape[1] == 7:
            track.wrenches[leaf] = rows


def _drawable(values: Array) -> Array:
    """Return values without those that no picture has room for."""
    return np.where(np.abs(values) < _LARGEST, values, np.nan)


def _factor(seconds: Array, walls: Array) -> Array:
    """Return the real-time factor over windows of a hundredth of the flight."""
    count = len(seconds)
    edges = np.unique(np.linspace(0, count - 1, min(count, 101)).astype(int))
    simulated, wall = np.diff(seconds[edges]), np.diff(walls[edges])
    middle = (seconds[edges][1:] + seconds[edges][:-1]) / 2
    with np.errstate(divide='ignore', invalid='ignore'):
        factor = np.where(wall > 0, simulated / wall, np.nan)
    return np.column_stack([middle, factor])
