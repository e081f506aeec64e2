# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One solid of many parts: cavities filled, specks dropped, overlapping parts united."""

import numpy as np

from fluid_sim_ros.hydro.meshes.crossing import crossing_point, winding_numbers
from fluid_sim_ros.hydro.meshes.manifold import manifold_of, surface_of
from fluid_sim_ros.hydro.meshes.surface import (
    MeshFaultError,
    Surface,
    components,
    volume_and_center,
)
from fluid_sim_ros.physics.arrays import Array

#: Most parts that are looked at one by one.
MOST_PARTS = 4000
#: A part smaller than this share of the largest one is a speck.
_SPECK = 1e-7
#: Volume over the cube of the radius below which a body is a sheet.
_SHEET = 1e-7


def solid_of_parts(parts: list[Surface], words: list[str], unit: float) -> Surface:
    """
    Return one solid without inner walls.

    Parameters
    ----------
    parts
        Closed, each with its faces to one side, in one frame of radius 1.
    words
        What was repaired is added here.
    unit
        Length of the frame's unit [m], for what is said.

    Returns
    -------
    Surface
        All faces outward.

    Raises
    ------
    MeshFaultError
        If a part crosses itself, or there is no volume.

    """
    volumes = np.array([volume_and_center(part.triangles)[0] for part in parts])
    largest = np.abs(volumes).max(initial=0)
    if largest < _SHEET:
        raise MeshFaultError(
            'the mesh encloses no volume (a sheet without thickness, or a surface that crosses '
            'itself); mend it in a modelling program'
        )
    large = np.abs(volumes) > _SPECK * largest
    if not large.all():
        words.append(f'{np.count_nonzero(~large)} parts without volume dropped')
    parts = [part for part, keep in zip(parts, large, strict=True) if keep]
    parts = _without_cavities(parts, volumes[large], words, unit)
    for part in parts:
        crossing = crossing_point(part)
        if crossing is not None:
            raise MeshFaultError(
                'the surface crosses itself; unite or separate its parts in a modelling program',
                crossing,
            )
    if len(parts) > 1 and _boxes_meet(parts):
        parts = _united(parts, words, unit)
    return _together(parts)


def _without_cavities(
    parts: list[Surface], volumes: Array, words: list[str], unit: float
) -> list[Surface]:
    """Return the outer parts, turned outward; the inward ones inside them are cavities."""
    turned, filled, kept = 0, [], []
    for index, (part, volume) in enumerate(zip(parts, volumes, strict=True)):
        if volume > 0:
            kept.append(part)
            continue
        others = [other for k, other in enumerate(parts) if k != index and volumes[k] > -volume]
        point = part.vertices[part.faces[0]].mean(axis=0)[None]
        if any(winding_numbers(point, other.triangles)[0] > 0.5 for other in others):
            filled.append(-volume)
        else:
            turned += 1
            kept.append(Surface(part.vertices, part.faces[:, ::-1]))
    if turned:
        words.append('inside out: turned' if len(parts) == 1 else f'{turned} parts inside out')
    if filled:
        words.append(_cavities(filled, unit))
    return kept


def _cavities(volumes: list[float], unit: float) -> str:
    count = f'{len(volumes)} closed cavities' if len(volumes) > 1 else 'a closed cavity'
    return f'{count} ({sum(volumes) * unit**3:.3g} m^3) counted as filled: no water gets in'


def _boxes_meet(parts: list[Surface]) -> bool:
    low = np.array([part.vertices.min(axis=0) for part in parts])
    high = np.array([part.vertices.max(axis=0) for part in parts])
    order = np.argsort(low[:, 0])
    low, high = low[order], high[order]
    for k in range(len(parts) - 1):
        near = low[k + 1 :, 0] <= high[k, 0]
        meets = (
            near & (low[k + 1 :] <= high[k]).all(axis=1) & (high[k + 1 :] >= low[k]).all(axis=1)
        )
        if meets.any():
            return True
    return False


def _united(parts: list[Surface], words: list[str], unit: float) -> list[Surface]:
    import manifold3d

    before = sum(volume_and_center(part.triangles)[0] for part in parts)
    solids = [manifold_of(part) for part in parts]
    # rounding between touching faces would leave slivers of water
    solid = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
    surface = surface_of(solid)
    count, label = components(surface.faces)
    pieces = [surface.part(label == k) for k in range(count)]
    volumes = [volume_and_center(piece.triangles)[0] for piece in pieces]
    outer = [piece for piece, volume in zip(pieces, volumes, strict=True) if volume > 0]
    holes = [-volume for volume in volumes if volume < 0]
    overlap = before - sum(volume for volume in volumes)
    overlapped = overlap > 1e-4 * before
    if overlapped or len(outer) != len(parts):
        words.append(
            f'{len(parts)} parts united into {len(outer)}'
            + (f', which overlapped by {overlap / before:.1%}' if overlapped else '')
        )
    if holes and max(holes) > _SPECK * sum(volumes):
        words.append(_cavities(holes, unit))
    return outer


def _together(parts: list[Surface]) -> Surface:
    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=True)]
    return Surface(np.concatenate([part.vertices for part in parts]), np.concatenate(faces))
