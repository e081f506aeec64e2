"""A picture of a mesh with its axes, its centres and its coefficients."""

from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.hydro.coefficients import Coefficients
from fluid_sim_ros.hydro.meshes.simplify import decimated
from fluid_sim_ros.hydro.meshes.surface import area_vectors
from fluid_sim_ros.physics.arrays import Array

#: Faces that are drawn, at most.
_FACES = 6000
_COLORS = ('#d62728', '#2ca02c', '#1f77b4')
_NAMES = ('x forward', 'y left', 'z up')
_LIGHT = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])


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

    figure = Figure(figsize=(12, 5.4), layout='constrained')
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.3, 1))
    body = figure.add_subplot(grid[:, 0], projection='3d')
    _draw_body(body, found)
    _draw_added_mass(figure.add_subplot(grid[0, 1]), found)
    _draw_drag(figure.add_subplot(grid[1, 1]), found)
    figure.savefig(path, dpi=110)


def _draw_body(axes: Any, found: Coefficients) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    solid = found.file.solid
    simple = decimated(solid.surface, _FACES)
    triangles = solid.frame.outward(simple.triangles)
    normals = area_vectors(triangles)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    bright = 0.45 + 0.5 * np.clip(normals @ _LIGHT, 0, 1)
    colors = np.c_[np.outer(bright, [0.62, 0.72, 0.85]), np.full(len(bright), 0.45)]
    axes.add_collection3d(Poly3DCollection(triangles, facecolors=colors, edgecolors='none'))
    center, size = found.statics.center, found.statics.size
    corners = triangles.reshape(-1, 3)
    middle, reach = 0.5 * (corners.min(axis=0) + corners.max(axis=0)), 0.55 * size.max()
    arrow = 0.6 * reach
    for k in range(3):
        tip = np.zeros(3)
        tip[k] = arrow
        axes.quiver(*np.zeros(3), *tip, color=_COLORS[k], linewidth=2, arrow_length_ratio=0.15)
        axes.text(*(1.12 * tip), _NAMES[k], color=_COLORS[k], fontsize=9)
    axes.scatter(*center, s=50, color='#1f4ed8', depthshade=False, label='centre of buoyancy')
    if found.request.mass is not None:
        mass_center = found.request.mass_center or (0.0, 0.0, 0.0)
        axes.scatter(
            *mass_center, s=50, color='#e07b00', marker='s', depthshade=False,
            label='centre of mass',
        )  # fmt: skip
    point = found.added_mass.point
    if not np.allclose(point, center):
        axes.scatter(*point, s=60, color='black', marker='x', depthshade=False,
                     label='reference point')  # fmt: skip
    for k, limit in enumerate((axes.set_xlim, axes.set_ylim, axes.set_zlim)):
        limit(middle[k] - reach, middle[k] + reach)
    axes.set_box_aspect((1, 1, 1), zoom=1.1)
    axes.view_init(elev=22, azim=-55)
    axes.set_xlabel('x [m]')
    axes.set_ylabel('y [m]')
    axes.set_zlabel('z [m]')
    axes.legend(loc='upper left', fontsize=8)
    volume = found.statics.volume
    axes.set_title(
        f'{found.file.path.name}: {volume:.4g} m³, '
        f'{found.request.density * volume:.4g} kg displaced', fontsize=11,
    )  # fmt: skip


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
