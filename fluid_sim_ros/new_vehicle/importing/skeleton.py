# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The vehicle of a file as one free rigid base with its moving parts, and what hangs on it."""

from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.new_vehicle.importing.answers import Answers, LinkFin, Servo
from fluid_sim_ros.new_vehicle.importing.source import Source
from fluid_sim_ros.new_vehicle.layout import ThrusterPlace
from fluid_sim_ros.physics.arrays import Array

#: Mass of a base that states none, until the user's is known [kg].
_STAND_IN = 1.0


@dataclass
class Skeleton:
    """
    A vehicle whose frames are known.

    Attributes
    ----------
    source
        What was read.
    model
        Compiled, with a free joint; rigid parts are one body.
    xml
        The same as MJCF.
    base_id
        Of the base body.
    has_mass
        Whether the file states the mass of the base.
    places
        Thrusters, positions in base axes [m].
    fins
        Fins, the name of the site of each, and the joint that turns it or ''.
    servos
        Joints that are driven, and how.
    discs
        Geometry of thrusters, which is no part of the hull.
    said, questions
        What was decided; what was not.

    """

    source: Source
    model: mujoco.MjModel
    xml: str
    base_id: int
    has_mass: bool
    places: list[ThrusterPlace] = field(default_factory=list)
    fins: list[tuple[LinkFin, str, str]] = field(default_factory=list)
    servos: dict[str, Servo] = field(default_factory=dict)
    discs: list[str] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    questions: list[str] = field(default_factory=list)


def skeleton_of(source: Source, answers: Answers) -> Skeleton:
    """
    Return the vehicle of a file with a free joint and the links that the user names.

    Parameters
    ----------
    source
        What was read.
    answers
        What the user says.

    Returns
    -------
    Skeleton
        With questions where something is undecided.

    Raises
    ------
    ConfigError
        If the user names a link or joint that the file does not have, or MuJoCo refuses it.

    """
    spec, links = source.spec, _links(source)
    said, questions = list(source.said), []
    axes: dict[str, Array] = {}
    listed_thrusters = answers.thrusters if isinstance(answers.thrusters, list) else []
    rotors = [
        _known('thrusters: link', thruster.link, links)
        for thruster in listed_thrusters if thruster.link is not None
    ]  # fmt: skip
    for rotor in rotors:
        axes |= _without_joints(spec, links[rotor], rotor)
    if axes:
        said.append(f'joints of thrusters made fixed, their speed is a state: {listed(axes)}')
    joints = {joint.name: joint for joint in spec.joints if _moves(joint)}
    for name in answers.fixed:
        _known('fixed', name, list(joints))
        spec.delete(joints.pop(name))
    fins = [(fin, _known('fins: link', fin.link, links)) for fin in answers.fins]
    driven: dict[str, str] = {}
    for _, link in fins:
        for joint in links[link].joints:
            if joint.name in joints:
                driven[joint.name] = link
    servos = dict.fromkeys(driven, Servo())
    servos |= {_known('servos', name, joints): servo for name, servo in answers.servos.items()}
    for name, servo in servos.items():
        joints[name].armature = servo.armature
    if driven.keys() - answers.servos.keys():
        said.append(
            f'servos of {listed(sorted(driven.keys() - answers.servos.keys()))}: guess, those of '
            'the REMUS 100 (100 N m/rad, lag 0.1 s); servos: in the YAML file states others'
        )
    loose = [name for name in joints if name not in servos]
    if loose:
        questions.append(
            f'joints {listed(loose)}: fixed (--fixed NAME ...), or driven (servos: or fins: in '
            'the YAML file)'
        )
    for name in loose:  # until it is decided
        spec.delete(joints.pop(name))
    discs = _named_geometry(links, rotors)
    sites = _add_sites(links, fins)
    base = links[source.base]
    if not any(joint.type == mujoco.mjtJoint.mjJNT_FREE for joint in base.joints):
        base.add_freejoint(name=source.base)
    spec.compiler.fusestatic = True
    for mesh in spec.meshes:  # looks may be open
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    model, has_mass = _compiled(source, spec)
    skeleton = Skeleton(
        source, model, spec.to_xml(), model.body(source.base).id, has_mass,
        fins=[(fin, sites[fin.link], _joint_of(driven, link)) for fin, link in fins],
        servos=servos, discs=discs, said=said, questions=questions,
    )  # fmt: skip
    for thruster in listed_thrusters:
        place = _place_of(thruster, skeleton, axes)
        if place is not None:
            skeleton.places.append(place)
    return skeleton


def _joint_of(driven: dict[str, str], link: str) -> str:
    return next((joint for joint, owner in driven.items() if owner == link), '')


