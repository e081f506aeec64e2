# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Commands on vehicles: checked, then written to where MuJoCo reads them."""

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import CommandError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.exchange import ControlPorts, exchange_library
from fluid_sim_ros.scene.vehicle import Vehicle

WRENCH_FRAMES = ('base_link', 'map')


def finite(what: str, values: Sequence[float] | Array, size: int, names: str = '') -> Array:
    """
    Return values as an array of finite numbers.

    Parameters
    ----------
    what
        Begin of an error.
    values
        Numbers of any unit.
    size
        How many they must be.
    names
        Of the numbers, for errors.

    Returns
    -------
    Array
        Shape (size,).

    Raises
    ------
    CommandError
        If they are no numbers, too many or too few, or not finite; starts with ``what``.

    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise CommandError(f'{what}: {values!r} are not numbers') from None
    if array.shape != (size,):
        raise CommandError(f'{what}: got {array.size} values, needs {size} {names}'.rstrip())
    # a square that is finite says it for all of them, in a third of the time
    if not (math.isfinite(array @ array) or np.isfinite(array).all()):
        raise CommandError(f'{what}: {array.tolist()} holds a value that is not finite')
    return array


class Controls:
    """
    Commands of some actuators on their way to ``mjData.ctrl``: checked, then saturated.

    Parameters
    ----------
    control
        ``mjData.ctrl``.
    what
        Begin of error messages.
    names, ids, limits
        The actuators, in command order; limits of shape (n, 2), infinite where there is none.
    scale
        Command at a control of 1, shape (n,); None: commands are controls.

    """

    def __init__(
        self,
        control: Array,
        what: str,
        names: Sequence[str],
        ids: NDArray[np.int64],
        limits: Array,
        scale: Array | None = None,
    ) -> None:
        self._scale = None if scale is None or (scale == 1.0).all() else scale.copy()
        self._what, self._names = what, f'({listed(names)})'
        self._control, self._ids = control, np.array(ids, dtype=np.int64)
        self._limits = limits.T.astype(np.float64, order='C')
        self._command = np.empty(len(names))
        self._layout = struct.Struct(f'={len(names)}d')
        # plain addresses: the arrays above stay where they are
        self._write = exchange_library().command
        self._arguments = (
            self._command.ctypes.data, len(names), self._limits.ctypes.data,
            None if self._scale is None else self._scale.ctypes.data, self._ids.ctypes.data,
            control.ctypes.data,
        )  # fmt: skip

    def ports(self) -> ControlPorts:
        """Return where the compiled exchange with an autopilot writes, as long as this lives."""
        _, count, limits, scale, ids, control = self._arguments
        return ControlPorts(count, limits, scale, ids, control)

    def read(self) -> Array:
        """Return the present commands."""
        present: Array = self._control[self._ids]
        return present if self._scale is None else present * self._scale

    def write(self, values: Sequence[float] | Array) -> int:
        """
        Write one command per actuator.

        Parameters
        ----------
        values
            In the unit of the actuators, in command order, shape (n,).

        Returns
        -------
        int
            How many were beyond the limits.

        Raises
        ------
        CommandError
            If they are no numbers, too many or too few, or not finite.

        """
        command = self._command
        try:  # most are lists of floats, which take a fourth of the time this way
            self._layout.pack_into(command.data, 0, *(values if isinstance(values, list) else ()))
        except struct.error:
            command[:] = finite(self._what, values, len(command), self._names)
        beyond = self._write(*self._arguments)
        if beyond < 0:
            finite(self._what, values, len(command), self._names)  # says which it is
        return beyond


@dataclass(frozen=True)
class CommandedWrench:
    """
    A wrench at a base_link origin: force [N] and torque [N m] in the axes of ``frame``.

    The compiled step writes it to ``mjData.qfrc_applied``, at the attitude before each step: the
    generalized force of a free joint is the force in world axes, and the torque in body axes.
    """

    force_f: Array
    torque_f: Array
    frame: str

    @classmethod
    def checked(
        cls,
        vehicle: Vehicle,
        force: Sequence[float] | Array,
        torque: Sequence[float] | Array,
        frame: str,
    ) -> 'CommandedWrench':
        """
        Return the wrench of a command.

        Parameters
        ----------
        vehicle
            Whose.
        force, torque
            [N], [N m], shape (3,).
        frame
            Axes of both, ``base_link`` or ``map``.

        Returns
        -------
        CommandedWrench
            Checked.

        Raises
        ------
        CommandError
            Unknown frame, wrong length, not finite, or a base without a free joint.

        """
        if frame not in WRENCH_FRAMES:
            raise CommandError(
                f"wrench of '{vehicle.name}': frame '{frame}' is not known; "
                f'allowed: {listed(WRENCH_FRAMES)}'
            )
        if vehicle.dof_address < 0:
            raise CommandError(f"wrench of '{vehicle.name}': its base has no free joint")
        return cls(
            finite(f"force of '{vehicle.name}'", force, 3),
            finite(f"torque of '{vehicle.name}'", torque, 3),
            frame,
        )

    def is_zero(self) -> bool:
        """Return whether it does nothing."""
        return not (self.force_f.any() or self.torque_f.any())
