# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The MJCF of a new vehicle, with a comment at each number that was guessed."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.new_vehicle.design import (
    DRAG_COEFFICIENT,
    LINEAR_BELOW,
    RIGHTING_SHARE,
    Design,
)
from fluid_sim_ros.new_vehicle.layout import DENSITY, Thruster
from fluid_sim_ros.new_vehicle.thruster_keys import instance_keys

_HEAD = """<mujoco model="{name}">
  <!-- {name}, {mass} kg, {size} m, made by fluid_sim new-vehicle. A number with "guess" beside it
       follows from mass and size alone: replace it by what you measured (doc/new_vehicle.md of
       fluid_sim_ros).

       Fluid model: {fluid_model}
       Integrator: implicitfast, bounded at any timestep in the damping of a free body; 2 ms
       divides every usual control rate. -->
  <compiler autolimits="true"/>
  <option timestep="0.002" integrator="implicitfast"{option}

  <extension>
"""
_FLUID_MODEL = {
    'air': """inertia box of MuJoCo, here the box of the vehicle: C_d A is the area of each face
       (C_d 1). Thrust by the square of the rotor speed, with lag and reaction torque.""",
    'water': """Fossen's (2021), by fluid_sim.body: added mass, damping, buoyancy, free surface at
       z = 0. Thrust by the square of the propeller speed, with lag, little out of the water.""",
}
_OPTION = {
    'air': f"""
          density="{DENSITY['air']}" viscosity="1.79e-5"/>
  <!-- [kg/m^3], [Pa s]: air at sea level, 15 degC (ISA) -->""",
    'water': '/>',
}
_WATER = f"""    <plugin plugin="fluid_sim.body"/>
    <plugin plugin="fluid_sim.medium">
      <instance name="water">
        <config key="surface" value="0"/>               <!-- [m] world z -->
        <config key="density" value="{DENSITY['water']:g}"/>  <!-- [kg/m^3] fresh water -->
        <config key="viscosity" value="9e-4"/>          <!-- [Pa s] (IAPWS, 25 degC: 8.9e-4) -->
        <config key="density_above" value="1.204"/>     <!-- [kg/m^3] air, 20 degC (ISO 2533) -->
        <config key="viscosity_above" value="1.81e-5"/> <!-- [Pa s] air, 20 degC (Sutherland) -->
      </instance>
    </plugin>
"""
_SCENERY = """  </extension>

  <visual>
    <headlight ambient=".45 .45 .45" diffuse=".55 .55 .55"/>
    <global offwidth="1280" offheight="960"/>
    <map znear=".01"/>
  </visual>
  <statistic extent="{extent}"/>

  <asset>
    <texture type="skybox" builtin="gradient" rgb1="{sky}" width="256" height="1536"/>
    <texture name="floor" type="2d" builtin="checker" rgb1=".45 .45 .4" rgb2=".38 .4 .36"
             width="512" height="512"/>
    <material name="floor" texture="floor" texuniform="true" texrepeat="1 1"/>
  </asset>

  <default>
    <geom contype="0" conaffinity="0" group="2"/>
    <!-- thrust [N] along z of the site; reaction torque about it -->
    <default class="thrust">
      <general gear="0 0 1 0 0 0"/>
    </default>
    <default class="reaction">
      <general gear="0 0 0 0 0 1"/>
    </default>
  </default>

  <worldbody>
    <light pos="0 0 10" dir="0 .2 -1" diffuse=".6 .6 .6"/>
    <geom name="floor" type="plane" size="100 100 1" pos="0 0 {floor}" material="floor"
          contype="1" conaffinity="1" group="0"/>

    <body name="{name}" pos="0 0 {start}" simple="false">
      <freejoint name="{name}"/>
      <camera name="track" mode="trackcom" pos="{camera}" xyaxes=".71 .71 0 -.3 .3 .9"/>
      <!-- origin: centre of mass; guess: moments of inertia of an even box{box} -->
      <inertial pos="{balance} 0 0" mass="{hull_mass}" diaginertia="{inertia}"/>
"""
_BODY = """      <plugin plugin="fluid_sim.body">
        <!-- guess: of the ellipsoid displaced_water, exact for that (Lamb 1932);
             or 6 numbers [kg] x 3, [kg m^2] x 3 -->
        <config key="added_mass" value="auto"/>
        <!-- guess: rho/2 C_d A of the box with C_d {cd}: [N s^2/m^2] x 3, [N m s^2] x 3 -->
        <config key="quadratic_damping" value="{quadratic}"/>
        <!-- guess: as large as the quadratic one at {below} m/s and rad/s:
             [N s/m] x 3, [N m s] x 3 -->
        <config key="linear_damping" value="{linear}"/>
        <!-- [m^3]: mass over density, {buoyancy} N of buoyancy left over -->
        <config key="volume" value="{volume}"/>
        <!-- guess: [m] above the centre of mass, {share} of the height: it rights itself -->
        <config key="center_of_buoyancy" value="0 0 {righting}"/>
        <config key="geoms" value="displaced_water"/>
        <config key="drag" value="none"/>  <!-- the damping above holds it -->
      </plugin>
      <!-- the displaced volume in the proportions of the box: what the surface cuts -->
      <geom name="displaced_water" type="ellipsoid" size="{axes}" pos="0 0 {righting}"
            fluidshape="ellipsoid" mass="0" group="4" rgba=".2 .4 .9 .25"/>
"""
_TAIL = """
      <!-- z is the direction of positive thrust -->
{sites}
      <site name="imu" pos="0 0 0"/>
{fins}    </body>
  </worldbody>

  <!-- ctrl = thrust at rest [N]{angles}{unread} -->
  <actuator>
{actuators}
  </actuator>

  <!-- {key_comment} -->
  <keyframe>
    <key name="{key}" qpos="0 0 {start} 1 0 0 0{joints}" ctrl="{ctrl}"{act}/>
  </keyframe>
</mujoco>
"""


