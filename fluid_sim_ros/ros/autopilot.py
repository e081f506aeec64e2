"""Connects a node with the autopilot that flies one of its vehicles."""

from collections.abc import Callable, Mapping
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Bridge, Surroundings, open_bridge
from fluid_sim_ros.messages.commands import sticks_topic
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.simulation import Simulation


class CommandTap:
    """Hands the autopilot's commands to the recorder as if they had come on their topics."""

    def __init__(self, inputs: Inputs) -> None:
        self._inputs = inputs
        self._records = {entry.topic: entry for entry in inputs.inputs}

    def command(self, topic: str, data: bytes) -> None:
        """Record a command message."""
        if self._inputs.tap is not None:
            self._inputs.tap.command(self._records[topic].record, data)

    def event(self, **change: Any) -> None:
        """Record a change that no message made."""
        if self._inputs.tap is not None:
            self._inputs.tap.event(**change)


def check_pacing(settings: Mapping[str, Any]) -> None:
    """Raise ConfigError where the pacing leaves no room for an autopilot."""
    if settings['pacing'] == 'lockstep':
        raise ConfigError(
            "parameter 'pacing': an autopilot is a lockstep of its own; use free or realtime"
        )


def start_autopilot(
    simulation: Simulation,
    settings: Mapping[str, Any],
    inputs: Inputs,
    report: Callable[[str, str], None],
    reset: Callable[[], object],
) -> Bridge | None:
    """
    Listen for the autopilot that the parameters ask for; None when they ask for none.

    Raises
    ------
    ConfigError, MissingExtraError
        If other parameters do not go with it, the mapping does not fit, the port is in use, or
        the extra is missing.

    """
    if settings['autopilot.protocol'] == 'none':
        return None
    check_pacing(settings)
    if settings['thrust.unit'] != 'newton':
        raise ConfigError("parameter 'thrust.unit': with an autopilot it must be newton")
    options = AutopilotOptions(
        **{
            name: settings[f'autopilot.{name}']
            for name in (
                'protocol', 'vehicle', 'mapping', 'instance', 'port', 'address', 'timeout',
                'sticks_timeout',
            )
        }
    )  # fmt: skip
    log = CommandTap(inputs) if settings['record'] else None
    bridge = open_bridge(simulation, options, Surroundings(report, reset, log))
    if bridge.takes_sticks:
        inputs.add(sticks_topic(bridge.vehicle, bridge.set_sticks))
    return bridge
