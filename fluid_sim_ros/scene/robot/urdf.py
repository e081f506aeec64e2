# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle's URDF, made from its MuJoCo model: what ROS calls its robot description."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.robot.links import Link, joint_name, vehicle_links
from fluid_sim_ros.scene.robot.shapes import Shape, numbers, shapes_of
from fluid_sim_ros.scene.vehicle import Vehicle

_Element = ElementTree.Element
#: URDF's name of each kind of joint; a hinge without limits is ``continuous``, and a ball joint,
#: which URDF lacks, is ``floating``: its place comes from /tf.
_KINDS = {
    mujoco.mjtJoint.mjJNT_HINGE: 'revolute',
    mujoco.mjtJoint.mjJNT_SLIDE: 'prismatic',
    mujoco.mjtJoint.mjJNT_BALL: 'floating',
}
#: URDF wants a range of a slide [m], and for all that have a range a bound of effort [N, N m] and
#: of speed [m/s, rad/s]; where the model has none, this stands for none.
_NO_BOUND = 1e6


@dataclass(frozen=True)
class Frame:
    """
    A frame that is fixed to ``base_link``, such as a sensor's.

    Attributes
    ----------
    name
        Without the vehicle's name before it.
    position_b, quat_bf_wxyz
        Pose in base_link [m], shape (3,) and (4,).

    """

    name: str
    position_b: Array
    quat_bf_wxyz: Array


@dataclass(frozen=True)
class RobotDescription:
    """
    A vehicle as a URDF.

    Attributes
    ----------
    urdf
        The text.
    notes
        What URDF cannot say and how it is shown instead, a line each.

    """

    urdf: str
    notes: tuple[str, ...]


def robot_description(
    model: mujoco.MjModel,
    read_spec: Callable[[], mujoco.MjSpec],
    vehicle: Vehicle,
    frames: Sequence[Frame] = (),
) -> RobotDescription:
    """
    Return the URDF of a vehicle.

    Links have the names of the frames on /tf, ``<vehicle>/base_link`` first, and joints those of
    ``joint_states``; no tool needs a prefix.

    Parameters
    ----------
    model
        The compiled model.
    read_spec
        Returns what it was compiled from; asked where a geom is a mesh.
    vehicle
        One of its vehicles.
    frames
        Further links without mass.

    Returns
    -------
    RobotDescription
        The URDF, and what it lacks.

    """
    robot = ElementTree.Element('robot', name=vehicle.name)
    notes: list[str] = []
    taken = [frame.name for frame in frames]
    for link in vehicle_links(model, vehicle, taken):
        shapes = list(shapes_of(model, read_spec, link.body_id)) if link.body_id >= 0 else []
        notes += [shape.note for shape in shapes if shape.note]
        robot.append(_link(model, vehicle, link, shapes))
        if link.parent:
            robot.append(_joint(model, vehicle, link, notes))
    for frame in frames:
        name = f'{vehicle.name}/{frame.name}'
        ElementTree.SubElement(robot, 'link', name=name)
        parts = (f'{frame.name}_joint', 'fixed', f'{vehicle.name}/base_link', name)
        robot.append(_joint_element(*parts, frame.position_b, frame.quat_bf_wxyz))
    said = tuple(dict.fromkeys(notes))
    for line in reversed(said):
        robot.insert(0, ElementTree.Comment(f' {line.replace("--", "- -")} '))
    ElementTree.indent(robot)
    text = ElementTree.tostring(robot, encoding='unicode')
    return RobotDescription(f'<?xml version="1.0"?>\n{text}\n', said)


def _link(
    model: mujoco.MjModel, vehicle: Vehicle, link: Link, shapes: Sequence[Shape]
) -> _Element:
    element = ElementTree.Element('link', name=f'{vehicle.name}/{link.name}')
    body = link.body_id
    if body >= 0 and model.body_mass[body] > 0:
        inertial = ElementTree.SubElement(element, 'inertial')
        place = model.body_ipos[body] - link.shift_b
        inertial.append(_origin(place, model.body_iquat[body]))
        ElementTree.SubElement(inertial, 'mass', value=numbers(model.body_mass[[body]]))
        moments = dict(zip(('ixx', 'iyy', 'izz'), model.body_inertia[body], strict=True))
        given = {name: numbers(np.array([value])) for name, value in moments.items()}
        given |= {'ixy': '0', 'ixz': '0', 'iyz': '0'}
        ElementTree.SubElement(inertial, 'inertia', given)
    for shape in shapes:
        for wanted, tag in ((shape.is_visual, 'visual'), (shape.is_collision, 'collision')):
            if wanted:
                element.append(_shape(shape, tag, link))
    return element


