"""The scene's timed events (wind, current, thrust, disturbances) on the integer step clock."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.step_clock import NEVER, whole_steps


@dataclass(frozen=True)
class Event:
    """A scheduled change and the step at whose start it takes effect."""

    step: int
    change: ScheduledEvent


class Schedule:
    """
    Events in the order of their steps; ``next_step`` is all that the step loop looks at.

    The scene's own events return with every reset; those added at run time do not.

    Parameters
    ----------
    changes
        The scene's own events.
    timestep
        Of the scene [s].

    Attributes
    ----------
    next_step
        Tick at which the next event takes effect.

    Raises
    ------
    ConfigError
        If an event is not at a whole number of timesteps.

    """

    def __init__(self, changes: Sequence[ScheduledEvent], timestep: float) -> None:
        self._scene = tuple(
            Event(whole_steps(c.at, timestep, f'schedule at {c.at:g}'), c) for c in changes
        )
        self.next_step = NEVER
        self._added: tuple[Event, ...] = ()
        self._pending: list[Event] = []
        self.rewind(0)

    def add(self, event: Event) -> None:
        """
        Add an event of this run.

        Parameters
        ----------
        event
            What changes, and at which tick.

        """
        self._added = (*self._added, event)
        self._pending = self._sorted([*self._pending, event])
        self._update()

    def added(self) -> tuple[Event, ...]:
        """Return what was added in this run."""
        return self._added

    def rewind(self, step: int, added: tuple[Event, ...] = ()) -> None:
        """
        Make every event at or after a tick pending.

        Parameters
        ----------
        step
            The tick.
        added
            Events of this run.

        """
        self._added = added
        self._pending = self._sorted(e for e in (*self._scene, *added) if e.step >= step)
        self._update()

    def take_due(self, step: int) -> list[ScheduledEvent]:
        """
        Return the changes that take effect by now, and mark them done.

        Parameters
        ----------
        step
            The present tick.

        Returns
        -------
        list
            Of the changes, in order.

        """
        due = []
        while self.next_step <= step:
            due.append(self._pending.pop(0).change)
            self._update()
        return due

    def _update(self) -> None:
        self.next_step = self._pending[0].step if self._pending else NEVER

    @staticmethod
    def _sorted(events: Iterable[Event]) -> list[Event]:
        return sorted(events, key=lambda event: event.step)


def check_schedule(
    changes: Sequence[ScheduledEvent], vehicles: Mapping[str, Vehicle], where: str
) -> None:
    """
    Refuse events of unknown vehicles, or thrust of the wrong length.

    Parameters
    ----------
    changes
        Of the scene.
    vehicles
        Those that there are, by name.
    where
        What an error begins with.

    Raises
    ------
    ConfigError
        For the first such event, with its time.

    """
    for event in changes:
        at = f'{where}: schedule at {event.at:g} s'
        for name in (*event.thrust, *event.wrench):
            if name not in vehicles:
                raise ConfigError(
                    f"{at}: vehicle '{name}' is not in the scene; it has: {listed(vehicles)}"
                )
        for name, values in event.thrust.items():
            expected = len(vehicles[name].thrusters)
            if len(values) != expected:
                raise ConfigError(
                    f"{at}: thrust of '{name}' has {len(values)} values; it needs {expected}"
                )
