# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Panels of four corners: made of two flat neighbours, cut to a size, quartered."""

import numpy as np

from fluid_sim_ros.hydro.meshes.surface import Surface, area_vectors, face_pairs
from fluid_sim_ros.physics.arrays import Array

#: Two triangles in one plane to this cosine make one panel.
_FLAT = np.cos(np.radians(0.2))
#: Lengths closer than this are equal.
_TIE = 1e-3
_THREE = 3
#: Panels of less area, and sides of less length, than this are rounding; the radius is 1.
NOTHING = 1e-13
_NO_SIDE = 1e-8
#: A panel must be this wide: needles between faces that nearly meet are left out.
_NARROW = 1e-6


def three_cornered(panels: Array) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """
    Return which panels have three corners.

    Parameters
    ----------
    panels
        Shape (n, 4, 3).

    Returns
    -------
    Shape (n,).

    """
    result: np.ndarray[tuple[int], np.dtype[np.bool_]] = (panels[:, 2] == panels[:, 3]).all(axis=1)
    return result


def sound(panels: Array) -> Array:
    """
    Return panels without those that are a line, and with three corners where two are one.

    Parameters
    ----------
    panels
        Convex, shape (n, 4, 3).

    Returns
    -------
    Shape (k, 4, 3).

    """
    sides = np.linalg.norm(np.roll(panels, -1, axis=1) - panels, axis=2)
    result = panels.copy()
    for side in (0, 1, 3):  # the side 2 of three corners is none anyway
        short = (sides[:, side] < _NO_SIDE) & ~three_cornered(result)
        order = [(side + 2) % 4, (side + 3) % 4, side, side]
        result[short] = panels[short][:, order]
    short = (sides[:, 2] < _NO_SIDE) & ~three_cornered(result)
    result[short, 3] = result[short, 2]
    across = np.cross(result[:, 2] - result[:, 0], result[:, 3] - result[:, 1])
    area = 0.5 * np.linalg.norm(across, axis=1)
    ends = np.linalg.norm(np.roll(result, -1, axis=1) - result, axis=2)
    broken = (ends < _NO_SIDE).sum(axis=1) > three_cornered(result)
    needle = 2 * area < _NARROW * ends.max(axis=1)
    large: Array = result[(area > NOTHING) & ~needle & ~broken]
    return large


def merged_to_quads(surface: Surface) -> Array:
    """
    Return the faces of a mesh as panels, pairs in one plane as one of four corners.

    A pair is joined where it makes a convex panel, those first whose common side is the longest
    of both, as that of a halved rectangle is.

    Parameters
    ----------
    surface
        Closed.

    Returns
    -------
    Corners, three-cornered panels with the last twice, shape (n, 4, 3).

    """
    faces, corners = surface.faces, surface.triangles
    normals = area_vectors(corners)
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    pairs, consistent = face_pairs(faces)
    flat = np.einsum('ij,ij->i', unit[pairs[:, 0]], unit[pairs[:, 1]]) > _FLAT
    pairs = pairs[flat & consistent]
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    candidates = []
    for number, (one, two) in enumerate(pairs.tolist()):
        panel, common = _joined(surface, one, two)
        if panel is not None:
            longest = max(sides[one].max(), sides[two].max())
            candidates.append((round(1 - common / longest, 3), number, one, two, panel))
    taken = np.zeros(len(faces), bool)
    panels = []
    for _, _, one, two, panel in sorted(candidates, key=lambda entry: entry[:2]):
        if not (taken[one] or taken[two]):
            taken[[one, two]] = True
            panels.append(panel)
    rest = corners[~taken]
    alone = np.concatenate([rest, rest[:, 2:]], axis=1)
    return sound(np.concatenate([np.array(panels).reshape(-1, 4, 3), alone]))


def _joined(surface: Surface, one: int, two: int) -> tuple[Array | None, float]:
    """Return two triangles as one convex panel, or None; and the length of their common side."""
    first, second = surface.faces[one].tolist(), surface.faces[two].tolist()
    shared = [vertex for vertex in first if vertex in second]
    if len(shared) != 2:
        return None, 0.0
    place = next(k for k in range(_THREE) if first[k] not in shared)
    apex, left, right = (first[(place + k) % _THREE] for k in range(_THREE))
    other = next(vertex for vertex in second if vertex not in shared)
    panel = surface.vertices[[apex, left, other, right]]
    edges = np.roll(panel, -1, axis=0) - panel
    turns = np.cross(edges, np.roll(edges, -1, axis=0))
    normal = turns.sum(axis=0)
    size = np.linalg.norm(normal)
    # a corner of nearly 180 deg would be a triangle with a useless corner
    lengths = np.linalg.norm(edges, axis=1)
    if size == 0 or (turns @ normal < 1e-3 * size * lengths * np.roll(lengths, -1)).any():
        return None, 0.0
    return panel, float(np.linalg.norm(surface.vertices[left] - surface.vertices[right]))


