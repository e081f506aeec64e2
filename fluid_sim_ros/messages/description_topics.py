# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The robot description of every vehicle: its URDF, latched, as RViz and Foxglove expect it."""

from collections.abc import Mapping
from functools import cache

from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.messages.topic import LATCHED, StateTopic
from fluid_sim_ros.messages.transform_topics import sensor_frames
from fluid_sim_ros.scene.robot.urdf import RobotDescription, robot_description
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.simulation import Simulation

ROBOT_DESCRIPTION = 'robot_description'
_STRING = 'std_msgs/msg/String'


def descriptions(
    simulation: Simulation, suites: Mapping[str, SensorSuite]
) -> dict[str, RobotDescription]:
    """
    Return the URDF of every vehicle.

    Parameters
    ----------
    simulation
        Whose vehicles.
    suites
        The sensors of each vehicle; their frames are links, too.

    Returns
    -------
    dict
        Vehicle name -> its URDF.

    """
    read_spec = cache(simulation.scene.read_model)
    return {
        name: robot_description(
            simulation.model, read_spec, vehicle, sensor_frames(vehicle, suites[name])
        )
        for name, vehicle in simulation.vehicles.items()
    }


def description_topic(vehicle: str, description: RobotDescription, period: int) -> StateTopic:
    """
    Return the topic ``<v>/robot_description``.

    Parameters
    ----------
    vehicle
        Its name.
    description
        Its URDF.
    period
        Ticks between two messages for whoever does not send it once alone.

    Returns
    -------
    StateTopic
        Latched.

    """
    template = Template.of(_STRING, {'data': description.urdf})
    name = f'{vehicle}/{ROBOT_DESCRIPTION}'
    return StateTopic(name, _STRING, template, period, [], quality=LATCHED, once=True)
