# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Autopilot mappings of a new vehicle whose layout is a frame that PX4 or ArduPilot knows."""

import math
from typing import Any

import yaml

from fluid_sim_ros.new_vehicle.design import Design
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.schema.yaml_file import read_yaml

#: Preset -> the shipped mappings of a vehicle with the same frame and the same names of thrusters.
_FRAMES = {
    'quad': ('px4_x500', 'ardupilot_x500'),
    'vectored6': ('ardupilot_bluerov2',),
    'vectored8': ('px4_bluerov2_heavy', 'ardupilot_bluerov2_heavy'),
}
#: What belongs to the shipped vehicle alone: its battery, and sensors that a new one may lack.
_OF_THE_OTHER = ('battery',)
_PARAMETERS_OF_THE_OTHER = ('BATT_MONITOR', 'RNGFND1_TYPE', 'RNGFND1_ORIENT')
#: MOT_THST_EXPO of ArduPilot's defaults: share of the square in its curve of thrust.
_EXPO = 0.65


def mappings_of(design: Design) -> dict[str, str]:
    """
    Return the autopilot mappings of a design, by file name.

    Parameters
    ----------
    design
        Of a preset, or without a known frame.

    Returns
    -------
    dict
        Text of ``NAME_PROTOCOL.yaml``; nothing where the layout is no frame that they know.

    """
    texts = {}
    for frame in _FRAMES.get(design.layout, ()):
        content: dict[str, Any] = read_yaml(config_folder() / 'autopilots' / f'{frame}.yaml')
        for key in _OF_THE_OTHER:
            content.pop(key, None)
        parameters: dict[str, Any] = content.get('parameters', {})
        for key in _PARAMETERS_OF_THE_OTHER:
            parameters.pop(key, None)
        if design.medium == 'air':
            parameters |= _hover(content['protocol'], design)
        texts[f'{design.name}_{content["protocol"]}.yaml'] = (
            f'# made by fluid_sim new-vehicle after the shipped mapping {frame}: the same frame;\n'
            f'# fluid_sim run {design.name}.yaml --autopilot {content["protocol"]} '
            f'--mapping {design.name}_{content["protocol"]}.yaml\n'
            + yaml.safe_dump(content, sort_keys=False, default_flow_style=None, width=100)
        )
    return texts


def _hover(protocol: str, design: Design) -> dict[str, Any]:
    """Return the parameter that tells the throttle of hover."""
    share = max(
        thrust / thruster.limits[1]
        for thrust, thruster in zip(design.hover, design.thrusters, strict=True)
    )
    speed = math.sqrt(share)
    reason = f'full thrust is {1 / share:.2f} times the weight'
    if protocol == 'px4':
        return {'MPC_THR_HOVER': {'value': round(speed, 2), 'reason': reason}}
    # its curve of thrust (AP_Motors_Thrust_Linearization) makes the speed from this throttle
    throttle = (1 - _EXPO) * speed + _EXPO * speed**2
    return {'MOT_THST_HOVER': {'value': round(throttle, 2), 'reason': reason}}
