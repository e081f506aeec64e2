# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Simulated time in whole steps, kept exactly, also where the timestep changes on the way."""

import math
from dataclasses import dataclass
from fractions import Fraction

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.step_clock.durations import exact


@dataclass(frozen=True)
class Pace:
    """Steps of ``timestep_ns`` from step ``first`` on, at which the time was ``begin_ns`` [ns]."""

    timestep_ns: Fraction
    first: int = 0
    begin_ns: Fraction = Fraction(0)


class StepClock:
    """
    Turns steps into time and into ticks.

    A tick is the timestep that the scene states: what is due at a rate, or at a time of the scene,
    is counted in ticks. As long as the timestep is the scene's, the tick is the step.

    Parameters
    ----------
    timestep
        Of the scene [s].

    """

    def __init__(self, timestep: float) -> None:
        self._tick_ns = exact(timestep) * 1_000_000_000
        self.restart()

    def restart(self) -> None:
        """Go back to time 0 and to the scene's timestep."""
        self.load(None)

    def retime(self, step: int, timestep: Fraction) -> None:
        """
        Have later steps take another timestep.

        Parameters
        ----------
        step
            The present step.
        timestep
            Of the steps from here on [s], not above a tick.

        Raises
        ------
        ConfigError
            If it is not above 0, or longer than a tick.

        """
        tick = self._tick_ns / 1_000_000_000
        if not 0 < timestep <= tick:
            raise ConfigError(
                f'timestep {float(timestep):g} s: must be above 0, and not longer than the '
                f"scene's ({float(tick):g} s)"
            )
        begin_ns = Fraction(self._numerator(step), self._denominator)
        self.load(Pace(timestep * 1_000_000_000, step, begin_ns))

    def save(self) -> Pace:
        """Return what the time of every later step follows from."""
        return self._pace

    def load(self, pace: Pace | None) -> None:
        """
        Go on from a saved pace.

        Parameters
        ----------
        pace
            As ``save`` returned it; None: the scene's timestep all along.

        """
        pace = pace or Pace(self._tick_ns)
        self._pace = pace
        self.retimed = pace != Pace(self._tick_ns)
        # time [ns] = (base + (step - first) growth) / denominator, in whole numbers
        length, begin = pace.timestep_ns, pace.begin_ns
        self._denominator = math.lcm(length.denominator, begin.denominator)
        self._growth = length.numerator * (self._denominator // length.denominator)
        self._base = begin.numerator * (self._denominator // begin.denominator)
        self._first = pace.first
        # a tick in the unit of the numerator below
        self._per_tick = self._denominator * self._tick_ns.numerator
        self._tick_part = self._tick_ns.denominator

    @property
    def timestep(self) -> float:
        """The present timestep [s]."""
        return float(self._pace.timestep_ns / 1_000_000_000)

    def time(self, step: int) -> float:
        """
        Return the time of a step [s].

        Parameters
        ----------
        step
            Number of steps since time 0.

        """
        return self._numerator(step) / self._denominator * 1e-9

    def time_ns(self, step: int) -> int:
        """
        Return the time of a step [ns], rounded once from the exact number.

        Parameters
        ----------
        step
            Number of steps since time 0.

        """
        return (self._numerator(step) + self._denominator // 2) // self._denominator

    def tick(self, step: int) -> int:
        """
        Return the whole ticks that have passed at a step.

        Parameters
        ----------
        step
            Number of steps since time 0.

        """
        if not self.retimed:
            return step
        return self._numerator(step) * self._tick_part // self._per_tick

    def step_at(self, tick: int) -> int:
        """
        Return the first step at or after a tick.

        Parameters
        ----------
        tick
            Not before the one at which the present pace began.

        """
        if not self.retimed:
            return tick
        ahead = tick * self._per_tick - self._base * self._tick_part
        return self._first - -ahead // (self._growth * self._tick_part)

    def tick_at(self, time_ns: int) -> int:
        """
        Return the first tick at or after a time [ns].

        Parameters
        ----------
        time_ns
            Simulated time [ns].

        """
        return math.ceil(time_ns / self._tick_ns)

    def _numerator(self, step: int) -> int:
        return self._base + (step - self._first) * self._growth
