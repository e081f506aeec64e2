"""Connects a node with the autopilot that flies one of its vehicles."""

from collections.abc import Callable, Mapping
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Bridge, Surroundings, open_bridge
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


def start_autopilot(
    simulation: Simulation,
    settings: Mapping[str, Any],
    inputs: Inputs,
    report: Callable[[str, str], None],
    inform: Callable[[str], None],
    reset: Callable[[], object],
) -> Bridge | None:
    """
    Listen for the autopilot that the parameters ask for.

    Parameters
    ----------
    simulation
        Whose vehicle it flies.
    settings
        Values of the node's parameters.
    inputs
        The node's command topics; an autopilot that takes sticks adds one.
    report
        Takes (key, line): a fault to log.
    inform
        Takes each line that is news but no fault.
    reset
        Puts the vehicle back to where it started.

    Returns
    -------
    Bridge or None
        The bridge; None where the parameters ask for no autopilot.

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
                'on_timeout', 'sticks_timeout', 'earth',
            )
        }
    )  # fmt: skip
    log = CommandTap(inputs) if settings['record.path'] else None
    bridge = open_bridge(simulation, options, Surroundings(report, inform, reset, log))
    inputs.add(sticks_topic(bridge.vehicle, bridge.set_sticks))
    return bridge
