# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What recurs at a rate, counted in steps."""

import math
from fractions import Fraction

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.step_clock.durations import exact


class Beat:
    """
    What recurs at a rate: due at the step boundary nearest to each multiple of its interval.

    The average rate is exact, also where the interval is no whole number of steps.

    Parameters
    ----------
    interval
        Steps between two, 1 or more.

    Attributes
    ----------
    period
        Of it, every step that is due is a multiple: the interval if that is whole, otherwise 1.
    whole
        Whether the interval is a whole number of steps.
    ratio
        Numerator and denominator of the interval.
    longest
        The most steps between two.

    """

    def __init__(self, interval: Fraction) -> None:
        self.ratio = self._p, self._q = interval.numerator, interval.denominator
        self.whole = self._q == 1
        self.period = self._p if self.whole else 1
        self.longest = math.ceil(interval)

    @classmethod
    def at_rate(cls, rate_hz: float | Fraction, timestep: float, what: str) -> 'Beat':
        """
        Return the beat of a rate.

        Parameters
        ----------
        rate_hz
            [Hz].
        timestep
            [s].
        what
            Beginning of the error's message: which rate it is.

        Raises
        ------
        ConfigError
            If the rate is not above 0, or above the step rate.

        """
        if not rate_hz > 0:
            raise ConfigError(f'{what}: rate {float(rate_hz):g} Hz must be above 0')
        interval = 1 / (exact(rate_hz) * exact(timestep))
        if interval < 1:
            highest = float(1 / exact(timestep))
            raise ConfigError(
                f'{what}: rate {float(rate_hz):g} Hz is above the step rate; allowed is at most '
                f'{highest:g} Hz, or a timestep of at most {1 / float(rate_hz):.4g} s'
            )
        return cls(interval)

    def index(self, step: int) -> int:
        """
        Return how many were due before a step: the number of the one due then, from 0.

        Parameters
        ----------
        step
            0 or more.

        """
        # the k-th is due at floor(k p / q + 1/2): the first k with 2 k p >= (2 step - 1) q
        return -((1 - 2 * step) * self._q // (2 * self._p))

    def due(self, step: int) -> bool:
        """
        Return whether one is due at a step.

        Parameters
        ----------
        step
            0 or more.

        """
        if self.whole:
            return step % self._p == 0
        return self._place(self.index(step)) == step

    def until_next(self, step: int) -> int:
        """
        Return the steps from a step to the next one that is due after it.

        Parameters
        ----------
        step
            0 or more.

        """
        return self._place(self.index(step + 1)) - step

    def _place(self, index: int) -> int:
        return (2 * index * self._p + self._q) // (2 * self._q)
