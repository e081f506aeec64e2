# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Holds vehicles where a run begins, by the control laws in process: no ROS, no delay."""

from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.loop.autopilot_commands import VehicleCommands
from fluid_sim_ros.loop.autopilot_port import CommandLog, Surroundings
from fluid_sim_ros.loop.helms import Law, helm_of
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.plant import plant_of
from fluid_sim_ros.step_clock import Beat

#: Answers per second of simulated time [Hz].
RATE = 100.0


def state_of(simulation: Simulation, row: Array) -> State:
    """
    Return the state that a law is told of a vehicle.

    Parameters
    ----------
    simulation
        At a step boundary.
    row
        Of the vehicle, as ``Simulation.observe`` returned it.

    Returns
    -------
    State
        With the velocity of the medium.

    """
    return State(
        simulation.time, row[nat.POSITION].tolist(), row[nat.QUATERNION].tolist(),
        row[nat.LINEAR_VELOCITY].tolist(), row[nat.ANGULAR_VELOCITY].tolist(),
        row[nat.MEDIUM_VELOCITY].tolist(),
    )  # fmt: skip


class Hold:
    """
    A sink for the runner that commands every vehicle with thrusters; the last of the sinks.

    Parameters
    ----------
    simulation
        At its begin, which is held.
    log
        Gets every command before it takes effect, so that the run can be repeated; or None.

    Attributes
    ----------
    period
        Every tick at which it answers is a multiple of it.

    Raises
    ------
    ConfigError
        If no vehicle can be held, or the rate does not fit the timestep.

    """

    def __init__(self, simulation: Simulation, log: CommandLog | None = None) -> None:
        self._beat = Beat.at_rate(RATE, simulation.timestep, '--hold')
        self.period = self._beat.period
        self._held: list[tuple[int, Law, VehicleCommands]] = []
        rows = simulation.observe(forces=False).copy()
        for row, (name, vehicle) in enumerate(simulation.vehicles.items()):
            if vehicle.thrusters:
                plant, _ = plant_of(simulation.scene, name)
                law = helm_of(plant, vehicle, state_of(simulation, rows[row]))
                commands = VehicleCommands(simulation, name, Surroundings(log=log))
                self._held.append((row, law, commands))
        if not self._held:
            raise ConfigError(
                f'--hold: no vehicle has thrusters; the scene has: {listed(simulation.vehicles)}'
            )

    def write(self, simulation: Simulation) -> None:
        """
        Answer the present state with commands.

        Parameters
        ----------
        simulation
            At a step boundary; commanded.

        """
        if not self._beat.due(simulation.tick):
            return
        rows = simulation.observe(forces=False)
        states = [state_of(simulation, rows[row]) for row, _, _ in self._held]
        for state, (_, law, commands) in zip(states, self._held, strict=True):
            commands.set(*law(state))
