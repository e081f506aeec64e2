# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The life of a node's process: set-up, signals, executor thread, and an orderly end."""

import resource
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import rclpy
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor

from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.ros.parameters.files import lost_parameters
from fluid_sim_ros.ros.parameters.table import Table
from fluid_sim_ros.ros.process.command_line import asks_for_help, help_text, start_ros
from fluid_sim_ros.ros.process.signals import Ending, EndSignals

#: Longest wait of the executor before it looks whether it shall end [s].
_LONGEST_SPIN = 0.1
#: Exit code of a node that has lost something on the way.
LOST = 1
#: File handles that a node opens: 27 with one vehicle and a recording, by Fast DDS of Jazzy.
_HANDLES = 40


class LoopingNode(Ending, Protocol):
    """
    An rclpy node whose main thread runs a loop of its own.

    Attributes
    ----------
    lost
        What was lost on the way, such as a recording, or empty.

    """

    lost: str

    def run(self) -> None:
        """Run the loop until ``end``."""

    def close(self) -> None:
        """Refuse further work; called after ``run``, before the executor stops."""

    def destroy_node(self) -> None:
        """Remove the node."""

    def warn(self, line: str) -> None:
        """
        Tell the user of something that may not be meant.

        Parameters
        ----------
        line
            What.

        """


@dataclass(frozen=True)
class Executable:
    """
    A node that runs as a process.

    Attributes
    ----------
    name
        What it is called, and what error lines start with.
    summary
        What it does, for its help.
    table
        Its parameters.
    create
        Makes the node.
    start
        Called with the node before its executor starts (lifecycle autostart).

    """

    name: str
    summary: str
    table: Table
    create: Callable[[], Any]
    start: Callable[[Any], None] = lambda node: None


def run_process(executable: Executable, args: Sequence[str] | None) -> int:
    """
    Run a node until it ends, or SIGINT or SIGTERM ends it (`EndSignals`).

    Parameters
    ----------
    executable
        The node.
    args
        Command line with the program's name; None means that of the process.

    Returns
    -------
    int
        Exit code: 0, also where a signal has ended it, as ``ros2 launch`` wants it; 1 where it has
        lost something on the way, however it ended; 2 after one line about a FluidSimError.

    """
    arguments = list(sys.argv if args is None else args)
    if asks_for_help(arguments):
        sys.stdout.write(help_text(executable.name, executable.summary, executable.table))
        return 0
    signals = EndSignals(executable.name)
    try:
        _check_handles()
        start_ros(arguments)
    except FluidSimError as error:
        return _fail(executable.name, error)
    node = None
    try:
        node = executable.create()
        for line in lost_parameters(arguments, node.get_fully_qualified_name()):
            node.warn(line)
        if not signals.came:
            _spin(node, executable.start, signals)
    except FluidSimError as error:
        return _fail(executable.name, error)
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.shutdown()
    return LOST if node.lost else 0


def _check_handles() -> None:
    """Refuse a limit at which the middleware would fail in words that tell nothing."""
    most, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    handles = Path('/proc/self/fd')
    used = len(list(handles.iterdir())) if handles.exists() else 3
    if most != resource.RLIM_INFINITY and most - used < _HANDLES:
        raise ConfigError(
            f'this process may open {most - used} more files, and needs {_HANDLES}; '
            f'raise the limit, such as: ulimit -n {max(1024, used + 2 * _HANDLES)}'
        )


def _spin(node: Any, start: Callable[[Any], None], signals: EndSignals) -> None:
    """Run node and executor; in the end stop both in an order that leaves no thread behind."""
    signals.end(node)
    start(node)
    with executor_thread(node):
        try:
            node.run()
        finally:
            node.close()


@contextmanager
def executor_thread(node: Any) -> Iterator[None]:
    """
    Serve a node's services and parameters in a thread of its own, which ends with the block.

    Parameters
    ----------
    node
        An rclpy node.

    Yields
    ------
    None
        While the thread runs.

    """
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    ended = threading.Event()

    def spin() -> None:
        # a shutdown takes from an executor what it waits for, so it stops waiting first
        while not ended.is_set():
            # what the loop's thread removes may have been on its turn already
            with suppress(InvalidHandle):
                executor.spin_once(_LONGEST_SPIN)

    thread = threading.Thread(target=spin, name='executor')
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        executor.shutdown()


def _fail(name: str, error: FluidSimError) -> int:
    sys.stderr.write(f'{name}: error: {error}\n')
    return 2
