# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Ends of a bridge that a test plays: raw sockets and a runner in a thread."""

import contextlib
import socket
import threading
import time
from collections.abc import Iterator
from typing import Self

from fluid_sim_ros import Simulation
from fluid_sim_ros.loop.autopilot_pacing import AutopilotPacing
from fluid_sim_ros.loop.autopilot_port import (
    AutopilotOptions,
    Surroundings,
    open_bridge,
)
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.step_clock import NEVER


def free_port(protocol: str) -> int:
    """Return a port that nobody listens on."""
    kind = socket.SOCK_STREAM if protocol == 'px4' else socket.SOCK_DGRAM
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def waited(condition, seconds=10.0):
    """Poll until a condition holds; return whether it does."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.002)
    return True


class ThreadedFlight:
    """A simulation that its autopilots lead, run in a thread of its own; its parts fill it."""

    simulation: Simulation
    runner: Runner

    def __init__(self) -> None:
        self.resets = 0
        self.error: BaseException | None = None

    def close(self) -> None:
        """Close what the flight has open."""
        raise NotImplementedError

    def _reset(self) -> None:
        self.resets += 1
        self.simulation.reset()
        self.runner.restart()

    def _run(self, until: int) -> None:
        try:
            self.runner.run(until)
        except BaseException as error:  # noqa: BLE001 - raised again where the block is left
            self.error = error

    @contextlib.contextmanager
    def running(self, until: int = NEVER) -> Iterator[Self]:
        """Run until the block is left, and to a tick that is given before that."""
        thread = threading.Thread(target=self._run, args=(until,), daemon=True)
        thread.start()
        try:
            yield self
            if until != NEVER:
                thread.join(30.0)
        finally:
            self.runner.stop()
            thread.join(5.0)
            alive = thread.is_alive()
            self.close()
            assert not alive, 'the loop hangs'
            if self.error is not None:
                raise self.error


class BridgedFlight(ThreadedFlight):
    """
    A simulation with a bridge, run in a thread of its own.

    ``reports`` are (key, line), ``opening`` the lines that were said before.
    """

    def __init__(
        self,
        scene: str,
        protocol: str,
        clock: Pacing | None = None,
        timestep: float | None = None,
        **options,
    ) -> None:
        super().__init__()
        self.reports: list[tuple[str, str]] = []
        self.simulation = Simulation(scene, timestep=timestep)
        surroundings = Surroundings(
            report=lambda key, line: self.reports.append((key, line)),
            inform=lambda line: self.reports.append(('', line)),
            reset=self._reset,
        )
        # a port of the system's choice, so that tests run side by side
        chosen = AutopilotOptions(protocol, **{'port': free_port(protocol), **options})
        self.bridge = open_bridge(self.simulation, chosen, surroundings)
        self.opening = [line for _, line in self.reports]
        self.reports.clear()
        self.port = self.bridge.port
        pacing = AutopilotPacing(self.bridge, clock or Pacing())
        self.runner = Runner(self.simulation, NoSource(), [], pacing)

    def close(self) -> None:
        self.bridge.close()