def cut_to_size(panels: Array, longest: float, most: int) -> Array:
    """
    Return panels cut until no side is longer than wanted.

    Those of four corners become a grid; those of three are halved across their longest side.

    Parameters
    ----------
    panels
        Convex, shape (n, 4, 3).
    longest
        Longest side [unit of the panels].
    most
        Panels wanted at most: where there would be more, the work stops early.

    Returns
    -------
    Shape (k, 4, 3); more than ``most`` where that many are not enough.

    """
    three = three_cornered(panels)
    done = _grids(panels[~three], longest, most)
    count = sum(map(len, done))
    panels = panels[three]
    while len(panels):
        sides = np.linalg.norm(panels[:, [1, 2, 0]] - panels[:, :3], axis=2)
        large = sides.max(axis=1) > longest
        done.append(panels[~large])
        count += len(panels)
        if count > 2 * most:
            return np.concatenate([*done, panels[large]])
        panels, sides = panels[large], sides[large]
        first = (sides >= sides.max(axis=1, keepdims=True) * (1 - _TIE)).argmax(axis=1)
        panels = _triangle_halves(panels, first)
    return np.concatenate(done)


def _grids(panels: Array, longest: float, most: int) -> list[Array]:
    """Return each panel of four corners as a grid, all grids of one size together."""
    if not len(panels):
        return [panels]
    sides = np.linalg.norm(np.roll(panels, -1, axis=1) - panels, axis=2)
    wanted = np.maximum(sides[:, :2], sides[:, 2:]) / longest
    counts = np.maximum(np.ceil(wanted - _TIE), 1).astype(np.int64)
    if counts.prod(axis=1).sum() > 2 * most:
        return [np.repeat(panels, np.minimum(counts.prod(axis=1), 2 * most), axis=0)[: 2 * most]]
    grids = []
    for along, across in np.unique(counts, axis=0).tolist():
        chosen = panels[(counts == (along, across)).all(axis=1)]
        u, v = np.linspace(0, 1, along + 1), np.linspace(0, 1, across + 1)
        low = chosen[:, None, 0] + u[:, None] * (chosen[:, 1] - chosen[:, 0])[:, None]
        high = chosen[:, None, 3] + u[:, None] * (chosen[:, 2] - chosen[:, 3])[:, None]
        net = low[:, :, None] + v[:, None] * (high - low)[:, :, None]
        cells = [net[:, :-1, :-1], net[:, 1:, :-1], net[:, 1:, 1:], net[:, :-1, 1:]]
        grids.append(np.stack(cells, axis=3).reshape(-1, 4, 3))
    return grids


def _triangle_halves(panels: Array, first: np.ndarray[tuple[int], np.dtype[np.int64]]) -> Array:
    row = np.arange(len(panels))
    a, b, c = (panels[row, (first + k) % _THREE] for k in range(_THREE))
    middle = 0.5 * (a + b)
    return np.concatenate([np.stack([a, middle, c, c], 1), np.stack([middle, b, c, c], 1)])


def quartered(panels: Array) -> Array:
    """
    Return each panel as four.

    Parameters
    ----------
    panels
        Corners, three-cornered ones with the last twice, shape (n, 4, 3).

    Returns
    -------
    Shape (4 n, 4, 3).

    """
    three = three_cornered(panels)
    a, b, c, _ = np.moveaxis(panels[three], 1, 0)
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    quarters = [
        np.stack([x, y, z, z], axis=1)
        for x, y, z in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    ]
    a, b, c, d = np.moveaxis(panels[~three], 1, 0)
    ab, bc, cd, da = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + d), 0.5 * (d + a)
    middle = 0.25 * (a + b + c + d)
    quarters += [
        np.stack(corners, axis=1)
        for corners in (
            (a, ab, middle, da), (ab, b, bc, middle), (middle, bc, c, cd), (da, middle, cd, d),
        )
    ]  # fmt: skip
    return np.concatenate(quarters)
