# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Geoms of a model as shapes of URDF: boxes, cylinders, spheres, and meshes for what it lacks."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.resources import SHARE

#: A sphere of radius 1 m, of which an ellipsoid is made by its scale.
UNIT_SPHERE = f'package://{SHARE}/models/shapes/unit_sphere.stl'
#: Meshes that viewers of ROS read, too; those of MuJoCo's own format are none.
MESHES = ('.stl', '.obj', '.dae')
_GEOM = mujoco.mjtGeom
#: Groups that MuJoCo's own viewer shows unless it is told otherwise.
_SHOWN = 2


@dataclass(frozen=True)
class Shape:
    """
    A shape of URDF.

    Attributes
    ----------
    kind, attributes
        Element of ``<geometry>`` and its attributes.
    position_b, quat_bs_wxyz
        Pose in the frame of the geom's body [m], shape (3,) and (4,).
    rgba
        Colour, 0 to 1, shape (4,).
    is_visual, is_collision
        Which of both it is.
    note
        Why it is not the geom's own shape, or ''.

    """

    kind: str
    attributes: dict[str, str]
    position_b: Array
    quat_bs_wxyz: Array
    rgba: Array
    is_visual: bool
    is_collision: bool
    note: str = ''


def numbers(values: Array) -> str:
    """
    Return numbers as an attribute of URDF holds them.

    Parameters
    ----------
    values
        Of any unit, shape (n,).

    Returns
    -------
    str
        Twelve digits each.

    """
    return ' '.join(f'{value + 0.0:.12g}' for value in np.asarray(values).tolist())


def shapes_of(
    model: mujoco.MjModel, read_spec: Callable[[], mujoco.MjSpec], body: int
) -> Iterator[Shape]:
    """
    Yield the shapes of a body's geoms.

    A geom is visual where MuJoCo's viewer shows its group at first, and collision where it can
    touch something; one that is neither (such as a shape for fluid forces alone) is left out.

    Parameters
    ----------
    model
        The compiled model.
    read_spec
        Returns what it was compiled from; asked for the files of meshes.
    body
        Id of the body.

    Yields
    ------
    Shape
        One or several for each geom.

    """
    first = int(model.body_geomadr[body])
    for geom in range(first, first + int(model.body_geomnum[body])):
        material = int(model.geom_matid[geom])
        rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
        touches = bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
        seen = bool(model.geom_group[geom] <= _SHOWN and rgba[3] > 0)
        if not (touches or seen):
            continue
        for kind, attributes, offset, note in _forms(model, read_spec, geom):
            position, quat = _beside(model.geom_pos[geom], model.geom_quat[geom], *offset)
            yield Shape(kind, attributes, position, quat, rgba.copy(), seen, touches, note)


_Pose = tuple[Array, Array]
_Form = tuple[str, dict[str, str], _Pose, str]
_SAME: _Pose = (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))


def _forms(
    model: mujoco.MjModel, read_spec: Callable[[], mujoco.MjSpec], geom: int
) -> Iterator[_Form]:
    """Yield element, attributes, pose in the geom's frame, and note of each of a geom's shapes."""
    kind, size = int(model.geom_type[geom]), model.geom_size[geom]
    radius = {'radius': numbers(size[:1])}
    if kind == _GEOM.mjGEOM_SPHERE:
        yield 'sphere', radius, _SAME, ''
    elif kind == _GEOM.mjGEOM_BOX:
        yield 'box', {'size': numbers(2 * size)}, _SAME, ''
    elif kind in (_GEOM.mjGEOM_CYLINDER, _GEOM.mjGEOM_CAPSULE):
        yield 'cylinder', {**radius, 'length': numbers(2 * size[1:2])}, _SAME, ''
        if kind == _GEOM.mjGEOM_CAPSULE:
            for end in (-1, 1):
                yield 'sphere', radius, (np.array([0, 0, end * size[1]]), _SAME[1]), ''
    elif kind == _GEOM.mjGEOM_ELLIPSOID:
        yield 'mesh', {'filename': UNIT_SPHERE, 'scale': numbers(size)}, _SAME, ''
    elif kind == _GEOM.mjGEOM_MESH:
        yield _mesh(model, read_spec(), geom)
    else:
        name = _GEOM(kind).name.removeprefix('mjGEOM_').lower()
        note = (
            f'{_label(model, geom)} is a {name}, which URDF lacks: shown as a point of its place'
        )
        yield 'sphere', {'radius': '0.001'}, _SAME, note


def _mesh(model: mujoco.MjModel, spec: mujoco.MjSpec, geom: int) -> _Form:
    """Return a mesh by its file; MuJoCo has moved its vertices to their centre and main axes."""
    number = int(model.geom_dataid[geom])
    name = model.mesh(number).name
    source = spec.mesh(name)
    start = int(model.mesh_pathadr[number])
    file = bytes(model.paths[start:]).split(b'\0')[0].decode() if start >= 0 else ''
    path = (Path(spec.modelfiledir) / file).resolve()
    label = f'{_label(model, geom)}: mesh {name!r}'
    if path.suffix.lower() not in MESHES:
        note = f'{label} is no file of {", ".join(MESHES)}: shown as the box around it'
    elif not path.is_file():
        note = f'{label} has no file any more ({file or "none"}): shown as the box around it'
    elif source is None or _is_moved(source):
        note = f'{label} has refpos or refquat: shown as the box around it'
    else:
        scale = {'filename': path.as_uri(), 'scale': numbers(model.mesh_scale[number])}
        return 'mesh', scale, _inverse(model.mesh_pos[number], model.mesh_quat[number]), ''
    return 'box', {'size': numbers(2 * model.geom_size[geom])}, _SAME, note


def _is_moved(mesh: mujoco.MjsMesh) -> bool:
    return bool(np.any(mesh.refpos)) or not np.array_equal(mesh.refquat, _SAME[1])


def _label(model: mujoco.MjModel, geom: int) -> str:
    name = model.geom(geom).name
    body = model.body(model.geom_bodyid[geom]).name
    return f'geom {name!r}' if name else f'a geom of body {body!r}'


def _beside(position: Array, quat: Array, further: Array, turn: Array) -> _Pose:
    """Return a pose that is given in the frame of another one."""
    moved, product = np.empty(3), np.empty(4)
    mujoco.mju_rotVecQuat(moved, further, quat)
    mujoco.mju_mulQuat(product, quat, turn)
    return position + moved, product


def _inverse(position: Array, quat: Array) -> _Pose:
    back, moved = np.empty(4), np.empty(3)
    mujoco.mju_negQuat(back, quat)
    mujoco.mju_rotVecQuat(moved, -position, back)
    return moved, back
