# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a command message does to a simulation: its bytes in, ``Simulation.set_*`` called."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from fluid_sim_ros.errors import CommandError, ConfigError, listed
from fluid_sim_ros.messages.cdr import (
    read_float64_multi_array,
    read_joint_state,
    read_joy,
    read_stamped_pair,
)
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.thrust_matrix import WrenchAllocation

MULTI_ARRAY = 'std_msgs/msg/Float64MultiArray'
JOINT_STATE = 'sensor_msgs/msg/JointState'
WRENCH = 'geometry_msgs/msg/WrenchStamped'
TWIST = 'geometry_msgs/msg/TwistStamped'
JOY = 'sensor_msgs/msg/Joy'

#: What ``Commands`` looks at, as the node's parameters of the same names.
DEFAULTS = {'thrust.unit': 'newton', 'pacing': 'free', 'lockstep.match': 'stamp'}


@dataclass(frozen=True)
class Effect:
    """
    What became of a command.

    Attributes
    ----------
    answers
        It answers the present state (always true of commands that carry no stamp to match).
    applied
        It took effect; an answer to an earlier state does not.
    saturated
        How many values were beyond the range.
    shortfall
        What an allocated wrench lacks, in words, or ''.

    """

    answers: bool = True
    applied: bool = True
    saturated: int = 0
    shortfall: str = ''


@dataclass(frozen=True)
class CommandTopic:
    """One command topic: its relative name, message type and effect; ``thrust`` of a vehicle."""

    name: str
    type: str
    apply: Callable[[bytes], Effect]
    thrust: str = ''