def _links(source: Source) -> dict[str, Any]:
    """Return the bodies of the vehicle by name, base first."""
    found: dict[str, Any] = {}

    def visit(body: Any) -> None:
        if body.name:
            found[body.name] = body
        for child in body.bodies:
            visit(child)

    visit(source.spec.body(source.base))
    return found


def _known(what: str, name: str | None, known: Any) -> str:
    if name is None or name not in known:
        raise ConfigError(
            f"{what} '{name}' is not in the file{did_you_mean(str(name), known)} "
            f'it has: {listed(known)}'
        )
    return name


def _moves(joint: Any) -> bool:
    return bool(joint.type != mujoco.mjtJoint.mjJNT_FREE)


def _without_joints(spec: mujoco.MjSpec, body: Any, name: str) -> dict[str, Array]:
    """Make a link rigid; return the axis that it turned about, in its own axes."""
    axes = {}
    for joint in list(body.joints):
        if _moves(joint):
            axes[name] = np.array(joint.axis, dtype=float)
            spec.delete(joint)
    return axes


def _named_geometry(links: dict[str, Any], names: list[str]) -> list[str]:
    """Give the geometry of links a name, where it has none; return the names."""
    found = []
    for name in names:
        for k, geom in enumerate(links[name].geoms):
            geom.name = geom.name or f'{name}_{k}'
            found.append(geom.name)
    return found


def _add_sites(links: dict[str, Any], fins: list[tuple[LinkFin, str]]) -> dict[str, str]:
    """Keep the frame of every link as a site, and of every fin; return the sites of the fins."""
    taken = {site.name for body in links.values() for site in body.sites}
    for name, body in links.items():
        if name not in taken:
            body.add_site(name=name)
    sites = {}
    for fin, link in fins:
        forward, along = np.array(fin.forward), np.array(fin.along)
        up = np.cross(forward, along)
        if np.linalg.norm(up) <= 1e-6 * np.linalg.norm(forward) * np.linalg.norm(along):
            raise ConfigError(f"fins: '{link}': forward and along must span a plane")
        along = np.cross(up, forward)
        turn = np.stack([v / np.linalg.norm(v) for v in (forward, along, up)], axis=1)
        quat = np.empty(4)
        mujoco.mju_mat2Quat(quat, turn.reshape(-1))
        sites[fin.link] = f'{link}_foil'
        links[link].add_site(name=sites[fin.link], pos=fin.center, quat=quat)
    return sites


def _compiled(source: Source, spec: mujoco.MjSpec) -> tuple[mujoco.MjModel, bool]:
    base = spec.body(source.base)
    stated = any(body.explicitinertial for body in _rigid(base)) or (
        spec.compiler.inertiafromgeom != mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE
    )
    if not stated:
        base.explicitinertial = True
        base.mass, base.ipos, base.inertia = _STAND_IN, [0, 0, 0], [_STAND_IN] * 3
    try:
        return spec.compile(), stated
    except (ValueError, mujoco.FatalError) as error:
        words = ' '.join(str(error).split())
        if 'mass and inertia of moving bodies' in words:
            words += '; give the link an <inertial>, or make its joint fixed (--fixed NAME)'
        raise ConfigError(f'{source.path}: {words}') from None


def _rigid(body: Any) -> list[Any]:
    """Return a body and all that is fixed to it."""
    found = [body]
    for child in body.bodies:
        if not any(True for _ in child.joints):
            found += _rigid(child)
    return found


def _place_of(thruster: Any, skeleton: Skeleton, axes: dict[str, Array]) -> ThrusterPlace | None:
    """Return a thruster in base axes; None with a question where its direction is not known."""
    model, name = skeleton.model, thruster.name or thruster.link
    values = thruster.model_dump(exclude={'link', 'name', 'position', 'direction'})
    values['spin'] = thruster.spin or 'none'
    if thruster.link is None:
        return ThrusterPlace(
            name=name, position=thruster.position, direction=thruster.direction, **values
        )
    direction = thruster.direction
    if direction is None:
        if thruster.link not in axes:
            skeleton.questions.append(
                f"thruster '{name}': direction of positive thrust in the axes of its link, whose "
                'joint has no axis (direction: [x, y, z])'
            )
            return None
        direction = axes[thruster.link].tolist()
    if not any(direction):
        raise ConfigError(f"thruster '{name}': direction: is 0 0 0")
    site = model.site(thruster.link)
    if int(site.bodyid[0]) != skeleton.base_id:
        raise ConfigError(
            f"thruster '{name}': its link moves against the base, which is not modelled; make "
            'the joints between them fixed (--fixed NAME)'
        )
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, site.quat)
    along = turn.reshape(3, 3) @ np.array(direction)
    return ThrusterPlace(name=name, position=site.pos.tolist(), direction=along.tolist(), **values)
