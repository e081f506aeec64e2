# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Where the core and the node hand over what is recorded.

The recorder itself is a part of its own (``recording``), which neither the core nor the node may
import: they know the protocol below, and the name under which the part is found when it is
wanted.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from fluid_sim_ros.errors import ConfigError, listed, needed_for

if TYPE_CHECKING:  # the writer of logs needs no MuJoCo, and starts in a tenth of the time without
    from fluid_sim_ros.simulation import Simulation

#: The part that records; it has ``open_recorder`` with the arguments of the function below.
_PART = 'fluid_sim_ros.recording.recorder'

#: Topic of what changes a run without being a command message, in the node's namespace.
EVENTS = 'fluid_sim/events'
EVENTS_TYPE = 'std_msgs/msg/String'


@dataclass(frozen=True)
class RecordedTopic:
    """
    A topic to record.

    Attributes
    ----------
    name, type
        Full name, and message type.
    key
        Name that the simulation has for it, relative to the namespace and before any remapping.
    reliable, depth, transient_local
        Quality of service that is offered.

    """

    name: str
    type: str
    key: str = ''
    reliable: bool = True
    depth: int = 10
    transient_local: bool = False


@dataclass(frozen=True)
class RecorderOptions:
    """
    How to record.

    Attributes
    ----------
    path
        ``.mcap`` file, or a folder that gets the file and rosbag2's ``metadata.yaml``.
    settings
        Every parameter of the run, as attached to the log.
    namespace
        What stands before the relative topic names, ``/`` or ``/name``.
    policy
        ``block``: stepping waits for a full queue; ``drop``: states are left out and counted.
    queue_mib
        Size of the queue to the writer [MiB].
    chunk_s
        Longest wall time that a chunk stays open [s]: what a crash of the machine may cost.
    allow_assets_from
        Folders whose files the log may attach if the model names them, beside the model's own.

    """

    path: Path
    settings: Mapping[str, Any] = field(default_factory=dict)
    namespace: str = '/'
    policy: str = 'block'
    queue_mib: float = 8.0
    chunk_s: float = 1.0
    allow_assets_from: tuple[Path, ...] = ()


class RecorderPort(Protocol):
    """Takes what is recorded; every method runs in the stepping thread."""

    fault: str
    paths: list[Path]
    written: int
    dropped: int

    def tick(self, messages: Sequence[tuple[int, bytes]]) -> None:
        """
        Keep state messages of the present step, and hand over all that waits.

        Parameters
        ----------
        messages
            Place in the list of topics, and CDR bytes, of each.

        """

    def command(self, topic: int, data: bytes) -> None:
        """
        Keep a command as it was received, before it takes effect; never dropped.

        Parameters
        ----------
        topic
            Place in the list of topics.
        data
            CDR bytes.

        """

    def event(self, **change: Any) -> None:
        """
        Keep a change that no command message made, such as a thrust that went stale.

        Parameters
        ----------
        **change
            What has changed, by name.

        """

    def flush(self) -> None:
        """Hand over what has waited long enough; for loops that do not tick."""

    def next_segment(self) -> None:
        """Begin a new file: simulated time starts anew."""

    def close(self) -> None:
        """End the file properly."""


def open_recorder(
    simulation: 'Simulation', topics: Sequence[RecordedTopic], options: RecorderOptions
) -> RecorderPort:
    """
    Begin to record a simulation.

    Parameters
    ----------
    simulation
        At step 0.
    topics
        All that will be recorded.
    options
        Where to, and how.

    Returns
    -------
    RecorderPort
        Recording; close it.

    Raises
    ------
    MissingExtraError
        If the extra ``record`` is not installed.
    ConfigError
        If the file cannot be made.

    """
    with needed_for('recording'):
        part = import_module(_PART)
    tap: RecorderPort = part.open_recorder(simulation, topics, options)
    return tap


def selected(
    names: Sequence[str],
    patterns: Sequence[str],
    option: str = 'record.topics',
    old_names: Collection[str] = (),
) -> set[str]:
    """
    Return the topic names that the shell patterns choose.

    Parameters
    ----------
    names
        All that there are.
    patterns
        Applied in their order: each adds what it matches, or takes it away where it begins with
        ``!``. Where the first one takes away, all others are chosen before.
    option
        What the user gave the patterns to, for errors.
    old_names
        Those of the names that have a new name beside them: only patterns that match no other
        name choose them.

    Returns
    -------
    set
        Of the names.

    Raises
    ------
    ConfigError
        If a pattern matches none.

    """
    chosen = set(names) - set(old_names) if patterns and patterns[0].startswith('!') else set()
    for pattern in patterns:
        matching = {name for name in names if fnmatchcase(name, pattern.removeprefix('!'))}
        if not matching:
            raise ConfigError(
                f"{option}: '{pattern}' matches no topic; there are: {listed(names)}"
            )
        matching = matching - set(old_names) or matching
        chosen = chosen - matching if pattern.startswith('!') else chosen | matching
    return chosen
