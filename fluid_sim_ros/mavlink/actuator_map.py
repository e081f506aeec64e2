# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Turns the outputs of an autopilot into commands of a vehicle, as a mapping says."""

import ctypes
import math
import struct
from bisect import bisect_right
from collections.abc import Callable, Sequence
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.mavlink.mapping import ActuatorFile, AutopilotFile
from fluid_sim_ros.physics.t200 import t200_table
from fluid_sim_ros.plugins.exchange import (
    CURVES,
    MOST_OUTPUTS,
    ControlPorts,
    Driven,
    OutputCurve,
    exchange_library,
)
from fluid_sim_ros.scene.vehicle import Vehicle

#: Outputs of a HIL_ACTUATOR_CONTROLS and of the longest servo packet.
OUTPUTS = {'px4': 16, 'ardupilot': MOST_OUTPUTS}
#: An output that drives nothing counts as commanded when it has moved by this share of 1.
_MOVED = 0.05
#: Values of pulse width [us] are larger than this, controls of PX4 are not.
_PULSE = 100.0
#: Every so many answers of the autopilot they are looked through.
_LOOK = 25

Curve = Callable[[float], float]


class ActuatorMap:
    """
    Turns the outputs of an autopilot into commands of a vehicle.

    Parameters
    ----------
    file, path
        The mapping and where it was read.
    vehicle
        What it drives.

    Attributes
    ----------
    driven
        The same for the compiled exchange, which keeps the last outputs and commands in it.
    stray
        Numbers of outputs that moved and drive nothing.

    Raises
    ------
    ConfigError
        If a thruster or joint is not driven exactly once, or an output stands twice.

    """

    def __init__(self, file: AutopilotFile, path: Path, vehicle: Vehicle) -> None:
        outputs = [a.output for a in file.actuators]
        for output in outputs:
            if outputs.count(output) > 1 or output > OUTPUTS[file.protocol]:
                allowed = f'1 to {OUTPUTS[file.protocol]}, each once'
                raise ConfigError(f"{path}: key 'actuators': output {output}; allowed: {allowed}")
        thrusters = {a.thruster: a for a in file.actuators if a.thruster}
        joints = {a.joint: a for a in file.actuators if a.joint}
        _check_all(path, 'thruster', [a.thruster for a in file.actuators], vehicle.thrusters)
        _check_all(path, 'joint', [a.joint for a in file.actuators], vehicle.joints)
        self._thrusters = [
            (thrusters[name].output - 1, _curve(thrusters[name], *limits))
            for name, limits in zip(vehicle.thrusters, vehicle.thrust_range.tolist(), strict=True)
        ]
        self._joints = [
            (joints[name].output - 1, _curve(joints[name], *limits))
            for name, limits in zip(vehicle.joints, vehicle.joint_range.tolist(), strict=True)
        ]
        self._compiled = _Compiled([
            (actuators[name], *limits)
            for actuators, names, ranges in (
                (thrusters, vehicle.thrusters, vehicle.thrust_range),
                (joints, vehicle.joints, vehicle.joint_range),
            )
            for name, limits in zip(names, ranges.tolist(), strict=True)
        ])  # fmt: skip
        self.driven = self._compiled.driven
        self._span = max(a.input[-1] - a.input[0] for a in file.actuators)
        self._watched = sorted(set(range(1, 33)) - {*outputs, *file.ignored})
        self._seen: Sequence[float] = ()
        self._looks = -1
        self.stray: list[int] = []
        self.rest = ([0.0] * len(self._thrusters), [0.0] * len(self._joints))

    def commands(self, outputs: Sequence[float]) -> tuple[list[float], list[float]]:
        """
        Return thrusts [N] and joint commands, each in the vehicle's order.

        Parameters
        ----------
        outputs
            Of the autopilot: control values or pulse widths [us], by number from 1.

        Returns
        -------
        thrusts, joints
            [N], and [rad] or [m] as the joint's actuator takes it.

        """
        commands, count = self._compiled(outputs), len(self._thrusters)
        return commands[:count], commands[count:]

    def drive(self, thrusters: ControlPorts, joints: ControlPorts) -> None:
        """
        Have the compiled exchange write commands.

        Parameters
        ----------
        thrusters, joints
            Where to: ``Simulation.control_ports``.

        """
        self.driven.thrusters, self.driven.joints = thrusters, joints

    @property
    def outputs(self) -> list[float]:
        """The last outputs that became commands; empty before the first."""
        outputs: list[float] = self.driven.outputs[: self.driven.known]
        return outputs

    @property
    def last(self) -> tuple[list[float], list[float]]:
        """The last commands: thrusts [N] and joints; zeros before the first."""
        commands, count = self._compiled.last(), len(self._thrusters)
        return commands[:count], commands[count:]

    def plain_commands(self, outputs: Sequence[float]) -> tuple[list[float], list[float]]:
        """
        Return the same as ``commands``: its twin in Python.

        Parameters
        ----------
        outputs
            See there.

        """
        thrusts = [curve(outputs[place]) for place, curve in self._thrusters]
        return thrusts, [curve(outputs[place]) for place, curve in self._joints]

    def look_for_stray(self) -> int | None:
        """
        Return one of the last outputs that has moved since the first look and drives nothing.

        Once each. Cheap enough for every answer, because it looks at every 25th only.
        """
        self._looks += 1
        if self._looks % _LOOK:
            return None
        outputs = self.outputs
        if len(self._seen) != len(outputs):
            self._seen = outputs
        for number in self._watched:
            if number > len(outputs):
                return None
            moved = abs(outputs[number - 1] - self._seen[number - 1]) > _MOVED * self._span
            if moved and number not in self.stray:
                self.stray.append(number)
                return number
        return None


