"""What takes effect at step boundaries: scheduled changes, gaits, and wrenches that turn along."""

from fluid_sim_ros.scene.scene import CompiledScene
from fluid_sim_ros.scene.schedule import Event
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.simulation.commands import Commands
from fluid_sim_ros.simulation.engine import Engine


class Events:
    """
    The events of a simulation, counted in ticks (``StepClock``).

    Parameters
    ----------
    engine
        Model and data.
    compiled
        The scene's schedule and gaits.
    commands
        Where they take effect.

    Attributes
    ----------
    schedule, gaits
        Of the scene; the schedule also holds what was added in this run.

    """

    def __init__(self, engine: Engine, compiled: CompiledScene, commands: Commands) -> None:
        self.schedule, self.gaits = compiled.schedule, compiled.gaits
        self._commands = commands
        self._control = engine.data.ctrl

    @property
    def next_change(self) -> int:
        """Tick at which a scheduled event or a gait next takes effect."""
        return min(self.schedule.next_step, self.gaits.next_step)

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
        self.gaits.write_due(tick, self._control)
        self._commands.write_wrenches()

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
        self.gaits.restart(tick, gaits)
