# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's model and data, stepped and observed through the plugin library's C functions."""

import weakref
from collections.abc import Sequence

import mujoco
import numpy as np

from fluid_sim_ros.errors import CommandError, DivergedError, FluidSimError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.finite import MOST
from fluid_sim_ros.simulation.energy import EnergyBalance
from fluid_sim_ros.simulation.stages import Stages

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)


class Largest:
    """
    The largest values of the vehicles' motion, looked at between steps.

    Parameters
    ----------
    engine
        What is looked at.

    Attributes
    ----------
    values
        Per vehicle the largest speed [m/s], tilt [rad] and distance from the start [m],
        shape (n, 3).

    """

    def __init__(self, engine: 'Engine') -> None:
        self._engine = engine
        count = len(engine.observe(forces=False))
        self._start = np.zeros((count, 3))
        self.values = np.zeros((count, 3))
        self._addresses = (self._start.ctypes.data, self.values.ctypes.data)

    def begin(self) -> None:
        """Start from the present state."""
        self._start[:] = self._engine.observe(forces=False)[:, nat.POSITION]
        self.values[:] = 0.0

    def update(self) -> Array:
        """
        Look at the present state.

        Returns
        -------
        Array
            Its rows, of which only the motion is new.

        """
        return self._engine.raise_largest(*self._addresses)


class Engine:
    """
    A model and its data with every address resolved once.

    Parameters
    ----------
    model
        The compiled model.
    bases
        Body ids of the vehicles, in the order of the observed rows.

    Attributes
    ----------
    model, data
        What is stepped; to be changed only between steps.
    observed
        The copy that the last ``observe(forces=True)`` evaluated; only to be read.
    stepped
        What ``Native.lean`` returned.
    observe_addresses
        What ``fsr_observe`` is given: model, data, observed data, base bodies, their count, rows.

    """

    def __init__(self, model: mujoco.MjModel, bases: Sequence[int]) -> None:
        self.model = model
        self.data = mujoco.MjData(model)
        self.observed = mujoco.MjData(model)
        library = nat.native()
        self._take_steps = library.lean_step
        self._observe = library.observe
        self._raise_largest = library.raise_largest
        self._report = np.zeros(2)
        self._bases = np.array(bases, dtype=np.int32)
        self._rows = np.zeros((len(bases), nat.ROW_WIDTH))
        self.addresses = (model._address, self.data._address)
        self.stepped = library.lean(*self.addresses, self._report.ctypes.data)
        weakref.finalize(self, library.lean_free, self.stepped)
        self._observe_addresses = (
            *self.addresses, self.observed._address, self._bases.ctypes.data, len(bases),
        )  # fmt: skip
        self._rows_address = self._rows.ctypes.data
        self.observe_addresses = (*self._observe_addresses, self._rows_address)

    def step(self, n: int, tick: int = 0) -> int:
        """
        Take steps, each checked.

        Parameters
        ----------
        n
            How many at most.
        tick
            The present one, of the gaits that were handed over.

        Returns
        -------
        int
            How many were good; see ``divergence`` for what ended them.

        """
        return self._take_steps(self.stepped, n, tick)

    def divergence(self) -> DivergedError:
        """Return the error that describes the bad step which ended the last ``step``."""
        return divergence(self.model, *self._report.tolist())

    def observe(self, forces: bool, wrenches: bool = True) -> Array:
        """
        Observe the vehicles.

        Parameters
        ----------
        forces
            Whether accelerations and wrenches are evaluated at this very state, on a copy of it:
            the trajectory does not change.
        wrenches
            Whether wrenches are, besides accelerations; without, their columns stay as they were.

        Returns
        -------
        Array
            One row per base with the columns of ``plugins.native``, shape (n, columns);
            overwritten by the next call.

        """
        self._observe(*self._observe_addresses, forces + (forces and wrenches), self._rows_address)
        return self._rows

    def raise_largest(self, start: int, largest: int) -> Array:
        """
        Raise the largest values; see ``Largest``.

        Parameters
        ----------
        start, largest
            Addresses of the two arrays.

        Returns
        -------
        Array
            Rows as ``observe`` returns them, of which only the motion is new.

        """
        self._raise_largest(*self._observe_addresses, start, largest, self._rows_address)
        return self._rows

    def stages(self) -> Stages:
        """Return which stages of MuJoCo's step the next steps take."""
        return Stages.of(self.stepped, int(self.model.ngeom))

    def energy_balance(self) -> EnergyBalance:
        """Return the energy balance at the present state; takes a step on a copy."""
        out = np.zeros(3)
        nat.native().energy_feed(*self.addresses, self.observed._address, out.ctypes.data)
        return EnergyBalance(*out.tolist())

    def largest(self) -> Largest:
        """Return a watch for the largest speed, tilt and distance of each vehicle."""
        return Largest(self)

    def reset(self, keyframe: str | None) -> None:
        """
        Go to a keyframe, at time 0.

        Parameters
        ----------
        keyframe
            Its name; None: the model's initial state.

        Raises
        ------
        CommandError
            If the model has no such keyframe.

        """
        if keyframe is None:
            mujoco.mj_resetData(self.model, self.data)
            return
        mujoco.mj_resetDataKeyframe(self.model, self.data, keyframe_id(self.model, keyframe))
        self.data.time = 0.0

    def save(self) -> Array:
        """Return everything in the data that the next step depends on."""
        state = np.empty(mujoco.mj_stateSize(self.model, _STATE))
        mujoco.mj_getState(self.model, self.data, state, _STATE)
        return state

    def load(self, state: Array) -> None:
        """
        Go to a saved state.

        Parameters
        ----------
        state
            As ``save`` returned it, shape (n,).

        Raises
        ------
        FluidSimError
            If the state is of another model, or has numbers from which no positions come.

        """
        size = mujoco.mj_stateSize(self.model, _STATE)
        if state.shape != (size,):
            raise FluidSimError(
                f'the saved state has {state.size} numbers, the model needs {size}: '
                'it is of another model'
            )
        positions = state[1 : 1 + self.model.nq + self.model.nv]  # behind the time, and velocities
        if not (np.isfinite(state).all() and (np.abs(positions) <= MOST).all()):
            raise FluidSimError(
                'the saved state has numbers that are NaN or infinite, or positions or velocities '
                f'beyond {MOST:g}: no flight goes on from it'
            )
        mujoco.mj_setState(self.model, self.data, state, _STATE)


