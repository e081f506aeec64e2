# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The YAML schema of config/scenes and config/vehicles."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from fluid_sim_ros.schema.advised import Advised
from fluid_sim_ros.schema.base import Name, NotNegative, Number, Positive, Strict, Vector
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.schema.settings import Fluid, Integrator
from fluid_sim_ros.schema.waves import Waves
from fluid_sim_ros.schema.weather import Current, Wind


class VehicleFile(Strict):
    """One file of config/vehicles: how commands map onto a body of the MJCF model."""

    body: str
    thrusters: list[str] | None = None
    joints: list[str] | None = None
    sensors: SensorsFile = SensorsFile()
    source: str = ''


class Home(Strict):
    """
    Where the origin of the world lies on the Earth (WGS 84), and when.

    ``latitude`` and ``longitude`` [deg], ``altitude`` of the plane z = 0 [m], ``year`` of the
    magnetic field (decimal).
    """

    latitude: Annotated[Number, Field(ge=-90, le=90)] = 47.397742  # PX4's simulators, Zurich
    longitude: Annotated[Number, Field(ge=-180, le=180)] = 8.545594
    altitude: Annotated[Number, Field(ge=-5000, le=20000)] = 0.0
    year: Number = 2026.0


class BodyWrench(Strict):
    """A wrench at a vehicle's base_link origin: force [N], torque [N m], axes of ``frame``."""

    force: Vector = [0.0, 0.0, 0.0]
    torque: Vector = [0.0, 0.0, 0.0]
    frame: Literal['base_link', 'map'] = 'base_link'


class ScheduledEvent(Strict):
    """What changes at one simulated time ``at`` [s]."""

    at: NotNegative
    wind: Vector | None = None
    current: Vector | None = None
    thrust: dict[Name, list[Number]] = {}
    wrench: dict[Name, BodyWrench] = {}

    @model_validator(mode='after')
    def _does_something(self) -> 'ScheduledEvent':
        if not (self.wind or self.current or self.thrust or self.wrench):
            raise ValueError('changes nothing; allowed: wind, current, thrust, wrench')
        return self


class Gait(Strict):
    """
    A sine wave on a vehicle's joints (control.gait.JointWave), from the start of the scene.

    ``frequency`` [Hz], ``amplitudes``, ``phases`` and ``offsets`` [rad] one per joint in command
    order, smooth start over ``ramp`` [s], evaluated at ``rate`` [Hz].
    """

    frequency: Positive
    amplitudes: list[Number]
    phases: list[Number]
    offsets: list[Number] = []
    ramp: NotNegative = 0.0
    rate: Positive = 100.0


class SceneKeys(Strict):
    """What every file of config/scenes may say, whatever its vehicles are."""

    description: str = ''
    medium: Literal['air', 'water'] | None = None
    timestep: Positive | None = None
    integrator: Integrator | None = None
    fluid: Fluid | None = None
    advised: Advised | None = None
    duration: Positive = 10.0
    home: Home = Home()
    waves: Waves | None = None
    wind: Wind = []
    current: Current = []
    schedule: list[ScheduledEvent] = []
    gait: dict[Name, Gait] = {}


class ModelKeys(Strict):
    """What a file of config/scenes says of its one model."""

    model: str
    vehicles: dict[Name, str | VehicleFile] | None = None
    keyframe: str | None = None


class SceneFile(SceneKeys, ModelKeys):
    """One file of config/scenes that names a model; ``schema.fleet`` has the other kind."""
