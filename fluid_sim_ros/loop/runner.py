# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The loop that moves commands into the simulation and states out of it."""

from collections.abc import Callable, Sequence
from typing import Protocol

from fluid_sim_ros.loop.pacing import Pacing, Source
from fluid_sim_ros.loop.request_queue import RequestQueue
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER


class Sink(Protocol):
    """Where states go: written every ``period`` [ticks], at step boundaries, tick 0 included."""

    period: int

    def write(self, simulation: Simulation) -> None:
        """
        Take the state at this step boundary.

        Parameters
        ----------
        simulation
            At the boundary.

        """


class Runner:
    """
    Source -> simulation -> sinks, on one event schedule in ticks (``Simulation.tick``).

    At each boundary: requests of other threads, the boundary's wall time (real-time pacing), the
    sinks that are due, commands in, then steps up to the next boundary. Only the thread in
    ``run`` touches the simulation.

    Parameters
    ----------
    simulation, source, sinks, pacing
        What is run, where commands come from, where states go, and how fast.
    requests
        Work of other threads; None makes a queue of its own.
    housekeeping
        Called at every turn of the loop, also while paused or waiting; must return quickly.

    """

    def __init__(
        self,
        simulation: Simulation,
        source: Source,
        sinks: Sequence[Sink],
        pacing: Pacing,
        requests: RequestQueue | None = None,
        housekeeping: Callable[[], None] = lambda: None,
    ) -> None:
        self.simulation = simulation
        self.source = source
        self.sinks = list(sinks)
        self.pacing = pacing
        self.requests = requests or RequestQueue()
        self.housekeeping = housekeeping
        self.paused = False
        self.stopped = False
        self._written = -1

    def stop(self) -> None:
        """End ``run`` at the next boundary; may be called from any thread."""
        self.stopped = True

    def restart(self) -> None:
        """Note that the simulation's time was set anew (reset, load): write step 0 again."""
        self._written = -1
        self.pacing.begin(self.simulation)

    def run(self, until: int = NEVER) -> None:
        """
        Run until tick ``until``, ``stop``, or an error.

        Parameters
        ----------
        until
            Tick.

        Raises
        ------
        DivergedError
            From the simulation; sinks have then seen the last good boundary.

        """
        self.pacing.begin(self.simulation)
        simulation, requests = self.simulation, self.requests
        while not self.stopped:
            requests.serve()
            self.housekeeping()
            if self.stopped:
                return
            if not self.paused and not self.pacing.is_due(simulation):
                continue
            tick = simulation.tick
            self._write(tick)
            if tick >= until:
                return
            if self.paused:
                requests.idle()
                self.pacing.begin(simulation)
                continue
            pacing = self.pacing  # a request may have changed it
            if not pacing.meet(simulation, self.source):
                continue
            simulation.step(self._advance(until - tick))

    def advance_paused(self, steps: int) -> None:
        """
        Step while paused (a request of another thread), writing what falls due.

        Parameters
        ----------
        steps
            How many.

        """
        simulation = self.simulation
        end = simulation.step_count + steps
        while simulation.step_count < end:
            self.source.poll(simulation)
            simulation.step(self._advance(end - simulation.step_count))
            self._write(simulation.tick)

    def _advance(self, most: int) -> int:
        """Return the number of steps to the next boundary of any sink or of the pacing."""
        # a step is never longer than a tick, so no tick at which a sink is due is jumped over
        tick = self.simulation.tick
        for sink in self.sinks:
            most = min(most, sink.period - tick % sink.period)
        return min(most, self.pacing.steps_left(self.simulation))

    def _write(self, tick: int) -> None:
        if tick == self._written:
            return
        self._written = tick
        for sink in self.sinks:
            if tick % sink.period == 0:
                sink.write(self.simulation)


class NoSource:
    """A source without commands: the scene's own schedule is all that happens."""

    def poll(self, simulation: Simulation) -> None:
        """
        Do nothing.

        Parameters
        ----------
        simulation
            Left alone.

        """
