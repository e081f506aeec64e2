# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""From triangles of a file to one closed solid, each repair with a word."""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.close import turned_to_one_side, with_lids
from fluid_sim_ros.hydro.meshes.frame import Frame, framed
from fluid_sim_ros.hydro.meshes.solid import MOST_PARTS, solid_of_parts
from fluid_sim_ros.hydro.meshes.surface import (
    MeshFaultError,
    Surface,
    areas,
    components,
    volume_and_center,
)
from fluid_sim_ros.hydro.meshes.weld import welded, without_cracks

#: Farthest that a vertex may be from the origin [m]: beyond it products overflow.
_FARTHEST = 1e9


@dataclass(frozen=True)
class Solid:
    """
    A closed body.

    Attributes
    ----------
    surface
        In its own frame: radius 1, all faces outward, no inner walls.
    frame
        Where that frame is in mesh axes.
    repairs
        What was repaired, one phrase each; empty: nothing.

    """

    surface: Surface
    frame: Frame
    repairs: tuple[str, ...] = ()

    def in_mesh_axes(self) -> Surface:
        """
        Return the body in the axes of its file.

        Returns
        -------
        Surface
            Vertices in mesh axes [m].

        """
        return Surface(self.frame.outward(self.surface.vertices), self.surface.faces)


def repaired(surface: Surface) -> Solid:
    """
    Return triangles as a closed solid.

    Equal corners are welded, cracks closed, faces turned to one side, holes covered with lids,
    inner cavities filled and parts united where they meet.

    Parameters
    ----------
    surface
        Of a file [m].

    Returns
    -------
    Solid
        With what was repaired.

    Raises
    ------
    MeshFaultError
        If it is no solid and is not made one by these steps: what is wrong, where, and the
        remedy.

    """
    if not len(surface.faces):
        raise MeshFaultError('no triangles in it')
    if not np.isfinite(surface.vertices).all():
        raise MeshFaultError('a vertex is not finite; export the mesh again')
    if np.abs(surface.vertices).max() > _FARTHEST:
        raise MeshFaultError(f'a vertex is farther than {_FARTHEST:g} m away; export it again')
    joined = welded(surface)
    if not len(joined.faces) or not areas(joined.triangles).sum() > 0:
        raise MeshFaultError('all its triangles are points or lines')
    own, frame = framed(joined)
    try:
        body, words = _closed(own, frame.length)
    except MeshFaultError as fault:
        if fault.point is None:
            raise
        x, y, z = frame.outward(fault.point).round(9) + 0.0
        raise ConfigError(f'{fault} (near {x:.4g} {y:.4g} {z:.4g})') from None
    return Solid(body, frame, tuple(words))


def _closed(own: Surface, unit: float) -> tuple[Surface, list[str]]:
    words: list[str] = []
    own, gap = without_cracks(own)
    if gap:
        words.append(f'cracks up to {gap * unit:.2g} m welded')
    count, label = components(own.faces)
    if count > MOST_PARTS:
        raise MeshFaultError(
            f'{count} separate parts, at most {MOST_PARTS} are taken; unite them, or leave out '
            'screws and labels'
        )
    parts, turned, lids = [], 0, []
    for k in range(count):
        part, number = turned_to_one_side(own.part(label == k))
        part, widths = with_lids(part)
        parts.append(part)
        turned += number
        if abs(volume_and_center(part.triangles)[0]) > 0:
            lids += widths
    if turned:
        words.append(f'{turned} faces turned to the side of their neighbours')
    if lids:
        holes = f'{len(lids)} holes' if len(lids) > 1 else 'a hole'
        words.append(f'{holes} up to {max(lids) * unit:.2g} m wide closed with flat lids')
    return solid_of_parts(parts, words, unit), words
