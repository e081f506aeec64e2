"""Flies a log again: its commands into a fresh simulation, its states compared with the new."""

import json
import math
import platform
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import mujoco

from fluid_sim_ros.errors import CommandError, ConfigError, DivergedError, listed
from fluid_sim_ros.loop.recorder_port import EVENTS
from fluid_sim_ros.messages import commands as command_messages
from fluid_sim_ros.messages import state_topics
from fluid_sim_ros.messages.commands import Commands
from fluid_sim_ros.messages.state_topics import StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.recording.description import RunDescription
from fluid_sim_ros.recording.log import Log, LogMessage
from fluid_sim_ros.recording.replay.compare import Difference, compare
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER, exact

#: What ``changes`` may name. A wind or current holds for the whole flight, in place of those that
#: the scene or a command set.
CHANGES = (*RunSettings.model_fields, 'wind', 'current')


@dataclass
class Resimulation:
    """
    What came of a repetition.

    Attributes
    ----------
    commands, compared
        Command messages fed in, and state messages compared.
    difference
        The first beyond the tolerance, or None.
    largest
        Largest difference of a number per topic, relative to the larger of 1 and the number;
        of topics that were not identical.
    notes
        What a reader must know, such as another version of MuJoCo.
    pairs
        Per kept topic: (simulated time [ns], recorded bytes, new bytes).

    """

    commands: int = 0
    compared: int = 0
    difference: Difference | None = None
    largest: dict[str, float] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    pairs: dict[str, list[tuple[int, bytes, bytes]]] = field(default_factory=dict)


def parse_changes(pairs: Sequence[str]) -> dict[str, Any]:
    """
    Read ``KEY=VALUE`` texts.

    Parameters
    ----------
    pairs
        Texts such as ``timestep=0.001`` or ``wind=1,0,0``.

    Returns
    -------
    dict
        Value by key: a float [s], a text, three floats [m/s], or an int.

    Raises
    ------
    ConfigError
        For a key that is not in ``CHANGES``, or a value that cannot be read.

    """
    changes: dict[str, Any] = {}
    for pair in pairs:
        key, equals, text = pair.partition('=')
        if key not in CHANGES or not equals:
            raise ConfigError(f'--with {pair}: needs KEY=VALUE; keys: {listed(CHANGES)}')
        try:
            if key in ('wind', 'current'):
                changes[key] = [float(part) for part in text.split(',')]
            else:
                changes[key] = getattr(RunSettings.checked('--with {}', **{key: text}), key)
        except ValueError:
            raise ConfigError(f'--with {pair}: the value cannot be read') from None
    return changes


def resimulate(
    log: Log,
    tolerance: float = 0.0,
    changes: Mapping[str, Any] | None = None,
    keep: Sequence[str] = (),
) -> Resimulation:
    """
    Run a log's flight again.

    Parameters
    ----------
    log
        What was recorded.
    tolerance
        Largest difference allowed, relative to the larger of 1 and the recorded number; 0: every
        byte must be the same.
    changes
        What shall be otherwise (see ``CHANGES``): then nothing is compared, only kept.
    keep
        Endings of the topics whose messages the result shall hold.

    Returns
    -------
    Resimulation
        What came of it.

    Raises
    ------
    LogError
        If the log holds no run, or commands of it were lost.

    """
    description = log.description()
    with tempfile.TemporaryDirectory() as folder:
        repetition = _Repetition(description, Path(folder), dict(changes or {}))
        result = Resimulation(notes=_notes(description, log))
        comparer = _Comparer(log, repetition, tolerance, keep, result)
        try:
            for message in log.messages():
                if repetition.take(message):
                    result.commands += 1
                elif message.topic in repetition.states:
                    comparer.take(message)
        except DivergedError as error:
            if not changes:
                raise
            result.notes.append(f'the changed flight ended: {error}')
    return result