class _Compiled:
    """All curves in one call of the library."""

    def __init__(self, actuators: list[tuple[ActuatorFile, float, float]]) -> None:
        count = len(actuators)
        self._curves = (OutputCurve * count)()
        self._tables = []  # kept as long as the library reads them
        for curve, (a, low, high) in zip(self._curves, actuators, strict=True):
            rest, ahead, back = _slopes(a)
            curve.place, curve.reversed, curve.silent = a.output - 1, a.reversed, rest >= _PULSE
            curve.kind = CURVES.index(a.curve) if a.thruster else 0
            curve.rest, curve.ahead, curve.back = rest, ahead, back
            curve.low, curve.high = low, high
            if curve.kind == CURVES.index('t200'):
                table = t200_table(a.voltage).T.copy()
                curve.pulses, curve.thrusts = table[0].ctypes.data, table[1].ctypes.data
                curve.points = table.shape[1]
                self._tables.append(table)
        self._commands = (ctypes.c_double * count)()
        self.driven = Driven(
            curves=ctypes.addressof(self._curves), commands=ctypes.addressof(self._commands)
        )
        self._outputs = self.driven.outputs
        self._run = exchange_library().outputs
        self._arguments = (
            ctypes.addressof(self._curves), count, ctypes.addressof(self._outputs),
            ctypes.addressof(self._commands),
        )  # fmt: skip
        self._layouts = {n: struct.Struct(f'={n}d') for n in range(MOST_OUTPUTS + 1)}

    def __call__(self, outputs: Sequence[float]) -> list[float]:
        self._layouts[len(outputs)].pack_into(self._outputs, 0, *outputs)
        self.driven.known = len(outputs)
        self._run(*self._arguments)
        return self.last()

    def last(self) -> list[float]:
        commands: list[float] = self._commands[:]
        return commands


def _check_all(path: Path, kind: str, driven: list[str], existing: Sequence[str]) -> None:
    """Raise unless each of the existing thrusters or joints is driven exactly once."""
    driven = [name for name in driven if name]
    for name in driven:
        if name not in existing:
            raise ConfigError(
                f"{path}: {kind} '{name}' is not in the vehicle"
                f'{did_you_mean(name, existing)} it has: {listed(existing)}'
            )
        if driven.count(name) > 1:
            raise ConfigError(f"{path}: {kind} '{name}' is driven by two outputs")
    missing = [name for name in existing if name not in driven]
    if missing:
        raise ConfigError(
            f'{path}: drives {len(driven)} of {len(existing)} {kind}s; missing: {listed(missing)}'
        )


def _curve(actuator: ActuatorFile, low: float, high: float) -> Curve:
    """Return the command [N or rad] of an output's value, between the actuator's limits."""
    rest, ahead, back = _slopes(actuator)
    silent = rest >= _PULSE  # an output that is off sends no pulse
    command = _by_share(actuator, low, high)

    def curve(value: float) -> float:
        share = 0.0  # also where the value is no number
        if rest < value < math.inf:
            share = min((value - rest) * ahead, 1.0)
        elif -math.inf < value < rest and not (silent and value == 0):
            share = max((value - rest) * back, -1.0)
        return command(share)

    return curve


def _slopes(actuator: ActuatorFile) -> tuple[float, float, float]:
    """Return the value at rest, and the shares of full command per value ahead and back."""
    points = actuator.input
    rest, full = points[-2:]
    back = 1.0 / (rest - points[0]) if len(points) == 3 else 0.0
    return rest, 1.0 / (full - rest), back


def _by_share(actuator: ActuatorFile, low: float, high: float) -> Curve:
    """Return the command [N or rad] of a share of full command, -1 to 1."""
    if actuator.reversed:
        plain = _by_share(actuator.model_copy(update={'reversed': False}), low, high)
        return lambda share: plain(-share)
    if actuator.thruster and actuator.curve == 't200':
        pulses, thrusts = t200_table(actuator.voltage).T.tolist()
        # the table is the T200's; the limits are those of the model's thruster
        return lambda share: min(
            max(_interpolate(1500.0 + 400.0 * share, pulses, thrusts), low), high
        )
    if actuator.thruster and actuator.curve == 'rotor_speed':
        return lambda share: share * share * (high if share >= 0 else low)
    return lambda share: share * (high if share >= 0 else -low)


def _interpolate(x: float, xs: Sequence[float], ys: Sequence[float]) -> float:
    """Return y at x between points; the first and the last y beyond them."""
    i = bisect_right(xs, x)
    if i == 0:
        return ys[0]
    if i == len(xs):
        return ys[-1]
    return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])
