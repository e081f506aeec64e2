# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a log: one PNG per vehicle."""

import textwrap
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.output.term_colors import COLORS, term_color
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.recording.pictures.tracks import Track, Tracks

_STYLE: Any = {
    'font.size': 9, 'axes.grid': True, 'grid.alpha': 0.3, 'axes.spines.top': False,
    'axes.spines.right': False, 'figure.dpi': 110, 'legend.frameon': False,
    'axes.titlesize': 10, 'axes.titleweight': 'bold', 'axes.titlelocation': 'left',
}  # fmt: skip
_AXES = ('east x', 'north y', 'up z')
_EULER = ('roll', 'pitch', 'yaw')
#: No axis is shorter than this: what is smaller is no motion and no force, but rounding.
LEAST_SPANS = {
    'position [m]': 1e-3, 'attitude [deg]': 0.1, 'velocity [m/s]': 1e-3,
    'angular velocity [rad/s]': 1e-3, 'force [N]': 1e-6, 'torque [N m]': 1e-8,
}  # fmt: skip
#: Characters of a line, above the picture and in its legend.
_TITLE_WIDTH, _LEGEND_WIDTH = 110, 24
#: A term below this share of the largest is left out of the picture.
_NOTABLE = 1e-6


def overview(track: Track, tracks: Tracks, path: Path) -> Path:
    """
    Draw path, position, attitude, wrench per term, commands and speed.

    Parameters
    ----------
    track
        Vehicle to draw.
    tracks
        The log, for its real-time factor.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    with mpl.rc_context(_STYLE):
        figure = plt.figure(figsize=(12, 9), layout='constrained')
        grid: Any = figure.add_gridspec(3, 3)
        _path(figure.add_subplot(grid[0, 0], projection='3d'), [track])
        position = figure.add_subplot(grid[0, 1])
        _lines(position, track.times, track.position_w, _AXES, 'position [m]')
        least_span(position, 'position [m]')
        attitude = figure.add_subplot(grid[0, 2])
        _lines(attitude, track.times, np.degrees(track.euler), _EULER, 'attitude [deg]')
        least_span(attitude, 'attitude [deg]')
        force, torque = figure.add_subplot(grid[1, 0]), figure.add_subplot(grid[1, 1])
        _terms(force, track, slice(1, 4), 'fluid force by term [N]')
        least_span(force, 'force [N]')
        _terms(torque, track, slice(4, 7), 'fluid torque by term [N m]')
        least_span(torque, 'torque [N m]')
        velocity = figure.add_subplot(grid[1, 2])
        names = ('forward x', 'left y', 'up z')
        _lines(velocity, track.times, track.velocity_b, names, 'velocity, body axes [m/s]')
        least_span(velocity, 'velocity [m/s]')
        _commands(figure.add_subplot(grid[2, :2]), track)
        _speed(figure.add_subplot(grid[2, 2]), tracks.real_time_factor)
        for axes in figure.axes[1:]:
            axes.set_xlabel('simulated time [s]')
        figure.suptitle(track.name, fontweight='bold')
        return _save(figure, path)


def both_flights(recorded: Track, changed: Track, change: str, path: Path) -> Path:
    """
    Draw a recorded flight and the same one with a change.

    Parameters
    ----------
    recorded, changed
        The two flights of one vehicle.
    change
        What was changed, in words.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    with mpl.rc_context(_STYLE):
        figure = plt.figure(figsize=(12, 7), layout='constrained')
        grid: Any = figure.add_gridspec(3, 3, width_ratios=(1.25, 1, 1))
        _path(figure.add_subplot(grid[:, 0], projection='3d'), [recorded, changed])
        groups = (
            ('position [m]', _AXES, recorded.position_w, changed.position_w),
            ('attitude [deg]', _EULER, np.degrees(recorded.euler), _beside(recorded, changed)),
        )
        label = textwrap.fill(change, _LEGEND_WIDTH)
        for column, (title, names, old, new) in enumerate(groups, 1):
            for row, name in enumerate(names):
                axes = figure.add_subplot(grid[row, column])
                axes.plot(recorded.times, old[:, row], color=COLORS[0], label='recorded')
                axes.plot(changed.times, new[:, row], color=COLORS[1], ls='--', label=label)
                axes.set_title(f'{name}, {title}')
                least_span(axes, title)
        figure.axes[1].legend()
        for axes in figure.axes[1:]:
            axes.set_xlabel('simulated time [s]')
        title = f'{recorded.name}: as recorded, and with {change}'
        figure.suptitle(textwrap.fill(title, _TITLE_WIDTH), fontweight='bold')
        return _save(figure, path)


