# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The autopilots that a scene file states for its vehicles, and their bridges."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from fluid_sim_ros.loop.autopilot_port import (
    AutopilotOptions,
    Bridge,
    Surroundings,
    open_bridge,
)
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.simulation import Simulation


def autopilots_of(scene: Scene, **common: Any) -> list[AutopilotOptions]:
    """
    Return the autopilots that a scene's file states, in its order.

    Parameters
    ----------
    scene
        As its file says.
    **common
        Fields of ``AutopilotOptions`` that hold for all, such as ``timeout``.

    """
    members = {} if scene.fleet is None else scene.fleet.members
    return [
        AutopilotOptions(
            pilot.protocol, vehicle=name, mapping=pilot.mapping, instance=pilot.instance or 0,
            port=pilot.port, parameters=pilot.parameters, **common,
        )
        for name, member in members.items()
        if (pilot := member.autopilot) is not None
    ]  # fmt: skip


def open_bridges(
    simulation: Simulation, options: Sequence[AutopilotOptions], surroundings: Surroundings
) -> list[Bridge]:
    """
    Listen for several autopilots; with more than one, each line names the vehicle.

    Parameters
    ----------
    simulation
        What is flown.
    options
        Of each.
    surroundings
        That they share.

    Returns
    -------
    list
        The bridges; close them.

    Raises
    ------
    MissingExtraError, ConfigError
        As ``open_bridge``; those that were open are closed then.

    """
    bridges: list[Bridge] = []
    try:
        for each in options:
            around = surroundings if len(options) == 1 else _of(each.vehicle, surroundings)
            bridges.append(open_bridge(simulation, each, around))
    except BaseException:
        for bridge in bridges:
            bridge.close()
        raise
    return bridges


def _of(vehicle: str, shared: Surroundings) -> Surroundings:
    """Return surroundings whose lines begin with a vehicle's name."""

    def report(key: str, line: str) -> None:
        shared.report(f'{vehicle} {key}', f'{vehicle}: {line}')

    return replace(shared, report=report, inform=lambda line: shared.inform(f'{vehicle}: {line}'))
