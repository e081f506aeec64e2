# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The new simulation of a log's flight: it takes the recorded commands and events."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from fluid_sim_ros.errors import CommandError, printable
from fluid_sim_ros.loop.recorder_port import EVENTS
from fluid_sim_ros.messages import commands as command_messages
from fluid_sim_ros.messages import state_topics
from fluid_sim_ros.messages.commands import Commands
from fluid_sim_ros.messages.description_topics import ROBOT_DESCRIPTION
from fluid_sim_ros.messages.state_topics import StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.recording.description import RunDescription
from fluid_sim_ros.recording.log import LogMessage
from fluid_sim_ros.recording.run_file import read_json
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.sensors.reading import IMAGE
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.entities import Entities
from fluid_sim_ros.step_clock import NEVER, exact

_FRACTION = re.compile(r'\d{1,20}(/\d{1,20})?')


class Repetition:
    """
    The new simulation, brought along message by message.

    Parameters
    ----------
    description
        Of the recorded run.
    changes
        What shall be otherwise; see ``resimulate``.

    Attributes
    ----------
    changed
        Whether anything is.
    simulation
        The new one.
    states
        State topics that can be compared, by their full name in the log.

    """

    def __init__(self, description: RunDescription, changes: dict[str, Any]) -> None:
        run = description.run
        self.changed = bool(changes)
        fixed = [stream for stream in ('wind', 'current') if stream in changes]
        settings = RunSettings.checked(
            'run.json: {}', **{key: changes.get(key, run[key]) for key in RunSettings.model_fields}
        )
        self.simulation = simulation = Simulation(
            _without(description.scene(), fixed), **settings.model_dump()
        )
        description.restore(simulation, changed=self.changed)
        for stream in fixed:
            set_stream = simulation.set_wind if stream == 'wind' else simulation.set_current
            set_stream(changes[stream])
        defaults = {**state_topics.DEFAULTS, **command_messages.DEFAULTS}
        self._settings = defaults | run['settings']
        _check_settings(run['settings'], defaults)
        topics = Commands(simulation, self._settings).topics
        commands = {c.name: c for c in topics if c.name not in fixed}
        self._topics = StateTopics(simulation, self._settings)
        names: dict[str, str] = run['topics']
        self._commands = {full: commands[key] for full, key in names.items() if key in commands}
        by_key = {topic.name: topic for topic in self._topics.topics if _can_differ(topic)}
        if has_old_transforms(description):
            del by_key['/tf']
        self.states = {full: by_key[key] for full, key in names.items() if key in by_key}
        self._late = [topic for topic in self.states.values() if topic.appears_later]
        self._look_every = math.gcd(*(topic.period for topic in self._late)) or NEVER
        self._look_ahead()
        self._events = {full for full, key in names.items() if key == EVENTS}
        self._recorded_step = exact(run['timestep'])
        self._step = exact(simulation.timestep)
        self._observed = -1

    def take(self, message: LogMessage) -> bool:
        """
        Apply a message that commands something.

        Parameters
        ----------
        message
            Of the log.

        Returns
        -------
        bool
            Whether it was one.

        Raises
        ------
        FluidSimError
            If it is an event that none of ours can be.

        """
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
            self._apply(read_json(message.data[8:-1], 'an event'))
            return True
        return False

    def state(self, message: LogMessage, topic: StateTopic) -> bytes:
        """
        Return the new message of a state topic at a recorded message's time.

        Parameters
        ----------
        message
            As recorded.
        topic
            One of ``states``.

        Returns
        -------
        bytes
            CDR.

        """
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

    def _place(self, place: Any) -> None:
        """Set pose and twist of a body, as the node's services did."""
        if not isinstance(place, dict):
            raise LogError("an event's place must be a mapping")
        pose, twist = _numbers(place.get('pose'), 7), _numbers(place.get('twist'), 6)
        Entities(self.simulation).place(str(place.get('entity')), pose, twist)

    def _apply(self, event: Any) -> None:
        simulation = self.simulation
        if not isinstance(event, dict):
            raise LogError('an event must be a mapping')
        if 'stale' in event:
            name = str(event['stale'])
            thrusters = simulation.vehicle(name).thrusters
            simulation.set_thrust(name, [0.0] * len(thrusters))
        if 'timestep' in event:
            simulation.set_timestep(_fraction(event['timestep']))
        if 'place' in event:
            self._place(event['place'])
        settings = event.get('settings', {})
        if not isinstance(settings, dict):
            raise LogError("an event's settings must be a mapping")
        _check_settings(settings, self._settings)
        self._settings.update(settings)
        if 'enable_wind' in settings:
            if not isinstance(settings['enable_wind'], bool):
                raise LogError("an event's enable_wind must be true or false")
            simulation.enable_wind(settings['enable_wind'])


def _numbers(values: Any, count: int) -> list[float] | None:
    """Return the numbers of an event; null leaves something as it is."""
    if values is None:
        return None
    if not isinstance(values, list) or len(values) != count:
        raise LogError(f"an event's place needs {count} numbers, or null")
    if not all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
        raise LogError("an event's place must hold numbers")
    return [float(value) for value in values]


def _can_differ(topic: StateTopic) -> bool:
    """
    Return whether a topic tells of the flight.

    A robot description names files of its host, and pictures depend on the graphics driver:
    what was recorded of them stays.
    """
    return topic.type != IMAGE and not topic.name.endswith(f'/{ROBOT_DESCRIPTION}')


def has_old_transforms(description: RunDescription) -> bool:
    """
    Return whether a log is from before ``/tf_static``, so that its ``/tf`` cannot be compared.

    Parameters
    ----------
    description
        Of the recorded run.

    Returns
    -------
    bool
        False also where the log has no ``/tf``.

    """
    run = description.run
    return '/tf' in run['topics'].values() and 'tf.root' not in run['settings']


def _fraction(text: Any) -> Fraction:
    """Return a timestep [s] as the recorder writes it; no exponent, which could be any."""
    if not isinstance(text, str) or not _FRACTION.fullmatch(text):
        raise LogError(f'an event has the timestep {printable(text)}; needs NUMBER/NUMBER')
    return Fraction(text)


def _check_settings(settings: dict[str, Any], known: Mapping[str, Any]) -> None:
    """Refuse settings of another type than those that they stand for."""
    for name, value in settings.items():
        usual = known.get(name)
        number = isinstance(usual, int | float) and not isinstance(usual, bool)
        right = isinstance(value, int | float) if number else isinstance(value, type(usual))
        if usual is not None and not right:
            raise LogError(f"setting '{printable(name)}': {printable(value)} is of another type")


def _without(scene: Scene, streams: Sequence[str]) -> Scene:
    """Return a scene whose schedule leaves wind or current alone."""
    still = dict.fromkeys(streams)
    events = tuple(event.model_copy(update=still) for event in scene.schedule)
    return replace(scene, schedule=events)