def least_span(axes: Axes, quantity: str) -> None:
    """
    Widen a vertical axis that would show rounding errors in full size.

    Parameters
    ----------
    axes
        Whose curves are drawn.
    quantity
        One of LEAST_SPANS.

    """
    low, high = axes.get_ylim()
    if high - low < LEAST_SPANS[quantity]:
        middle, half = (low + high) / 2, LEAST_SPANS[quantity] / 2
        axes.set_ylim(middle - half, middle + half)


def _beside(recorded: Track, changed: Track) -> Array:
    """Return the changed flight's angles [deg], by whole turns nearest to the recorded ones."""
    old, new = np.degrees(recorded.euler[:1]), np.degrees(changed.euler)
    turns = np.round((new[:1] - old) / 360.0)
    return np.asarray(new - 360.0 * np.where(np.isfinite(turns), turns, 0.0))


def _save(figure: Figure, path: Path) -> Path:
    with new_file(path) as file:
        figure.savefig(file)
    plt.close(figure)
    return path


def _path(axes: Any, tracks: list[Track]) -> None:
    labels = ('recorded', 'changed') if len(tracks) > 1 else ('',)
    for track, color, label in zip(tracks, COLORS, labels, strict=False):
        x, y, z = track.position_w.T
        axes.plot(x, y, z, color=color, label=label)
        axes.scatter(x[:1], y[:1], z[:1], color=color, marker='o')
    axes.set_title('path (dot: begin) [m]')
    axes.set_xlabel('east x')
    axes.set_ylabel('north y')
    axes.set_zlabel('up z', labelpad=8)
    axes.locator_params(nbins=4)
    points = np.concatenate([track.position_w for track in tracks])
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return
    middle = (points.max(axis=0) + points.min(axis=0)) / 2
    half = max(float(np.ptp(points, axis=0).max()) / 2, 0.1)
    limits = zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), middle, strict=True)
    for set_limit, centre in limits:
        set_limit(centre - half, centre + half)
    axes.set_box_aspect((1, 1, 1), zoom=0.85)


def _lines(axes: Axes, times: Array, values: Array, names: Any, title: str) -> None:
    for i, name in enumerate(names):
        axes.plot(times, values[:, i], color=COLORS[i], label=name)
    axes.set_title(title)
    axes.legend(ncols=3, fontsize=8)


def _terms(axes: Axes, track: Track, part: slice, title: str) -> None:
    """Draw the size of each term's force or torque."""
    sizes = {
        term: np.linalg.norm(rows[:, part], axis=1)
        for term, rows in track.wrenches.items() if term != 'thrust'
    }  # fmt: skip
    largest = max((float(size.max()) for size in sizes.values()), default=0.0)
    axes.set_title(title)
    shown = [term for term, size in sizes.items() if size.max() > _NOTABLE * largest]
    for term in sorted(shown, key=lambda term: term != 'total'):
        width = 1.8 if term == 'total' else 1.0
        times = track.wrenches[term][:, 0]
        axes.plot(times, sizes[term], color=term_color(term), lw=width, label=term)
    if shown:
        axes.legend(ncols=2, fontsize=8)
    else:
        axes.text(0.5, 0.5, 'none', ha='center', transform=axes.transAxes)


def _commands(axes: Axes, track: Track) -> None:
    axes.set_title('commands')
    count = 0
    for name, rows in track.commands.items():
        for i in range(1, rows.shape[1]):
            color = COLORS[count % len(COLORS)]
            axes.step(
                rows[:, 0], rows[:, i], where='post', color=color, lw=1.0,
                label=f'{name} {i}',
            )  # fmt: skip
            count += 1
    if count:
        axes.legend(ncols=4, fontsize=8)
    else:
        axes.text(0.5, 0.5, 'none', ha='center', transform=axes.transAxes)


def _speed(axes: Axes, factor: Array) -> None:
    axes.plot(factor[:, 0], factor[:, 1], color=COLORS[0])
    axes.set_title('real-time factor of the recording')
    axes.set_ylim(bottom=0)
