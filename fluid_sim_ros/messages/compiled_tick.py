# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""All messages of a tick in one call of the library; the same bytes as ``StateTopics.data``."""

import ctypes
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.messages.state_topics import StateTopics
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.plugins.tick import Copy, Number, PublishQueue, Tick, TickTopic, tick_library
from fluid_sim_ros.simulation import Simulation


class CompiledTick:
    """
    Observes the state, fills the messages that are due and publishes them, without allocation.

    Topics whose numbers Python makes, such as those of sensors, are asked one after another in
    between, so that the order of the messages is that of the topics.

    Parameters
    ----------
    simulation
        Whose state.
    states
        Its topics.
    queue
        Publishes; None: nothing is published.

    """

    def __init__(
        self, simulation: Simulation, states: StateTopics, queue: PublishQueue | None = None
    ) -> None:
        self._simulation, self._states, self._queue = simulation, states, queue
        count = len(states.topics)
        self._held: list[object] = []  # what the addresses point to
        self._topics = (TickTopic * count)(*map(self._topic, states.topics))
        self._chosen = np.zeros(count, dtype=np.int64)
        self._made = np.zeros(count, dtype=np.int64)
        model, data, observed, bases, vehicles, rows = simulation.observe_addresses
        self._tick = Tick(
            model, data, observed, bases, vehicles, rows, self._address(states.stamp.view),
            ctypes.addressof(self._topics), self._chosen.ctypes.data, 0, self._made.ctypes.data, 0,
            queue.address if queue else None, 0,
        )  # fmt: skip
        self._take, self._into = tick_library().tick, ctypes.addressof(self._tick)

    def choose(self, places: Sequence[int], publishers: Sequence[int] = ()) -> None:
        """
        Choose which topics are wanted.

        Parameters
        ----------
        places
            Among ``StateTopics.topics``, rising.
        publishers
            Address of each one's publisher, or 0; empty: none is published.

        """
        self._chosen[: len(places)] = places
        self._tick.chosen_count = len(places)
        for place, publisher in zip(places, publishers or [0] * len(places), strict=True):
            self._topics[place].publisher = publisher or None

    def take(self) -> bool:
        """
        Make the messages that are due at the present tick, and publish them.

        Returns
        -------
        bool
            False: one could not be published; see ``PublishQueue.fault``.

        """
        simulation, states = self._simulation, self._states
        tick, time_ns = simulation.tick, simulation.time_ns
        take, into, chosen = self._take, self._into, self._chosen
        place = take(into, tick, time_ns, 0, 0)
        while place >= 0:
            ready = states.ready(states.topics[chosen[place]])
            place = take(into, tick, time_ns, place + (not ready), ready)
        return place == -1

    def made(self) -> list[int]:
        """Return the places of the topics whose messages the last ``take`` has made."""
        places: list[int] = self._made[: self._tick.made_count].tolist()
        return places

    def published(self, place: int) -> int:
        """
        Return how many messages of a topic were published so far.

        Parameters
        ----------
        place
            Among ``StateTopics.topics``.

        """
        return int(self._topics[place].published)

    def _topic(self, topic: StateTopic) -> TickTopic:
        copies = [
            Copy(self._address(target), self._address(source), len(target))
            for target, source in topic.copies
            if len(target)
        ]
        numbers = [
            Number(
                self._address(made.target),
                None if made.source is None else self._address(made.source),
                made.scale,
                made.actuator,
            )
            for made in topic.numbers
        ]
        message = topic.template.buffer
        return TickTopic(
            topic.period, topic.needs_forces, topic.asks,
            *self._array(Number, numbers), *self._array(Copy, copies),
            self._address(message), len(message),
        )  # fmt: skip

    def _array(
        self, kind: type[ctypes.Structure], items: Sequence[ctypes.Structure]
    ) -> tuple[int | None, int]:
        if not items:
            return None, 0
        array = (kind * len(items))(*items)
        self._held.append(array)
        return ctypes.addressof(array), len(items)

    def _address(self, what: memoryview | bytearray | NDArray[np.float64]) -> int:
        """Return where bytes lie, which are held from now on."""
        array = np.frombuffer(what, dtype=np.uint8)
        self._held.append(array)
        return array.ctypes.data
