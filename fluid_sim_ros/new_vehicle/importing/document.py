# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The MJCF of an imported vehicle: what MuJoCo read, with fluid, thrusters and a place to be."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.new_vehicle.importing.actuators import add_actuators, rest_of, site_of
from fluid_sim_ros.new_vehicle.importing.mass import BaseMass
from fluid_sim_ros.new_vehicle.importing.skeleton import Skeleton
from fluid_sim_ros.new_vehicle.layout import Medium, Thruster
from fluid_sim_ros.new_vehicle.thruster_keys import instance_keys
from fluid_sim_ros.physics.arrays import Array

#: Folder of the files that the model names, beside it.
ASSETS = 'assets'
_VISCOSITY = {'air': 1.79e-5, 'water': 9e-4}
_SCENERY = """<mujoco>
  <visual>
    <headlight ambient=".45 .45 .45" diffuse=".55 .55 .55"/>
    <global offwidth="1280" offheight="960"/>
    <map znear=".01"/>
  </visual>
  <statistic extent="{extent}"/>
  <asset>
    <texture type="skybox" builtin="gradient" rgb1="{sky}" width="256" height="1536"/>
    <texture name="{floor}" type="2d" builtin="checker" rgb1=".45 .45 .4" rgb2=".38 .4 .36"
             width="512" height="512"/>
    <material name="{floor}" texture="{floor}" texuniform="true" texrepeat="1 1"/>
  </asset>
  <worldbody>
    <light pos="0 0 10" dir="0 .2 -1" diffuse=".6 .6 .6"/>
    <geom name="{floor}" type="plane" size="100 100 1" pos="0 0 {depth}" material="{floor}"/>
  </worldbody>
</mujoco>"""
_SKY = {
    'air': '.72 .82 .92" rgb2=".35 .5 .7',
    'water': '.12 .42 .52" rgb2=".02 .07 .12',
}


@dataclass(frozen=True)
class Contents:
    """
    What the model is made of.

    Attributes
    ----------
    skeleton
        The vehicle as read.
    medium
        ``air`` or ``water``.
    density
        Of the fluid [kg/m^3].
    mass
        Of the base.
    thrusters
        Positions from the centre of mass of the whole [m].
    hover
        Thrusts at rest [N], one each.
    fluid_keys
        Of ``fluid_sim.body``, and the comment beside them.
    axes, center
        Semi-axes and centre of the displaced volume in base axes [m]; None in air.
    size
        Largest extent [m].

    """

    skeleton: Skeleton
    medium: Medium
    density: float
    mass: BaseMass
    thrusters: list[Thruster]
    hover: Array
    fluid_keys: dict[str, str]
    axes: Array | None
    center: Array | None
    size: float


def document_of(contents: Contents) -> str:
    """
    Return the model as MJCF.

    Parameters
    ----------
    contents
        What it is made of.

    Returns
    -------
    str
        Opens in MuJoCo with the plugin library loaded.

    """
    skeleton, water = contents.skeleton, contents.medium == 'water'
    root = ElementTree.fromstring(skeleton.xml)
    root.set('model', skeleton.source.name)
    option = _child(root, 'option', 1)
    option.set('timestep', '0.002')
    option.set('integrator', 'implicitfast')
    for key in ('density', 'viscosity', 'wind'):
        option.attrib.pop(key, None)
    option.attrib.pop('collision', None)
    compiler = _child(root, 'compiler', 0)
    for key in ('meshdir', 'texturedir'):
        compiler.set(key, ASSETS)
    _add_scenery(root, contents)
    _add_extension(root, contents)
    body = next(b for b in root.iter('body') if b.get('name') == skeleton.source.base)
    body.set('pos', f'0 0 {_n(start_height(contents))}')
    for key in ('quat', 'euler', 'axisangle', 'xyaxes', 'zaxis'):
        body.attrib.pop(key, None)
    body.set('simple', 'false')
    _set_inertial(body, contents.mass)
    _add_fluid(body, contents)
    for thruster in contents.thrusters:
        _sub(body, 'site', name=site_of(thruster.name), zaxis=_n(thruster.direction),
             pos=_n(thruster.position + contents.mass.total_center))  # fmt: skip
    if not any(site.get('name') == 'imu' for site in root.iter('site')):
        _sub(body, 'site', name='imu', pos=_n(contents.mass.total_center))
    add_actuators(root, contents.skeleton, contents.thrusters, contents.hover)
    _add_start(root, contents)
    ElementTree.indent(root, '  ')
    text = ElementTree.tostring(root, encoding='unicode')
    words = (
        f'{skeleton.source.name}, imported from {skeleton.source.path.name} by fluid_sim import; '
        f'{"under water" if water else "in air"}. Its report says where each number is from.'
    )
    head, _, rest = text.partition('\n')
    return f'{head}\n  <!-- {re.sub("-{2,}", "-", words)} -->\n{rest}\n'


