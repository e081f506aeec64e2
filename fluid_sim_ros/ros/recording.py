# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Connects a node's topics with a recorder."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rclpy.node import Node

from fluid_sim_ros.loop.recorder_port import (
    RecordedTopic,
    RecorderOptions,
    RecorderPort,
    open_recorder,
    selected,
)
from fluid_sim_ros.messages.topic import NEWEST
from fluid_sim_ros.ros.health.diagnostics import DIAGNOSTICS, Diagnostics
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.ros.outputs import Outputs
from fluid_sim_ros.simulation import Simulation

_DIAGNOSTICS = '/diagnostics'


def start_recording(
    node: Node,
    simulation: Simulation,
    settings: Mapping[str, Any],
    inputs: Inputs,
    outputs: Outputs,
    diagnostics: Diagnostics,
) -> RecorderPort | None:
    """
    Begin to record what the parameters ask for.

    Parameters
    ----------
    node
        The simulator's node.
    simulation
        At the state that the log begins with.
    settings
        Values of the node's parameters.
    inputs, outputs, diagnostics
        What is recorded; each gets the recorder and its places in the log.

    Returns
    -------
    RecorderPort or None
        The recorder; None where the parameters ask for nothing.

    Raises
    ------
    ConfigError, MissingExtraError
        If a pattern matches no topic, the file cannot be made, or the extra is missing.

    """
    if not settings['record.path']:
        return None
    patterns = [pattern for pattern in settings['record.topics'] if pattern]
    names = [topic.name for topic in outputs.topics] + [_DIAGNOSTICS]
    old_names = [topic.name for topic in outputs.topics if topic.state.new_name]
    wanted = selected(names, patterns, old_names=old_names)
    recorded: list[RecordedTopic] = []
    for output in outputs.topics:
        if output.name in wanted:
            output.record = len(recorded)
            state = output.state
            recorded.append(RecordedTopic(output.full, state.type, output.name, *state.quality))
    for entry in inputs.inputs:
        entry.record = len(recorded)
        full = entry.subscription.topic
        recorded.append(RecordedTopic(full, entry.command.type, entry.topic, *NEWEST))
    if _DIAGNOSTICS in wanted:
        diagnostics.record = len(recorded)
        recorded.append(RecordedTopic(_DIAGNOSTICS, DIAGNOSTICS, _DIAGNOSTICS))
    options = RecorderOptions(
        path=Path(settings['record.path']),
        settings={name: _plain(value) for name, value in settings.items()},
        namespace=node.get_namespace(),
        policy=settings['record.policy'],
        queue_mib=settings['record.queue'],
        chunk_s=settings['record.chunk'],
        allow_assets_from=tuple(map(Path, filter(None, [settings['record.allow_assets_from']]))),
    )
    tap = open_recorder(simulation, recorded, options)
    inputs.tap = outputs.tap = diagnostics.tap = tap
    return tap


def _plain(value: Any) -> Any:
    """Return a parameter's value as JSON can hold it (ROS gives arrays of its own kind)."""
    if isinstance(value, str | int | float):
        return value
    return list(value)