def mjcf_of(design: Design) -> str:
    """
    Return the model of a design as MJCF.

    Parameters
    ----------
    design
        What to write.

    """
    water = design.medium == 'water'
    start, largest = start_height(design), float(design.size.max())
    head = _HEAD.format(
        name=design.name, mass=_n(design.mass), size=_n(design.size),
        fluid_model=_FLUID_MODEL[design.medium], option=_OPTION[design.medium],
    )  # fmt: skip
    scenery = _SCENERY.format(
        name=design.name, extent=_n(3 * largest), start=_n(start),
        sky='.12 .42 .52" rgb2=".02 .07 .12' if water else '.72 .82 .92" rgb2=".35 .5 .7',
        floor=_n(3 * start if water else 0), camera=_n(1.4 * largest * np.array([1, -1, 0.7])),
        hull_mass=_n(design.mass - (design.fins.weigh if design.fins else 0.0)),
        balance=_n(design.fins.balance if design.fins else 0.0), inertia=_n(design.inertia, 6),
        box='' if water else ',\n           from which the drag box follows too',
    )  # fmt: skip
    return ''.join([
        head, _WATER if water else '', _thrusters(design), scenery,
        _fluid(design) if water else '', _looks(design), _tail(design),
    ])  # fmt: skip


def start_height(design: Design) -> float:
    """
    Return the height at which the vehicle starts [m], clear of ground and surface.

    Parameters
    ----------
    design
        The vehicle.

    """
    clear = 1.0 + 2.0 * float(design.size.max())
    return -clear if design.medium == 'water' else clear


def _thrusters(design: Design) -> str:
    instances = '\n'.join(_instance(t, water=design.medium == 'water') for t in design.thrusters)
    return (
        '    <!-- guess where your list was silent: diameter [m], thrust coefficient '
        '[N/(rad/s)^2],\n         torque over thrust [m], lag [s] -->\n'
        f'    <plugin plugin="fluid_sim.thruster">\n{instances}\n    </plugin>\n'
        f'{design.fins.instance() if design.fins else ""}'
    )


def _instance(thruster: Thruster, *, water: bool) -> str:
    keys = instance_keys(thruster, water=water)
    lines = ''.join(
        f'        <config key="{key}" value="{value}"/>\n' for key, value in keys.items()
    )
    return f'      <instance name="{thruster.name}">\n{lines}      </instance>'


