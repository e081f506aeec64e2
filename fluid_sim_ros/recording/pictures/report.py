# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log as one interactive HTML file that needs nothing beside it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.output.html_page import write_page
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.recording.pictures.plots import LEAST_SPANS
from fluid_sim_ros.recording.pictures.tracks import Track, Tracks

_TEMPLATE = Path(__file__).with_name('report.html')
#: Points per line; a screen shows fewer.
_POINTS = 3000
#: Significant digits of a number in the file.
_DIGITS = 7
#: Distinguishable for colour-blind readers (Okabe and Ito 2008).
_COLORS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#000000', '#999999')
_TIME = 'simulated time [s]'


def write_report(tracks: Tracks, about: Sequence[tuple[str, str]], path: Path) -> Path:
    """
    Write the report.

    Parameters
    ----------
    tracks
        What is drawn.
    about
        Rows (key, text) that stand above the plots.
    path
        HTML file to write.

    Returns
    -------
    Path
        The file.

    """
    title = f'{path.stem}: {", ".join(track.name for track in tracks.vehicles)}'
    content = {
        'about': [list(row) for row in about],
        'vehicles': [
            {'name': track.name, 'plots': _plots(track, tracks)} for track in tracks.vehicles
        ],
    }
    return write_page(_TEMPLATE, title, content, path)


def _plots(track: Track, tracks: Tracks) -> list[dict[str, Any]]:
    x, y, z = track.position_w.T
    along = ('forward x', 'left y', 'up z')
    found = [
        _plot('path seen from above [m]', [_series('path', x, y)], 'east x [m]', path=True),
        _plot('path seen from the south [m]', [_series('path', x, z)], 'east x [m]', path=True),
        _group('position [m]', track.times, track.position_w, ('east x', 'north y', 'up z')),
        _group('attitude [deg]', track.times, np.degrees(track.euler), ('roll', 'pitch', 'yaw')),
        _group('velocity, body axes [m/s]', track.times, track.velocity_b, along),
        _group('angular velocity, body axes [rad/s]', track.times, track.omega_b, along),
    ]
    spans = ('position [m]', 'attitude [deg]', 'velocity [m/s]', 'angular velocity [rad/s]')
    for plot, quantity in zip(found[2:], spans, strict=True):
        plot['least'] = LEAST_SPANS[quantity]
    for title, part in (('force [N]', slice(1, 4)), ('torque [N m]', slice(4, 7))):
        series = [
            _series(term, rows[:, 0], np.linalg.norm(rows[:, part], axis=1), i)
            for i, (term, rows) in enumerate(track.wrenches.items())
            if np.any(rows[:, part])
        ]
        for entry in series:  # thrust would dwarf the fluid; a click shows it
            entry['off'] = entry['name'] == 'thrust'
        found.append(_plot(f'size of each {title}', series) | {'least': LEAST_SPANS[title]})
    commands = [
        _series(f'{name} {i}', rows[:, 0], rows[:, i], number, step=True)
        for name, rows in track.commands.items()
        for number, i in enumerate(range(1, rows.shape[1]))
    ]
    found.append(_plot('commands', commands))
    factor = tracks.real_time_factor
    found.append(
        _plot('real-time factor of the recording', [_series('factor', factor[:, 0], factor[:, 1])])
    )
    return found


def _group(title: str, times: Array, values: Array, names: Sequence[str]) -> dict[str, Any]:
    return _plot(title, [_series(name, times, values[:, i], i) for i, name in enumerate(names)])


def _plot(
    title: str, series: list[dict[str, Any]], xlabel: str = _TIME, path: bool = False
) -> dict[str, Any]:
    return {'title': title, 'series': series, 'xlabel': xlabel, 'path': path, 'least': 0.0}


def _series(name: str, x: Array, y: Array, color: int = 0, step: bool = False) -> dict[str, Any]:
    x, y = _thinned(x, y)
    return {
        'name': name,
        'color': _COLORS[color % len(_COLORS)],
        'x': [_rounded(value) for value in x.tolist()],
        'y': [_rounded(value) for value in y.tolist()],
        'step': step,
    }


def _thinned(x: Array, y: Array) -> tuple[Array, Array]:
    """Keep the lowest and highest point of each of a number of stretches, in order."""
    count = len(x)
    if count <= _POINTS:
        return x, y
    kept = set()
    for stretch in np.array_split(np.arange(count), _POINTS // 2):
        values = np.where(np.isfinite(y[stretch]), y[stretch], 0.0)
        kept |= {int(stretch[values.argmin()]), int(stretch[values.argmax()])}
    places = sorted(kept | {0, count - 1})
    return x[places], y[places]


def _rounded(value: float) -> float | None:
    return float(f'{value:.{_DIGITS}g}') if np.isfinite(value) else None
