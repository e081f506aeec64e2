# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is written before each step, within the compiled step: gaits, and wrenches that turn."""

from collections.abc import Mapping

import numpy as np

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.gaits import GaitCycle, Gaits
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation.actuation import CommandedWrench
from fluid_sim_ros.simulation.engine import Engine
from fluid_sim_ros.step_clock import NEVER

#: What the compiled step counts a beat's interval with: 64-bit numbers.
_LARGEST = 1 << 62


class StepCommands:
    """
    Gaits and commanded wrenches, handed over to the compiled step whenever they change.

    A gait whose rate is no number that the compiled step can count with is written from here, by
    ``GaitCycle.write``: the compiled step is its twin, to the bit.

    Parameters
    ----------
    engine
        Model and data.
    gaits
        Of the scene.
    vehicles
        By name.

    Attributes
    ----------
    gaits
        As above.
    wrenches
        Those that act, by vehicle; only to be read.

    """

    def __init__(self, engine: Engine, gaits: Gaits, vehicles: Mapping[str, Vehicle]) -> None:
        self._engine, self._vehicles = engine, vehicles
        self._control, self._applied = engine.data.ctrl, engine.data.qfrc_applied
        self.gaits = gaits
        self.wrenches: dict[str, CommandedWrench] = {}
        self._here: list[GaitCycle] = []
        self._addresses = np.zeros((len(vehicles), 3), dtype=np.int32)
        self._numbers = np.zeros((len(vehicles), 6))

    def run_gaits(self, names: tuple[str, ...] | None) -> None:
        """
        Have the gaits of some vehicles run, and no others.

        Parameters
        ----------
        names
            Of the vehicles; None: all of the scene.

        """
        gaits, library = self.gaits, nat.native()
        gaits.running = gaits.names if names is None else names
        self._here = []
        library.lean_forget_gaits(self._engine.stepped)
        for cycle in gaits.cycles():
            if max(cycle.beat.ratio) > _LARGEST:
                self._here.append(cycle)
                continue
            wave = cycle.wave
            beat = np.array(cycle.beat.ratio, dtype=np.int64)
            whole = np.array([cycle.period, wave.frequency, wave.ramp])
            controls = np.array(cycle.controls, dtype=np.int32)
            offsets = wave.offsets or (0.0,) * len(wave.amplitudes)
            joints = np.array([wave.amplitudes, wave.phases, offsets]).T.copy()
            library.lean_add_gait(
                self._engine.stepped, beat.ctypes.data, whole.ctypes.data, len(controls),
                controls.ctypes.data, joints.ctypes.data,
            )  # fmt: skip

    def end_gait(self, vehicle: str) -> None:
        """
        End a vehicle's gait, if it has one.

        Parameters
        ----------
        vehicle
            Its name.

        """
        if vehicle in self.gaits.running:
            self.run_gaits(tuple(name for name in self.gaits.running if name != vehicle))

    def hold_wrenches(self, wrenches: Mapping[str, CommandedWrench]) -> None:
        """
        Hold wrenches, and no others.

        Parameters
        ----------
        wrenches
            By vehicle.

        """
        self.wrenches = dict(wrenches)
        for i, (name, wrench) in enumerate(self.wrenches.items()):
            vehicle = self._vehicles[name]
            in_body_axes = wrench.frame == 'base_link'
            self._addresses[i] = vehicle.qpos_address, vehicle.dof_address, in_body_axes
            self._numbers[i, :3], self._numbers[i, 3:] = wrench.force_f, wrench.torque_f
        nat.native().lean_hold_wrenches(
            self._engine.stepped, len(self.wrenches), self._addresses.ctypes.data,
            self._numbers.ctypes.data,
        )  # fmt: skip

    def end_wrench(self, vehicle: str) -> None:
        """
        End a vehicle's wrench, if it has one.

        Parameters
        ----------
        vehicle
            Its name.

        """
        if vehicle in self.wrenches:
            self.hold_wrenches({n: w for n, w in self.wrenches.items() if n != vehicle})
            first = self._vehicles[vehicle].dof_address
            self._applied[first : first + 6] = 0

    def write_here(self, tick: int) -> None:
        """
        Write those gaits that the compiled step does not.

        Parameters
        ----------
        tick
            The present one.

        """
        for cycle in self._here:
            cycle.write(tick, self._control)

    def next_here(self, tick: int) -> int:
        """
        Return the first tick after a tick at which ``write_here`` is to be called (``NEVER``).

        Parameters
        ----------
        tick
            0 or more.

        """
        return min((cycle.next_due(tick + 1) for cycle in self._here), default=NEVER)
