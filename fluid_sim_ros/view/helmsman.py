# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Holds vehicles by their laws while a view is open, moves their targets, and lets them go."""

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_commands import VehicleCommands
from fluid_sim_ros.loop.autopilot_port import Surroundings
from fluid_sim_ros.loop.helms import Helm, Move, helm_of
from fluid_sim_ros.loop.hold import RATE, state_of
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.plant import plant_of
from fluid_sim_ros.step_clock import Beat


class Helmsman:
    """
    A sink for the runner that commands the vehicles that are held; the last of the sinks.

    Parameters
    ----------
    simulation
        What is commanded.

    Attributes
    ----------
    period
        Every tick at which it answers is a multiple of it.

    """

    def __init__(self, simulation: Simulation) -> None:
        self._beat = Beat.at_rate(
            min(RATE, 1.0 / simulation.timestep), simulation.timestep, 'hold'
        )
        self.period = self._beat.period
        self._simulation = simulation
        self._order = {name: i for i, name in enumerate(simulation.vehicles)}
        self._held: dict[str, tuple[int, Helm, VehicleCommands]] = {}
        self._moving: dict[str, Move] = {}

    @property
    def held(self) -> tuple[str, ...]:
        """Names of the vehicles that are held."""
        return tuple(self._held)

    def hold(self, name: str) -> None:
        """
        Hold a vehicle where it is.

        Parameters
        ----------
        name
            Of the vehicle.

        Raises
        ------
        FluidSimError
            If no law fits it; says why.

        """
        vehicle = self._simulation.vehicle(name)
        if not vehicle.thrusters:
            raise ConfigError(f"vehicle '{name}' has no thrusters to hold it with")
        plant, _ = plant_of(self._simulation.scene, name)
        row = self._order[name]
        rows = self._simulation.observe(forces=False)
        helm = helm_of(plant, vehicle, state_of(self._simulation, rows[row]))
        self._held[name] = (row, helm, VehicleCommands(self._simulation, name, Surroundings()))

    def let_go(self, name: str) -> None:
        """
        Leave a vehicle to its last commands.

        Parameters
        ----------
        name
            Of the vehicle; one that is not held is left as it is.

        """
        self._held.pop(name, None)
        self._moving.pop(name, None)

    def steer(self, name: str, by: Move) -> None:
        """
        Move the target of a vehicle from now on.

        Parameters
        ----------
        name
            Of the vehicle.
        by
            Shares of the fastest, -1 to 1; zeros end it.

        Raises
        ------
        ConfigError
            If the vehicle is not held.

        """
        if name not in self._held:
            raise ConfigError(f"vehicle '{name}' is not held: switch 'hold and steer' on first")
        self._moving[name] = by

    def write(self, simulation: Simulation) -> None:
        """
        Answer the present state with commands.

        Parameters
        ----------
        simulation
            At a step boundary; commanded.

        """
        if not self._held or not self._beat.due(simulation.tick):
            return
        rows = simulation.observe(forces=False)
        states = [state_of(simulation, rows[row]) for row, _, _ in self._held.values()]
        period = self._beat.longest * simulation.timestep
        for state, (name, (_, helm, commands)) in zip(states, self._held.items(), strict=True):
            if name in self._moving and any(self._moving[name]):
                pairs = zip(self._moving[name], helm.fastest, strict=True)
                helm.move(Move(*(share * fastest * period for share, fastest in pairs)))
            commands.set(*helm(state))