def _fluid(design: Design) -> str:
    quadratic = design.quadratic_damping
    return _BODY.format(
        cd=DRAG_COEFFICIENT, quadratic=_n(quadratic, 4), below=LINEAR_BELOW,
        linear=_n(LINEAR_BELOW * quadratic, 4), buoyancy=_n(design.buoyancy),
        volume=_n(design.volume), share=RIGHTING_SHARE,
        righting=_n(RIGHTING_SHARE * design.size[2]), axes=_n(design.semi_axes, 6),
    )  # fmt: skip


def _looks(design: Design) -> str:
    """Return what collides, the box, and what is seen: hull, nose, arms and discs."""
    half, thin = design.size / 2, 0.04 * float(design.size.max())
    lines = [
        f'      <geom name="hull" type="box" size="{_n(half)}" mass="0" group="3"'
        '\n            rgba=".2 .6 .2 .3" contype="1" conaffinity="1"/>',
        '',
        '      <!-- looks; orange: ahead -->',
        f'      <geom type="ellipsoid" size="{_n(half * [0.7, 0.7, 0.8], 4)}"'
        ' rgba=".2 .35 .7 1"/>',
        f'      <geom type="sphere" size="{_n(1.5 * thin, 4)}" pos="{_n(0.6 * half[0], 4)} 0 0"'
        ' rgba=".95 .5 .1 1"/>',
    ]
    for thruster in design.thrusters:
        position, radius = thruster.position, thruster.diameter / 2
        if np.linalg.norm(position) > thin:
            lines.append(
                f'      <geom type="capsule" size="{_n(0.4 * thin, 4)}"'
                f' fromto="0 0 0 {_n(position, 4)}" rgba=".15 .15 .17 1"/>'
            )
        depth = 0.3 * radius if design.medium == 'water' else 0.03 * radius
        lines.append(
            f'      <geom type="cylinder" size="{_n([radius, depth], 4)}" pos="{_n(position, 4)}"'
            f' zaxis="{_n(thruster.direction, 4)}"\n            rgba=".3 .5 .9 .5"/>'
        )
    return '\n'.join(lines) + '\n'


def _tail(design: Design) -> str:
    thrusters, water = design.thrusters, design.medium == 'water'
    turning = [thruster for thruster in thrusters if thruster.spin]
    fins = design.fins
    servos = fins.servos() if fins else []
    control = [*design.hover, *[0.0] * (len(turning) + len(servos))]
    speeds = [
        x
        for thruster, thrust in zip(thrusters, design.hover, strict=True)
        if any(thruster.lag)
        for x in (thruster.speed(thrust), 0.0)
    ] + [0.0] * len(servos)
    return _TAIL.format(
        sites='\n'.join(
            f'      <site name="{t.name}" pos="{_n(t.position)}" zaxis="{_n(t.direction)}"/>'
            for t in thrusters
        ),
        actuators='\n'.join([*map(_thrust, thrusters), *map(_reaction, turning), *servos]),
        angles=', deflections [rad]' if fins else '',
        unread='; that of the reaction torques is not read' if turning else '',
        key='start' if water else 'hover', joints=' 0' * len(servos),
        fins=fins.bodies() if fins else '',
        key_comment=(
            'under water, at rest' if water
            else 'thrusts that carry the weight level (act: rotor speed [rad/s], clock)'
        ),
        start=_n(start_height(design)), ctrl=_n(control),
        act=f' act="{_n(speeds)}"' if speeds else '',
    )  # fmt: skip


def _thrust(thruster: Thruster) -> str:
    lag = ' actdim="2"' if any(thruster.lag) else ''
    return (
        f'    <plugin name="{thruster.name}" class="thrust" plugin="fluid_sim.thruster"'
        f' instance="{thruster.name}" site="{thruster.name}"\n'
        f'            ctrlrange="{_n(thruster.limits)}"{lag}/>'
    )


def _reaction(thruster: Thruster) -> str:
    return (
        f'    <plugin name="{thruster.name}_torque" class="reaction" plugin="fluid_sim.thruster"'
        f' instance="{thruster.name}"\n            site="{thruster.name}"/>'
    )


def _n(values: ArrayLike, digits: int = 12) -> str:
    """Return numbers as MJCF has them."""
    return ' '.join(f'{value + 0.0:.{digits}g}' for value in np.atleast_1d(values))
