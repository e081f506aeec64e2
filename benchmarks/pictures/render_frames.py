# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Draws the frames and symbols of doc/physics.md: world ENU, body FLU, the flow and the forces.

    .venv/bin/python -m benchmarks.pictures.render_frames
"""

import matplotlib as mpl
import numpy as np

from benchmarks.common import ROOT

mpl.use('agg')
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from scipy.spatial import ConvexHull

OUT = ROOT / 'doc' / 'img' / 'frames.png'
#: Where the world's axes east, north and up go on the paper.
PAPER = np.array([[0.94, -0.20], [0.55, 0.42], [0.0, 1.0]])
INK, WATER, FORCE, BODY = '#222222', '#0072b2', '#d55e00', '#8a8a8a'
#: The vehicle: place of its reference point O, heading and pitch (bow up) [rad].
ORIGIN_W, YAW, PITCH = np.array([2.2, 1.1, -1.75]), -0.3, 0.12


def rotation() -> np.ndarray:
    """Return R_wb: columns are the body's axes (forward, left, up) in the world."""
    cy, sy, cp, sp = np.cos(YAW), np.sin(YAW), np.cos(PITCH), np.sin(PITCH)
    return np.array([[cy * cp, -sy, -cy * sp], [sy * cp, cy, -sy * sp], [sp, 0.0, cp]])


def paper(points_w: np.ndarray) -> np.ndarray:
    """Return where points of the world lie on the paper."""
    return np.asarray(points_w) @ PAPER


def label_at(point_w: np.ndarray, right: float, up: float) -> np.ndarray:
    """Return the place of a label beside a point of the world."""
    return paper(point_w) + np.array([right, up])


def arrow(
    axes: Axes, start_w: np.ndarray, vector_w: np.ndarray, text: str, colour: str,
    shift: tuple[float, float] = (0.0, 0.0), width: float = 1.8,
) -> None:  # fmt: skip
    """Draw a vector of the world, with its symbol at the tip."""
    start, tip = paper(start_w), paper(start_w + vector_w)
    axes.annotate(
        '', tip, start, arrowprops={'arrowstyle': '-|>', 'color': colour, 'lw': width,
                                    'shrinkA': 0, 'shrinkB': 0},
    )  # fmt: skip
    along = (tip - start) / np.linalg.norm(tip - start)
    axes.text(*(tip + 0.16 * along + shift), text, color=colour, fontsize=11, ha='center',
              va='center')  # fmt: skip


def hull(axes: Axes, turn: np.ndarray) -> None:
    """Draw the outline of the hull, an ellipsoid as the paper sees it."""
    angles = np.linspace(0, 2 * np.pi, 120)
    lat = np.linspace(-np.pi / 2, np.pi / 2, 60)
    a, b = np.meshgrid(angles, lat)
    shell = np.stack([0.85 * np.cos(b) * np.cos(a), 0.34 * np.cos(b) * np.sin(a),
                      0.28 * np.sin(b)], axis=-1).reshape(-1, 3)  # fmt: skip
    points = paper(ORIGIN_W + shell @ turn.T)
    outline = points[ConvexHull(points).vertices]
    axes.add_patch(Polygon(outline, facecolor='#dddddd', edgecolor=BODY, lw=1.5, zorder=0))


def surface(axes: Axes) -> None:
    """Draw a patch of the water's surface."""
    corners = np.array([[-0.6, -0.4, 0], [4.6, -0.4, 0], [4.6, 2.4, 0], [-0.6, 2.4, 0]])
    axes.add_patch(Polygon(paper(corners), facecolor='#dcebf5', edgecolor=WATER, lw=0.8,
                           alpha=0.55, zorder=-1))  # fmt: skip
    axes.text(*paper(np.array([4.25, 2.15, 0])), 'surface', color=WATER, fontsize=10, ha='right')


def draw() -> None:
    """Draw it all and write the picture."""
    turn = rotation()
    figure, axes = plt.subplots(figsize=(8.6, 5.6))
    surface(axes)
    hull(axes, turn)
    zero = np.zeros(3)
    for axis, text in zip(np.eye(3), ('x east', 'y north', 'z up'), strict=True):
        arrow(axes, zero, 0.95 * axis, text, INK, (0.12, 0.0))
    axes.text(*label_at(zero, -0.48, -0.05), 'map', fontsize=11, weight='bold')
    shifts = ((0.3, -0.06), (0.2, 0.06), (0.0, 0.04))
    for axis, text, shift in zip(turn.T, ('x forward', 'y left', 'z up'), shifts, strict=True):
        arrow(axes, ORIGIN_W, 1.25 * axis, text, INK, shift)
    axes.text(*label_at(ORIGIN_W, -2.45, -0.25), '<v>/base_link, O', fontsize=11, weight='bold')
    axes.plot(*np.transpose([paper(zero), paper(ORIGIN_W)]), color=BODY, lw=1, ls=':')
    axes.text(*label_at(0.55 * ORIGIN_W, -0.22, -0.06), '$p_w$', fontsize=12, color=BODY)
    # the flow, the velocity of O, and their difference
    flow, velocity = np.array([-0.5, 0.9, 0.0]), turn @ np.array([1.3, 0.0, 0.1])
    start = ORIGIN_W + np.array([2.2, -0.4, -0.45])
    arrow(axes, start, velocity, '$v$', WATER, (0.06, 0.05))
    arrow(axes, start, flow, '$u$', WATER)
    arrow(axes, start + flow, velocity - flow, '', WATER, width=1.0)
    axes.text(*label_at(start + flow + 0.5 * (velocity - flow), 0.95, 0.14),
              '$v_{rel} = R^T (v - u)$', color=WATER, fontsize=11, ha='center')  # fmt: skip
    # weight and buoyancy
    mass, buoyancy = ORIGIN_W + turn @ [-0.45, 0, -0.17], ORIGIN_W + turn @ [-0.45, 0, 0.13]
    for point, name, shift in ((mass, 'G', (0.16, -0.02)), (buoyancy, 'B', (0.16, 0.03))):
        axes.plot(*paper(point), 'o', color=FORCE, ms=4)
        axes.text(*(paper(point) + shift), name, color=FORCE, fontsize=11, ha='center')
    arrow(axes, mass, np.array([0, 0, -1.0]), '$m g$', FORCE, (0.0, -0.05))
    arrow(axes, buoyancy, np.array([0, 0, 1.0]), r'$\rho V g$', FORCE, (-0.18, 0.03))
    axes.set_aspect('equal')
    axes.axis('off')
    axes.set(xlim=(-1.3, 6.2), ylim=(-3.0, 1.7))
    figure.savefig(OUT, dpi=130, bbox_inches='tight')
    plt.close(figure)


def main() -> None:
    """Draw the picture of doc/physics.md."""
    draw()
    print(OUT.relative_to(ROOT))


if __name__ == '__main__':
    main()
