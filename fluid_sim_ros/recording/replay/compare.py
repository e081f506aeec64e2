# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How a state message differs from a recorded one, field by field."""

from dataclasses import dataclass
from typing import Any

from fluid_sim_ros.errors import printable
from fluid_sim_ros.recording.decode import fields
from fluid_sim_ros.recording.log import LogMessage


@dataclass(frozen=True)
class Difference:
    """The first number of a log that a repetition does not reproduce."""

    topic: str
    time_s: float
    step: int
    field: str
    recorded: Any
    simulated: Any

    def __str__(self) -> str:
        return (
            f'{self.topic} at {self.time_s:.6f} s (step {self.step}): {self.field} was '
            f'{printable(self.recorded)}, is {printable(self.simulated)}'
        )


def compare(
    message: LogMessage, data: bytes, definition: str, tolerance: float
) -> tuple[float, Difference | None]:
    """
    Compare the fields of a recorded message with those of another of its type.

    Parameters
    ----------
    message
        As recorded.
    data
        CDR bytes of the other; empty: a reading that did not come.
    definition
        Of the message type.
    tolerance
        Largest difference allowed, relative to the larger of 1 and the recorded number.

    Returns
    -------
    The largest difference [-], and the first one beyond the tolerance.

    """
    recorded = fields(definition, message.data)
    simulated = of_the_same_joints(recorded, fields(definition, data) if data else {})
    largest, first = 0.0, None
    for name in recorded | simulated:
        old, new = recorded.get(name), simulated.get(name)
        size = _size(old, new)
        largest = max(largest, size)
        if first is None and size > tolerance:
            time = message.log_ns / 1e9
            first = Difference(message.topic, time, message.step, name, old, new)
    return largest, first


def of_the_same_joints(recorded: dict[str, Any], simulated: dict[str, Any]) -> dict[str, Any]:
    """
    Return what a sensor_msgs/JointState says of the joints that a recorded one names.

    Logs of earlier versions name thrusters alone. Other messages stay as they are, and
    so do those that name other joints than the recorded one.

    Parameters
    ----------
    recorded, simulated
        Fields of both messages, by their names.

    Returns
    -------
    dict
        Fields of the simulated one, in the places that the recorded one has.

    """
    old = [value for name, value in recorded.items() if name.startswith('name[')]
    new = [value for name, value in simulated.items() if name.startswith('name[')]
    if not 0 < len(old) < len(new) or not set(old) < set(new):
        return simulated
    same = {name: value for name, value in simulated.items() if '[' not in name}
    for place, joint in enumerate(old):
        ending = f'[{new.index(joint)}]'
        for name, value in simulated.items():
            if name.endswith(ending):
                same[f'{name.removesuffix(ending)}[{place}]'] = value
    return same


def _size(old: Any, new: Any) -> float:
    """Return the difference of two values relative to the larger of 1 and the old one."""
    if isinstance(old, float) and isinstance(new, float):
        if old == new or (old != old and new != new):
            return 0.0
        size = abs(new - old) / max(1.0, abs(old))
        return size if size == size else float('inf')
    return 0.0 if old == new else float('inf')
