# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Time between control steps, from stamps of the states (never from a clock on the wall)."""

#: A longer gap than this is a lost message, not a control period [s].
LONGEST_PERIOD = 0.1


class StampClock:
    """
    Turns stamps into control periods.

    Attributes
    ----------
    restarted
        True when the last stamp was the first or lay before the one before it (a reset of the
        simulation): integrators have to start anew.

    """

    def __init__(self) -> None:
        self._last: float | None = None
        self.restarted = True

    def advance(self, stamp: float) -> float:
        """
        Return the time since the last stamp [s], between 0 and ``LONGEST_PERIOD``.

        A repeated stamp gives 0, so that the answer to a repeated state is the same answer.

        Parameters
        ----------
        stamp
            Of the present state [s].

        Returns
        -------
        float
            [s].

        """
        last, self._last = self._last, stamp
        self.restarted = last is None or stamp < last
        if self.restarted or last is None:
            return 0.0
        return min(stamp - last, LONGEST_PERIOD)
