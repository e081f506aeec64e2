# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pictures of the demo."""

from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from fluid_sim_ros.demo.summary import Recording
from fluid_sim_ros.physics.arrays import Array

_STYLE: Any = {
    'font.size': 10, 'axes.grid': True, 'grid.alpha': 0.3, 'axes.spines.top': False,
    'axes.spines.right': False, 'figure.dpi': 110, 'legend.frameon': False,
}  # fmt: skip
#: Distinguishable for colour-blind readers (Okabe and Ito 2008).
_COLORS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7')
_GUST_COLOR = '#F0E442'
#: Floor of the logarithmic error axis [cm].
_SMALLEST_ERROR = 1e-2
_AXES = ('east x', 'north y', 'up z')
_BODY = ('forward x', 'left y', 'up z')


def trajectory(recording: Recording, targets: Array, path: Path) -> Path:
    """
    Draw path, position and error against time.

    Parameters
    ----------
    recording
        The flight.
    targets
        Where the vehicle should be at each state [m], world axes, shape (n, 3).
    path
        File of the picture.

    Returns
    -------
    Path
        That file.

    """
    times, position = recording.odometry[:, 0], recording.odometry[:, 1:4]
    with mpl.rc_context(_STYLE):
        figure = plt.figure(figsize=(12, 7), layout='constrained')
        halves: Any = figure.subfigures(1, 2, width_ratios=(1, 1.7))
        left, right = halves
        figure.suptitle('A quadrotor goes to a waypoint and holds it in a gust')
        above, near = left.subplots(2, 1)
        _draw_path(above, recording, targets)
        _draw_excursions(near, recording, targets)

        along, off, tilt = right.subplots(3, 1, sharex=True, height_ratios=(1.4, 1, 1))
        for axis, (color, name) in enumerate(zip(_COLORS, _AXES, strict=False)):
            along.plot(times, targets[:, axis], color=color, lw=1, ls='--', alpha=0.7)
            along.plot(times, position[:, axis], color=color, label=name)
        along.plot([], [], color='grey', lw=1, ls='--', label='target')
        along.set_ylabel('position [m]')
        error = 100 * np.linalg.norm(position - targets, axis=1)
        off.semilogy(times, np.maximum(error, _SMALLEST_ERROR), color='black')
        off.set_ylabel('distance from\nthe target [cm]')
        tilt.plot(times, np.degrees(_tilt(recording.odometry[:, 4:8])), color='black')
        tilt.set_ylabel('tilt [deg]')
        tilt.set_xlabel('simulated time [s]')
        _finish((along, off, tilt), recording)
        return _save(figure, path)


def wrench(recording: Recording, path: Path) -> Path:
    """
    Draw wind, fluid force and torque, and rotor thrust against time.

    Parameters
    ----------
    recording
        The flight.
    path
        File of the picture.

    Returns
    -------
    Path
        That file.

    """
    times = recording.fluid[:, 0]
    with mpl.rc_context(_STYLE):
        figure, rows = plt.subplots(4, 1, figsize=(10, 9), sharex=True, layout='constrained')
        figure.suptitle('What the air does to the quadrotor, and what its rotors answer')
        wind, force, torque, thrust = rows
        for axis, (color, name) in enumerate(zip(_COLORS, _AXES, strict=False)):
            wind.plot(recording.wind[:, 0], recording.wind[:, 1 + axis], color=color, label=name)
        wind.set_ylabel('wind at the\nvehicle [m/s]')
        for axis, (color, name) in enumerate(zip(_COLORS, _BODY, strict=False)):
            force.plot(times, recording.fluid[:, 1 + axis], color=color, label=name)
            torque.plot(times, 1e3 * recording.fluid[:, 4 + axis], color=color, label=name)
        size = np.linalg.norm(recording.drag[:, 1:4], axis=1)
        force.plot(recording.drag[:, 0], size, color='black', lw=1, ls=':', label='|drag|')
        force.set_ylabel('fluid force,\nbody axes [N]')
        torque.set_ylabel('fluid torque about\nbase_link [mN m]')
        for rotor in range(recording.thrust.shape[1] - 1):
            thrust.plot(
                recording.thrust[:, 0], recording.thrust[:, 1 + rotor],
                color=_COLORS[rotor % len(_COLORS)], lw=1, label=f'm{rotor + 1}',
            )  # fmt: skip
        thrust.set_ylabel('thrust of each\nrotor [N]')
        thrust.set_xlabel('simulated time [s]')
        _finish(rows, recording)
        return _save(figure, path)


def _draw_path(axes: Any, recording: Recording, targets: Array) -> None:
    """Draw the path as seen from above."""
    east, north, _ = recording.odometry[:, 1:4].T
    places = np.unique(targets, axis=0)
    axes.plot(east, north, color=_COLORS[0], label='path')
    axes.plot(places[:, 0], places[:, 1], 'kx', ms=8, label='waypoints')
    axes.set_aspect('equal')
    axes.margins(0.12)
    axes.set_xlabel('east [m]')
    axes.set_ylabel('north [m]')
    axes.set_title('from above', loc='left', fontsize=10)
    axes.legend(loc='upper left', fontsize=9)


def _draw_excursions(axes: Any, recording: Recording, targets: Array) -> None:
    """Draw the path around the last waypoint, before, in and after the gust."""
    times = recording.odometry[:, 0]
    off = 100 * (recording.odometry[:, 1:4] - targets)[:, :2]
    begin, end = recording.gust
    spans = (('in the gust', begin, end), ('after it', end, times[-1] + 1.0))
    for (label, since, until), color in zip(spans, _COLORS[1:], strict=False):
        inside = (times >= since) & (times < until)
        axes.plot(off[inside, 0], off[inside, 1], color=color, label=label)
    axes.plot(0, 0, 'kx', ms=8)
    axes.set_aspect('equal', adjustable='datalim')
    axes.margins(0.15)
    axes.set_xlabel('east of the waypoint [cm]')
    axes.set_ylabel('north of it [cm]')
    axes.set_title('at the waypoint', loc='left', fontsize=10)
    axes.legend(loc='upper left', fontsize=9)


def _tilt(quat_wb_wxyz: Array) -> Array:
    """Return the angle between the body's z axis and up [rad]."""
    _, x, y, _ = quat_wb_wxyz.T
    angle: Array = np.arccos(np.clip(1.0 - 2.0 * (x * x + y * y), -1.0, 1.0))
    return angle


def _finish(rows: Any, recording: Recording) -> None:
    """Shade the gust and put legends beside the axes, where they hide nothing."""
    begin, end = recording.gust
    last = recording.odometry[-1, 0]
    for axes in rows:
        axes.set_xlim(recording.odometry[0, 0], last)
        if begin < last:
            axes.axvspan(begin, min(end, last), color=_GUST_COLOR, alpha=0.35, lw=0)
        if axes.get_legend_handles_labels()[1]:
            axes.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), fontsize=9)
    if begin < last:
        rows[0].text(
            0.5 * (begin + min(end, last)), 1.01, 'gust', ha='center', va='bottom',
            transform=rows[0].get_xaxis_transform(), color='#6b6600',
        )  # fmt: skip


def _save(figure: Figure, path: Path) -> Path:
    figure.savefig(path)
    plt.close(figure)
    return path
