# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A device for mujoco_warp, and one model with many worlds on it."""

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import ConfigError, MissingExtraError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.simulation import Simulation

PRECISION = 'float32'


class WarpDevice:
    """
    A device, by the name that Warp gives it.

    Parameters
    ----------
    name
        ``cpu``, ``cuda`` or ``cuda:0``.

    Attributes
    ----------
    wp, mjw
        The modules warp and mujoco_warp.
    is_cuda
        Whether it is a GPU.
    description
        Name and precision, as a table has it.

    Raises
    ------
    ConfigError, MissingExtraError
        If there is no such device, or no mujoco_warp.

    """

    def __init__(self, name: str) -> None:
        try:
            import warp as wp

            # standard output holds results only; what fails is raised
            wp.config.log_level = wp.LOG_ERROR
            import mujoco_warp as mjw
        except ModuleNotFoundError as error:
            raise MissingExtraError(
                f'--device needs {error.name}, which is not installed; '
                'type: pip install "fluid_sim_ros[warp]"'
            ) from None
        with _quiet():
            wp.init()
        self.wp, self.mjw = wp, mjw
        try:
            self._device = wp.get_device(name)
        except (ValueError, RuntimeError):
            known = listed(str(device) for device in wp.get_devices())
            raise ConfigError(f"--device '{name}': not here; devices: {known}") from None
        self.name = name
        self.is_cuda = bool(self._device.is_cuda)
        model = f' ({self._device.name})' if self.is_cuda else ''
        self.description = f'{self._device.alias}{model}, {PRECISION}'

    def scope(self) -> Any:
        """Return a context in which arrays and kernels are on this device."""
        return self.wp.ScopedDevice(self._device)


class WarpWorlds:
    """
    One model with ``size`` worlds on a device.

    Each world has a start, controls and wind of its own, and the model fields that are named.

    Parameters
    ----------
    device
        Where.
    simulation
        Whose model; it stands at the start.
    size
        Number of worlds.
    own_fields
        Fields of the model that differ from world to world.

    Raises
    ------
    ConfigError
        If mujoco_warp does not support something in the model.

    """

    def __init__(
        self, device: WarpDevice, simulation: Simulation, size: int, own_fields: Sequence[str]
    ) -> None:
        self._device = device
        self._graph: Any = None
        mjw, wp = device.mjw, device.wp
        model, data = simulation.model, simulation.data
        with device.scope(), warnings.catch_warnings():
            warnings.simplefilter('ignore')
            try:
                self._model = mjw.put_model(model, batch_sizes=dict.fromkeys(own_fields, size))
                self._data = mjw.put_data(model, data, nworld=size)
            except (NotImplementedError, ValueError) as error:
                where = f"--device {device.name}: scene '{simulation.scene.name}'"
                raise ConfigError(f'{where}: mujoco_warp: {error}') from None
            self._model.opt.wind = wp.zeros(size, dtype=wp.vec3)
        self._model.opt.warn_overflow = 0  # asked for by ``overflowed``, not printed

    def begin(self, starts: Mapping[str, Array], winds: Array, own: Mapping[str, Array]) -> None:
        """
        Go to the start.

        Parameters
        ----------
        starts
            By field of mjData; shape (worlds, ...).
        winds
            Shape (worlds, 3) [m/s].
        own
            By field of mjModel; shape (worlds, ...).

        """
        with self._device.scope():
            self._model.opt.wind.assign(winds.astype(np.float32))
            for name, values in own.items():
                field = getattr(self._model, name)
                # vectors are one element of a Warp array, and the last axis of a numpy one
                field.assign(values.astype(np.float32).reshape(field.numpy().shape))
            if self._device.is_cuda and self._graph is None:
                self._capture()
            self._device.mjw.reset_data(self._model, self._data)
            for name, values in starts.items():
                if values.shape[1]:
                    getattr(self._data, name).assign(values.astype(np.float32))

    def step(self, count: int) -> None:
        """
        Take steps in all worlds.

        Parameters
        ----------
        count
            Number of steps.

        """
        with self._device.scope():
            for _ in range(count):
                if self._graph is not None:
                    self._device.wp.capture_launch(self._graph)
                else:
                    self._device.mjw.step(self._model, self._data)

    def state(self) -> tuple[Array, Array]:
        """Return qpos and qvel of all worlds, shape (worlds, nq) and (worlds, nv)."""
        qpos, qvel = self._data.qpos.numpy(), self._data.qvel.numpy()
        return qpos.astype(np.float64), qvel.astype(np.float64)

    def overflowed(self) -> NDArray[np.bool_]:
        """Return which worlds had more contacts or constraints than there was room for."""
        flags: NDArray[np.bool_] = self._data.overflow.numpy() != 0
        return flags

    def _capture(self) -> None:
        """Record the kernel launches of one step, so that they start as one: faster than each."""
        self._device.mjw.step(self._model, self._data)  # kernels are compiled
        with self._device.wp.ScopedCapture() as capture:
            self._device.mjw.step(self._model, self._data)
        self._graph = capture.graph


def state_fields(model: mujoco.MjModel) -> tuple[str, ...]:
    """
    Return the fields of mjData that make the start of a world.

    Parameters
    ----------
    model
        The model.

    Returns
    -------
    tuple
        Names.

    """
    return ('qpos', 'qvel', 'act', 'ctrl') if model.na else ('qpos', 'qvel', 'ctrl')


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep standard error free of what Warp's library says of a machine without a GPU."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
