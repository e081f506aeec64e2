# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The scene's timed events (wind, current, thrust, disturbances) on the integer step clock."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush

from fluid_sim_ros.errors import CommandError, ConfigError, did_you_mean, listed
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.limits import beyond, limit
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.step_clock import NEVER, rounded_steps


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
    rounded
        A line for each time that is no whole number of timesteps: the event is at the nearest.

    """

    def __init__(self, changes: Sequence[ScheduledEvent], timestep: float) -> None:
        events, lines = [], []
        for change in changes:
            step, line = rounded_steps(change.at, timestep, f'schedule at {change.at:g}')
            events.append(Event(step, change))
            lines += [line] if line else []
        self._scene, self.rounded = tuple(events), tuple(lines)
        self._pending: list[tuple[int, int, Event]] = []  # a heap: step, order of coming, event
        self._added: dict[int, Event] = {}  # of this run and still to come, by order of coming
        self._coming = 0
        self.next_step = NEVER
        self.rewind(0)

    def add(self, event: Event) -> None:
        """
        Add an event of this run.

        Parameters
        ----------
        event
            The event; its step is not past.

        Raises
        ------
        CommandError
            If as many as the limit ``scene_events`` are pending.

        """
        if len(self._added) >= (most := limit('scene_events')):
            raise CommandError(
                str(beyond('scene_events', most, f'an event more than {most} pending ones'))
            )
        self._added[self._coming] = event
        self._push(event)

    def added(self) -> tuple[Event, ...]:
        """Return what was added in this run and is still to come."""
        return tuple(self._added.values())

    def rewind(self, step: int, added: tuple[Event, ...] = ()) -> None:
        """
        Make every event at or after a tick pending.

        Parameters
        ----------
        step
            The present one.
        added
            Those of this run.

        """
        self._pending, self._coming = [], 0
        for event in self._scene:
            if event.step >= step:
                self._push(event)
        self._added = {}
        for event in added:
            if event.step >= step:
                self._added[self._coming] = event
                self._push(event)
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
            _, order, event = heappop(self._pending)
            self._added.pop(order, None)
            due.append(event.change)
            self._update()
        return due

    def _push(self, event: Event) -> None:
        heappush(self._pending, (event.step, self._coming, event))
        self._coming += 1
        self._update()

    def _update(self) -> None:
        self.next_step = self._pending[0][0] if self._pending else NEVER


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
                    f"{at}: vehicle '{name}' is not in the scene"
                    f'{did_you_mean(name, vehicles)} it has: {listed(vehicles)}'
                )
        for name, values in event.thrust.items():
            expected = len(vehicles[name].thrusters)
            if len(values) != expected:
                raise ConfigError(
                    f"{at}: thrust of '{name}' has {len(values)} values; it needs {expected}"
                )
