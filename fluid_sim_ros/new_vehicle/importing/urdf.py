# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A URDF, with or without xacro: checked, its meshes found and made STL, read by MuJoCo."""

import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.hydro.meshes.reading import read_triangles
from fluid_sim_ros.new_vehicle.importing.mesh_paths import mesh_file
from fluid_sim_ros.new_vehicle.importing.source import Source, fit_for_topics, stl_bytes

#: Elements of other programs, which are left out.
_OF_OTHERS = ('transmission', 'gazebo', 'ros2_control', 'sensor')


def read_urdf(
    path: Path, root: ElementTree.Element, packages: list[Path], unit: str | None
) -> Source:
    """
    Return a URDF as MuJoCo reads it: links, joints, geometry, mass and inertia as they stand.

    Parameters
    ----------
    path
        Of the file.
    root
        Its element ``robot``.
    packages
        Given with ``--package-path``.
    unit
        Of the mesh files' numbers; None: metres.

    Returns
    -------
    Source
        With every mesh as STL.

    Raises
    ------
    ConfigError
        If a mass or an inertia is impossible, a mesh is missing, or MuJoCo refuses the file.

    """
    _check_inertials(path, root)
    said = _left_out(root)
    assets: dict[str, bytes] = {}
    known: dict[Path, str] = {}
    for mesh in root.iter('mesh'):
        place = mesh_file(mesh.get('filename', ''), path, packages)
        if place not in known:
            known[place] = f'{len(known)}_{fit_for_topics(place.stem)}.stl'
            assets[known[place]] = stl_bytes(read_triangles(place, unit))
        mesh.set('filename', known[place])
    if known:
        said.append(
            f'{len(known)} mesh {"file" if len(known) == 1 else "files"} taken in '
            f'{unit or "metres"}, made STL: {listed(place.name for place in known)}'
        )
    for child in root.findall('mujoco'):
        root.remove(child)
    settings = ElementTree.SubElement(root, 'mujoco')
    ElementTree.SubElement(
        settings, 'compiler', discardvisual='false', strippath='false', balanceinertia='false',
    )  # fmt: skip
    try:
        spec = mujoco.MjSpec.from_string(ElementTree.tostring(root, encoding='unicode'))
    except (ValueError, mujoco.FatalError) as error:
        raise ConfigError(f'{path}: MuJoCo does not read it: {error}') from None
    spec.assets = assets
    # what a file says is taken; a link without inertial has no mass
    spec.compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE
    tops = [body.name for body in spec.bodies if body.parent == spec.worldbody]
    if len(tops) != 1:
        raise ConfigError(f'{path}: must have one root link; it has: {listed(tops)}')
    name = fit_for_topics(root.get('name') or path.name.split('.')[0])
    return Source(path, name, spec, tops[0], assets, said=said)


def _check_inertials(path: Path, root: ElementTree.Element) -> None:
    for link in root.findall('link'):
        inertial = link.find('inertial')
        if inertial is None:
            continue
        where = f"{path}: link '{link.get('name')}'"
        mass = _number(where, inertial, 'mass', 'value')
        entries = {
            key: _number(where, inertial, 'inertia', key)
            for key in ('ixx', 'iyy', 'izz', 'ixy', 'ixz', 'iyz')
        }
        if mass == 0 and not any(entries.values()):
            link.remove(inertial)  # a frame
            continue
        if mass <= 0:
            raise ConfigError(f'{where}: mass {mass:g}: must be above 0 [kg]')
        tensor = np.array(
            [
                [entries['ixx'], entries['ixy'], entries['ixz']],
                [entries['ixy'], entries['iyy'], entries['iyz']],
                [entries['ixz'], entries['iyz'], entries['izz']],
            ]
        )
        low, middle, high = np.linalg.eigvalsh(tensor)
        if low <= 0:
            raise ConfigError(
                f'{where}: principal moments of inertia {low:.4g} {middle:.4g} {high:.4g}: must '
                'be above 0 [kg m^2]; a box of mass m has m/12 (b^2 + c^2)'
            )
        if low + middle < high:
            raise ConfigError(
                f'{where}: no body has the principal moments of inertia {low:.4g} {middle:.4g} '
                f'{high:.4g} [kg m^2]: the two smaller ones together must be at least the '
                'largest; check the axes, the units and the signs of ixy, ixz, iyz'
            )


def _number(where: str, inertial: ElementTree.Element, tag: str, key: str) -> float:
    element = inertial.find(tag)
    text = '0' if element is None else element.get(key, '0')
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ConfigError(f'{where}: {tag} {key}: must be a finite number (got {text!r})')
    return value


def _left_out(root: ElementTree.Element) -> list[str]:
    """Take out what other programs read; return what to say of it."""
    said = []
    for tag in _OF_OTHERS:
        found = root.findall(tag)
        for element in found:
            root.remove(element)
        if found:
            said.append(f'{len(found)} <{tag}> left out: of other programs')
    mimics = [joint for joint in root.findall('joint') if joint.find('mimic') is not None]
    for joint in mimics:
        joint.remove(joint.find('mimic'))  # type: ignore[arg-type]
    if mimics:
        said.append(f'<mimic> of {listed(str(j.get("name")) for j in mimics)} left out')
    return said
