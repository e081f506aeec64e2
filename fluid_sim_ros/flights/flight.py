# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The one form of a flight: signals in SI units, ENU and FLU axes, on one clock.

A reader of a format makes a ``RawLog``: streams of named columns, as they stand in the log. A
mapping says which columns are which quantity, in what unit and axes; ``Flight`` holds the result.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.physics.arrays import Array

Flags = NDArray[np.bool_]


class FlightError(FluidSimError):
    """A log of a flight cannot be read or used; the message says why and what to do."""


@dataclass(frozen=True)
class Quantity:
    """What a signal can be: how many numbers (0: any), unit, axes and words for people."""

    size: int
    unit: str
    axes: str
    what: str


#: Axes: ``world`` (map, ENU), ``body`` (base_link, FLU), ``attitude`` (world from body), or none.
QUANTITIES: dict[str, Quantity] = {
    'position': Quantity(3, 'm', 'world', 'place of base_link'),
    'attitude': Quantity(4, '-', 'attitude', 'quaternion w x y z, map from base_link'),
    'velocity': Quantity(3, 'm/s', 'world', 'velocity of base_link'),
    'rates': Quantity(3, 'rad/s', 'body', 'angular velocity'),
    'specific_force': Quantity(3, 'm/s^2', 'body', 'what an accelerometer feels, +g at rest'),
    'wind': Quantity(3, 'm/s', 'world', 'velocity that the air or water moves toward'),
    'rotor_speed': Quantity(0, 'rad/s', '', 'measured speed of each rotor'),
    'thrust': Quantity(0, 'N', '', 'commanded thrust of each thruster'),
    'pulse': Quantity(0, 'us', '', 'pulse width to each motor controller'),
    'normalized': Quantity(0, '-', '', 'command of each motor, 0 to 1 or -1 to 1'),
    'battery': Quantity(1, 'V', '', 'voltage of the battery'),
}
#: What drives a model, the most direct first.
ACTUATORS = ('rotor_speed', 'thrust', 'normalized', 'pulse')
#: What a comparison starts from and judges by.
STATE = ('position', 'attitude', 'velocity', 'rates')


@dataclass(frozen=True)
class Stream:
    """
    Columns of a log on one clock, as they stand there.

    Attributes
    ----------
    times
        [s], shape (n,).
    columns
        Name -> numbers in the unit and axes of the log, shape (n,).

    """

    times: Array
    columns: Mapping[str, Array]


@dataclass(frozen=True)
class RawLog:
    """
    What a reader found in a file.

    Attributes
    ----------
    path, kind
        The file, and its format in words.
    format
        Of the mapping that fits by default: ``px4``, ``ardupilot``, ``bitcraze``, ``ros``,
        ``table``.
    streams
        Name -> its columns.
    about
        Facts of the log for people (vehicle, software).
    faults
        What is damaged or was lost, a line each.

    """

    path: Path
    kind: str
    format: str
    streams: Mapping[str, Stream]
    about: Mapping[str, str] = field(default_factory=dict)
    faults: tuple[str, ...] = ()


@dataclass(frozen=True)
class Signal:
    """
    One quantity over time.

    Attributes
    ----------
    quantity
        A key of ``QUANTITIES``.
    times
        [s] from the begin of the flight, rising, shape (n,).
    values
        In the unit and axes of the quantity, shape (n, size).
    source
        Stream and columns of the log.
    names
        Of the columns; for actuators those of the thrusters where the log or the mapping says.
    stated
        Unit and axes in the log, such as ``deg/s frd``.
    truth
        Whether a simulator wrote it, not an estimator or a sensor.
    command
        Whether it is exactly what was commanded, from its time on: it drives a model before
        everything that was measured.
    gaps
        (begin, end) of each hole [s].
    outliers
        Samples that jump away from their neighbours, shape (n,).
    dropped
        How many samples were not used, by reason.

    """

    quantity: str
    times: Array
    values: Array
    source: str
    names: tuple[str, ...] = ()
    stated: str = ''
    truth: bool = False
    command: bool = False
    gaps: tuple[tuple[float, float], ...] = ()
    outliers: Flags = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    dropped: Mapping[str, int] = field(default_factory=dict)

    @property
    def rate(self) -> float:
        """Samples a second, by the median distance of two [Hz]."""
        if len(self.times) < 2:
            return 0.0
        return float(1.0 / np.median(np.diff(self.times)))

    def covers(self, begin: float, end: float) -> bool:
        """
        Return whether the signal holds from one time to another, without a gap.

        Parameters
        ----------
        begin, end
            [s].

        """
        if not len(self.times) or begin < self.times[0] - 1e-9:
            return False
        if self.command:  # holds until the next, however late it comes
            return True
        if end > self.times[-1] + 1e-9:
            return False
        return not any(start < end and stop > begin for start, stop in self.gaps)

    def between(self, times: Array) -> Array:
        """
        Return the signal at given times, linear between samples.

        Parameters
        ----------
        times
            [s], shape (m,); beyond the ends the first or last sample holds.

        Returns
        -------
        Array
            Shape (m, size).

        """
        return np.stack([np.interp(times, self.times, v) for v in self.values.T], axis=1)

    def held(self, times: Array) -> Array:
        """
        Return the last sample at or before given times: what a command is.

        Parameters
        ----------
        times
            [s], shape (m,).

        Returns
        -------
        Array
            Shape (m, size).

        """
        place = np.searchsorted(self.times, np.asarray(times) + 1e-9, side='right') - 1
        held: Array = self.values[np.clip(place, 0, len(self.times) - 1)]
        return held


@dataclass(frozen=True)
class Flight:
    """
    A flight in the one form.

    Attributes
    ----------
    raw
        What it was read from.
    signals
        Quantity -> signal; where a simulator wrote the truth, that.
    begin
        Time of the log at which the flight's clock is 0 [s].
    vehicle
        Of the mapping: the vehicle of a scene; '' where it does not say.
    notes
        What a reader must know: what was dropped, what is ambiguous; a line each.

    """

    raw: RawLog
    signals: Mapping[str, Signal]
    begin: float = 0.0
    vehicle: str = ''
    notes: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The file's name."""
        return self.raw.path.name

    @property
    def actuators(self) -> Signal | None:
        """What drives a model: a stated command, else the most direct of the actuator signals."""
        there = [self.signals[q] for q in ACTUATORS if q in self.signals]
        return next((s for s in there if s.command), there[0] if there else None)

    @property
    def missing(self) -> tuple[str, ...]:
        """What a comparison lacks, a line each."""
        lines = [f'{q}: {QUANTITIES[q].what}' for q in STATE if q not in self.signals]
        if self.actuators is None:
            lines.append(f'actuators: one of {", ".join(ACTUATORS)}')
        return tuple(lines)
