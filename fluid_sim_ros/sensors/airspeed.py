# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The airspeed sensor: a pitot tube."""

import math
from collections.abc import Sequence

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import DENSITY
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.media import Fluids
from fluid_sim_ros.schema.sensors import AirspeedFile
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import pressure_reading
from fluid_sim_ros.sensors.sensor import Sensor


class Airspeed(Sensor, file=AirspeedFile):
    """
    Differential pressure q = rho v |v| / 2 of the flow along x of the mount, wind included.

    v is the component of the velocity relative to the air (incompressible flow, no error of the
    tube's place or of cross flow), rho the density that the scene's forces see. Without a reading
    while it is under water.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    differential_pressure
        [Pa]; negative in flow from behind.
    airspeed
        Indicated airspeed: the speed that gives this pressure at sea level's standard density
        [m/s]; negative in flow from behind.

    """

    config: AirspeedFile
    channels = (('pressure', 1),)
    readings = (pressure_reading('airspeed/pressure'),)
    differential_pressure = airspeed = 0.0

    def __init__(self, carrier: Carrier, config: AirspeedFile) -> None:
        super().__init__(carrier, config)
        fluids = Fluids.of(carrier.simulation.model, carrier.simulation.streams)
        self._surface, self._density = fluids.surface, fluids.air_density
        if not self._density > 0:
            raise ConfigError(f'{self.where}: the scene has no air')

    def _measure(self, values: Array) -> bool:
        x, y, z = self._velocity_b().tolist()
        u, v, w = self._to_body(self._state[nat.MEDIUM_VELOCITY].tolist())
        speed = self.mount.turned((x - u, y - v, z - w))[0]
        values[0] = 0.5 * self._density * speed * abs(speed)
        return self._position_w()[2] >= self._surface

    def compiled_constants(self) -> Sequence[float]:
        """Return the height of the surface [m] and the density of the air [kg/m^3]."""
        return self._surface, self._density

    def _convert(self) -> None:
        self.differential_pressure = q = float(self.values[0])
        self.airspeed = math.copysign(math.sqrt(2.0 * abs(q) / DENSITY), q)