def start_height(contents: Contents) -> float:
    """
    Return the height at which the vehicle starts [m], clear of ground and surface.

    Parameters
    ----------
    contents
        Of the model.

    """
    clear = round(1.0 + 2.0 * contents.size, 3)
    return -clear if contents.medium == 'water' else clear


def _add_scenery(root: ElementTree.Element, contents: Contents) -> None:
    start = start_height(contents)
    names = {element.get('name') for element in root.iter()}
    floor = next(name for name in ('floor', 'ground_of_scene') if name not in names)
    has_floor = any(geom.get('type') == 'plane' for geom in root.iter('geom'))
    scenery = ElementTree.fromstring(_SCENERY.format(
        extent=_n(3 * contents.size), sky=_SKY[contents.medium], floor=floor,
        depth=_n(3 * start if contents.medium == 'water' else 0),
    ))  # fmt: skip
    world = _child(root, 'worldbody', len(root))
    for section in scenery:
        if section.tag == 'worldbody':
            if not has_floor:
                for k, element in enumerate(section):
                    world.insert(k, element)
            continue
        own = root.find(section.tag)
        if own is None:
            root.insert(list(root).index(world), section)
        elif section.tag == 'asset':
            own.extend(section)


def _add_extension(root: ElementTree.Element, contents: Contents) -> None:
    extension = _child(root, 'extension', 2)
    if not any(plugin.get('plugin') == 'fluid_sim.body' for plugin in extension):
        _sub(extension, 'plugin', plugin='fluid_sim.body')
    medium = _sub(_sub(extension, 'plugin', plugin='fluid_sim.medium'), 'instance', name='fluid')
    keys = {'density': _n(contents.density), 'viscosity': _n(_VISCOSITY[contents.medium])}
    if contents.medium == 'water':  # air above it, 20 degC (ISO 2533, Sutherland)
        keys |= {'surface': '0', 'density_above': '1.204', 'viscosity_above': '1.81e-5'}
    _configure(medium, keys)
    plugin = _sub(extension, 'plugin', plugin='fluid_sim.thruster')
    for thruster in contents.thrusters:
        _configure(
            _sub(plugin, 'instance', name=thruster.name),
            instance_keys(thruster, water=contents.medium == 'water'),
        )
    if contents.skeleton.fins:
        plugin = _sub(extension, 'plugin', plugin='fluid_sim.foil')
        for fin, site, _ in contents.skeleton.fins:
            _configure(
                _sub(plugin, 'instance', name=site),
                {'site': site, 'span': _n(fin.span), 'chord': _n(fin.chord)},
            )


def _set_inertial(body: ElementTree.Element, mass: BaseMass) -> None:
    for old in body.findall('inertial'):
        body.remove(old)
    full = mass.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    inertial = ElementTree.Element(
        'inertial', pos=_n(mass.center), mass=_n(mass.mass), fullinertia=_n(full)
    )
    body.insert(0, inertial)


def _add_fluid(body: ElementTree.Element, contents: Contents) -> None:
    plugin = ElementTree.Element('plugin', plugin='fluid_sim.body')
    keys = dict(contents.fluid_keys)
    if contents.axes is not None and contents.center is not None:
        keys['geoms'] = 'displaced_water'
        _sub(body, 'geom', name='displaced_water', type='ellipsoid', size=_n(contents.axes, 6),
             pos=_n(contents.center), fluidshape='ellipsoid', mass='0', group='4', contype='0',
             conaffinity='0', rgba='.2 .4 .9 .25')  # fmt: skip
    _configure(plugin, keys)
    body.insert(1, plugin)


def _add_start(root: ElementTree.Element, contents: Contents) -> None:
    skeleton = contents.skeleton
    for old in root.findall('keyframe'):
        root.remove(old)
    own = skeleton.model
    control, state = rest_of(skeleton, contents.thrusters, contents.hover)
    joints = [0.0] * (own.nq - 7)
    pose = [0, 0, start_height(contents), 1, 0, 0, 0]
    key = _sub(_sub(root, 'keyframe'), 'key', name='start', qpos=_n([*pose, *joints]))
    if control:
        key.set('ctrl', _n(control))
    if state:
        key.set('act', _n(state))


def _child(root: ElementTree.Element, tag: str, place: int) -> ElementTree.Element:
    found = root.find(tag)
    if found is None:
        found = ElementTree.Element(tag)
        root.insert(place, found)
    return found


def _sub(parent: ElementTree.Element, tag: str, **attributes: str) -> ElementTree.Element:
    return ElementTree.SubElement(parent, tag, attributes)


def _configure(element: ElementTree.Element, keys: dict[str, str]) -> None:
    for key, value in keys.items():
        _sub(element, 'config', key=key, value=value)


def _n(values: ArrayLike, digits: int = 12) -> str:
    return ' '.join(f'{value + 0.0:.{digits}g}' for value in np.atleast_1d(values))
