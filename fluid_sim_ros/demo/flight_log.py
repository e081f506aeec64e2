# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the demo's log says: the rows for its pictures, the flight flown again, and a still."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.demo.summary import VEHICLE, Recording, gust_of_scene
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.log import Log, LogMessage
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate

#: Simulated time of the still [s]: leaning into the gust.
_STILL_AT = 12.0
_STILL_TIMEOUT = 30.0

_POSE = ('pose.pose.position', 'xyz'), ('pose.pose.orientation', 'wxyz')
_ODOMETRY = (*_POSE, ('twist.twist.linear', 'xyz'), ('twist.twist.angular', 'xyz'))
_WRENCH = ('wrench.force', 'xyz'), ('wrench.torque', 'xyz')
_FIELDS = {
    'odom': [f'{group}.{axis}' for group, axes in _ODOMETRY for axis in axes],
    'wrench/total': [f'{group}.{axis}' for group, axes in _WRENCH for axis in axes],
    'wrench/drag': [f'wrench.force.{axis}' for axis in 'xyz'],
    'medium/wind': [f'twist.linear.{axis}' for axis in 'xyz'],
    'joint_states': [f'effort[{rotor}]' for rotor in range(4)],
}
#: What is read, and what the demo's simulator records: the still shows the thrust, and viewers
#: the markers and the robot description, which they place by /tf.
_READ = tuple(f'{VEHICLE}/{leaf}' for leaf in _FIELDS)
_SHOWN = ('markers', 'robot_description')
TOPICS = (
    *_READ, f'{VEHICLE}/wrench/thrust', *(f'{VEHICLE}/{leaf}' for leaf in _SHOWN),
    '/tf_static', '/tf',
)  # fmt: skip


def read_recording(path: Path) -> Recording:
    """
    Return what the demo's pictures and numbers are made of.

    Parameters
    ----------
    path
        The log of the flight.

    Returns
    -------
    Recording
        Rows by time.

    Raises
    ------
    ConfigError
        If the log is damaged or lacks a topic.

    """
    log = open_log(path)
    if log.faults:
        raise ConfigError(f'{path}: damaged: {log.faults[0]}')
    messages: dict[str, list[LogMessage]] = {f'/{name}': [] for name in _READ}
    for message in log.messages(list(messages)):
        messages[message.topic].append(message)
    odometry, fluid, drag, wind, thrust = (
        _rows(log, name, messages[f'/{VEHICLE}/{name}']) for name in _FIELDS
    )
    return Recording(odometry, fluid, drag, wind, thrust, gust_of_scene())


def _rows(log: Log, name: str, messages: list[LogMessage]) -> Array:
    """Return one row per message: its simulated time [s] and the topic's numbers."""
    definition = log.topic(f'/{VEHICLE}/{name}').definition
    table = columns(definition, [message.data for message in messages])
    seconds = np.array([message.log_ns for message in messages]) * 1e-9
    return np.column_stack([seconds, *(table[field] for field in _FIELDS[name])])


def check_again(path: Path) -> dict[str, Any]:
    """
    Fly a log's commands again and return the numbers of the comparison.

    Parameters
    ----------
    path
        The log of the flight.

    Returns
    -------
    dict
        Size of the log, and how many commands and states were compared.

    Raises
    ------
    ConfigError
        If a state differs.

    """
    log = open_log(path)
    outcome = resimulate(log)
    if outcome.difference is not None or not outcome.compared:
        raise ConfigError(f'{path}: not repeated: {outcome.difference or "nothing in it"}')
    return {
        'path': str(path),
        'bytes': log.size,
        'commands': outcome.commands,
        'states_resimulated': outcome.compared,
        'identical': True,
    }


def still(path: Path) -> tuple[Path, str]:
    """
    Render a picture in a process of its own, as drivers may end it.

    Parameters
    ----------
    path
        The log of the flight.

    Returns
    -------
    path, fault
        File of the picture, and why there is none, or empty.

    """
    out = path.with_name('still.png')
    out.unlink(missing_ok=True)
    command = [
        sys.executable, '-m', 'fluid_sim_ros.cli', 'render', str(path), '--out', str(out),
        '--at', str(_STILL_AT),
    ]  # fmt: skip
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=_STILL_TIMEOUT,
            env={'MUJOCO_GL': 'egl', **os.environ},
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return out, f'no picture within {_STILL_TIMEOUT:g} s'
    if done.returncode or not out.exists():
        lines = done.stderr.strip().splitlines() or [f'exit code {done.returncode}']
        return out, lines[-1]
    return out, ''
