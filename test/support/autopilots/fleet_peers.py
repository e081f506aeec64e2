# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A fleet whose scene file states its autopilots, run in a thread, and stand-ins that fly it."""

import threading
from collections.abc import Callable
from dataclasses import replace

from fluid_sim_ros import Simulation
from fluid_sim_ros.loop.autopilot_fleet import autopilots_of, open_bridges
from fluid_sim_ros.loop.autopilot_pacing import AutopilotPacing
from fluid_sim_ros.loop.autopilot_port import Surroundings
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.loop.shared_lockstep import joined
from fluid_sim_ros.recording.sink import RecordingSink
from test.support.autopilots.autopilot_peers import ThreadedFlight, free_port


class FleetFlight(ThreadedFlight):
    """A simulation with a bridge for each autopilot of its scene, at ports that are free."""

    def __init__(self, scene, log=None, **common) -> None:
        super().__init__()
        self.simulation = Simulation(scene)
        self.sink = None if log is None else RecordingSink(self.simulation, log)
        self.reports: list[str] = []
        surroundings = Surroundings(
            report=lambda key, line: self.reports.append(line),
            inform=self.reports.append, reset=self._reset, log=self.sink,
        )  # fmt: skip
        stated = autopilots_of(self.simulation.scene, **common)
        options = [replace(each, port=free_port(each.protocol)) for each in stated]
        bridges = open_bridges(self.simulation, options, surroundings)
        self.bridges = {bridge.vehicle: bridge for bridge in bridges}
        self.ports = {name: bridge.port for name, bridge in self.bridges.items()}
        pacing = AutopilotPacing(joined(bridges, self.simulation, self.sink), Pacing())
        sinks = [] if self.sink is None else [self.sink]
        self.runner = Runner(self.simulation, NoSource(), sinks, pacing)

    def close(self) -> None:
        for bridge in self.bridges.values():
            bridge.close()
        if self.sink is not None:
            self.sink.close()


class Pilot(threading.Thread):
    """A stand-in that flies in a thread; what it raises is raised by ``join``."""

    def __init__(self, fly: Callable[[], None]) -> None:
        super().__init__(daemon=True)
        self._fly, self.error = fly, None
        self.start()

    def run(self) -> None:
        try:
            self._fly()
        except BaseException as error:  # noqa: BLE001 - raised again by join
            self.error = error

    def join(self, timeout: float | None = 30.0) -> None:
        """Wait for its end."""
        super().join(timeout)
        assert not self.is_alive(), 'the stand-in hangs'
        if self.error is not None:
            raise self.error
