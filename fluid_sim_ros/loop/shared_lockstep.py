# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Several autopilots in one lockstep: simulated time goes on when all have answered."""

from collections.abc import Sequence
from fractions import Fraction

from fluid_sim_ros.loop.autopilot_port import Bridge, CommandLog, Exchange
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact


class SharedLockstep:
    """
    One autopilot for each of several vehicles.

    At a boundary each gets its state first, so that all compute at once, and is then waited for.
    Commands take effect when all have come: the flight does not depend on who is faster. Where
    one of them says how long its frames are (ArduPilot), the time to the nearest exchange of any
    is split into equal steps no longer than the scene's.

    Parameters
    ----------
    bridges
        The autopilots, each of a vehicle of its own.
    simulation
        What they fly.
    log
        Is told of each new timestep; or None.

    """

    def __init__(
        self, bridges: Sequence[Bridge], simulation: Simulation, log: CommandLog | None
    ) -> None:
        self._bridges = tuple(bridges)
        self._log = log
        self._longest = exact(simulation.timestep)
        self._retimes = any(bridge.leads for bridge in bridges)
        for bridge in bridges:
            bridge.join()
        self._met: set[int] = set()
        self._asked = -1  # step at which all got their states
        self._end = 0  # step of the next exchange
        self._timestep = Fraction(0)

    def begin(self, simulation: Simulation) -> None:
        """
        Go on from the simulation's present time, which a reset may have set back.

        Parameters
        ----------
        simulation
            What is flown.

        """
        self._met.clear()
        self._asked, self._end = -1, simulation.step_count
        if not simulation.step_count:  # it has the scene's timestep again
            self._timestep = Fraction(0)
        for bridge in self._bridges:
            bridge.begin(simulation)

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to the next exchange of any.

        Parameters
        ----------
        simulation
            What is flown.

        """
        if self._retimes:
            return max(1, self._end - simulation.step_count)
        return min(bridge.steps_left(simulation) for bridge in self._bridges)

    def meet(self, simulation: Simulation) -> bool:
        """
        Exchange states and commands with those whose boundary it is.

        Parameters
        ----------
        simulation
            What is flown.

        Returns
        -------
        bool
            False: some have not answered yet, do not step.

        """
        step = simulation.step_count
        if self._retimes and step < self._end:
            return True
        if self._asked != step:
            self._asked = step
            self._met.clear()
            for bridge in self._bridges:
                bridge.offer(simulation)
        for i, bridge in enumerate(self._bridges):
            if i in self._met:
                continue
            if bridge.meet(simulation):
                self._met.add(i)
            if self._asked < 0:  # it has begun anew, and all with it
                return False
        if len(self._met) < len(self._bridges):
            return False
        if self._retimes:
            self._plan(simulation)
        return True

    def _plan(self, simulation: Simulation) -> None:
        """Split the time to the next exchange of any into steps."""
        end_ns = min(bridge.next_ns(simulation) for bridge in self._bridges)
        span = Fraction(end_ns - simulation.time_ns, 1_000_000_000)
        count = -int(-span // self._longest)  # rounded up
        timestep = span / count
        if timestep != self._timestep:
            self._timestep = timestep
            simulation.set_timestep(timestep)
            if self._log is not None:
                self._log.event(timestep=str(timestep))
        self._end = simulation.step_count + count


def joined(bridges: Sequence[Bridge], simulation: Simulation, log: CommandLog | None) -> Exchange:
    """
    Return what simulated time waits for with one or several autopilots.

    Parameters
    ----------
    bridges
        At least one.
    simulation
        What they fly.
    log
        As of ``SharedLockstep``.

    Returns
    -------
    Exchange
        The bridge itself where it is the only one.

    """
    return bridges[0] if len(bridges) == 1 else SharedLockstep(bridges, simulation, log)
