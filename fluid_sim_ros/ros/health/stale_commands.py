# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Thrust commands that are too old: thrust goes to zero, and it is reported."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from fluid_sim_ros.simulation import Simulation


@dataclass
class Freshness:
    """When a vehicle was last commanded, on the clock that ``command_timeout`` refers to."""

    commanded_at: float | None = None
    stale: bool = False
    times_stale: int = 0


class StaleCommands:
    """
    Watches the age of every vehicle's thrust command.

    Age counts in simulated time, with free pacing in wall time; nothing is stale before the first
    command.

    Parameters
    ----------
    simulation
        Whose vehicles are watched.
    settings
        The node's parameters; ``pacing`` and ``command_timeout`` may change at run time.
    report
        Takes the subject and the line of a report.

    Attributes
    ----------
    freshness
        By vehicle name.

    """

    def __init__(
        self, simulation: Simulation, settings: dict[str, Any], report: Callable[[str, str], None]
    ) -> None:
        self._simulation = simulation
        self._settings = settings
        self._report = report
        self.freshness = {name: Freshness() for name in simulation.vehicles}

    def commanded(self, vehicle: str) -> None:
        """
        Note a command that took effect now.

        Parameters
        ----------
        vehicle
            Name of the vehicle that was commanded.

        """
        freshness = self.freshness[vehicle]
        freshness.commanded_at = self._clock()
        freshness.stale = False

    def expire(self) -> list[str]:
        """
        Set thrust to zero where the command has become stale; return those vehicles.

        Returns
        -------
        list
            Names of the vehicles whose command has just become stale.

        """
        limit = self._settings['command_timeout']
        if not limit:
            return []
        now, expired = self._clock(), []
        for name, freshness in self.freshness.items():
            at = freshness.commanded_at
            if at is not None and not freshness.stale and now - at > limit:
                freshness.stale = True
                freshness.times_stale += 1
                expired.append(name)
                thrusters = self._simulation.vehicles[name].thrusters
                self._simulation.set_thrust(name, np.zeros(len(thrusters)))
                self._report(
                    f'{name} stale',
                    f"thrust of '{name}': no command for {limit:g} s, thrust set to zero",
                )
        return expired

    def forget(self) -> None:
        """Start anew after a reset."""
        for freshness in self.freshness.values():
            freshness.commanded_at = None
            freshness.stale = False

    def _clock(self) -> float:
        return time.monotonic() if self._settings['pacing'] == 'free' else self._simulation.time
