# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is said and done when an autopilot that has answered does not answer any more."""

from fluid_sim_ros.errors import AutopilotError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.counters import Counters

#: A silence of this length is reported [s] of wall time; it is also how long another ArduPilot is
#: kept away from the vehicle of one that is silent.
REPORT_AFTER = 1.0


class Silence:
    """
    One silence after another of one autopilot.

    Parameters
    ----------
    name
        What people call the autopilot.
    options
        How long it is waited for, and what follows.
    surroundings, counters
        Where it is reported and counted.

    Attributes
    ----------
    reported
        It is silent for so long that this was said.
    given_up
        It was waited for long enough, and simulated time goes on without it.

    """

    def __init__(
        self, name: str, options: AutopilotOptions, surroundings: Surroundings, counters: Counters
    ) -> None:
        self._name, self._options = name, options
        self._surroundings, self._counters = surroundings, counters
        self.reported = self.given_up = False
        self._held = False  # the rule was stated

    def lasts(self, seconds: float) -> bool:
        """
        Note how long it is silent by now.

        Parameters
        ----------
        seconds
            Of wall time since it was asked, or heard.

        Returns
        -------
        bool
            Whether simulated time goes on without it.

        Raises
        ------
        AutopilotError
            If the time is over and the rule is ``stop``.

        """
        if self.given_up:
            return True
        if seconds < REPORT_AFTER:
            return False
        if not self.reported:
            self.reported = True
            self._counters.gone += 1
            self._surroundings.report(
                'gone', f'{self._name}: no answer for {REPORT_AFTER:g} s; simulated time waits'
            )
        if seconds < self._options.timeout or self._held:
            return False
        return self._time_is_over()

    def absent(self, seconds: float) -> None:
        """
        Note how long nobody is connected where somebody was.

        Simulated time then stands still, for a new process begins at the start anyway.

        Parameters
        ----------
        seconds
            Of wall time since the connection was lost.

        Raises
        ------
        AutopilotError
            If the time is over and the rule is ``stop``.

        """
        if self._options.on_timeout == 'stop' and seconds >= self._options.timeout:
            raise AutopilotError(f'{self._name}: gone for {self._options.timeout:g} s: stopped')

    def give_up(self, line: str) -> None:
        """
        Go on without it, whatever the rule.

        Parameters
        ----------
        line
            Why.

        """
        self.reported = self.given_up = True
        self._surroundings.report('given up', f'{self._name}: {line}')

    def ends(self, seconds: float) -> None:
        """
        Note that it answers.

        Parameters
        ----------
        seconds
            How long it was silent.

        """
        if self.reported:
            self._surroundings.inform(f'{self._name} answers again after {seconds:.1f} s')
        self.forget()

    def forget(self) -> None:
        """Begin anew, as with another process."""
        self.reported = self.given_up = self._held = False

    def _time_is_over(self) -> bool:
        line = f'no answer for {self._options.timeout:g} s'
        if self._options.on_timeout == 'stop':
            raise AutopilotError(f'{self._name}: {line}: stopped')
        if self._options.on_timeout == 'continue':
            self.give_up(f'{line}: thrust to rest, going on at real time')
            return True
        self._held = True
        self._surroundings.report('given up', f'{self._name}: {line}: still waiting')
        return False