def keyframe_id(model: mujoco.MjModel, name: str) -> int:
    """
    Return the id of a keyframe.

    Parameters
    ----------
    model
        The compiled model.
    name
        Of the keyframe.

    Returns
    -------
    int
        Its id.

    Raises
    ------
    CommandError
        If the model has no such keyframe, with those that it has.

    """
    identity = int(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, name))
    if identity < 0:
        names = listed(model.key(i).name for i in range(model.nkey))
        raise CommandError(f"keyframe '{name}' is not in the model; it has: {names}")
    return identity


def divergence(model: mujoco.MjModel, time: float, dof: float) -> DivergedError:
    """
    Return the error that describes a bad step.

    Parameters
    ----------
    model
        The compiled model.
    time
        Of the step [s].
    dof
        Index of the velocity that went wrong.

    Returns
    -------
    DivergedError
        With time, body and a remedy.

    """
    body = '(unknown)'
    if 0 <= dof < model.nv:
        body = model.body(model.dof_bodyid[int(dof)]).name or '(unnamed)'
    integrator = mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix('mjINT_')
    hint = f'try a timestep below {model.opt.timestep:g} s'
    if integrator in ('EULER', 'RK4'):
        hint += ' or the integrator implicitfast'
    return DivergedError(
        f"the simulation diverged at t = {time:.6g} s in body '{body}' "
        f'({integrator}, {model.opt.timestep:g} s); {hint}',
        time=time,
        body=body,
    )
