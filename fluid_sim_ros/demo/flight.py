# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The flight of the demo: simulator and controller as two ROS 2 processes in lockstep."""

import os
import secrets
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fluid_sim_ros.demo.children import Child
from fluid_sim_ros.demo.flight_log import TOPICS
from fluid_sim_ros.demo.listener import Listener
from fluid_sim_ros.demo.summary import SCENE, VEHICLE, WAYPOINTS
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.interruption import held
from fluid_sim_ros.ros.controllers.states import read_odometry
from fluid_sim_ros.ros.process.this_host import stay_on_this_host

#: Domains to choose from: above those that people and tests use, and with UDP ports below the
#: ephemeral ports of Linux.
_DOMAINS = range(61, 101)
#: Longest wait for the first state, and for the next one during the run [s, wall].
_START_PATIENCE, _PATIENCE = 30.0, 15.0
#: Sleep between two looks at what has arrived [s].
_PAUSE = 0.05


@dataclass(frozen=True)
class Heard:
    """Odometry that a third process heard (CDR), and wall time from the first step on [s]."""

    odometry: list[bytes]
    wall: float


def fly_demo(out: Path, duration: float, log: Path | None = None) -> Heard:
    """
    Run simulator and controller to the end and return what was heard on the way.

    Parameters
    ----------
    out
        Folder for what the processes write: <name>.log.
    duration
        Simulated time [s].
    log
        File that the simulator records to, or None.

    Returns
    -------
    Heard
        The odometry that arrived here, and the wall time that the flight took.

    Raises
    ------
    FluidSimError
        If a process dies or stops answering; the line holds the last it wrote.

    """
    # nobody outside this host is asked, neither by this process nor by its children
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    stay_on_this_host()
    with _listener() as (listener, domain), _children(out, domain, duration, log) as children:
        _follow(listener, children)
    stamps = [read_odometry(data).stamp_ns for data in listener.messages]
    moving = next(i for i, stamp_ns in enumerate(stamps) if stamp_ns > 0)
    wall = (listener.sent_ns[-1] - listener.sent_ns[moving]) * 1e-9
    return Heard(listener.messages, wall)


def _follow(listener: Listener, children: '_Children') -> None:
    """Take messages until the simulator ends."""
    # in lockstep the simulator holds at time 0 until the controller is there, so that no state
    # is missed once the first was heard
    _wait_for(
        listener, children, lambda: bool(listener.messages),
        'the simulator has published no state',
    )  # fmt: skip
    with held():
        children.start_controller()
    _wait_for(
        listener, children, lambda: read_odometry(listener.messages[-1]).stamp_ns > 0,
        'the controller has answered no state',
    )  # fmt: skip
    heard = time.perf_counter()
    while children.simulator.running:
        children.check()
        if listener.take(_PAUSE):
            heard = time.perf_counter()
        elif time.perf_counter() - heard > _PATIENCE:
            raise FluidSimError(
                f'no state for {_PATIENCE:g} s of wall time; {children.simulator.last_words()}'
            )
    while listener.take(_PAUSE):
        pass
    children.check()


def _wait_for(
    listener: Listener, children: '_Children', ready: Callable[[], bool], complaint: str
) -> None:
    deadline = time.perf_counter() + _START_PATIENCE
    while not ready():
        listener.take(_PAUSE)
        children.check()
        if time.perf_counter() > deadline:
            raise FluidSimError(
                f'{complaint} within {_START_PATIENCE:g} s; {children.last_words()}'
            )


@contextmanager
def _listener() -> Iterator[tuple[Listener, int]]:
    """Make a listener in a ROS domain in which nobody else is."""
    start = secrets.randbelow(len(_DOMAINS))
    for i in range(len(_DOMAINS)):
        domain = _DOMAINS[(start + i) % len(_DOMAINS)]
        with ExitStack() as stack:
            with held():
                listener = Listener(domain, f'{VEHICLE}/odom')
                stack.callback(listener.close)
            listener.take(0.2)  # give discovery a moment
            if listener.is_alone():
                yield listener, domain
                return
    raise FluidSimError(f'every ROS domain from {_DOMAINS[0]} to {_DOMAINS[-1]} is in use')


class _Children:
    """The simulator, and the controller once it is started."""

    def __init__(self, out: Path, domain: int, duration: float, log: Path | None) -> None:
        self._out = out
        self._environment = {'ROS_DOMAIN_ID': str(domain), 'ROS_LOG_DIR': str(out / 'ros_log')}
        recording: dict[str, Any] = {}
        if log is not None:
            recording = {'record.path': log, 'record.topics': list(TOPICS)}
        self.simulator = self._start(
            'fluid_sim_node', 'fluid_sim_ros.ros.node',
            scene=SCENE, pacing='lockstep', duration=repr(duration), **recording,
        )  # fmt: skip
        self.controller: Child | None = None

    def start_controller(self) -> None:
        plan = [number for waypoint in WAYPOINTS for number in waypoint]
        self.controller = self._start(
            'quad_controller', 'fluid_sim_ros.ros.controllers.quad', scene=SCENE, waypoints=plan
        )

    def _start(self, name: str, module: str, **parameters: Any) -> Child:
        arguments = ['--ros-args']
        for key, value in parameters.items():
            arguments += ['-p', f'{key}:={value}']
        return Child(name, module, arguments, self._environment, self._out / f'{name}.log')

    def all(self) -> list[Child]:
        return [child for child in (self.simulator, self.controller) if child is not None]

    def check(self) -> None:
        self.simulator.check()
        if self.controller is not None:
            self.controller.check()
            if not self.controller.running and self.simulator.running:
                raise FluidSimError(f'the controller ended early; {self.controller.last_words()}')

    def last_words(self) -> str:
        return self.all()[-1].last_words()

    def stop(self) -> None:
        for child in self.all():
            child.stop()


@contextmanager
def _children(out: Path, domain: int, duration: float, log: Path | None) -> Iterator[_Children]:
    with ExitStack() as stack:
        with held():  # nobody is started whom nobody stops
            children = _Children(out, domain, duration, log)
            stack.callback(children.stop)
        yield children
        for child in children.all():
            code = child.stop()
            if code:
                raise FluidSimError(
                    f'{child.name} ended with exit code {code}; {child.last_words()}'
                )
