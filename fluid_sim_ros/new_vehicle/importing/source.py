# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A file that is imported, as MuJoCo's own reader has it."""

from dataclasses import dataclass, field
from pathlib import Path

import mujoco

from fluid_sim_ros.hydro.meshes import shapes
from fluid_sim_ros.hydro.meshes.surface import Surface

#: Faces that MuJoCo takes of a mesh, at most.
MOST_FACES = 200_000


@dataclass
class Source:
    """
    What was read.

    Attributes
    ----------
    path
        Of the file.
    name
        That the file gives the vehicle, fit for topics.
    spec
        As MuJoCo read it.
    base
        Name of the vehicle's base body.
    assets
        Files that the model names, by the name that it has for them: STL, as bytes.
    hull
        Of a mesh file: the file itself; None: the geometry of the base.
    said
        What was decided or left out on the way, one phrase each.

    """

    path: Path
    name: str
    spec: mujoco.MjSpec
    base: str
    assets: dict[str, bytes] = field(default_factory=dict)
    hull: Path | None = None
    said: list[str] = field(default_factory=list)


def stl_bytes(surface: Surface) -> bytes:
    """
    Return a mesh as a binary STL that MuJoCo takes.

    Parameters
    ----------
    surface
        Triangles [m].

    Returns
    -------
    bytes
        The file.

    """
    if len(surface.faces) > MOST_FACES:
        from fluid_sim_ros.hydro.meshes.simplify import decimated

        surface = decimated(surface, MOST_FACES)
    return shapes.stl_bytes(surface)


def fit_for_topics(name: str) -> str:
    """
    Return a name with letters, digits and _ only, a letter first.

    Parameters
    ----------
    name
        Any.

    Returns
    -------
    str
        ``vehicle`` where nothing is left.

    """
    kept = ''.join(c if c.isascii() and c.isalnum() else '_' for c in name).strip('_')
    kept = kept.lstrip('0123456789_')[:60]
    return kept if kept and kept != 'world' else 'vehicle'
