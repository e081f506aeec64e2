# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Panels of a body for the boundary-element method: two meshes, each panel of one four of the other.

Constant panels need a partition of the surface, no more: neighbours need not meet at their
corners. Choices that equal lengths leave open go to the first in the file, so that rounding does
not make them.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.hydro.meshes.simplify import decimated, within, without_flat_edges
from fluid_sim_ros.hydro.meshes.surface import (
    MeshFaultError,
    Surface,
    areas,
    volume_and_center,
)
from fluid_sim_ros.hydro.quads import cut_to_size, merged_to_quads, quartered, sound
from fluid_sim_ros.hydro.sharp_edges import cut_towards_edges, sharp_edges
from fluid_sim_ros.physics.arrays import Array

#: Panels of the coarser mesh, at most; the finer one has four times as many.
COARSE = 1350
#: A smooth body of more faces is not refined: it is computed with so many, and a quarter of them.
_SMOOTH = 4 * COARSE
#: How far a body with sharp edges is simplified in turn, of its radius, until it can be refined
#: enough; and what it may lose of its volume and its area.
_SIMPLER = (5e-4, 1e-3, 2e-3, 4e-3, 8e-3, 1.6e-2)
_LOST = 0.02
#: Panels of a body that is too detailed for refinement, and what it may lose then.
_MOST, _ROUGH = 2500, 0.05
_LAYERS = ((8, 6, 5), (4, 3, 2))
#: Longest side of a panel over the square root of a sixth of the area: 1 is the side of a cube.
_LONGEST = 0.45
_STEP = 2**0.125
#: Depth of the layers beside a sharp edge, in longest sides.
_DEPTH = 1.4


@dataclass(frozen=True)
class Panels:
    """
    The panels of one body, coarse and fine.

    Attributes
    ----------
    coarse, fine
        Corners, counter-clockwise seen from outside, three-cornered ones with the last twice;
        shape (n, 4, 3).
    alike
        Whether each coarse panel is four fine ones; otherwise both are meshes of their own.

    """

    coarse: Array
    fine: Array
    alike: bool


def panels_of(surface: Surface, coarse: int = COARSE) -> Panels:
    """
    Return the panels of a closed body.

    Parameters
    ----------
    surface
        Closed, all faces outward, radius about 1.
    coarse
        Most panels of the coarser mesh.

    Returns
    -------
    Panels
        Narrow beside sharp edges. A body that has no room for any refinement gets more.

    Raises
    ------
    MeshFaultError
        If its detail does not fit into any number of panels that can be solved for.

    """
    body = without_flat_edges(surface)
    if not len(sharp_edges(body)) and len(body.faces) > coarse:
        fine = decimated(body, _SMOOTH * coarse // COARSE)
        rough = decimated(fine, min(coarse, len(fine.faces) // 4))
        return Panels(as_panels(rough), as_panels(fine), alike=False)
    best = _best_refined(body, coarse)
    return Panels(best, quartered(best), alike=True)


def as_panels(surface: Surface) -> Array:
    """
    Return the triangles of a mesh as panels.

    Parameters
    ----------
    surface
        Any mesh.

    Returns
    -------
    Corners, the last one twice, shape (n, 4, 3).

    """
    triangles = surface.triangles
    return sound(np.concatenate([triangles, triangles[:, 2:]], axis=1))


def _best_refined(body: Surface, most: int) -> Array:
    """Return panels within a number, of the body or of a simpler one that allows more layers."""
    bodies = list(_ever_simpler(body))
    best, goal = None, np.inf
    for layers in _LAYERS:
        for simple in bodies:
            panels, miss = _refined(simple, most, layers)
            if miss <= 0:
                return panels
            if miss < goal:
                best, goal = panels, miss
    return _plain(body, bodies[-1]) if best is None else best


def _plain(body: Surface, simplest: Surface) -> Array:
    """Return panels without layers, of a body that is too detailed for any within the number."""
    quads = merged_to_quads(simplest)
    if len(quads) <= _MOST:
        return quads
    rough = decimated(body, _MOST)
    volume, area = _kept(rough, body)
    if max(abs(volume - 1), abs(area - 1)) > _ROUGH:
        raise MeshFaultError(
            f'more detail than {_MOST} panels hold (with so many, volume {volume - 1:+.0%}, area '
            f'{area - 1:+.0%}); leave out screws, threads and text, or fill what is hollow'
        )
    return as_panels(rough)


def _kept(simple: Surface, body: Surface) -> tuple[float, float]:
    """Return volume and area of a simpler body over those of the body."""
    one, two = simple.triangles, body.triangles
    return (
        volume_and_center(one)[0] / volume_and_center(two)[0],
        float(areas(one).sum() / areas(two).sum()),
    )


def _ever_simpler(body: Surface) -> Iterator[Surface]:
    """Yield a body, and simpler ones of nearly its volume and area."""
    yield body
    count = len(body.faces)
    for reach in _SIMPLER:
        simple = within(body, reach)
        if max(abs(share - 1) for share in _kept(simple, body)) > _LOST:
            return
        if len(simple.faces) < 0.8 * count:
            count = len(simple.faces)
            yield simple


def _refined(body: Surface, most: int, choices: tuple[int, ...]) -> tuple[Array, float]:
    """
    Return the finest panels of a body within a number, and by how much they miss the goal.

    The goal is a longest side; of the numbers of layers beside sharp edges, the first with which
    it is met.
    """
    size = float(np.sqrt(areas(body.triangles).sum() / 6))
    edges = sharp_edges(body)
    whole = merged_to_quads(body)
    best, goal = whole, np.inf
    if len(whole) > most:
        return best, goal
    for layers in choices:
        # even panels without layers would have 1.6 times this side
        side, panels = 0.6 * size * np.sqrt(6 / most), None
        while side < 4.0:
            sized = cut_to_size(whole, side, most)
            panels = cut_towards_edges(sized, edges, _DEPTH * side, layers, most)
            if panels is not None:
                break
            side *= _STEP
        if panels is None:
            continue
        miss = side / size - _LONGEST
        if miss < goal:
            best, goal = panels, miss
        if miss <= 0 or not len(edges):
            break
    return best, goal
