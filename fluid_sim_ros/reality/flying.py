# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flies windows side by side: many short runs of one model from given states, in threads."""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np
from mujoco import rollout
from numpy.typing import NDArray

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.windows import ATTITUDE, POSITION, RATES, VELOCITY, WIDTH, Windows

_STATE = int(mujoco.mjtState.mjSTATE_FULLPHYSICS)
#: Pieces that a batch of windows is cut into for each thread.
_PIECES = 2


class Flyer:
    """
    A driven model with data for each thread.

    Parameters
    ----------
    driven
        The model.
    threads
        How many; None: one for each core.

    """

    def __init__(self, driven: Driven, threads: int | None = None) -> None:
        self.driven, self.model = driven, driven.model
        self.timestep = float(driven.model.opt.timestep)
        self.threads = threads or os.cpu_count() or 1
        # the plugins keep what they read of a model in its data: each model has data of its own
        self._data = [mujoco.MjData(driven.model) for _ in range(self.threads)]
        self._size = mujoco.mj_stateSize(driven.model, _STATE)
        model, vehicle = driven.model, driven.vehicle
        self._qpos, self._qvel = 1 + vehicle.qpos_address, 1 + model.nq + vehicle.dof_address
        ids = vehicle.thruster_ids
        has = model.actuator_actnum[ids] > 0
        self._act = 1 + model.nq + model.nv + model.actuator_actadr[ids][has]
        self._others = np.concatenate([
            1 + driven.other_positions, 1 + model.nq + driven.other_velocities
        ])  # fmt: skip
        self._blank = np.empty(self._size)
        mujoco.mj_getState(model, self._data[0], self._blank, _STATE)

    def states(self, start: Array, windows: Windows, spun: Array | None) -> Array:
        """
        Return full states of the engine, shape (w, n).

        Parameters
        ----------
        start
            States of the vehicle, shape (w, 13).
        windows
            Whose begins these are: the time of the model's clock, and where its other parts are.
        spun
            Speeds of the rotors that have a lag [rad/s], shape (w, m); None: at rest.

        """
        full = np.tile(self._blank, (len(start), 1))
        full[:, 0] = windows.clock
        if windows.parts is not None:
            full[:, self._others] = windows.parts
        at = self._qpos
        full[:, at : at + 3], full[:, at + 3 : at + 7] = start[:, POSITION], start[:, ATTITUDE]
        at = self._qvel
        full[:, at : at + 3], full[:, at + 3 : at + 6] = start[:, VELOCITY], start[:, RATES]
        if spun is not None:
            full[:, self._act] = spun
        return full

    def fly(self, full: Array, controls: Array, every: Sequence[int]) -> Array:
        """
        Fly windows; return the states of the vehicle after some steps, shape (w, m, 13).

        Parameters
        ----------
        full
            As ``states`` returns them, shape (w, n).
        controls
            Of the thrusters, shape (w, steps, t).
        every
            Numbers of steps after which a state is kept, shape (m,).

        Returns
        -------
        Array
            Shape (w, m, 13).

        """
        return self._vehicle(self._roll(full, controls)[:, np.asarray(every) - 1])

    def spin_up(self, full: Array, controls: Array) -> Array:
        """
        Return the speeds of the rotors that have a lag, after the controls before each window.

        Parameters
        ----------
        full
            Of the windows' begins, shape (w, n); where the body goes meanwhile does not count.
        controls
            Before each window, shape (w, steps, t).

        """
        last: Array = self._roll(full, controls)[:, -1, self._act]
        return last

    def _roll(self, full: Array, controls: Array) -> Array:
        count, steps = controls.shape[:2]
        ctrl = np.zeros((count, steps, self.model.nu))
        ctrl[:, :, self.driven.vehicle.thruster_ids] = controls
        out = np.empty((count, steps, self._size))
        pieces = np.array_split(np.arange(count), min(count, _PIECES * self.threads))
        free = list(range(self.threads))

        def run(piece: NDArray[np.int64]) -> None:
            place = free.pop()
            try:
                rows = slice(int(piece[0]), int(piece[-1]) + 1)
                rollout.rollout(
                    self.model, self._data[place], full[rows], ctrl[rows], state=out[rows]
                )
            finally:
                free.append(place)

        if self.threads == 1:
            for piece in pieces:
                run(piece)
        else:
            with ThreadPoolExecutor(self.threads) as pool:
                list(pool.map(run, pieces))
        return out

    def _vehicle(self, full: Array) -> Array:
        found = np.empty((*full.shape[:-1], WIDTH))
        found[..., :7] = full[..., self._qpos : self._qpos + 7]
        found[..., 7:] = full[..., self._qvel : self._qvel + 6]
        return found
