# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What every bridge shares: outputs that become commands, faults, and what is shown of both."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, ClassVar, Literal

from fluid_sim_ros.loop.autopilot_commands import VehicleCommands
from fluid_sim_ros.loop.autopilot_port import (
    AutopilotOptions,
    BridgeStatus,
    Surroundings,
)
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.counters import Counters
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.sticks import CHANNELS, Sticks
from fluid_sim_ros.plugins.exchange import Peer
from fluid_sim_ros.simulation import Simulation

#: Longest wait for an autopilot at a time [s], so that requests of other threads are served.
SLICE = 0.05

#: Level and line of a status.
Trouble = tuple[Literal['warn', 'error'], str]


class AutopilotLink(ABC):
    """
    One autopilot at one vehicle, whatever protocol it speaks.

    Parameters
    ----------
    simulation, options, surroundings
        As for ``autopilot.open_bridge``.
    actuators
        What its outputs drive.
    file
        The rest of the mapping.

    Attributes
    ----------
    vehicle
        Name of the vehicle.
    counters
        What has happened.
    peer
        The other end of its socket, as the compiled exchange knows it.

    """

    #: What people call it, and its protocol in options.
    name: ClassVar[str]
    protocol: ClassVar[str]
    #: Channels of a radio control that it takes.
    channels: ClassVar[int] = CHANNELS
    leads: ClassVar[bool] = False
    peer: Peer

    def __init__(
        self,
        simulation: Simulation,
        options: AutopilotOptions,
        surroundings: Surroundings,
        actuators: ActuatorMap,
        file: AutopilotFile,
    ) -> None:
        self.vehicle = options.vehicle
        self.counters = Counters()
        self._surroundings = surroundings
        self._actuators = actuators
        self._sticks = Sticks(file.rc, options.sticks_timeout, self.channels)
        self._commands = VehicleCommands(simulation, options.vehicle, surroundings)
        actuators.drive(*simulation.control_ports(options.vehicle))
        self._usual = False  # the next exchange may be one call of the library

    @abstractmethod
    def begin(self, simulation: Simulation) -> None:
        """
        Go on from the simulation's present time, which a reset may have set back.

        Parameters
        ----------
        simulation
            The one that the bridge was made for.

        """

    @abstractmethod
    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to the next exchange.

        Parameters
        ----------
        simulation
            The one that the bridge was made for, at a step boundary.

        """

    @abstractmethod
    def meet(self, simulation: Simulation) -> bool:
        """
        Exchange state and commands where this boundary is one of an exchange.

        Parameters
        ----------
        simulation
            The one that the bridge was made for, at a step boundary.

        Returns
        -------
        bool
            Whether the simulation may go on; False where no answer has come yet.

        """

    @abstractmethod
    def join(self) -> None:
        """Be one of several; see ``autopilot_port.Bridge``."""

    @abstractmethod
    def offer(self, simulation: Simulation) -> None:
        """
        Send the state that is due at this boundary, without waiting.

        Parameters
        ----------
        simulation
            The one that the bridge was made for, at a step boundary.

        """

    @abstractmethod
    def next_ns(self, simulation: Simulation) -> int:
        """
        Return the simulated time of the next exchange [ns].

        Parameters
        ----------
        simulation
            The one that the bridge was made for, at a step boundary.

        """

    def set_sticks(self, axes: Sequence[float], buttons: Sequence[float]) -> None:
        """
        Take the sticks of a radio control; see ``Sticks``.

        Parameters
        ----------
        axes
            Deflections, -1 to 1; saturated.
        buttons
            0 for off, another number for on.

        Raises
        ------
        CommandError
            If they are too many, none, or not finite.

        """
        self._sticks.move(axes, buttons)

    def status(self) -> BridgeStatus:
        """Return what to show people."""
        counters = self.counters
        values = {
            'protocol': self.protocol, **self._values(), 'sticks_lost': self._sticks.lost,
            'last_outputs': [round(value, 3) for value in self._actuators.outputs],
            'saturated': self._commands.saturated, **counters.values(),
        }  # fmt: skip
        trouble = self._trouble()
        if trouble is None and counters.malformed:
            line = f'{counters.malformed} malformed messages, last: {counters.last_fault}'
            trouble = 'warn', line
        level, line = trouble or ('ok', 'in lockstep')
        return BridgeStatus(level, line, values)

    @abstractmethod
    def reasons(self) -> list[str]:
        """Return what may be wrong while it has not answered yet, most likely first."""

    @abstractmethod
    def _values(self) -> dict[str, Any]:
        """Return the numbers of the protocol."""

    @abstractmethod
    def _trouble(self) -> Trouble | None:
        """Return what keeps it from lockstep, or None."""

    def _drive(self, outputs: Sequence[float]) -> None:
        """Command what the outputs drive; one that moves and drives nothing is reported."""
        self._commands.set(*self._actuators.commands(outputs))
        self._look_for_stray()

    def _driven(self) -> None:
        """Note what the compiled exchange has commanded."""
        actuators, commands = self._actuators, self._commands
        if self._surroundings.log is not None:
            commands.log(*actuators.last)
        commands.saturated += actuators.driven.beyond
        self._look_for_stray()

    def _look_for_stray(self) -> None:
        stray = self._actuators.look_for_stray()
        if stray is not None:
            line = f'{self.name} moves output {stray}, which drives nothing'
            self._surroundings.report(f'output {stray}', line)

    def _malformed(self, fault: str) -> None:
        """Count and report what could not be read."""
        self.counters.fault(fault)
        self._surroundings.report('malformed', f'{self.name}: {fault}')