class _Repetition:
    """The new simulation, brought along message by message."""

    def __init__(self, description: RunDescription, folder: Path, changes: dict[str, Any]) -> None:
        run = description.run
        self.changed = bool(changes)
        fixed = [stream for stream in ('wind', 'current') if stream in changes]
        settings = RunSettings.checked(
            '--with {}', **{key: changes.get(key, run[key]) for key in RunSettings.model_fields}
        )
        self.simulation = simulation = Simulation(
            _without(description.scene(folder), fixed), **settings.model_dump()
        )
        description.restore(simulation, changed=self.changed)
        for stream in fixed:
            set_stream = simulation.set_wind if stream == 'wind' else simulation.set_current
            set_stream(changes[stream])
        self._settings = state_topics.DEFAULTS | command_messages.DEFAULTS | dict(run['settings'])
        topics = Commands(simulation, self._settings).topics
        commands = {c.name: c for c in topics if c.name not in fixed}
        self._topics = StateTopics(simulation, self._settings)
        by_key = {topic.name: topic for topic in self._topics.topics}
        names: dict[str, str] = run['topics']
        self._commands = {full: commands[key] for full, key in names.items() if key in commands}
        self.states = {full: by_key[key] for full, key in names.items() if key in by_key}
        self._late = [topic for topic in self.states.values() if topic.appears_later]
        self._look_every = math.gcd(*(topic.period for topic in self._late)) or NEVER
        self._look_ahead()
        self._events = {full for full, key in names.items() if key == EVENTS}
        self._recorded_step = exact(run['timestep'])
        self._step = exact(simulation.timestep)
        self._observed = -1

    def take(self, message: LogMessage) -> bool:
        """Apply a message that commands something; return whether it was one."""
        command = self._commands.get(message.topic)
        if command is not None:
            self._advance(message)
            try:
                command.apply(message.data)
            except CommandError:  # it was rejected in flight, too
                return True
            return True
        if message.topic in self._events:
            self._advance(message)
            self._apply(json.loads(message.data[8:-1]))
            return True
        return False

    def state(self, message: LogMessage, topic: StateTopic) -> bytes:
        """Return the new message of a state topic at a recorded message's time."""
        self._advance(message)
        if self._observed != message.step:
            self._observed = message.step
            self._topics.take_state()
        return self._topics.data(topic)

    def _advance(self, message: LogMessage) -> None:
        step = message.step
        if self._step != self._recorded_step:
            # the boundary at or after the recorded one
            step = -int(-(message.step * self._recorded_step) // self._step)
        simulation = self.simulation
        while (now := simulation.step_count) < step:
            to_look = self._look_every - simulation.tick % self._look_every
            simulation.step(min(step - now, to_look))
            self._look_ahead()

    def _look_ahead(self) -> None:
        """Measure what will stand in a later message."""
        tick = self.simulation.tick
        if tick % self._look_every:
            return
        self._topics.take_state()
        for topic in self._late:
            if tick % topic.period == 0:
                self._topics.data(topic)

    def _apply(self, event: dict[str, Any]) -> None:
        simulation = self.simulation
        if 'stale' in event:
            name = event['stale']
            simulation.set_thrust(name, [0.0] * len(simulation.vehicles[name].thrusters))
        if 'timestep' in event:
            simulation.set_timestep(Fraction(event['timestep']))
        settings = event.get('settings', {})
        self._settings.update(settings)
        if 'enable_wind' in settings:
            simulation.enable_wind(settings['enable_wind'])


def _without(scene: Scene, streams: Sequence[str]) -> Scene:
    """Return a scene whose schedule leaves wind or current alone."""
    still = dict.fromkeys(streams)
    events = tuple(event.model_copy(update=still) for event in scene.schedule)
    return replace(scene, schedule=events)


class _Comparer:
    """Compares states, and keeps those that are asked for."""

    def __init__(
        self,
        log: Log,
        repetition: _Repetition,
        tolerance: float,
        keep: Sequence[str],
        result: Resimulation,
    ) -> None:
        self._definitions = {topic.name: topic.definition for topic in log.topics.values()}
        self._repetition = repetition
        self._tolerance = tolerance
        self._result = result
        self._kept = (
            {name for name in repetition.states if name.endswith(tuple(keep))} if keep else ()
        )

    def take(self, message: LogMessage) -> None:
        """Compare one recorded state with the new one."""
        result = self._result
        data = self._repetition.state(message, self._repetition.states[message.topic])
        if data and message.topic in self._kept:
            pairs = result.pairs.setdefault(message.topic, [])
            pairs.append((message.log_ns, message.data, data))
        if self._repetition.changed:
            return
        result.compared += 1
        if data != message.data:
            self._differ(message, data)

    def _differ(self, message: LogMessage, data: bytes) -> None:
        result, definition = self._result, self._definitions[message.topic]
        largest, first = compare(message, data, definition, self._tolerance)
        result.difference = result.difference or first
        result.largest[message.topic] = max(result.largest.get(message.topic, 0.0), largest)


def _notes(description: RunDescription, log: Log) -> list[str]:
    """Return what may explain a difference."""
    versions = description.run['versions']
    notes = [f'damaged log: {fault}' for fault in log.faults]
    if versions['mujoco'] != mujoco.__version__:
        notes.append(f'recorded with MuJoCo {versions["mujoco"]}, this is {mujoco.__version__}')
    machine = f'{platform.system()} {platform.machine()}'
    if versions['machine'] != machine:
        notes.append(f'recorded on {versions["machine"]}, this is {machine}')
    return notes
