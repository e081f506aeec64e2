"""The scene's timed events (wind, current, thrust, disturbances) on the integer step clock."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.scene_schema import ScheduledEvent

#: A step number that no run reaches.
NEVER = 1 << 62


def exact(value: float) -> Fraction:
    """Return the decimal number that a person wrote, exactly (``0.002`` -> 1/500)."""
    return Fraction(repr(float(value)))


def whole_steps(seconds: float, timestep: float, what: str) -> int:
    """
    Return how many steps a duration takes.

    Raises
    ------
    ConfigError
        If the duration is not a whole number of timesteps.

    """
    steps = exact(seconds) / exact(timestep)
    if steps.denominator != 1:
        raise ConfigError(
            f'{what}: {seconds:g} s is not a whole number of timesteps of {timestep:g} s'
        )
    return steps.numerator


@dataclass(frozen=True)
class Event:
    """A scheduled change and the step at whose start it takes effect."""

    step: int
    change: ScheduledEvent


class Schedule:
    """Scene events in the order of their steps; ``next_step`` is what the step loop looks at."""

    def __init__(self, changes: Sequence[ScheduledEvent], timestep: float) -> None:
        self._events = sorted(
            (Event(whole_steps(c.at, timestep, f'schedule at {c.at:g}'), c) for c in changes),
            key=lambda event: event.step,
        )
        self.next_step = NEVER
        self.rewind(0)

    def rewind(self, step: int) -> None:
        """Make every event at or after ``step`` pending again."""
        self._position = sum(event.step < step for event in self._events)
        self._update()

    def take_due(self, step: int) -> list[ScheduledEvent]:
        """Return the changes that take effect at or before ``step`` and mark them done."""
        due = []
        while self.next_step <= step:
            due.append(self._events[self._position].change)
            self._position += 1
            self._update()
        return due

    def _update(self) -> None:
        pending = self._position < len(self._events)
        self.next_step = self._events[self._position].step if pending else NEVER
