# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What control laws share: the time between states, integrals that follow it, and limits."""

from fluid_sim_ros.control.integral import Integral
from fluid_sim_ros.control.timing import StampClock


class ControlLaw:
    """
    A law whose memory is the stamp of the last state and some integrals.

    The integrals start anew when time goes back.

    Parameters
    ----------
    integrals
        All that the law has.

    """

    def __init__(self, *integrals: Integral) -> None:
        self._clock = StampClock()
        self._integrals = integrals

    @property
    def restarted(self) -> bool:
        """True when the last step saw time go back, or was the first."""
        return self._clock.restarted

    def _advance(self, time: float) -> float:
        """Take the integrals on to the stamp of a state [s]; return the time since the last."""
        dt = self._clock.advance(time)
        if self._clock.restarted:
            for integral in self._integrals:
                integral.restart()
        for integral in self._integrals:
            integral.advance(dt)
        return dt


def clamp(value: float, low: float, high: float) -> float:
    """
    Return the nearest number from ``low`` to ``high``.

    Parameters
    ----------
    value, low, high
        Numbers of one unit, ``low`` not above ``high``.

    """
    return min(max(value, low), high)


def within(value: float, bound: float) -> float:
    """
    Return the nearest number from ``-bound`` to ``bound``.

    Parameters
    ----------
    value, bound
        Numbers of one unit, ``bound`` not below 0.

    """
    if value < -bound:
        return -bound
    return bound if value > bound else value
