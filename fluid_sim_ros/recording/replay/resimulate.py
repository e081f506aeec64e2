# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flies a log again: its commands into a fresh simulation, its states compared with the new."""

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import mujoco

from fluid_sim_ros.errors import ConfigError, DivergedError, listed
from fluid_sim_ros.recording.damage import reading
from fluid_sim_ros.recording.description import RunDescription
from fluid_sim_ros.recording.log import Log, LogMessage
from fluid_sim_ros.recording.model.trial import try_model
from fluid_sim_ros.recording.replay.compare import Difference, compare
from fluid_sim_ros.recording.replay.repetition import Repetition, has_old_transforms
from fluid_sim_ros.schema.limits import beyond, limit
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.sensors.reading import IMAGE

#: Steps that a message allows for: a log has at least one for each second or so of flight.
_STEPS_PER_MESSAGE = 1000
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
        If the log holds no run, or the run is not one that can be flown.

    """
    description = log.description()
    with reading(log.path):
        description.scene()  # what is missing is found before anything is tried
        try_model(log.path)
        repetition = Repetition(description, dict(changes or {}))
        result = Resimulation(notes=_notes(description, log))
        comparer = _Comparer(log, repetition, tolerance, keep, result)
        most = limit('log_steps')
        try:
            for number, message in enumerate(log.messages(), 1):
                if message.step > most + _STEPS_PER_MESSAGE * number:
                    raise beyond('log_steps', most, f'step {message.step} in message {number}')
                with reading(log.path, f"'{message.topic}' at step {message.step}"):
                    if repetition.take(message):
                        result.commands += 1
                    elif message.topic in repetition.states:
                        comparer.take(message)
        except DivergedError as error:
            if not changes:
                raise
            result.notes.append(f'the changed flight ended: {error}')
        result.notes += [f'warning: {line}' for line in repetition.simulation.warnings.lines]
    return result


#: Of a log that names fewer joints than the flight has; see ``compare.of_the_same_joints``.
_OLD_JOINTS = (
    'joint_states of this log name thrusters alone (an earlier version): those are compared'
)


#: Of a log from before ``/tf_static``; its ``/tf`` says nothing that its odometry does not.
_OLD_TRANSFORMS = '/tf of this log (an earlier version) holds what does not move: not compared'


class _Comparer:
    """Compares states, and keeps those that are asked for."""

    def __init__(
        self,
        log: Log,
        repetition: Repetition,
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
        if (
            first is None
            and message.topic.endswith('/joint_states')
            and _OLD_JOINTS not in result.notes
        ):
            result.notes.append(_OLD_JOINTS)


def _notes(description: RunDescription, log: Log) -> list[str]:
    """Return what may explain a difference."""
    versions = description.run['versions']
    notes = [f'damaged log: {fault}' for fault in log.faults]
    if has_old_transforms(description):
        notes.append(_OLD_TRANSFORMS)
    pictures = sorted(topic.name for topic in log.topics.values() if topic.type == IMAGE)
    if pictures:
        notes.append(f'pictures are not drawn again, the recorded ones stay: {listed(pictures)}')
    if versions['mujoco'] != mujoco.__version__:
        notes.append(f'recorded with MuJoCo {versions["mujoco"]}, this is {mujoco.__version__}')
    machine = f'{platform.system()} {platform.machine()}'
    if versions['machine'] != machine:
        notes.append(f'recorded on {versions["machine"]}, this is {machine}')
    return notes
