# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The YAML schema of a scene with several vehicles, each of a model of its own."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from fluid_sim_ros.schema.base import Name, Number, Positive, Strict
from fluid_sim_ros.schema.scene import SceneKeys, VehicleFile

#: Protocols of autopilots; ``loop.autopilot_port`` says more of them.
Protocol = Literal['px4', 'ardupilot']
#: Place of a vehicle: x, y and, where it is not that of the keyframe, z [m].
Place = Annotated[list[Number], Field(min_length=2, max_length=3)]


class FleetAutopilot(Strict):
    """
    Who flies a vehicle of a fleet.

    Attributes
    ----------
    protocol
        ``px4`` or ``ardupilot``.
    instance
        Its number on this host, which shifts the port; None: it counts from 0 in the order of the
        file, for each protocol on its own.
    mapping
        File of config/autopilots; '': ``<protocol>_<model>``.
    port
        To listen on; 0: by protocol and instance.
    parameters
        Of the autopilot, in place of those of the mapping; for a program that is started.

    """

    protocol: Protocol
    instance: Annotated[int, Field(ge=0, le=250)] | None = None
    mapping: str = ''
    port: Annotated[int, Field(ge=0, le=65535)] = 0
    parameters: dict[str, Number] = {}


def _autopilot(content: Any) -> Any:
    return {'protocol': content} if isinstance(content, str) else content


class FleetVehicle(Strict):
    """
    One vehicle of a fleet, or several alike.

    Attributes
    ----------
    model
        Name of a model, or path of an MJCF file.
    vehicle
        How commands map onto it: a vehicle file, or its content; None: that of the model's name,
        or else the model's only free body.
    position
        Of its base in the world [m]; without z: at the height of its keyframe, or as the model
        stands.
    yaw
        Turn about the vertical [deg], counter-clockwise from above; added to the model's own.
    keyframe
        Of its model, for joints, rotors and controls at the start; '': as the model stands.
    autopilot
        Who flies it; None: nobody.
    count, spacing
        So many of them, NAME_1, NAME_2, ..., on a square grid with this spacing [m]; the first at
        ``position``, rows along x, then along y.

    """

    model: str
    vehicle: str | VehicleFile | None = None
    position: Place = [0.0, 0.0]
    yaw: Number = 0.0
    keyframe: str = ''
    autopilot: Annotated[FleetAutopilot | None, BeforeValidator(_autopilot)] = None
    count: Annotated[int, Field(ge=1)] | None = None
    spacing: Positive | None = None

    @model_validator(mode='after')
    def _is_spaced(self) -> 'FleetVehicle':
        if (self.count is None) != (self.spacing is None):
            raise ValueError('count and spacing [m] go together; give both or none')
        return self


class FleetFile(SceneKeys):
    """
    One file of config/scenes without a model of its own.

    Attributes
    ----------
    vehicles
        By name; its topics begin with the name.
    world
        Model whose ground, light and fluid the scene has; '': that of a vehicle (doc/fleets.md).

    """

    vehicles: Annotated[dict[Name, FleetVehicle], Field(min_length=1)]
    world: str = ''
