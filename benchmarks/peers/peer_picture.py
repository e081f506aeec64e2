# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The picture of peer_simulators.py: error against time, one panel for each task."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from fluid_sim_ros.lab.drawing.colors import COLORS
from fluid_sim_ros.lab.drawing.style import STYLE, save_figure

_FAMILIES = dict(
    zip(
        ('fluid_sim', 'MuJoCo', 'JSBSim', 'RotorPy', 'SciPy', 'drone-models'), COLORS, strict=False
    )
)
_MARKERS = dict(zip(_FAMILIES, 'osDv^P', strict=True))
_LEAST = 1e-14  # what is less is drawn here [m]
_GAP, _LETTER = 11, 4.6  # between two labels; width of a letter [points]


def draw(result: dict[str, Any], path: Path) -> Path:
    """Draw the comparison; return the file."""
    with plt.rc_context(STYLE):
        tasks = list(result['tasks'].values())
        rows = (len(tasks) + 1) // 2
        figure, axes = plt.subplots(
            rows, 2, figsize=(13, 5 * rows), squeeze=False, layout='constrained'
        )
        for panel, task in zip(axes.flat, tasks, strict=False):
            _panel(panel, task)
        figure.suptitle('Error against processor time', fontweight='bold')
        return save_figure(figure, path)


def _panel(axes: Axes, task: dict[str, Any]) -> None:
    curves: dict[str, list[dict[str, Any]]] = {}
    for found in task['points']:
        curves.setdefault(found['peer'], []).append(found)
    seen: dict[str, int] = {}
    ends = []
    for peer, points in curves.items():
        family = _family(peer)
        good = sorted((p for p in points if p['error_m'] is not None), key=_cost)
        if not good:
            continue
        style = ('-', '--', ':', '-.')[seen.get(family, 0)]
        seen[family] = seen.get(family, 0) + 1
        x, y = [_cost(p) for p in good], [max(p['error_m'], _LEAST) for p in good]
        axes.loglog(
            x, y, ls=style, marker=_MARKERS[family], color=_FAMILIES[family], ms=4, lw=1.2,
            mfc='none' if style != '-' else None,
        )  # fmt: skip
        ends.append((x[-1], y[-1], peer, _FAMILIES[family]))
    for target in task['time_at']:
        axes.axhline(float(target), color='#555555', lw=0.7, ls=(0, (1, 3)))
    left, right = axes.get_xlim()
    low, high = axes.get_ylim()
    axes.set(xlim=(left, right * 40), ylim=(low, high * 10))  # room for the labels
    _label(axes, ends)
    lost = sorted({p['peer'] for p in task['points']} - {end[2] for end in ends})
    if lost:
        axes.text(
            0.98, 0.98, '\n'.join(f'{peer}: diverges at every timestep' for peer in lost),
            color=_FAMILIES[_family(lost[0])], transform=axes.transAxes, ha='right', va='top',
            fontsize=8,
        )  # fmt: skip
    axes.set(
        title=task['title'], xlabel='processor time per simulated second [us]',
        ylabel='largest position error [m]',
    )  # fmt: skip


def _family(peer: str) -> str:
    return peer.split()[0].rstrip(',')


def _cost(found: dict[str, Any]) -> float:
    return float(found['us_per_s'])


def _label(axes: Axes, ends: list[tuple[float, float, str, str]]) -> None:
    """Write each curve's name at its end, pushed up where it would cover a name or a marker."""
    axes.figure.canvas.draw()
    to_pixels, scale = axes.transData.transform, 72 / axes.figure.dpi
    taken = [
        scale * to_pixels(vertex)
        for line in axes.lines[: len(ends)]
        for vertex in zip(*line.get_data(), strict=True)
    ]
    names: list[tuple[float, float, float]] = []  # left, right, height
    for x, y, peer, color in sorted(ends, key=lambda end: -end[0]):
        left, height = scale * to_pixels((x, y)) + np.array([7, 0])
        right, free = left + _LETTER * len(peer), height
        while any(left < a < right and abs(free - b) < _GAP / 2 for a, b in taken) or any(
            left < b and a < right and abs(free - h) < _GAP for a, b, h in names
        ):
            free += 1
        names.append((left, right, free))
        axes.annotate(
            peer, (x, y), xytext=(7, free - height - 3), textcoords='offset points', color=color,
            fontsize=8, arrowprops=_line(color) if free - height > _GAP else None,
        )  # fmt: skip


def _line(color: str) -> dict[str, Any]:
    return {'arrowstyle': '-', 'color': color, 'lw': 0.5, 'alpha': 0.6}
