# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An autopilot as a pacing: simulated time goes on when it has answered."""

from fluid_sim_ros.loop.autopilot_port import Exchange
from fluid_sim_ros.loop.pacing import Pacing, Source
from fluid_sim_ros.simulation import Simulation


class AutopilotPacing(Pacing):
    """
    Simulated time goes on when the autopilot has answered, and no faster than ``clock`` allows.

    Parameters
    ----------
    bridge
        The autopilot, or several as ``SharedLockstep``.
    clock
        ``Pacing`` (free) or ``RealTime``.

    """

    def __init__(self, bridge: Exchange, clock: Pacing) -> None:
        self.bridge = bridge
        self.clock = clock

    def begin(self, simulation: Simulation) -> None:
        """
        Start (again) from the simulation's present time.

        Parameters
        ----------
        simulation
            What is flown.

        """
        self.clock.begin(simulation)
        self.bridge.begin(simulation)

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to the next exchange, or to the next look at the clock.

        Parameters
        ----------
        simulation
            What is flown.

        """
        return min(self.clock.steps_left(simulation), self.bridge.steps_left(simulation))

    def is_due(self, simulation: Simulation) -> bool:
        """
        Wait for the boundary's wall time.

        Parameters
        ----------
        simulation
            What is flown.

        Returns
        -------
        bool
            False: not yet, serve requests and come back.

        """
        return self.clock.is_due(simulation)

    def meet(self, simulation: Simulation, source: Source) -> bool:
        """
        Take in other commands, then those of the autopilot.

        Parameters
        ----------
        simulation
            What is flown.
        source
            Of the other commands.

        Returns
        -------
        bool
            False: no answer yet, do not step.

        """
        source.poll(simulation)
        if self.bridge.meet(simulation):
            return True
        self.clock.begin(simulation)  # the time that was waited is not to be caught up
        return False
