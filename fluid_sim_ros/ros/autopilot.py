# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Connects a node with the autopilots that fly its vehicles."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_fleet import autopilots_of, open_bridges
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Bridge, Exchange, Surroundings
from fluid_sim_ros.loop.shared_lockstep import joined
from fluid_sim_ros.messages.commands import sticks_topic
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.simulation import Simulation


class CommandTap:
    """
    Hands the autopilot's commands to the recorder as if they had come on their topics.

    Parameters
    ----------
    inputs
        The node's command topics, which know their places in the log.

    """

    def __init__(self, inputs: Inputs) -> None:
        self._inputs = inputs
        self._records = {entry.topic: entry for entry in inputs.inputs}

    def command(self, topic: str, data: bytes) -> None:
        """
        Record a command message.

        Parameters
        ----------
        topic
            Name of its command topic, relative.
        data
            The message (CDR).

        """
        if self._inputs.tap is not None:
            self._inputs.tap.command(self._records[topic].record, data)

    def event(self, **change: Any) -> None:
        """
        Record a change that no message made.

        Parameters
        ----------
        **change
            What has changed, by name; ready for JSON.

        """
        if self._inputs.tap is not None:
            self._inputs.tap.event(**change)


def check_pacing(settings: Mapping[str, Any]) -> None:
    """
    Check that the pacing leaves room for an autopilot.

    Parameters
    ----------
    settings
        Values of the node's parameters.

    Raises
    ------
    ConfigError
        If it is lockstep.

    """
    if settings['pacing'] == 'lockstep':
        raise ConfigError(
            "parameter 'pacing': an autopilot is a lockstep of its own; use free or realtime"
        )


@dataclass(frozen=True)
class Autopilots:
    """
    The autopilots of a node.

    Attributes
    ----------
    bridges
        One for each vehicle that has one.
    exchange
        What simulated time waits for; None without an autopilot.

    """

    bridges: Sequence[Bridge] = ()
    exchange: Exchange | None = None

    def close(self) -> None:
        """Close every socket."""
        for bridge in self.bridges:
            bridge.close()


def start_autopilots(
    simulation: Simulation,
    settings: Mapping[str, Any],
    inputs: Inputs,
    report: Callable[[str, str], None],
    inform: Callable[[str], None],
    reset: Callable[[], object],
) -> Autopilots:
    """
    Listen for the autopilots that the parameters ask for: one, or those of the scene file.

    Parameters
    ----------
    simulation
        Whose vehicles they fly.
    settings
        Values of the node's parameters.
    inputs
        The node's command topics; each autopilot adds one for sticks.
    report
        Takes (key, line): a fault to log.
    inform
        Takes each line that is news but no fault.
    reset
        Puts the vehicle back to where it started.

    Returns
    -------
    Autopilots
        Listening; none where neither parameters nor scene ask for one.

    Raises
    ------
    ConfigError, MissingExtraError
        If other parameters do not go with it, the mapping does not fit, the port is in use, or
        the extra is missing.

    """
    protocol = settings['autopilot.protocol']
    common = {
        name: settings[f'autopilot.{name}']
        for name in ('address', 'timeout', 'on_timeout', 'sticks_timeout', 'earth')
    }
    if protocol == 'none':
        return Autopilots()
    if protocol == 'scene':
        options = autopilots_of(simulation.scene, **common)
        if not options:
            return Autopilots()
    else:
        own = {
            name: settings[f'autopilot.{name}']
            for name in ('vehicle', 'mapping', 'instance', 'port')
        }
        options = [AutopilotOptions(protocol, **own, **common)]
    check_pacing(settings)
    if settings['thrust.unit'] != 'newton':
        raise ConfigError("parameter 'thrust.unit': with an autopilot it must be newton")
    log = CommandTap(inputs) if settings['record.path'] else None
    bridges = open_bridges(simulation, options, Surroundings(report, inform, reset, log))
    for bridge in bridges:
        inputs.add(sticks_topic(bridge.vehicle, bridge.set_sticks))
    return Autopilots(bridges, joined(bridges, simulation, log))
