# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Records a simulation that runs without ROS: the same messages, byte for byte, as the node's."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros.loop.recorder_port import RecordedTopic, RecorderOptions, selected
from fluid_sim_ros.messages import commands as command_messages
from fluid_sim_ros.messages import state_topics
from fluid_sim_ros.messages.commands import Commands
from fluid_sim_ros.messages.compiled_tick import CompiledTick
from fluid_sim_ros.messages.state_topics import StateTopics
from fluid_sim_ros.messages.topic import NEWEST
from fluid_sim_ros.recording.recorder import Recorder
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import NEVER


class RecordingSink:
    """
    A sink for the runner that records every state topic.

    Parameters
    ----------
    simulation
        At step 0.
    path
        As ``RecorderOptions.path``.
    settings
        Parameters of the run that differ from the node's defaults.
    topics
        Patterns of relative topic names.
    allow_assets_from
        As ``RecorderOptions.allow_assets_from``.

    """

    def __init__(
        self,
        simulation: Simulation,
        path: Path,
        settings: Mapping[str, Any] | None = None,
        topics: Sequence[str] = ('*',),
        allow_assets_from: Sequence[Path] = (),
    ) -> None:
        known = {**state_topics.DEFAULTS, **command_messages.DEFAULTS, **(settings or {})}
        self._states = StateTopics(simulation, known)
        names = selected(
            [topic.name for topic in self._states.topics], topics,
            old_names=[topic.name for topic in self._states.topics if topic.new_name],
        )  # fmt: skip
        places = [i for i, topic in enumerate(self._states.topics) if topic.name in names]
        wanted = [self._states.topics[i] for i in places]
        commands = Commands(simulation, known).topics
        channels = [
            RecordedTopic(f'/{t.name.lstrip("/")}', t.type, t.name, *t.quality) for t in wanted
        ]
        channels += [RecordedTopic(f'/{t.name}', t.type, t.name, *NEWEST) for t in commands]
        options = RecorderOptions(path, known, allow_assets_from=tuple(allow_assets_from))
        self.recorder = Recorder(simulation, channels, options)
        self._once = [(i, topic) for i, topic in enumerate(wanted) if topic.once]
        self._recorded = {place: i for i, place in enumerate(places)}
        self._compiled = CompiledTick(simulation, self._states)
        self._compiled.choose([p for p in places if not self._states.topics[p].once])
        self._commands = {topic.name: len(wanted) + i for i, topic in enumerate(commands)}
        self._begun = False  # whether the file has what never changes
        self.period = math.gcd(*(topic.period for topic in wanted if not topic.once)) or NEVER

    def write(self, simulation: Simulation) -> None:
        """
        Record what is due at this step.

        Parameters
        ----------
        simulation
            At the step that is recorded.

        """
        topics = self._states.topics
        messages: list[tuple[int, bytes]] = []
        if not self._begun:
            self._begun = True
            messages += [(i, topic.data()) for i, topic in self._once]
        self._compiled.take()
        messages += [
            (self._recorded[place], topics[place].template.bytes())
            for place in self._compiled.made()
        ]
        self.recorder.tick(messages)

    def command(self, name: str, data: bytes) -> None:
        """
        Record a command message before it is applied.

        Parameters
        ----------
        name
            Relative topic name.
        data
            CDR bytes.

        """
        self.recorder.command(self._commands[name], data)

    def event(self, **change: Any) -> None:
        """
        Record a change that no command message made.

        Parameters
        ----------
        change
            Its fields, which JSON can hold.

        """
        self.recorder.event(**change)

    def next_segment(self) -> None:
        """Begin a new file: simulated time has been set back to 0."""
        self.recorder.next_segment()
        self._begun = False

    def close(self) -> None:
        """End the file."""
        self.recorder.close()
