# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The magnetometer, and the Earth's field at home."""

from collections.abc import Sequence

import numpy as np
from pygeomag import GeoMag

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.scene import Home
from fluid_sim_ros.schema.sensors import MagnetometerFile
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import MAGNETIC_FIELD, Quantity, Reading
from fluid_sim_ros.sensors.sensor import Sensor


def earth_field(home: Home) -> Array:
    """
    Return the Earth's magnetic flux density at home.

    The World Magnetic Model (Chulliat et al., NOAA/NCEI and BGS) of the home's year, evaluated by
    pygeomag.

    Parameters
    ----------
    home
        Place and year.

    Returns
    -------
    Array
        [T], world axes (east, north, up), shape (3,).

    Raises
    ------
    ConfigError
        If the year is outside the model's five years.

    """
    model = GeoMag()
    try:
        field = model.calculate(
            glat=home.latitude, glon=home.longitude, alt=home.altitude / 1000.0, time=home.year
        )
    except ValueError as error:
        raise ConfigError(f'home: year {home.year:g}: {error}') from None
    # pygeomag: north, east, down in nanotesla
    return np.array([field.y, field.x, -field.z]) * 1e-9


class Magnetometer(Sensor, file=MagnetometerFile):
    """
    The Earth's field in the axes of the mount; the vehicle's own magnetism is left out.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    field
        Magnetic flux density [T], shape (3,).

    """

    config: MagnetometerFile
    channels = (('field', 3),)
    dither = (1e-7,)  # [T]: 1 mG
    readings = (Reading('imu/mag', MAGNETIC_FIELD, (Quantity('field', 'T', ('field',)),)),)

    def __init__(self, carrier: Carrier, config: MagnetometerFile) -> None:
        super().__init__(carrier, config)
        self.field = self.values
        self.field_w = earth_field(carrier.simulation.scene.home)

    def _measure(self, values: Array) -> bool:
        values[:] = self.mount.turned(self._to_body(self.field_w.tolist()))
        return True

    def compiled_constants(self) -> Sequence[float]:
        """Return the Earth's field [T], world axes."""
        field_w: list[float] = self.field_w.tolist()
        return field_w
