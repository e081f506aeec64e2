# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How fast simulated time passes: free, with the wall clock, or in lockstep with answers."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER, Beat

#: Real-time pacing sleeps no longer than this at once, so that requests are served [s].
_LONGEST_SLEEP = 0.05
#: Real-time pacing gives up catching up beyond this lag and starts its clock anew [s].
_LARGEST_LAG = 0.25
#: Share of the wanted real-time factor below which it is reported.
KEPT_PACE = 0.95


class Source(Protocol):
    """Where commands come from."""

    def poll(self, simulation: Simulation) -> None:
        """
        Apply what has arrived; never blocks.

        Parameters
        ----------
        simulation
            What is commanded.

        """


class LockstepSource(Source, Protocol):
    """A source that can be waited for."""

    def wait(self, simulation: Simulation, timeout: float) -> bool:
        """
        Block until the answer to the present state has come.

        Parameters
        ----------
        simulation
            What is commanded.
        timeout
            Of wall time [s].

        Returns
        -------
        bool
            Whether it has come, and was applied.

        """


@dataclass
class Pacing:
    """How fast simulated time may pass: as it comes (``free``)."""

    def begin(self, simulation: Simulation) -> None:
        """
        Start (again) from the simulation's present time.

        Parameters
        ----------
        simulation
            What is run.

        """

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the most steps that may be taken before the next look at the source.

        Parameters
        ----------
        simulation
            What is run.

        """
        return NEVER

    def is_due(self, simulation: Simulation) -> bool:
        """
        Wait a short while for the boundary's wall time.

        Parameters
        ----------
        simulation
            What is run.

        Returns
        -------
        bool
            False: not yet, serve requests and come back.

        """
        return True

    def meet(self, simulation: Simulation, source: Source) -> bool:
        """
        Take in commands at a boundary.

        Parameters
        ----------
        simulation
            What is run.
        source
            Of the commands.

        Returns
        -------
        bool
            False: do not step yet, serve requests and come back.

        """
        source.poll(simulation)
        return True


@dataclass
class RealTime(Pacing):
    """
    Simulated time follows wall time times ``factor``.

    Attributes
    ----------
    factor
        Simulated seconds per wall second, above 0.
    tick
        Steps between looks at the clock and at the source.
    overruns
        How often the loop lagged by more than 0.25 s of wall time and started its clock anew.

    """

    factor: float = 1.0
    tick: int = 1
    overruns: int = 0
    _wall: float = field(default=0.0, init=False)
    _simulated: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        if not 0 < self.factor < float('inf'):
            raise ConfigError(f'real-time factor {self.factor}: must be finite and above 0')

    def begin(self, simulation: Simulation) -> None:
        """
        Start (again) from the present wall time.

        Parameters
        ----------
        simulation
            What is run.

        """
        self._wall = time.perf_counter()
        self._simulated = simulation.time

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to the next look at the clock.

        Parameters
        ----------
        simulation
            What is run.

        """
        return self.tick - simulation.tick % self.tick

    def is_due(self, simulation: Simulation) -> bool:
        """
        Sleep until the boundary's wall time, a short while at most.

        Parameters
        ----------
        simulation
            What is run.

        Returns
        -------
        bool
            False: not yet, serve requests and come back.

        """
        due = self._wall + (simulation.time - self._simulated) / self.factor
        ahead = due - time.perf_counter()
        if ahead > _LONGEST_SLEEP:  # wake for requests, then come back
            time.sleep(_LONGEST_SLEEP)
            return False
        if ahead > 0:
            time.sleep(ahead)
        elif ahead < -_LARGEST_LAG:
            self.overruns += 1
            self.begin(simulation)
        return True


@dataclass
class Lockstep(Pacing):
    """
    At each beat the loop waits until the source has answered the present state.

    Attributes
    ----------
    beat
        At which steps an answer is waited for.
    on_timeout
        Called each ``patience`` [s] of wall time without an answer; returns True to go on without.
    misses
        How often patience ran out.

    """

    beat: Beat
    on_timeout: Callable[[Simulation], bool] = lambda simulation: False
    patience: float = 0.1
    misses: int = 0
    _asked_at: float = field(default=0.0, init=False)
    _waiting_for: int = field(default=-1, init=False)

    def begin(self, simulation: Simulation) -> None:
        """
        Forget what was waited for.

        Parameters
        ----------
        simulation
            What is run.

        """
        self._waiting_for = -1

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to the next answer.

        Parameters
        ----------
        simulation
            What is run.

        """
        return self.beat.until_next(simulation.step_count)

    def meet(self, simulation: Simulation, source: Source) -> bool:
        """
        Wait for the answer at every step that is due.

        Parameters
        ----------
        simulation
            What is run.
        source
            That is waited for; see ``LockstepSource``.

        Returns
        -------
        bool
            False: not answered, do not step.

        """
        if not self.beat.due(simulation.step_count):
            return True
        if self._waiting_for != simulation.step_count:
            self._waiting_for = simulation.step_count
            self._asked_at = time.perf_counter()
        left = self._asked_at + self.patience - time.perf_counter()
        if source.wait(simulation, max(0.0, left)):  # type: ignore[attr-defined]
            return True
        if time.perf_counter() - self._asked_at < self.patience:
            return False  # woken by a request
        self.misses += 1
        self._asked_at = time.perf_counter()
        return self.on_timeout(simulation)
