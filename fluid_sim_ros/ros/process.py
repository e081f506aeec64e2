"""The life of a node's process: set-up, signals, executor thread, and an orderly end."""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Protocol

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.ros.parameters.files import check_parameter_files

#: Largest ROS_DOMAIN_ID whose UDP ports stay below 65536 (OMG DDSI-RTPS 2.5, section 9.6.2.3).
_LARGEST_DOMAIN = 232


class Ending(Protocol):
    """What a signal ends."""

    def end(self) -> None:
        """Have the loop return; safe in a signal handler."""


class LoopingNode(Ending, Protocol):
    """An rclpy node whose main thread runs a loop of its own."""

    def run(self) -> None:
        """Run the loop until ``end``."""

    def close(self) -> None:
        """Refuse further work; called after ``run``, before the executor stops."""

    def destroy_node(self) -> None:
        """Remove the node."""


def run_process(
    name: str,
    create: Callable[[], LoopingNode],
    args: Sequence[str] | None,
    start: Callable[[Any], None] = lambda node: None,
) -> int:
    """
    Run a node until it ends, SIGINT or SIGTERM; a second signal ends the process at once.

    Parameters
    ----------
    name
        What error lines start with.
    create
        Makes the node.
    args
        Command line; None means that of the process.
    start
        Called with the node before its executor starts (lifecycle autostart).

    Returns
    -------
    int
        Exit code: 0, or 2 after one line about a FluidSimError.

    """
    arguments = list(sys.argv if args is None else args)
    try:
        check_domain()
        check_parameter_files(arguments)
        rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    except FluidSimError as error:
        return _fail(name, error)
    node = None
    try:
        node = create()
        _spin(node, start)
    except FluidSimError as error:
        return _fail(name, error)
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.shutdown()
    return 0


def _spin(node: Any, start: Callable[[Any], None]) -> None:
    """Run node and executor; in the end stop both in an order that leaves no thread behind."""
    end_on_signal(node)
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

    def spin() -> None:
        try:
            executor.spin()
        except ExternalShutdownException:
            return

    thread = threading.Thread(target=spin, name='executor')
    thread.start()
    try:
        yield
    finally:
        executor.shutdown()
        thread.join()


def end_on_signal(node: Ending) -> None:
    """
    End a loop at SIGINT or SIGTERM; a second signal ends the process at once.

    Parameters
    ----------
    node
        Its ``end`` is called at the first signal.

    """
    ending = False

    def on_signal(number: int, frame: Any) -> None:
        nonlocal ending
        if ending:
            os._exit(128 + number)
        ending = True
        node.end()

    signal.signal(signal.SIGINT, on_signal)
    signal.signal(signal.SIGTERM, on_signal)


def _fail(name: str, error: FluidSimError) -> int:
    sys.stderr.write(f'{name}: error: {error}\n')
    return 2


def check_domain() -> None:
    """
    Check ROS_DOMAIN_ID, and keep discovery on this host unless the user opened it.

    Raises
    ------
    ConfigError
        If the domain is not a whole number from 0 to 232.

    """
    text = os.environ.get('ROS_DOMAIN_ID', '')
    if text and not (text.isdecimal() and int(text) <= _LARGEST_DOMAIN):
        raise ConfigError(f"ROS_DOMAIN_ID is '{text}'; allowed: 0 to {_LARGEST_DOMAIN}")
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
