# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A comparison as a picture and a page that a person understands."""

import base64
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

from fluid_sim_ros.errors import printable
from fluid_sim_ros.output.html_page import write_page
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.reality.compare import BASELINES, Comparison
from fluid_sim_ros.reality.residual.numbers import AXES
from fluid_sim_ros.reality.residual.residuals import Residuals

_TEMPLATE = Path(__file__).with_name('page.html')
#: Okabe and Ito (2008): measured, model, baselines.
MEASURED, MODEL, HELD, RIGID = '#000000', '#0072B2', '#999999', '#E69F00'
STYLE: Any = {
    'font.size': 9, 'axes.grid': True, 'grid.alpha': 0.25, 'axes.spines.top': False,
    'axes.spines.right': False, 'legend.frameon': False, 'axes.titlesize': 10,
    'axes.titleweight': 'bold', 'axes.titlelocation': 'left',
}  # fmt: skip
_ERRORS = {
    'position_m': 'position [m]', 'velocity_m_s': 'velocity [m/s]', 'attitude_deg': 'attitude [°]',
}  # fmt: skip
_NAMES = {'hold_velocity': 'hold velocity', 'rigid_body': 'rigid body, no fluid'}
_MOST_POINTS = 4000


def draw(comparison: Comparison, path: Path) -> Path:
    """
    Draw errors by horizon, and measured against modelled accelerations.

    Parameters
    ----------
    comparison
        What came out.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    with plt.style.context(STYLE):
        figure, axes = plt.subplots(3, 3, figsize=(11, 9), layout='constrained', dpi=110)
        _by_horizon(comparison, axes[0])
        found = comparison.residuals
        _series(found, axes[1])
        _scatter(found, axes[2])
        with new_file(path) as file:
            figure.savefig(file)
        plt.close(figure)
    return path


def _by_horizon(comparison: Comparison, axes: Any) -> None:
    horizons = [float(h) for h in comparison.numbers['horizons']]
    sets = [('model', comparison.errors, MODEL)]
    sets += [
        (_NAMES[name], comparison.baselines[name], color)
        for name, color in zip(BASELINES, (HELD, RIGID), strict=True)
    ]
    for axis, (key, title) in zip(axes, _ERRORS.items(), strict=True):
        for name, values, color in sets:
            middle = np.median(values[key], axis=0)
            axis.plot(horizons, middle, 'o-', color=color, label=name, ms=3)
            high = np.percentile(values[key], 90, axis=0)
            axis.fill_between(horizons, middle, high, color=color, alpha=0.12, lw=0)
        axis.set(title=f'error of {title}', xlabel='after [s]', yscale='log')
    axes[0].legend(title='median; shaded to 90 %')


def _series(found: Residuals, axes: Any) -> None:
    for i, axis in enumerate(axes):
        if len(found.force):
            measured, model = found.force[:, i], found.force_model[:, i]
            title = f'specific force {AXES[i]} [m/s²]'
        else:
            measured, model = found.turn[:, i], found.turn_model[:, i]
            title = f'angular acceleration {AXES[i]} [rad/s²]'
        axis.plot(found.times, measured, color=MEASURED, lw=0.8, label='measured')
        axis.plot(found.times, model, color=MODEL, lw=0.8, label='model')
        axis.set(title=title, xlabel='time [s]')
    axes[0].legend()


def _scatter(found: Residuals, axes: Any) -> None:
    take = slice(None, None, max(1, len(found.times) // _MOST_POINTS))
    for i, axis in enumerate(axes):
        if len(found.force):
            off = (found.force - found.force_model)[take, i]
            title = f'force missing along {AXES[i]} [m/s²]'
        else:
            off = (found.turn - found.turn_model)[take, i]
            title = f'turn missing about {AXES[i]} [rad/s²]'
        speed = found.speed[take, i]
        axis.plot(speed, off, '.', color=MODEL, ms=2, alpha=0.4)
        axis.axhline(0, color=MEASURED, lw=0.6)
        if np.ptp(speed) > 0:
            line = np.polyfit(speed, off, 1)
            ends = np.array([speed.min(), speed.max()])
            axis.plot(ends, np.polyval(line, ends), color=RIGID, lw=1.5)
        axis.set(title=title, xlabel=f'velocity along {AXES[i]} [m/s]')


def write_report(comparison: Comparison, picture: Path, path: Path) -> Path:
    """
    Write a comparison as a page with its picture inside.

    Parameters
    ----------
    comparison
        What came out.
    picture
        That ``draw`` wrote.
    path
        HTML file to write.

    Returns
    -------
    Path
        The file.

    """
    numbers = comparison.numbers
    windows = numbers['windows']
    left = ', '.join(f'{n} {why}' for why, n in windows['left_out'].items())
    about = (
        f'{windows["used"]} open-loop windows from {windows["from_s"]:.2f} to '
        f'{windows["to_s"]:.2f} s, each from the measured state, driven by {numbers["driven_by"]}'
        + (f'; left out: {left}' if left else '')
    )
    parts: list[dict[str, Any]] = [
        {'text': about},
        {'title': 'What it says', 'lines': [printable(line) for line in numbers['words']] or
         ['nothing stands out']},
        {'title': 'Error by horizon, median (90 %)', 'head': _head(), 'rows': _rows(numbers)},
        {'image': data_uri(picture)},
        {'title': 'What is off, by axis', 'head': ['', 'rms', 'mean', 'measured / model',
                                                   'per m/s along the axis'],
         'rows': _axis_rows(numbers['residuals'])},
    ]  # fmt: skip
    if numbers['notes'] or numbers['clocks']:
        clocks = [f'{what}: {1e3 * s:+.1f} ms apart' for what, s in numbers['clocks'].items()]
        parts.append({'title': 'To know', 'lines': [*map(printable, numbers['notes']), *clocks]})
    title = f'{numbers["model"]} against {comparison.windows.flight.name}'
    return write_page(_TEMPLATE, title, {'parts': parts}, path)


def data_uri(picture: Path) -> str:
    """
    Return a PNG as text that a page can hold.

    Parameters
    ----------
    picture
        The file.

    """
    return 'data:image/png;base64,' + base64.b64encode(picture.read_bytes()).decode()


def _head() -> list[str]:
    return ['after', *(f'{name} {title}' for name in ('model', *_NAMES.values())
                       for title in _ERRORS.values())]  # fmt: skip


def _rows(numbers: dict[str, Any]) -> list[list[str]]:
    rows = []
    for horizon, errors in numbers['horizons'].items():
        sets = [errors, *(numbers['baselines'][name]['horizons'][horizon] for name in BASELINES)]
        cells = [f'{each[key]["median"]:.3g} ({each[key]["p90"]:.3g})' for each in sets
                 for key in _ERRORS]  # fmt: skip
        rows.append([f'{horizon} s', *cells])
    return rows


def _told(number: float | None, form: str) -> str:
    return 'too little to tell' if number is None else f'{number:{form}}'


def _axis_rows(residuals: dict[str, Any]) -> list[list[str]]:
    rows = []
    for kind, facts in residuals.items():
        for axis in AXES if isinstance(facts, dict) else ():
            n = facts['axes'][axis]
            rows.append([
                f'{kind.replace("_", " ")} {axis} [{facts["unit"]}]', f'{n["rms"]:.3g}',
                f'{n["mean"]:+.3g}', _told(n['scale'], '.3f'), _told(n['per_speed'], '+.3g'),
            ])  # fmt: skip
    return rows
