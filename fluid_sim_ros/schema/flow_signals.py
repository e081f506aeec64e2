# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Signals of winds and currents in time, the same everywhere but for the profile of the mean."""

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.schema.base import NotNegative, Number, Positive, Strict, Vector
from fluid_sim_ros.schema.flow_model import FlowModel, words


class Signal(FlowModel):
    """A velocity over time; there may be many, which add up."""

    def _keys(self, stream: str) -> dict[str, str]:
        return {f'{stream}_signal': self._terms()}

    def _terms(self) -> str:
        """Return the words of the key."""
        raise NotImplementedError


class Ramp(Signal):
    """From 0 to ``amplitude`` [m/s] between ``start`` [s] and ``start + duration``."""

    model: Literal['ramp']
    amplitude: Vector
    start: NotNegative = 0.0
    duration: Positive

    def _terms(self) -> str:
        return f'ramp {words([*self.amplitude, self.start, self.duration])}'


class Sine(Signal):
    """``amplitude`` [m/s] times sin(2 pi t/period + phase), ``period`` [s], ``phase`` [rad]."""

    model: Literal['sine']
    amplitude: Vector
    period: Positive
    phase: Number = 0.0

    def _terms(self) -> str:
        return f'sine {words([*self.amplitude, self.period, self.phase])}'


class Gust(Signal):
    """
    The 1-cosine gust of MIL-F-8785C, 3.7.2.3: ``amplitude`` [m/s], ``length`` [m] of its rise.

    It rises over ``length / airspeed`` [s] from ``start`` [s] and stays; with ``hold`` [s] it
    falls again as it rose.
    """

    model: Literal['gust']
    amplitude: Vector
    start: NotNegative = 0.0
    length: Positive
    airspeed: Positive
    hold: NotNegative | None = None

    def _terms(self) -> str:
        rise = self.length / self.airspeed
        hold = [] if self.hold is None else [self.hold]
        return f'gust {words([*self.amplitude, self.start, rise, *hold])}'


#: Speed of the main tidal constituents [deg/h]; Pugh (1987), Tides, Surges and Mean Sea-Level.
TIDES = {
    'M2': 28.9841042, 'S2': 30.0, 'N2': 28.4397295, 'K2': 30.0821373,
    'K1': 15.0410686, 'O1': 13.9430356, 'P1': 14.9589314, 'M4': 57.9682084,
}  # fmt: skip


class Constituent(Strict):
    """
    One harmonic of a tide: ``amplitude`` [m/s] times cos(omega t - phase_deg).

    ``name`` is one of ``TIDES``, or ``period_hours`` stands instead.
    """

    name: str | None = None
    period_hours: Positive | None = None
    amplitude: Vector
    phase_deg: Number = 0.0

    @model_validator(mode='after')
    def _one_period(self) -> Self:
        if (self.name is None) == (self.period_hours is None):
            raise ValueError('needs either name or period_hours')
        if self.name is not None and self.name not in TIDES:
            hint = did_you_mean(self.name, TIDES)
            known = listed(TIDES)
            raise ValueError(f"constituent '{self.name}' is not known{hint} known: {known}")
        return self

    def term(self) -> str:
        """Return A cos(omega t - g) as the sine that it is, in the words of fluid_sim.medium."""
        hours = 360.0 / TIDES[self.name] if self.name is not None else self.period_hours or 0.0
        phase = math.pi / 2 - math.radians(self.phase_deg)
        return f'sine {words([*self.amplitude, 3600.0 * hours, phase])}'


class Tide(Signal):
    """A sum of harmonics."""

    model: Literal['tide']
    constituents: Annotated[list[Constituent], Field(min_length=1)]

    def _terms(self) -> str:
        return ' '.join(part.term() for part in self.constituents)
