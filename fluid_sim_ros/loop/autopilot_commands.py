# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What an autopilot commands: logged as messages, then applied."""

import struct
from collections.abc import Sequence

from fluid_sim_ros.loop.autopilot_port import Surroundings
from fluid_sim_ros.messages.commands import JOINT_STATE, MULTI_ARRAY
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.simulation import Simulation


class VehicleCommands:
    """
    Commands of one vehicle by an autopilot: logged as messages, then applied.

    Parameters
    ----------
    simulation
        What is commanded.
    vehicle
        Name of the vehicle.
    surroundings
        Holds the log.

    Attributes
    ----------
    saturated
        How many values were beyond their limits so far.

    """

    def __init__(self, simulation: Simulation, vehicle: str, surroundings: Surroundings) -> None:
        target = simulation.vehicle(vehicle)
        self._simulation = simulation
        self._vehicle = vehicle
        self._surroundings = surroundings
        thrusts, joints = [0.0] * len(target.thrusters), [0.0] * len(target.joints)
        self._thrust = Template.of(MULTI_ARRAY, {'data': thrusts}, ['data'])
        self._joints = Template.of(
            JOINT_STATE, {'name': target.joints, 'position': joints}, ['position']
        )
        self.saturated = 0

    def set(self, thrusts: Sequence[float], joints: Sequence[float]) -> None:
        """
        Command all thrusters and all joints.

        Parameters
        ----------
        thrusts
            [N], in the order of the vehicle's thrusters; empty: they keep their commands.
        joints
            In the unit of each actuator, in the order of the vehicle's joints; empty: as above.

        Raises
        ------
        CommandError
            For a wrong length, or a value that is not finite.

        """
        simulation, name = self._simulation, self._vehicle
        self.log(thrusts, joints)
        if thrusts:
            self.saturated += simulation.set_thrust(name, thrusts)
        if joints:
            self.saturated += simulation.set_joints(name, joints)

    def log(self, thrusts: Sequence[float], joints: Sequence[float]) -> None:
        """
        Log commands of all thrusters and all joints that take effect at this boundary.

        Parameters
        ----------
        thrusts, joints
            See ``set``.

        """
        name, log = self._vehicle, self._surroundings.log
        if log is None:
            return
        if thrusts:
            struct.pack_into(f'<{len(thrusts)}d', self._thrust.blocks[0], 0, *thrusts)
            log.command(f'{name}/cmd/thrust', self._thrust.bytes())
        if joints:
            struct.pack_into(f'<{len(joints)}d', self._joints.blocks[0], 0, *joints)
            log.command(f'{name}/cmd/joints', self._joints.bytes())
