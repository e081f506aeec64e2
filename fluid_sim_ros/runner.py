"""The loop that moves commands into the simulation and states out of it, at one of three paces."""

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

from fluid_sim_ros.environment import NEVER, exact, whole_steps
from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.simulation import Simulation

Result = TypeVar('Result')

#: How long a paused or waiting loop sleeps between looks at its requests [s].
_IDLE_WAIT = 0.05
#: Real-time pacing gives up catching up beyond this lag and starts its clock anew [s].
_LARGEST_LAG = 0.25


class Source(Protocol):
    """Where commands come from."""

    def poll(self, simulation: Simulation) -> None:
        """Apply what has arrived; never blocks."""


class LockstepSource(Source, Protocol):
    """A source that can be waited for."""

    def wait(self, simulation: Simulation, timeout: float) -> bool:
        """Block up to ``timeout`` [s] for the answer to the present state; True when applied."""


class Sink(Protocol):
    """Where states go: written every ``period`` [steps], at step boundaries, step 0 included."""

    period: int

    def write(self, simulation: Simulation) -> None:
        """Take the state at this step boundary."""


class RequestQueue:
    """Work that other threads want done between two steps (reset, pause, parameter changes)."""

    def __init__(self, on_arrival: Callable[[], None] = lambda: None) -> None:
        self._waiting: deque[tuple[Callable[[], object], Future[object]]] = deque()
        self._arrived = threading.Event()
        self._on_arrival = on_arrival
        self._closed = False

    def call(self, work: Callable[[], Result], timeout: float) -> Result:
        """
        Have the stepping thread run ``work`` at its next step boundary and return its result.

        Raises
        ------
        FluidSimError
            If the loop has ended, or does not answer within ``timeout`` [s].

        """
        if self._closed:
            raise FluidSimError('the simulation loop has ended')
        future: Future[object] = Future()
        self._waiting.append((work, future))
        self._arrived.set()
        self._on_arrival()
        try:
            return future.result(timeout)  # type: ignore[return-value]
        except TimeoutError:
            if future.cancel():
                raise FluidSimError(
                    f'the simulation loop did not answer within {timeout:g} s'
                ) from None
            return future.result(timeout)  # type: ignore[return-value]

    def serve(self) -> None:
        """Run what waits; called by the stepping thread only."""
        while self._waiting:
            work, future = self._waiting.popleft()
            if not future.set_running_or_notify_cancel():
                continue
            try:
                future.set_result(work())
            except Exception as error:  # noqa: BLE001 - the caller in the other thread gets it
                future.set_exception(error)
        self._arrived.clear()

    def idle(self) -> None:
        """Sleep until a request arrives, a short while at most."""
        if not self._waiting:
            self._arrived.wait(_IDLE_WAIT)

    def close(self) -> None:
        """Refuse new requests and end those that wait."""
        self._closed = True
        while self._waiting:
            _, future = self._waiting.popleft()
            future.cancel()


@dataclass
class Pacing:
    """How fast simulated time may pass: as it comes (``free``)."""

    def begin(self, simulation: Simulation) -> None:
        """Start (again) from the simulation's present time."""

    def longest_advance(self) -> int:
        """Return the most steps that may be taken before the next look at the source."""
        return NEVER

    def is_due(self, simulation: Simulation) -> bool:
        """Wait a short while for the boundary's wall time; False: not yet, serve requests."""
        return True

    def meet(self, simulation: Simulation, source: Source) -> bool:
        """Take in commands at a boundary; False: do not step yet, come back after requests."""
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
        self._wall = time.perf_counter()
        self._simulated = simulation.time

    def longest_advance(self) -> int:
        return self.tick

    def is_due(self, simulation: Simulation) -> bool:
        due = self._wall + (simulation.time - self._simulated) / self.factor
        ahead = due - time.perf_counter()
        if ahead > _IDLE_WAIT:  # wake for requests, then come back
            time.sleep(_IDLE_WAIT)
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
    Every ``period`` steps the loop waits until the source has answered the present state.

    Attributes
    ----------
    period
        Steps between two answers.
    on_timeout
        Called each ``patience`` [s] of wall time without an answer; returns True to go on without.
    misses
        How often patience ran out.

    """

    period: int
    on_timeout: Callable[[Simulation], bool] = lambda simulation: False
    patience: float = 0.1
    misses: int = 0
    _asked_at: float = field(default=0.0, init=False)
    _waiting_for: int = field(default=-1, init=False)

    def begin(self, simulation: Simulation) -> None:
        self._waiting_for = -1

    def longest_advance(self) -> int:
        return self.period

    def meet(self, simulation: Simulation, source: Source) -> bool:
        if simulation.step_count % self.period:
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


class Runner:
    """
    Source -> simulation -> sinks, on one event schedule in whole steps.

    At each boundary: requests of other threads, the boundary's wall time (real-time pacing), the
    sinks that are due, commands in, then steps up to the next boundary. Only the thread in ``run`` touches the simulation.

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
        Run until step ``until``, ``stop``, or an error.

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
            step = simulation.step_count
            if not self.paused and not self.pacing.is_due(simulation):
                continue
            self._write(step)
            if step >= until:
                return
            if self.paused:
                requests.idle()
                self.pacing.begin(simulation)
                continue
            pacing = self.pacing  # a request may have changed it
            if not pacing.meet(simulation, self.source):
                continue
            simulation.step(self._advance(step, min(until - step, pacing.longest_advance())))

    def advance_paused(self, steps: int) -> None:
        """Step while paused (a request of another thread), writing what falls due."""
        simulation = self.simulation
        end = simulation.step_count + steps
        while simulation.step_count < end:
            step = simulation.step_count
            self.source.poll(simulation)
            simulation.step(self._advance(step, end - step))
            self._write(simulation.step_count)

    def _advance(self, step: int, most: int) -> int:
        """Return the number of steps to the next boundary of any sink or of the pacing."""
        for sink in self.sinks:
            most = min(most, sink.period - step % sink.period)
        pace = self.pacing.longest_advance()
        if pace < NEVER:
            most = min(most, pace - step % pace)
        return most

    def _write(self, step: int) -> None:
        if step == self._written:
            return
        self._written = step
        for sink in self.sinks:
            if step % sink.period == 0:
                sink.write(self.simulation)


class NoSource:
    """A source without commands: the scene's own schedule is all that happens."""

    def poll(self, simulation: Simulation) -> None:
        """Do nothing."""


def period_steps(rate_hz: float, timestep: float, what: str) -> int:
    """
    Return the number of steps between two outputs at a rate.

    Raises
    ------
    ConfigError
        If the rate is not above 0 or does not divide the step rate.

    """
    if not rate_hz > 0:
        raise ConfigError(f'{what}: rate {rate_hz:g} Hz must be above 0')
    steps = 1 / (exact(rate_hz) * exact(timestep))
    if steps.denominator != 1:
        highest = float(1 / exact(timestep))
        raise ConfigError(
            f'{what}: rate {rate_hz:g} Hz does not divide the step rate of {highest:g} Hz'
        )
    return steps.numerator


def duration_steps(seconds: float, timestep: float) -> int:
    """Return the step at which a run of ``seconds`` ends; 0 s means never."""
    return whole_steps(seconds, timestep, 'duration') if seconds else NEVER
