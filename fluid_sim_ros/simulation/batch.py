# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Many runs of one simulation in a single call, in which Python has no part."""

import mujoco
import numpy as np

from fluid_sim_ros.errors import DivergedError
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.plugins.limits import limited_bodies
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.engine import divergence
from fluid_sim_ros.step_clock import StepClock

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)


class BatchRuns:
    """
    Runs that differ by their start and their commands only, to the bits of ``Simulation.step``.

    Nothing may change on the way: no scheduled event, no gait, no commanded wrench
    (``Simulation.next_change``). ``take`` takes up the simulation's present state as a start,
    ``run`` flies them all; the simulation needs ``reset`` afterwards.

    Parameters
    ----------
    simulation
        What is flown.
    steps
        Of each run.
    period
        Steps between two looks at the largest values.
    most
        Runs of one call at most.
    watch
        Steps between two looks at the energy.

    Attributes
    ----------
    rows
        The vehicles at the end of each run, with the columns of ``plugins.native`` up to the
        medium's velocity; shape (runs, n, columns).
    largest
        As ``engine.Largest``, shape (runs, n, 3).
    times
        At the end of each run [s].
    energy
        What ``energy_take`` added up over each run, shape (runs, 3).
    warned
        Counts of MuJoCo's warnings, shape (runs, kinds).
    limits
        As ``plugins.limits`` has them for each of its bodies, shape (runs, bodies, 4).

    """

    def __init__(
        self, simulation: Simulation, steps: int, period: int, most: int, watch: int
    ) -> None:
        self._simulation = simulation
        self._model, self._data = simulation.model, simulation.data
        bodies = [vehicle.body_id for vehicle in simulation.vehicles.values()]
        self._bases = np.array(bodies, dtype=np.int32)
        self._states = np.zeros((most, mujoco.mj_stateSize(self._model, _STATE)))
        self._winds = np.zeros((most, 3))
        self._done = np.zeros(most, dtype=np.int32)
        self._reports = np.zeros((most, 2))
        self._rows = np.zeros((most, len(bodies), nat.ROW_WIDTH))
        self._largest = np.zeros((most, len(bodies), 3))
        self._energy = np.zeros((most, 3))
        self._warned = np.zeros((most, int(mujoco.mjtWarning.mjNWARNING)), dtype=np.int32)
        limited = len(limited_bodies(self._model, self._data))
        self._limits = np.zeros((most, limited, 4))
        self._steps, self._period, self._watch = steps, period, watch
        self._clock = StepClock(simulation.timestep)
        self.count = 0

    def take(self) -> None:
        """Take up the simulation's present state and commands as the start of one more run."""
        mujoco.mj_getState(self._model, self._data, self._states[self.count], _STATE)
        self._winds[self.count] = self._model.opt.wind
        self.count += 1

    def run(self) -> None:
        """Fly the runs that were taken up; their results stand until the next call."""
        self._largest[:] = self._energy[:] = 0.0
        arrays = (
            self._states, self._winds, self._done, self._reports, self._rows, self._largest,
        )  # fmt: skip
        nat.native().runs(
            self._model._address, self._data._address, self._simulation.observed._address,
            self._bases.ctypes.data, len(self._bases), self.count, self._steps, self._period,
            *(array.ctypes.data for array in arrays), self._watch, self._energy.ctypes.data,
            self._warned.ctypes.data, self._limits.shape[1], self._limits.ctypes.data,
        )  # fmt: skip
        flown = slice(0, self.count)
        self.rows, self.largest = self._rows[flown], self._largest[flown]
        self.energy, self.warned = self._energy[flown], self._warned[flown]
        self.limits = self._limits[flown]
        self.times = [self._clock.time(step) for step in self._done[flown].tolist()]
        self.count = 0

    def divergence(self, run: int) -> DivergedError | None:
        """
        Return the error that ended a run, or None for one that went through.

        Parameters
        ----------
        run
            Index of the run.

        """
        if self._done[run] == self._steps:
            return None
        return divergence(self._model, *self._reports[run].tolist())
