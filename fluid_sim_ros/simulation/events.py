# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What takes effect at step boundaries: scheduled changes, and gaits."""

from fluid_sim_ros.scene.scene import CompiledScene
from fluid_sim_ros.scene.schedule import Event
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.simulation.commands import Commands


class Events:
    """
    The events of a simulation, counted in ticks (``StepClock``).

    Parameters
    ----------
    compiled
        The scene's schedule and gaits.
    commands
        Where they take effect.

    Attributes
    ----------
    schedule
        Of the scene, and what was added in this run.
    next_stop
        Tick up to which steps may be taken without ``begin_step``.

    """

    def __init__(self, compiled: CompiledScene, commands: Commands) -> None:
        self.schedule = compiled.schedule
        self._commands = commands
        self.next_stop = 0

    def next_change(self, tick: int) -> int:
        """
        Return the tick at which a scheduled event or a gait next takes effect (``NEVER``).

        Parameters
        ----------
        tick
            The present one.

        """
        return min(self.schedule.next_step, self._commands.in_steps.gaits.next_due(tick))

    def begin_step(self, tick: int) -> None:
        """
        Apply what takes effect with the step from here.

        Parameters
        ----------
        tick
            The present one.

        """
        for change in self.schedule.take_due(tick):
            self._commands.apply(change)
        self._commands.in_steps.write_here(tick)
        self.next_stop = min(self.schedule.next_step, self._commands.in_steps.next_here(tick))

    def add(self, tick: int, change: ScheduledEvent) -> None:
        """
        Have a change take effect in this run.

        Parameters
        ----------
        tick
            At which it does.
        change
            What changes.

        Raises
        ------
        CommandError
            If the scene has no such medium; see ``Commands.set_wind``.

        """
        for stream in ('wind', 'current'):
            if getattr(change, stream) is not None:
                self._commands.streams.check(stream)
        self.schedule.add(Event(tick, change))
        self.next_stop = min(self.next_stop, tick)

    def restart(self, tick: int, added: tuple[Event, ...], gaits: tuple[str, ...] | None) -> None:
        """
        Go on from a tick.

        Parameters
        ----------
        tick
            The present one.
        added
            Events that were added to those of the scene.
        gaits
            Names of the vehicles whose gaits run; None: all of the scene.

        """
        self.schedule.rewind(tick, added)
        self._commands.in_steps.run_gaits(gaits)
        self.next_stop = tick
