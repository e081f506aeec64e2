# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A small URDF to import, what comes of it, what is asked and what is refused."""

import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.new_vehicle.importing.answers import answers_of
from fluid_sim_ros.new_vehicle.importing.questions import UndecidedError
from fluid_sim_ros.new_vehicle.importing.vehicle import import_vehicle

INERTIAL = (
    '<inertial><origin xyz="0 0 -0.02"/><mass value="{mass}"/><inertia ixx="{ixx}" ixy="0" '
    'ixz="0" iyy="0.3" iyz="0" izz="0.4"/></inertial>'
)
BOX = '<geometry><box size="0.5 0.3 0.2"/></geometry>'
ROV = """<robot name="my-rov">
  <link name="base">{inertial}<collision>{geometry}</collision></link>
  <link name="screw"/>
  <joint name="shaft" type="continuous"><parent link="base"/><child link="screw"/>
    <origin xyz="-0.3 0 0" rpy="0 0 3.14159265358979"/><axis xyz="-1 0 0"/></joint>
  {more}
</robot>"""
SCREW = {'link': 'screw', 'max_thrust': 20}


def rov(folder, mass=30, ixx=0.2, geometry=BOX, more='', inertial=INERTIAL, name='rov.urdf'):
    path = folder / name
    inertial = inertial.format(mass=mass, ixx=ixx)
    path.write_text(ROV.format(inertial=inertial, geometry=geometry, more=more))
    return path


def vehicle(path, packages=(), **options):
    options = {'medium': 'water', 'thrusters': [SCREW], 'panels': 40, **options}
    return import_vehicle(path, answers_of(None, options), list(packages), lambda line: None)


def questions(path, **options):
    with pytest.raises(UndecidedError) as error:
        vehicle(path, **options)
    return error.value.questions


def refusal(path, packages=(), **options):
    with pytest.raises(ConfigError) as error:
        vehicle(path, packages, **options)
    assert not isinstance(error.value, UndecidedError)
    assert '\n' not in str(error.value)
    return str(error.value)
