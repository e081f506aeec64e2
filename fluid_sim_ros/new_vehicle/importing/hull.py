# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The closed hull of a vehicle: which geometry it is, its volume, and its coefficients."""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.coefficients import Coefficients, Request, coefficients_of
from fluid_sim_ros.hydro.meshes import shapes
from fluid_sim_ros.hydro.meshes.reading import MeshFile, read_mesh
from fluid_sim_ros.hydro.meshes.surface import Surface
from fluid_sim_ros.hydro.statics import Statics, statics_of
from fluid_sim_ros.interruption import owns
from fluid_sim_ros.new_vehicle.importing.answers import Answers
from fluid_sim_ros.new_vehicle.importing.skeleton import Skeleton
from fluid_sim_ros.physics.arrays import Array

#: Two hulls that differ by more in volume are asked about.
_UNLIKE = 0.2
_ROUND = 24  # sections of a circle
_GEOM = mujoco.mjtGeom


@dataclass(frozen=True)
class Hull:
    """A closed hull in base axes: the mesh as read, and its statics."""

    file: MeshFile
    statics: Statics


def hull_of(skeleton: Skeleton, answers: Answers) -> Hull | None:
    """
    Return the hull that the user or the file states.

    Parameters
    ----------
    skeleton
        The vehicle; told what was decided, and asked what was not.
    answers
        What the user says.

    Returns
    -------
    Hull
        None where it is undecided.

    Raises
    ------
    ConfigError
        If a hull that is asked for is not there, or is no solid.

    """
    chosen = answers.hull
    if chosen is None and skeleton.source.hull is not None:
        hull = _read(skeleton.source.hull, answers.unit, answers.up or 'file')
        return _told(skeleton, hull)
    if chosen not in (None, 'collision', 'visual'):
        return _told(skeleton, _read(Path(str(chosen)), answers.unit))
    found: dict[str, Hull] = {}
    faults: dict[str, ConfigError] = {}
    for kind in ('collision', 'visual') if chosen is None else (chosen,):
        surface = _surface_of(skeleton, collides=kind == 'collision')
        if surface is None:
            continue
        try:
            owns()
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / f'{kind}.obj'
                shapes.write_obj(surface, path)
                hull = _read(path, None)
            called = Path(f'{skeleton.source.name} ({kind} geometry)')
            found[kind] = replace(hull, file=replace(hull.file, path=called))
        except ConfigError as error:
            faults[kind] = error
    if not found:
        if faults:
            fault = next(iter(faults.values()))
            raise ConfigError(f'{skeleton.source.path}: hull: {fault}')
        skeleton.questions.append('hull: a closed mesh (--hull FILE): the base has no geometry')
        return None
    volumes = {kind: hull.statics.volume for kind, hull in found.items()}
    if len(found) == 2 and max(volumes.values()) > (1 + _UNLIKE) * min(volumes.values()):
        words = ', '.join(f'{kind} {1e3 * volume:.3g} l' for kind, volume in volumes.items())
        skeleton.questions.append(f'hull: --hull collision, visual or a mesh FILE ({words})')
    kind = next(iter(found))
    skeleton.said.append(f'hull: the {kind} geometry of the base, {1e3 * volumes[kind]:.4g} l')
    return found[kind]


def hydro_of(
    hull: Hull,
    density: float,
    mass: float,
    center: Array,
    panels: int,
    say: Callable[[str], None],
) -> Coefficients:
    """
    Return the hydrodynamic coefficients of a hull.

    Parameters
    ----------
    hull
        In base axes.
    density
        Of the fluid [kg/m^3].
    mass, center
        Of the vehicle [kg], [m].
    panels
        Of the coarser mesh, at most.
    say
        Takes a line of progress.

    Returns
    -------
    Coefficients
        In base axes.

    """
    center_m = (float(center[0]), float(center[1]), float(center[2]))
    request = Request(
        hull.file.path, density, unit='m', mass=mass, mass_center=center_m, coarse=panels
    )
    return coefficients_of(request, say, hull.file)


def _read(path: Path, unit: str | None, up: str = 'keep') -> Hull:
    file = read_mesh(path, unit, up)
    return Hull(file, statics_of(file.solid))


def _told(skeleton: Skeleton, hull: Hull) -> Hull:
    """Say what was repaired, turned or scaled in a mesh file."""
    file = hull.file
    said = [f'in {file.unit}'] if file.unit != 'm' else []
    said += file.repairs
    if said:
        skeleton.said.append(f'{file.path.name}: {"; ".join(said)}')
    return hull


def _surface_of(skeleton: Skeleton, *, collides: bool) -> Surface | None:
    """Return the geometry of the base in one mesh, in its axes; parts may overlap."""
    model, parts = skeleton.model, []
    for geom in np.flatnonzero(model.geom_bodyid == skeleton.base_id):
        if model.geom(geom).name in skeleton.discs:
            continue
        if bool(model.geom_contype[geom] or model.geom_conaffinity[geom]) != collides:
            continue
        part = _part(model, int(geom))
        if part is None:
            continue
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        points = part.vertices @ turn.reshape(3, 3).T + model.geom_pos[geom]
        parts.append(Surface(points, part.faces))
    return shapes.together(parts) if parts else None


def _part(model: mujoco.MjModel, geom: int) -> Surface | None:
    size, kind = model.geom_size[geom], model.geom_type[geom]
    if kind == _GEOM.mjGEOM_BOX:
        return shapes.box(2 * size)
    if kind == _GEOM.mjGEOM_CYLINDER:
        return shapes.cylinder(size[0], 2 * size[1], sections=_ROUND)
    if kind == _GEOM.mjGEOM_SPHERE:
        return shapes.ellipsoid([size[0]] * 3, 2)
    if kind == _GEOM.mjGEOM_ELLIPSOID:
        return shapes.ellipsoid(size, 2)
    if kind == _GEOM.mjGEOM_CAPSULE:
        ball = shapes.ellipsoid([size[0]] * 3, 2)
        points = ball.vertices + np.sign(ball.vertices[:, 2:]) * [0, 0, size[1]]
        return Surface(points, ball.faces)
    if kind == _GEOM.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        begin, faces = model.mesh_faceadr[mesh], model.mesh_facenum[mesh]
        return Surface(
            model.mesh_vert[first : first + count].astype(float),
            model.mesh_face[begin : begin + faces].astype(np.int64),
        )
    return None