class Commands:
    """
    The command topics of a scene.

    Parameters
    ----------
    simulation
        What is commanded.
    settings
        ``thrust.unit``, ``pacing`` and ``lockstep.match``, looked at with every command.

    Raises
    ------
    ConfigError
        If thrust shall be normalized and a thruster has no limit.

    """

    def __init__(self, simulation: Simulation, settings: Mapping[str, Any]) -> None:
        self._simulation = simulation
        self._settings = settings
        self.topics: list[CommandTopic] = []
        self._allocations: dict[str, WrenchAllocation] = {}
        for vehicle in simulation.vehicles.values():
            self._add_vehicle(vehicle)
        for stream in ('wind', 'current'):
            self._add(stream, TWIST, self._medium_of(stream))

    def _add_vehicle(self, vehicle: Vehicle) -> None:
        name = vehicle.name
        if vehicle.thrusters:
            scale = self._thrust_scale(vehicle)
            self._add(
                f'{name}/cmd/thrust', MULTI_ARRAY,
                lambda data: self._thrust(vehicle, read_float64_multi_array(data), scale), name,
            )  # fmt: skip
            self._add(
                f'{name}/cmd/thrust_stamped', JOINT_STATE,
                lambda data: self._thrust_stamped(vehicle, data, scale), name,
            )  # fmt: skip
            self._add(
                f'{name}/cmd/wrench_allocated', WRENCH,
                lambda data: self._wrench_allocated(vehicle, data), name,
            )  # fmt: skip
        if vehicle.dof_address >= 0:
            self._add(f'{name}/cmd/wrench', WRENCH, lambda data: self._wrench(vehicle, data))
        if vehicle.joints:
            self._add(f'{name}/cmd/joints', JOINT_STATE, lambda data: self._joints(vehicle, data))

    def _add(
        self, name: str, message: str, apply: Callable[[bytes], Effect], thrust: str = ''
    ) -> None:
        self.topics.append(CommandTopic(name, message, apply, thrust))

    # ---- one function per kind of command --------------------------------------------------

    def _thrust_scale(self, vehicle: Vehicle) -> Array | None:
        """Return the limits that a normalized command is a share of, or None for newton."""
        if self._settings['thrust.unit'] == 'newton':
            return None
        if not np.isfinite(vehicle.thrust_range).all():
            raise ConfigError(
                f"parameter 'thrust.unit': normalized needs a ctrlrange for every thruster of "
                f"'{vehicle.name}'"
            )
        return vehicle.thrust_range

    def _thrust(self, vehicle: Vehicle, values: Array, scale: Array | None) -> Effect:
        if scale is not None and len(values) == len(scale):
            values = np.where(values >= 0, values * scale[:, 1], -values * scale[:, 0])
        return Effect(saturated=self._simulation.set_thrust(vehicle.name, values))

    def _thrust_stamped(self, vehicle: Vehicle, data: bytes, scale: Array | None) -> Effect:
        command = read_joint_state(data)
        if not self._answers(command.stamp_ns):
            return Effect(answers=False, applied=False)
        values = command.effort
        if command.names:
            values = _by_name(vehicle, command.names, values)
        return self._thrust(vehicle, values, scale)

    def _answers(self, stamp_ns: int) -> bool:
        """Return whether a stamp is that of the present state; only lockstep by stamp asks."""
        settings, now_ns = self._settings, self._simulation.time_ns
        if settings['pacing'] != 'lockstep' or settings['lockstep.match'] != 'stamp':
            return True
        if stamp_ns > now_ns:
            raise CommandError(
                f'stamp {stamp_ns} ns is ahead of the simulation '
                f'({now_ns} ns); answer an odometry with its own stamp'
            )
        return stamp_ns == now_ns  # older: a second answer to a state that was answered

    def _joints(self, vehicle: Vehicle, data: bytes) -> Effect:
        command = read_joint_state(data)
        # a stamp of 0 means now, as for wind and current, and answers no state but the first
        answers = self._answers(command.stamp_ns)
        if command.stamp_ns and not answers:
            return Effect(answers=False, applied=False)
        values = command.position if len(command.position) else command.effort
        joints: dict[str, float] | list[float] = values.tolist()
        if command.names:
            if len(command.names) != len(values):
                raise CommandError(f'{len(command.names)} names, but {len(values)} values')
            joints = dict(zip(command.names, values.tolist(), strict=True))
        return Effect(answers, saturated=self._simulation.set_joints(vehicle.name, joints))

    def _wrench(self, vehicle: Vehicle, data: bytes) -> Effect:
        command = read_stamped_pair(data)
        frames = {f'{vehicle.name}/base_link': 'base_link', 'map': 'map'}
        if command.frame not in frames:
            raise CommandError(f"frame '{command.frame}' is not known; allowed: {listed(frames)}")
        self._simulation.set_wrench(
            vehicle.name, command.first, command.second, frames[command.frame]
        )
        return Effect()

    def _wrench_allocated(self, vehicle: Vehicle, data: bytes) -> Effect:
        command = read_stamped_pair(data)
        allowed = f'{vehicle.name}/base_link'
        if command.frame != allowed:
            raise CommandError(f"frame '{command.frame}' is not known; allowed: {allowed}")
        if vehicle.name not in self._allocations:
            self._allocations[vehicle.name] = WrenchAllocation(self._simulation.model, vehicle)
        allocation = self._allocations[vehicle.name]
        thrusts, shortfall = allocation.thrusts(command.first.tolist(), command.second.tolist())
        saturated = self._simulation.set_thrust(vehicle.name, thrusts)
        return Effect(saturated=saturated, shortfall=shortfall)

    def _medium_of(self, stream: str) -> Callable[[bytes], Effect]:
        def apply(data: bytes) -> Effect:
            command = read_stamped_pair(data)
            if command.frame not in ('', 'map'):
                raise CommandError(f"frame '{command.frame}' is not known; allowed: map")
            if not np.isfinite(command.first).all():
                raise CommandError(f'{command.first.tolist()} holds a value that is not finite')
            simulation = self._simulation
            if command.stamp_ns > simulation.time_ns:
                # by name: wind and current are fields of the event
                change = ScheduledEvent.model_validate({'at': 0, stream: command.first.tolist()})
                simulation.schedule(command.stamp_ns, change)
            elif stream == 'wind':
                simulation.set_wind(command.first)
            else:
                simulation.set_current(command.first)
            return Effect()

        return apply


def sticks_topic(
    vehicle: str, set_sticks: Callable[[list[float], list[float]], None]
) -> CommandTopic:
    """
    Return the topic of the sticks with which a person flies an autopilot's vehicle.

    Parameters
    ----------
    vehicle
        Name of the vehicle.
    set_sticks
        Takes axes (-1 to 1) and buttons.

    Returns
    -------
    CommandTopic
        ``<vehicle>/cmd/sticks``.

    """

    def apply(data: bytes) -> Effect:
        axes, buttons = read_joy(data)
        set_sticks(axes.tolist(), buttons.tolist())
        return Effect()

    return CommandTopic(f'{vehicle}/cmd/sticks', JOY, apply)


def _by_name(vehicle: Vehicle, names: list[str], values: Array) -> Array:
    """Return values in the thrusters' order."""
    if sorted(names) != sorted(vehicle.thrusters) or len(names) != len(values):
        raise CommandError(
            f'names must be the thrusters {listed(vehicle.thrusters)}, one effort each, or empty'
        )
    place = {name: i for i, name in enumerate(names)}
    return np.array([values[place[name]] for name in vehicle.thrusters])
