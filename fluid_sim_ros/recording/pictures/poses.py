# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log's model, and the pose in which it stands at each recorded time."""

from pathlib import Path

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.recording.damage import LogError, reading
from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.model.trial import try_model
from fluid_sim_ros.recording.pictures.tracks import Track, read_tracks
from fluid_sim_ros.simulation import Simulation


class LogPoses:
    """
    Poses of all vehicles of a log.

    Parameters
    ----------
    log
        Its model is tried in another process first: it comes from a stranger.

    Attributes
    ----------
    simulation
        Of the log's scene, at its begin; not stepped.
    tracks
        By the name of the vehicle in the scene.

    Raises
    ------
    LogError
        If the log holds no odometry, or no model.

    """

    def __init__(self, log: Log) -> None:
        log.description().scene()  # what is missing is found before anything is tried
        try_model(log.path)
        run = log.description().run
        self.simulation = Simulation(log.description().scene(), seed=run['seed'])
        prefix = run['namespace'].strip('/')
        self.tracks = {
            track.name.removeprefix(prefix).strip('/'): track
            for track in read_tracks(log).vehicles
        }
        self._joints = {name: _joint_states(log, track) for name, track in self.tracks.items()}
        self._start = self.simulation.data.qpos.copy()

    @property
    def times(self) -> Array:
        """Times of the first vehicle's odometry [s], shape (n,)."""
        first: Track = next(iter(self.tracks.values()))
        return first.times

    def check_vehicle(self, name: str, path: Path) -> str:
        """
        Return the name of a vehicle.

        Parameters
        ----------
        name
            Asked for; empty: the first.
        path
            Of the log, for errors.

        Returns
        -------
        str
            One of ``tracks``.

        Raises
        ------
        LogError
            If there is none of this name.

        """
        name = name or next(iter(self.tracks))
        if name not in self.tracks:
            raise LogError(f"{path}: no vehicle '{name}'; it has: {', '.join(self.tracks)}")
        return name

    def qpos(self, time: float, changed: dict[str, Track] | None = None) -> Array:
        """
        Return the pose of the model at a time.

        Parameters
        ----------
        time
            Simulated time [s]; the last state that is not after it is taken.
        changed
            Other tracks of some of the vehicles.

        Returns
        -------
        Array
            Of the model, shape (nq,).

        """
        model = self.simulation.model
        qpos: Array = self._start.copy()
        for name, track in {**self.tracks, **(changed or {})}.items():
            at = self.simulation.vehicles[name].qpos_address
            i = latest(track.times, time)
            if at >= 0:
                qpos[at : at + 3] = track.position_w[i]
                qpos[at + 3 : at + 7] = track.quat_wb_wxyz[i]
            for joint, (times, positions) in self._joints[name].items():
                qpos[model.joint(joint).qposadr[0]] = positions[latest(times, time)]
        return qpos


def latest(times: Array, time: float) -> int:
    """
    Return the row of the last time that is not after a time.

    Parameters
    ----------
    times
        Rising [s], shape (n,).
    time
        [s].

    Returns
    -------
    int
        0 before the first.

    """
    return max(0, int(np.searchsorted(times, time + 1e-9)) - 1)


def medium_of(log: Log, track: Track, stream: str) -> Array:
    """
    Return the recorded velocity of the medium at a vehicle.

    Parameters
    ----------
    log
        The log.
    track
        Of the vehicle.
    stream
        ``wind`` or ``current``.

    Returns
    -------
    Array
        Times [s] and velocities [m/s], world axes, shape (n, 4); n = 0 where it is not recorded.

    """
    name = f'/{track.name}/medium/{stream}'
    topic = next((t for t in log.topics.values() if t.name == name), None)
    messages = [] if topic is None else list(log.messages([name]))
    if topic is None or not messages:
        return np.empty((0, 4))
    with reading(log.path, f"topic '{name}'"):
        table = columns(topic.definition, [m.data for m in messages])
        numbers = [table[f'twist.linear.{axis}'] for axis in 'xyz']
    return np.column_stack([np.array([m.log_ns for m in messages]) / 1e9, *numbers])


def _joint_states(log: Log, track: Track) -> dict[str, tuple[Array, Array]]:
    """Return times [s] and positions of each joint of a vehicle that the log has."""
    topic = next((t for t in log.topics.values() if t.name == f'/{track.name}/joint_states'), None)
    if topic is None:
        return {}
    messages = list(log.messages([topic.name]))
    if not messages:
        return {}
    table = columns(topic.definition, [m.data for m in messages])
    times = np.array([m.log_ns for m in messages]) / 1e9
    found = {}
    for i in range(sum(name.startswith('name[') for name in table)):
        joint = str(table[f'name[{i}]'][0])
        found[joint] = (times, table[f'position[{i}]'])
    return {name: pair for name, pair in found.items() if np.any(pair[1])}
