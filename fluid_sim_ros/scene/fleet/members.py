# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a fleet is made of: its vehicles' models, and where each begins."""

from dataclasses import dataclass, field
from pathlib import Path

from fluid_sim_ros.schema.fleet import FleetAutopilot

#: Keyframe of a composed model at which its vehicles begin.
START = 'start'


@dataclass(frozen=True)
class Member:
    """
    One vehicle of a fleet.

    Attributes
    ----------
    model_path
        The MJCF file of its model.
    position
        Of its base in the world [m], shape (2,) or (3,); without z: as the keyframe has it.
    yaw
        Added turn about the vertical [deg].
    keyframe
        Of its model; '': as the model stands.
    autopilot
        Who flies it, or None; its instance is a number.
    kind
        By which mappings of autopilots go: the name of its vehicle file, or else of its model.
    mjcf, assets
        The model as text, in place of the file, and the files that it names.

    """

    model_path: Path
    position: tuple[float, ...] = (0.0, 0.0)
    yaw: float = 0.0
    keyframe: str = ''
    autopilot: FleetAutopilot | None = None
    kind: str = ''
    mjcf: str = field(default='', repr=False)
    assets: dict[str, bytes] = field(default_factory=dict, repr=False)


@dataclass(frozen=True)
class Fleet:
    """
    The vehicles that are put into the world of a scene's model.

    Attributes
    ----------
    members
        By vehicle name.
    taken_out
        Bodies of the world's model that are not part of the world.

    """

    members: dict[str, Member]
    taken_out: tuple[str, ...] = ()


def prefix_of(name: str) -> str:
    """
    Return what the names of a vehicle's bodies and actuators begin with in a composed model.

    Parameters
    ----------
    name
        Of the vehicle.

    """
    return f'{name}/'
