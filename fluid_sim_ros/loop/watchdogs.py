# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""All watchdogs of a run in one sink; what they find goes into the simulation's warnings."""

from collections.abc import Callable

import mujoco

from fluid_sim_ros.loop.energy_watch import EnergyWatch
from fluid_sim_ros.loop.grid_watch import GridWatch
from fluid_sim_ros.loop.outcome import Outcome
from fluid_sim_ros.plugins.limits import LimitWatch
from fluid_sim_ros.simulation import Simulation

#: Simulated time between two looks at the vehicles [s].
_PERIOD = 0.01
#: MuJoCo warnings that leave the state alone but mean that something was cut short.
CUT_SHORT = {
    mujoco.mjtWarning.mjWARN_INERTIA: 'the mass matrix is nearly singular: check the inertias',
    mujoco.mjtWarning.mjWARN_CONTACTFULL: 'contacts were left out: raise <size memory>',
    mujoco.mjtWarning.mjWARN_CNSTRFULL: 'constraints were left out: raise <size memory>',
    mujoco.mjtWarning.mjWARN_BADCTRL: 'a control was not finite and was set to zero',
}


class Watchdogs:
    """
    Looks at a simulation at its boundaries, and says what a user must hear.

    A sink for the runner; a loop of its own calls ``write`` as often as it likes. The warnings of
    the load are said first.

    Parameters
    ----------
    simulation
        What is watched; its ``warnings`` get the lines.
    show
        Takes each line as it comes up.
    period
        Ticks between two looks; default: those of 10 ms.

    Attributes
    ----------
    period
        As above.

    """

    def __init__(
        self,
        simulation: Simulation,
        show: Callable[[str], None] = lambda line: None,
        period: int | None = None,
    ) -> None:
        self._simulation, self._show = simulation, show
        self._grids, self._energy = GridWatch(simulation), EnergyWatch(simulation)
        self._limits = LimitWatch(simulation.model, simulation.data)
        self._outcome = Outcome(simulation)
        self.period = period or max(1, round(_PERIOD / simulation.timestep))
        self._next_energy = self._energy.period
        self._shown = 0
        self._show_new()

    def write(self, simulation: Simulation) -> None:
        """
        Look at the state at this step boundary.

        Parameters
        ----------
        simulation
            At the boundary.

        """
        for line in self._grids.new_lines():
            simulation.warnings.add(line)
        for line in self._limits.look():
            simulation.warnings.add(f'{line} (t = {simulation.time:g} s)')
        for kind, meaning in CUT_SHORT.items():
            if simulation.data.warning[kind].number:
                simulation.warnings.add(f'MuJoCo: {meaning}')
        tick = simulation.tick
        if tick >= self._next_energy or tick < self._next_energy - self._energy.period:
            self._next_energy = tick + self._energy.period
            self._say(self._energy.take())
        self._show_new()

    def finish(self) -> list[str]:
        """
        Judge the run at its end.

        Returns
        -------
        list
            How the vehicles ended, where that is worth a word; one line each.

        """
        self._energy.take()
        self._say(self._energy.judge())
        self._show_new()
        return self._outcome.remarks()

    def _say(self, line: str) -> None:
        if line:
            self._simulation.warnings.add(line, key='energy')

    def _show_new(self) -> None:
        lines = self._simulation.warnings.lines
        for line in lines[self._shown :]:
            self._show(line)
        self._shown = len(lines)
