# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Actuators of an imported vehicle: thrusters with their reaction torques, and servos."""

import xml.etree.ElementTree as ElementTree

import numpy as np

from fluid_sim_ros.new_vehicle.importing.skeleton import Skeleton
from fluid_sim_ros.new_vehicle.layout import Thruster
from fluid_sim_ros.physics.arrays import Array


def site_of(thruster: str) -> str:
    """
    Return the name of a thruster's site.

    Parameters
    ----------
    thruster
        Its name.

    Returns
    -------
    str
        Beside the site of the link, which may have the thruster's name.

    """
    return f'{thruster}_thrust'


def add_actuators(
    root: ElementTree.Element, skeleton: Skeleton, thrusters: list[Thruster], hover: Array
) -> None:
    """
    Add thrusters, then their torques, then servos, after the actuators that the file has.

    Parameters
    ----------
    root
        The model.
    skeleton
        The vehicle.
    thrusters
        Its thrusters.
    hover
        Thrusts at rest [N], one each.

    """
    actuator = root.find('actuator')
    if actuator is None:
        actuator = ElementTree.SubElement(root, 'actuator')
    for thruster in thrusters:
        values = {
            'name': thruster.name, 'plugin': 'fluid_sim.thruster', 'instance': thruster.name,
            'site': site_of(thruster.name), 'gear': '0 0 1 0 0 0',
            'ctrlrange': ' '.join(f'{x + 0.0:.12g}' for x in thruster.limits),
        }  # fmt: skip
        if any(thruster.lag):
            values['actdim'] = '2'
        ElementTree.SubElement(actuator, 'plugin', values)
    for thruster in thrusters:
        if thruster.spin:
            ElementTree.SubElement(actuator, 'plugin', {
                'name': f'{thruster.name}_torque', 'plugin': 'fluid_sim.thruster',
                'instance': thruster.name, 'site': site_of(thruster.name),
                'gear': '0 0 0 0 0 1',
            })  # fmt: skip
    for joint, servo in skeleton.servos.items():
        values = {
            'name': joint, 'joint': joint, 'kp': f'{servo.stiffness:g}', 'dampratio': '1',
        }  # fmt: skip
        if servo.lag:
            values['timeconst'] = f'{servo.lag:g}'
        if skeleton.model.joint(joint).limited[0]:
            values['inheritrange'] = '1'
        ElementTree.SubElement(actuator, 'position', values)


def rest_of(
    skeleton: Skeleton, thrusters: list[Thruster], hover: Array
) -> tuple[list[float], list[float]]:
    """
    Return controls and activations at rest, in the order of `add_actuators`.

    Parameters
    ----------
    skeleton
        The vehicle.
    thrusters
        Its thrusters.
    hover
        Thrusts at rest [N], one each.

    Returns
    -------
    control, state
        One per actuator; two per thruster with a lag, speed [rad/s] and clock, one per servo.

    """
    turning = sum(bool(thruster.spin) for thruster in thrusters)
    model, servos = skeleton.model, skeleton.servos
    control = [*[0.0] * model.nu, *np.asarray(hover).tolist(), *[0.0] * (turning + len(servos))]
    state = [0.0] * model.na
    for thruster, thrust in zip(thrusters, hover, strict=True):
        if any(thruster.lag):
            state += [thruster.speed(float(thrust)), 0.0]
    return control, state + [0.0] * sum(servo.lag > 0 for servo in servos.values())
