# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The work-precision chart of a problem as a picture."""

import statistics
import textwrap
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from fluid_sim_ros.lab.charts.pareto import judged
from fluid_sim_ros.lab.drawing.colors import INTEGRATOR_COLORS, rung_colors
from fluid_sim_ros.lab.drawing.style import MARKERS, STYLE, save_figure

_REAL_TIME = 1e6  # [us per simulated second]
#: Labels of the vertical axis; errors at the end belong to charts of earlier releases.
_UNITS = {
    'pose': 'pose error, largest over the run [-]',
    'position': 'position error, largest over the run [-]',
    'attitude': 'attitude error, largest over the run [-]',
    'velocity': 'velocity error, largest over the run [-]',
    'position_m': 'position error at the end [m]',
    'attitude_rad': 'attitude error at the end [rad]',
    'regime': 'error of mean descent or frequency [-]',
}
_LEAST = 1e-16
#: Distance of a slope guide below its curve, as a factor.
_BELOW = 0.2
#: Where errors span more than this, the legend finds some of its room between them.
_ROOMY = 1e10


def draw(result: dict[str, Any], path: Path) -> Path:
    """
    Draw total error and discretisation error against processor time.

    Parameters
    ----------
    result
        A chart, as ``measure`` returns it.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    with plt.rc_context(STYLE):
        chaotic = result['sensitivity']['chaotic']
        columns = 1 if chaotic else 2
        figure, axes = plt.subplots(
            1, columns, figsize=(6.6 * columns, 5.6), squeeze=False, layout='constrained'
        )
        _total(axes[0, 0], result)
        if not chaotic:
            _timestep_alone(axes[0, 1], result)
        figure.suptitle(f'{result["title"]} ({result["duration_s"]:g} s)', fontweight='bold')
        note = f'{result["stands_for"]}. Reference: {result["reference"]}.'
        if chaotic:
            note += ' Chaotic: judged by its regime, not point by point.'
        if result.get('note'):
            note += f' {result["note"]}.'
        note += _about_costs(result)
        note = '\n'.join(textwrap.wrap(note, 90 * columns))
        figure.supxlabel(note, fontsize=8, color='#555555')
        return save_figure(figure, path)


def _about_costs(result: dict[str, Any]) -> str:
    """Return what a reader must know of the times that are drawn."""
    wall = statistics.median(p['wall_us_per_s'] / p['cpu_us_per_s'] for p in result['points'])
    return (
        f' Wall time is {wall:.2f} times the processor time drawn. On the front, anything more '
        f'accurate costs at least {result["same_cost"]["factor"]:.2f} times as much.'
    )


def _curves(result: dict[str, Any]) -> dict[tuple[str, str], list[dict[str, Any]]]:
    curves: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for point in result['points']:
        curves.setdefault((point['rung'], point['integrator']), []).append(point)
    return curves


def _total(axes: Axes, result: dict[str, Any]) -> None:
    """Draw the error against the reference: colour by rung, marker by integrator."""
    by, colors = result['judged_by'], rung_colors(list(result['rungs']))
    drawn: dict[str, Any] = {}
    for (rung, integrator), points in _curves(result).items():
        good = [p for p in points if p['error'] is not None]
        (line,) = axes.loglog(
            [p['cpu_us_per_s'] for p in good],
            [max(judged(p, by) or 0, _LEAST) for p in good],
            color=colors[rung], marker=MARKERS[integrator], ms=4, lw=0.9, mfc='none',
        )  # fmt: skip
        drawn.setdefault(rung, line)
    front = sorted((p for p in result['points'] if p['pareto']), key=lambda p: p['cpu_us_per_s'])
    ring = axes.scatter(
        [p['cpu_us_per_s'] for p in front],
        [max(judged(p, by) or 0, _LEAST) for p in front],
        s=90, facecolors='none', edgecolors='black', linewidths=1.1, zorder=4,
    )  # fmt: skip
    for rung, facts in result['rungs'].items():
        if facts['model_error'] and rung != list(result['rungs'])[-1]:
            axes.axhline(facts['model_error'], color=colors[rung], ls='--', lw=0.8, alpha=0.7)
    _failures(axes, result['points'], lambda p: colors[p['rung']])
    _frame(axes, _UNITS[by], 'Error against the reference')
    low, high = axes.get_ylim()
    room = 0.5 if high / low < _ROOMY else 0.35
    axes.set_ylim(low * (low / high) ** room, high)  # for the legend, below the curves
    shapes = [
        Line2D([], [], color='#555555', marker=marker, ls='', mfc='none', ms=5)
        for marker in MARKERS.values()
    ]
    floor = Line2D([], [], color='#555555', ls='--', lw=0.8)
    cross = Line2D([], [], color='#555555', marker='x', ls='')
    axes.legend(
        [*drawn.values(), floor, *shapes, ring, cross],
        [*drawn, 'model error', *MARKERS, 'Pareto front', 'failed run'],
        fontsize=7.5, ncols=2, loc='lower left',
    )  # fmt: skip


def _timestep_alone(axes: Axes, result: dict[str, Any]) -> None:
    """Draw the discretisation error of the richest rung, timesteps beside the points."""
    richest = list(result['rungs'])[-1]
    points = [p for p in result['points'] if p['rung'] == richest]
    orders = result['orders'][richest]
    for integrator, color in INTEGRATOR_COLORS.items():
        # none where the run failed; 0 is the converged run itself
        good = [p for p in points if p['integrator'] == integrator and p['discretisation']]
        if not good:
            continue
        x = [p['cpu_us_per_s'] for p in good]
        y = [max(p['discretisation'], _LEAST) for p in good]
        order = orders.get(integrator)
        label = integrator + (f', order {order:.2f}' if order else '')
        axes.loglog(x, y, color=color, marker=MARKERS[integrator], ms=4, lw=1.2, label=label)
        if integrator == 'RK4':
            _guide(axes, x, y, 4)
            for point, height in list(zip(good, y, strict=True))[::2]:
                axes.annotate(
                    f'{point["timestep_s"] * 1e3:g} ms', (point['cpu_us_per_s'], height),
                    xytext=(5, 3), textcoords='offset points', fontsize=7, color=color,
                )  # fmt: skip
        if integrator == 'Euler':
            _guide(axes, x, y, 1)
    within = result['rungs'][richest]['converged_within']
    if within:
        axes.axhspan(
            _LEAST, max(within, _LEAST), color='#888888', alpha=0.15, lw=0,
            label='converged to here',
        )  # fmt: skip
    _failures(axes, points, lambda p: INTEGRATOR_COLORS[p['integrator']])
    by = result.get('discretised_by', result['judged_by'])
    unit = 'rad' if by == 'attitude_rad' else 'm'
    _frame(
        axes, f'error by the timestep alone [{unit}]',
        f'"{richest}" against its converged run, after {result["discretisation_at_s"]:g} s',
    )  # fmt: skip
    axes.legend(fontsize=8, loc='lower left')


def _guide(axes: Axes, x: list[float], y: list[float], order: int) -> None:
    """Draw a slope below the middle of a curve."""
    start = len(x) // 2
    span = np.array([x[start] / 4, x[start] * 4])
    height = _BELOW * y[start] * (span / x[start]) ** -order
    axes.loglog(span, height, color='#777777', lw=0.8, ls=':')
    axes.annotate(
        f'slope {order}', (span[1], height[1]), fontsize=7, color='#555555',
        xytext=(3, -3), textcoords='offset points',
    )  # fmt: skip


def _failures(axes: Axes, points: list[dict[str, Any]], color: Any) -> None:
    """Draw failed runs as crosses along the upper edge."""
    for point in points:
        if point['status'] != 'ok':
            axes.plot(
                point['cpu_us_per_s'], 0.985, 'x', color=color(point), ms=5,
                transform=axes.get_xaxis_transform(), clip_on=False,
            )  # fmt: skip


def _frame(axes: Axes, ylabel: str, title: str) -> None:
    axes.axvline(_REAL_TIME, color='#333333', lw=1)
    axes.text(
        _REAL_TIME, 0.5, 'real time ', transform=axes.get_xaxis_transform(), rotation=90,
        ha='right', va='center', fontsize=8, color='#333333',
    )  # fmt: skip
    axes.set_xlabel('processor time per simulated second [µs]')
    axes.set_ylabel(ylabel)
    axes.set_title(title)
    axes.set_xlim(right=2 * _REAL_TIME)