def _shape(shape: Shape, tag: str, link: Link) -> _Element:
    element = ElementTree.Element(tag)
    element.append(_origin(shape.position_b - link.shift_b, shape.quat_bs_wxyz))
    geometry = ElementTree.SubElement(element, 'geometry')
    ElementTree.SubElement(geometry, shape.kind, shape.attributes)
    if tag == 'visual':
        colour = numbers(np.round(shape.rgba.astype(float), 6))
        material = ElementTree.SubElement(element, 'material', name=f'rgba {colour}')
        ElementTree.SubElement(material, 'color', rgba=colour)
    return element


def _joint(model: mujoco.MjModel, vehicle: Vehicle, link: Link, notes: list[str]) -> _Element:
    parent, child = f'{vehicle.name}/{link.parent}', f'{vehicle.name}/{link.name}'
    joint = link.joint_id
    if joint < 0:
        parts = (f'{link.name}_joint', 'fixed', parent, child)
        return _joint_element(*parts, link.position_p, link.quat_pl_wxyz)
    kind = _KINDS[mujoco.mjtJoint(int(model.jnt_type[joint]))]
    limited = bool(model.jnt_limited[joint])
    if kind == 'revolute' and not limited:
        kind = 'continuous'
    name = joint_name(model, joint, vehicle)
    element = _joint_element(name, kind, parent, child, link.position_p, link.quat_pl_wxyz)
    if kind == 'floating':
        notes.append(f'joint {name!r} is a ball joint, which URDF lacks: floating, placed by /tf')
        return element
    ElementTree.SubElement(element, 'axis', xyz=numbers(model.jnt_axis[joint]))
    if kind != 'continuous':
        element.append(_limit(model, joint))
    damping, friction = (
        float(values[model.jnt_dofadr[joint]])
        for values in (model.dof_damping, model.dof_frictionloss)
    )
    if damping or friction:
        given = {'damping': f'{damping:.12g}', 'friction': f'{friction:.12g}'}
        ElementTree.SubElement(element, 'dynamics', given)
    return element


def _limit(model: mujoco.MjModel, joint: int) -> _Element:
    effort, (low, high) = _NO_BOUND, (-_NO_BOUND, _NO_BOUND)
    if model.jnt_actfrclimited[joint]:
        effort = float(np.abs(model.jnt_actfrcrange[joint]).max())
    if model.jnt_limited[joint]:
        low, high = model.jnt_range[joint].tolist()
    given = {'lower': low, 'upper': high, 'effort': effort, 'velocity': _NO_BOUND}
    attributes = {name: f'{value:.12g}' for name, value in given.items()}
    return ElementTree.Element('limit', attributes)


def _joint_element(
    name: str, kind: str, parent: str, child: str, position: Array, quat_wxyz: Array
) -> _Element:
    element = ElementTree.Element('joint', name=name, type=kind)
    element.append(_origin(position, quat_wxyz))
    ElementTree.SubElement(element, 'parent', link=parent)
    ElementTree.SubElement(element, 'child', link=child)
    return element


def _origin(position: Array, quat_wxyz: Array) -> _Element:
    """Return an origin; URDF turns about the fixed axes x, y and z, in this order."""
    place, turn = (numbers(np.round(values, 12)) for values in (position, _rpy(quat_wxyz)))
    return ElementTree.Element('origin', xyz=place, rpy=turn)


def _rpy(quat_wxyz: Array) -> Array:
    """Return roll, pitch and yaw [rad]; scipy's would add 29 MiB to whatever opens a log."""
    flat, unit = np.empty(9), quat_wxyz / np.linalg.norm(quat_wxyz)
    mujoco.mju_quat2Mat(flat, unit)
    turned = flat.reshape(3, 3)
    level = np.hypot(turned[0, 0], turned[1, 0])
    pitch = np.arctan2(-turned[2, 0], level)
    if level < 1e-7:  # straight up or down: only the sum of roll and yaw is known
        return np.array([np.arctan2(-turned[1, 2], turned[1, 1]), pitch, 0.0])
    roll = np.arctan2(turned[2, 1], turned[2, 2])
    return np.array([roll, pitch, np.arctan2(turned[1, 0], turned[0, 0])])
