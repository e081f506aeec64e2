# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The watchdogs of a sweep's runs: one text for each row, the same however a run is made."""

from collections.abc import Sequence

import numpy as np

from fluid_sim_ros.loop.energy_watch import energy_line, energy_period
from fluid_sim_ros.loop.grid_watch import GridWatch, has_grid
from fluid_sim_ros.loop.watchdogs import CUT_SHORT
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.limits import limit_lines, limited_bodies
from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.simulation import Simulation


class RunWatch:
    """
    Watches the runs of one compiled simulation: energy, limits of forces, MuJoCo's limits, grids.

    Parameters
    ----------
    simulation
        What is run.

    Attributes
    ----------
    period
        Steps between two looks at the energy.
    has_grid
        Whether runs must be looked at on the way, for the grid of a wind or current.

    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self.period = energy_period(simulation.timestep)
        self.has_grid = has_grid(simulation)
        self._limited = limited_bodies(simulation.model, simulation.data)
        self._addresses = (simulation.model._address, simulation.data._address)
        self._sums = np.zeros(3)
        self.begin()

    def begin(self) -> None:
        """Begin a run at the present state."""
        native().forget_limits(*self._addresses)
        self._sums[:] = 0.0
        self._taken = 0
        self._grids = GridWatch(self._simulation)

    @property
    def next_step(self) -> int:
        """Step at which ``take`` wants to be called next."""
        return self._taken + self.period

    def take(self) -> None:
        """Take the state at this step boundary into account."""
        self._grids.new_lines()
        if self._simulation.step_count >= self.next_step:
            self._take_energy(self._simulation.step_count)

    def _take_energy(self, now: int) -> None:
        passed = (now - self._taken) * self._simulation.model.opt.timestep
        self._taken = now
        native().energy_take(
            *self._addresses, self._simulation.observed._address, passed, self._sums.ctypes.data
        )

    def end(self, complete: bool) -> str:
        """
        End a run.

        Parameters
        ----------
        complete
            Whether it went through; a state that diverged has no energy.

        Returns
        -------
        str
            What the watchdogs say of it, or nothing.

        """
        simulation = self._simulation
        now = simulation.step_count
        if complete and now > self._taken:
            self._take_energy(now)
        limits = np.zeros((len(self._limited), 4))
        for number, row in enumerate(limits):
            native().limits(*self._addresses, number, row.ctypes.data)
        warned = [warning.number for warning in simulation.data.warning]
        said = self.text(simulation.time, self._sums, warned, limits)
        return '; '.join(filter(None, (said, *self._grids.lines)))

    def text(self, time: float, energy: Array, warned: Sequence[int], limits: Array) -> str:
        """
        Return what the watchdogs say of a run.

        Parameters
        ----------
        time
            At its end [s].
        energy
            Sums of ``energy_take`` [J], shape (3,).
        warned
            Counts of MuJoCo's warnings.
        limits
            Of each body that ``plugins.limits`` watches, shape (bodies, 4).

        Returns
        -------
        str
            Lines joined by semicolons.

        """
        model = self._simulation.model
        lines = [energy_line(model, time, *energy.tolist())]
        for body, values in zip(self._limited, limits.tolist(), strict=True):
            lines += limit_lines(model, body, *values).values()
        lines += [f'MuJoCo: {meaning}' for kind, meaning in CUT_SHORT.items() if warned[kind]]
        return '; '.join(filter(None, lines))
