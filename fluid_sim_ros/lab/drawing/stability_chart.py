# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Stability maps as pictures: one panel per integrator, the predicted boundaries on top."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from fluid_sim_ros.lab.drawing.colors import OUTCOME_COLORS
from fluid_sim_ros.lab.drawing.style import STYLE, save_figure
from fluid_sim_ros.lab.problems.bodies import AXES, family
from fluid_sim_ros.lab.problems.boundaries import predicted
from fluid_sim_ros.lab.stability.outcomes import OUTCOMES, TOLERANCE
from fluid_sim_ros.lab.stability.stability_map import values
from fluid_sim_ros.physics.arrays import Array

_LINES = {'sign flip': ':', 'growth': '--'}


def draw_map(result: dict[str, Any], path: Path) -> Path:
    """
    Draw a stability map, one panel per integrator.

    Parameters
    ----------
    result
        A map, as ``run_map`` returns it; ``largest_steps`` is drawn where it is there.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    integrators = result['integrators']
    with plt.rc_context({**STYLE, 'axes.grid': False}):
        figure, axes = plt.subplots(
            1, len(integrators), figsize=(3.1 * len(integrators) + 0.6, 4.4), sharey=True,
            squeeze=False, layout='constrained',
        )  # fmt: skip
        lines: dict[str, Any] = {}
        for panel, integrator in zip(axes[0], integrators, strict=True):
            _cells(panel, result, integrator)
            lines |= _boundaries(panel, result, integrator)
            panel.set_title(integrator)
            panel.set_xlabel(AXES[result['x']].label)
        axes[0, 0].set_ylabel(AXES[result['y']].label)
        fixed = ', '.join(f'{key} {value:g}' for key, value in result['fixed'].items())
        figure.suptitle(
            family(result['problem']).title + (f' ({fixed})' if fixed else ''), fontweight='bold'
        )
        names = {
            'energy loss': f'energy loss > {TOLERANCE:.0%}',
            'energy gain': f'energy gain > {TOLERANCE:.0%}',
            'underdamped': f'too slow by > {TOLERANCE:.0%}',
            'reset': 'silent MuJoCo reset',
        }
        patches = [
            Patch(color=OUTCOME_COLORS[word], label=names.get(word, word)) for word in OUTCOMES
        ]
        figure.legend(
            handles=[*patches, *lines.values()], loc='outside lower center', ncols=9, fontsize=8
        )
        return save_figure(figure, path)


def _cells(axes: Axes, result: dict[str, Any], integrator: str) -> None:
    x, y = values(result, 'x'), values(result, 'y')
    grid = np.full((len(y), len(x)), np.nan)
    for row in result['map']:
        if row['integrator'] == integrator:
            grid[y.index(row['y']), x.index(row['x'])] = OUTCOMES.index(row['outcome'])
    edges = [_logspace(result[f'{axis}_range'], result['cells'] + 1) for axis in ('x', 'y')]
    colors = ListedColormap([OUTCOME_COLORS[word] for word in OUTCOMES])
    axes.pcolormesh(*edges, grid, cmap=colors, vmin=-0.5, vmax=len(OUTCOMES) - 0.5)
    axes.set_xscale('log')
    axes.set_yscale('log')


def _logspace(limits: list[float], count: int) -> Array:
    low, high = limits
    return np.asarray(np.geomspace(low, high, count), dtype=np.float64)


def _boundaries(axes: Axes, result: dict[str, Any], integrator: str) -> dict[str, Any]:
    """Draw what theory says and, where it was measured, the largest stable step."""
    drawn: dict[str, Any] = {}
    if result['x'] != 'timestep':
        return drawn
    kind = family(result['problem'])
    heights = _logspace(result['y_range'], 40)
    limits = axes.get_xlim(), axes.get_ylim()
    courses: dict[str, list[float]] = {}
    for height in heights:
        body = kind.body.with_values({**result['fixed'], result['y']: float(height)})
        for name, step in predicted(body, kind.drag, integrator).items():
            courses.setdefault(name, []).append(step)
    for name, steps in courses.items():
        (line,) = axes.plot(steps, heights, 'k', ls=_LINES[name], lw=1.3)
        line.set_label(f'predicted: {name}')
        drawn[name] = line
    found = [
        row for row in result.get('largest_steps', ())
        if row['integrator'] == integrator and row['largest_s']
    ]  # fmt: skip
    if found:
        (line,) = axes.plot(
            [row['largest_s'] for row in found], [row['y'] for row in found], color='#F0E442',
            lw=2, label='largest stable step',
        )  # fmt: skip
        drawn['bisection'] = line
    axes.set_xlim(limits[0])
    axes.set_ylim(limits[1])
    return drawn
