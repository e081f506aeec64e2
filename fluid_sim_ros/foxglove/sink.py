# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sends a simulation's topics to live viewers: computed only while one of them looks."""

import math
import time
from collections.abc import Mapping
from typing import Any

from foxglove import Channel, Context, Schema

from fluid_sim_ros.foxglove.server import LiveServer
from fluid_sim_ros.loop.foxglove_port import LiveControl
from fluid_sim_ros.messages import commands as command_messages
from fluid_sim_ros.messages import state_topics
from fluid_sim_ros.messages.commands import Commands
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.state_topics import StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.simulation import Simulation

#: Wall time between two looks at who looks [s], and simulated time between two while nobody does.
_REFRESH, _IDLE = 0.1, 0.01


class FoxgloveSink:
    """
    A sink for the runner; see ``loop.foxglove_port.LivePort``.

    Parameters
    ----------
    simulation, settings, port, control
        As for ``open_foxglove``.

    Attributes
    ----------
    period
        Ticks between two calls of ``write``.
    port
        That the server listens on.

    """

    def __init__(
        self,
        simulation: Simulation,
        settings: Mapping[str, Any],
        port: int,
        control: LiveControl,
    ) -> None:
        known = {**state_topics.DEFAULTS, **command_messages.DEFAULTS, **settings}
        self._states = StateTopics(simulation, known)
        # held here: the channels go with it
        self._context = context = Context()
        prefix = str(settings.get('namespace', '')).strip('/')
        root = f'/{prefix}/' if prefix else '/'

        def channel(name: str, kind: str) -> Channel:
            full = name if name.startswith('/') else f'{root}{name}'
            schema = Schema(name=kind, encoding='ros2msg', data=definition(kind).text.encode())
            return Channel(full, message_encoding='cdr', schema=schema, context=context)

        self._topics: list[tuple[StateTopic, Channel]] = [
            (topic, channel(topic.name, topic.type))
            for topic in self._states.topics
            if not topic.new_name
        ]
        self._commands = {
            topic.name: channel(topic.name, topic.type)
            for topic in Commands(simulation, known).topics
        }
        self._server = LiveServer(simulation.scene.name, port, context, control)
        self.port = self._server.port
        self._idle = max(1, round(_IDLE / simulation.timestep))
        self._simulation = simulation
        self._active: list[tuple[StateTopic, Channel]] = []
        self._sent_once: set[str] = set()
        self._refreshed_at = -math.inf
        self.period = self._idle

    def write(self, simulation: Simulation) -> None:
        """
        Send what is due and wanted at this step boundary.

        Parameters
        ----------
        simulation
            At the boundary.

        """
        now = time.monotonic()
        if now - self._refreshed_at > _REFRESH:
            self._refreshed_at = now
            self._refresh()
        tick = simulation.tick
        due = [pair for pair in self._active if tick % pair[0].period == 0]
        if not due:
            return
        self._states.take_state()
        stamp = simulation.time_ns
        for topic, channel in due:
            if data := self._states.data(topic):
                channel.log(data, log_time=stamp)
        self._server.tell_time(stamp)

    def command(self, name: str, data: bytes) -> None:
        """
        Send a command message, before it is applied.

        Parameters
        ----------
        name
            Relative topic name.
        data
            CDR bytes.

        """
        channel = self._commands[name]
        if channel.has_sinks():
            channel.log(data, log_time=self._simulation.time_ns)

    def restart(self) -> None:
        """Note that simulated time was set back: viewers begin anew."""
        self._states.restart()
        self._sent_once.clear()
        self._server.begin_anew()

    def close(self) -> None:
        """Close every connection."""
        self._server.close()

    def _refresh(self) -> None:
        """Look which channels have subscribers; send those what never changes."""
        self._active = []
        for topic, channel in self._topics:
            if not channel.has_sinks():
                self._sent_once.discard(topic.name)
            elif not topic.once:
                self._active.append((topic, channel))
            elif topic.name not in self._sent_once:
                self._sent_once.add(topic.name)
                channel.log(self._states.data(topic), log_time=self._simulation.time_ns)
        self.period = math.gcd(*(topic.period for topic, _ in self._active)) or self._idle


#: What ``loop.foxglove_port`` calls.
open_foxglove = FoxgloveSink
