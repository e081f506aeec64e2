# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How the node's messages reach the middleware: compiled, in a thread of their own or not."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from rclpy.node import Node

from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.plugins.tick import PublishQueue
from fluid_sim_ros.ros.raw import RawPublisher, publish_functions

#: Not on and off: YAML reads these as true and false.
THREADS = ('auto', 'always', 'never')
#: Least size of the queue [bytes], and its size in messages of all topics.
_LEAST, _ROUNDS = 1 << 16, 2
#: How long the thread may go on at the end, until its queue is empty [s].
_LONGEST_END = 1.0
#: Where control groups are, and that of this process (version 2).
_GROUPS, _OWN_GROUP = Path('/sys/fs/cgroup'), Path('/proc/self/cgroup')


class Publishing:
    """
    Sends the messages of a node's publishers in their order, and never leaves one out.

    With a thread the steps go on while the middleware works; where it cannot keep up, they wait.
    The bytes and the order are the same.

    Parameters
    ----------
    node
        Owner of the publishers.
    publishers
        All that send.
    sizes
        Of one message of each topic [bytes].
    settings
        Values of the node's parameters; ``publish.thread`` and ``pacing`` are looked at.

    Attributes
    ----------
    queue
        What the compiled tick publishes through; None where this ROS keeps its functions to
        itself, so that each message goes through rclpy.
    reason
        Why it is None, or empty.

    Raises
    ------
    ConfigError
        If a thread is asked for where there is no queue.

    """

    def __init__(
        self,
        node: Node,
        publishers: Iterable[RawPublisher],
        sizes: Iterable[int],
        settings: Mapping[str, Any],
    ) -> None:
        self._node, self._settings = node, settings
        self._topics = {publisher.address: publisher.topic for publisher in publishers}
        self.queue: PublishQueue | None = None
        functions, self.reason = publish_functions()
        if functions:
            self.queue = PublishQueue(functions, max(_LEAST, _ROUNDS * sum(sizes)))
        self.choose()

    @property
    def threaded(self) -> bool:
        """Whether messages go out in a thread of their own."""
        return self.queue is not None and self.queue.threaded

    @property
    def way(self) -> str:
        """In words, how messages go out now."""
        if self.queue is None:
            return f'through rclpy, because there is no {self.reason}'
        return 'in a thread of its own' if self.threaded else 'in the thread that steps'

    def choose(self) -> None:
        """
        Start or end the thread, as the parameters say now.

        Raises
        ------
        ConfigError
            If a thread is asked for where there is no queue.

        """
        if self.queue is None:
            if self._settings['publish.thread'] == 'always':
                raise ConfigError(
                    "parameter 'publish.thread': always is not possible, because there is no "
                    f'{self.reason}; set auto'
                )
            return
        if wants_thread(self._settings, cores()):
            self.queue.start()
        else:
            self._end(self.queue)

    def send(self, publisher: RawPublisher, data: bytes) -> None:
        """
        Publish a message.

        Parameters
        ----------
        publisher
            By which.
        data
            The message (CDR).

        """
        if self.queue is None:
            publisher.publish(data)
            return
        self.queue.send(publisher.address, data)

    def check(self) -> None:
        """
        Raise what the middleware has said.

        Raises
        ------
        FluidSimError
            If a message could not be published while ROS was up.

        """
        if self.queue is None:
            return
        address, text = self.queue.fault()
        if address and self._node.context.ok():
            topic = self._topics.get(address, 'a topic')
            raise FluidSimError(f'{topic}: a message could not be published: {text}')

    def close(self) -> None:
        """
        Send what waits, for a short while at most, and end the thread.

        Raises
        ------
        FluidSimError
            If messages were left out, or could not be published.

        """
        if self.queue is None:
            return
        try:
            self._end(self.queue)
            self.check()
        finally:
            self.queue.free()
            self.queue = None

    def _end(self, queue: PublishQueue) -> None:
        left = queue.stop(_LONGEST_END)
        if left:
            raise FluidSimError(
                f'{left} messages were not published: the middleware took longer than '
                f'{_LONGEST_END:g} s; look for a subscriber that does not answer'
            )


def wants_thread(settings: Mapping[str, Any], cores: int) -> bool:
    """
    Return whether messages shall go out in a thread of their own.

    Parameters
    ----------
    settings
        ``publish.thread`` and ``pacing``. ``auto``: where a second core is there to run it, and
        nobody waits for each message, as in lockstep.
    cores
        That this process may use.

    """
    choice = settings['publish.thread']
    if choice == 'auto':
        return cores > 1 and settings['pacing'] == 'free'
    return bool(choice == 'always')


def usual_way() -> str:
    """Return in words how messages go out with ``publish.thread: auto``."""
    functions, missing = publish_functions()
    if not functions:
        return f'through rclpy, because there is no {missing}'
    if cores() < 2:
        return 'compiled, in the thread that steps: this process may use one core'
    return 'compiled; with free pacing in a thread of its own'


def cores() -> int:
    """Return how many cores this process may use: by affinity and by the quota of its group."""
    count = len(os.sched_getaffinity(0))
    try:
        lines = _OWN_GROUP.read_text(encoding='utf-8').splitlines()
        group = next(line for line in lines if line.startswith('0::')).removeprefix('0::/')
        quota, period = Path(_GROUPS, group, 'cpu.max').read_text(encoding='ascii').split()
        return max(1, min(count, int(quota) // int(period)))
    except (OSError, StopIteration, ValueError):  # no such group, or no quota: 'max'
        return count
