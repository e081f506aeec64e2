# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Barometer and water pressure sensor: the static pressure of what is around them."""

from collections.abc import Sequence

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import (
    TROPOPAUSE_PRESSURE,
    pressure_altitude,
    standard_pressure,
    standard_temperature,
)
from fluid_sim_ros.scene.media import Fluids
from fluid_sim_ros.schema.sensors import BarometerFile, PressureFile
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import pressure_reading
from fluid_sim_ros.sensors.sensor import Sensor


class _Static(Sensor):
    """
    Static pressure: the standard atmosphere above the surface, hydrostatic below.

        p = p_ISA(altitude)                      in air
        p = p_ISA(altitude of surface) + rho g d at depth d in water

    The dynamic pressure of the flow past the vehicle is left out.
    """

    config: BarometerFile | PressureFile
    channels = (('pressure', 1),)
    dither = (1.0,)  # [Pa]: 8 cm of air, 0.1 mm of water

    def __init__(self, carrier: Carrier, config: BarometerFile | PressureFile) -> None:
        super().__init__(carrier, config)
        self._fluids = Fluids.of(carrier.simulation.model, carrier.simulation.streams)
        self._home = carrier.simulation.scene.home.altitude
        gravity = -float(carrier.simulation.model.opt.gravity[2])
        self._weight = self._fluids.water_density * gravity
        self._at_surface = standard_pressure(self._home + self._fluids.surface)
        self.pressure = 0.0

    def _measure(self, values: Array) -> bool:
        height = self._position_w()[2]
        depth = self._fluids.surface - height
        if depth > 0:
            values[0] = self._at_surface + self._weight * depth
        else:
            values[0] = standard_pressure(self._home + height)
        return True

    def compiled_constants(self) -> Sequence[float]:
        """
        Return height of the surface and altitude of home [m], weight of water, pressures.

        Returns
        -------
        Sequence
            [m], [m], [N/m^3]; at the surface and at the tropopause [Pa].

        """
        return (
            self._fluids.surface, self._home, self._weight, self._at_surface, TROPOPAUSE_PRESSURE
        )  # fmt: skip


class Barometer(_Static, file=BarometerFile):
    """
    A barometer.

    Attributes
    ----------
    pressure
        [Pa].
    altitude
        Where the standard atmosphere has this pressure [m].
    temperature
        Of the standard atmosphere there [K].

    """

    readings = (pressure_reading('pressure'),)
    altitude = 0.0
    temperature = 0.0

    def _convert(self) -> None:
        self.pressure = float(self.values[0])
        self.altitude = pressure_altitude(self.pressure)
        self.temperature = standard_temperature(self.altitude)


class WaterPressure(_Static, file=PressureFile):
    """
    An absolute pressure sensor of a vehicle in water.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    pressure
        [Pa].
    depth
        Below the mean surface by that pressure [m]; about 0 in air.

    """

    readings = (pressure_reading('water/pressure'),)
    depth = 0.0

    def __init__(self, carrier: Carrier, config: PressureFile) -> None:
        super().__init__(carrier, config)
        if not self._weight > 0:
            raise ConfigError(f'{self.where}: the scene has no water, or no gravity downwards')

    def _convert(self) -> None:
        self.pressure = float(self.values[0])
        self.depth = (self.pressure - self._at_surface) / self._weight
