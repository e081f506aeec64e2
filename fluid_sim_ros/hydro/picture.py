# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A picture of a mesh with its axes, its centres and its coefficients."""

from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.hydro.coefficients import Coefficients
from fluid_sim_ros.hydro.meshes.surface import area_vectors
from fluid_sim_ros.physics.arrays import Array

_COLORS = ('#d62728', '#2ca02c', '#1f77b4')
_NAMES = 'xyz'
_ROOT_2, _ROOT_6, _ROOT_3 = 2**-0.5, 6**-0.5, 3**-0.5
#: Name -> what is to the right, up, and towards the eye, in mesh axes [m].
_VIEWS = {
    'from the front, left and above': (
        (-_ROOT_2, _ROOT_2, 0), (-_ROOT_6, -_ROOT_6, 2 * _ROOT_6), (_ROOT_3, _ROOT_3, _ROOT_3),
    ),
    'from above': ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    'from the right': ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
    'from ahead': ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
}  # fmt: skip
_LIGHT = np.array([0.5, -0.3, 0.8]) / np.linalg.norm([0.5, -0.3, 0.8])


def draw(found: Coefficients, path: Path) -> None:
    """
    Draw a mesh, its axes and centres, and its coefficients beside the usual estimates.

    Parameters
    ----------
    found
        Of a mesh.
    path
        Of the picture (PNG).

    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12.6, 6.4), layout='constrained')
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, 3, width_ratios=(1, 1, 1.35))
    for number, (name, turn) in enumerate(_VIEWS.items()):
        axes = figure.add_subplot(grid[number // 2, number % 2])
        _draw_view(axes, found, np.array(turn, dtype=float), legend=number == 0)
        axes.set_title(name, fontsize=10)
    _draw_added_mass(figure.add_subplot(grid[0, 2]), found)
    _draw_drag(figure.add_subplot(grid[1, 2]), found)
    volume = found.statics.volume
    figure.suptitle(
        f'{found.file.path.name}: {volume:.4g} m³, '
        f'{found.request.density * volume:.4g} kg displaced', fontsize=12,
    )  # fmt: skip
    figure.savefig(path, dpi=105)


def _draw_view(axes: Any, found: Coefficients, turn: Array, *, legend: bool) -> None:
    """Draw the body as seen along the last row of ``turn``, nearest faces last."""
    from matplotlib.collections import PolyCollection

    triangles = found.added_mass.triangles
    normals = area_vectors(triangles)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    seen = triangles @ turn.T
    order = np.argsort(seen[:, :, 2].mean(axis=1))
    order = order[(normals @ turn[2])[order] > 0]  # what faces away is hidden
    bright = (0.5 + 0.5 * np.clip(normals @ _LIGHT, 0, 1))[order]
    colors = np.outer(bright, [0.68, 0.78, 0.9])
    axes.add_collection(
        PolyCollection(seen[order][:, :, :2], facecolors=colors, edgecolors=colors, linewidths=0.3)
    )
    reach = 0.33 * found.statics.size.max()
    for k in range(3):
        tip = reach * turn[:2, k]
        if np.linalg.norm(tip) < 0.2 * reach:
            continue  # along the line of sight
        axes.annotate(
            '', tip, (0, 0), arrowprops={'arrowstyle': '->', 'color': _COLORS[k], 'lw': 2}
        )
        axes.annotate(
            _NAMES[k], 1.15 * tip, color=_COLORS[k], ha='center', va='center', fontsize=9
        )
    points = [(found.statics.center, 'o', '#1f4ed8', 'centre of buoyancy')]
    if found.request.mass is not None:
        center = np.array(found.request.mass_center or (0.0, 0.0, 0.0))
        points.append((center, 's', '#e07b00', 'centre of mass'))
    if not np.allclose(found.added_mass.point, found.statics.center):
        points.append((found.added_mass.point, 'x', 'black', 'reference point'))
    for point, marker, color, label in points:
        x, y = turn[:2] @ point
        axes.plot(x, y, marker, color=color, label=label, zorder=5, markersize=7)
    axes.set_aspect('equal')
    axes.margins(0.12)
    axes.autoscale_view()
    axes.grid(alpha=0.3)
    axes.tick_params(labelsize=7)
    if legend:
        axes.legend(fontsize=7, loc='best')


def _draw_added_mass(axes: Any, found: Coefficients) -> None:
    center = found.added_mass.about(found.statics.center)
    diagonal, error = np.diag(center.matrix), np.diag(center.error)
    mass = found.request.density * found.statics.volume
    gyration = mass * found.statics.volume ** (2 / 3)
    unit = np.r_[np.full(3, mass), np.full(3, gyration)]
    place = np.arange(6.0)
    _bars(axes, place - 0.25, diagonal / unit, error / unit, '#1f77b4', 'this mesh')
    _bars(axes, place, found.ellipsoid / unit, None, '#9ecae1', 'ellipsoid')
    _bars(axes, place[:3] + 0.25, found.box / mass, None, '#c7c7c7', 'box (DNV)')
    axes.set_xticks(place, ['x', 'y', 'z', 'roll', 'pitch', 'yaw'])
    axes.set_title('added mass over ρV; moments over ρV·V^(2/3)', fontsize=10)
    axes.legend(fontsize=8)
    for k in range(6):
        words = f'{diagonal[k]:.3g}' + (' kg' if k < 3 else '\nkg m²')
        axes.annotate(words, (place[k] - 0.25, diagonal[k] / unit[k]), (0, 4), ha='center',
                      textcoords='offset points', fontsize=7)  # fmt: skip
    axes.margins(y=0.2)


def _draw_drag(axes: Any, found: Coefficients) -> None:
    damping = found.damping
    taken = damping.quadratic[:3] * damping.speed**2
    ends = np.array([damping.low[:3], damping.high[:3]]) * damping.speed**2
    place = np.arange(3.0)
    axes.bar(place, taken, 0.5, color='#7fbf7b')
    axes.errorbar(place, taken, np.abs(ends - taken), fmt='none', ecolor='#222222', capsize=4)
    names = [
        f'{axis}: {drag.shape.name}'.replace(' across', '\nacross').replace(' of a', '\nof a')
        for axis, drag in zip('xyz', damping.axes, strict=True)
    ]
    axes.set_xticks(place, names, fontsize=8)
    axes.set_title(f'drag at {damping.speed:g} m/s [N], with the published range', fontsize=10)
    axes.margins(y=0.15)


def _bars(
    axes: Any, place: Array, height: Array, error: Array | None, color: str, label: str
) -> None:
    axes.bar(place, height, 0.25, yerr=error, color=color, label=label, capsize=2)
