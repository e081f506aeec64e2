# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The receiver of a satellite navigation system."""

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.media import Fluids
from fluid_sim_ros.schema.sensors import GnssFile
from fluid_sim_ros.sensors.geodesy import LocalFrame
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import NAV_SAT_FIX, VELOCITY, Quantity, Reading
from fluid_sim_ros.sensors.sensor import Sensor


class Gnss(Sensor, file=GnssFile):
    """
    Position and velocity of the antenna; without a reading while it is under water.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    position_w, velocity_w
        East, north, up: [m] from home, and [m/s], shape (3,) each.
    latitude, longitude, altitude
        WGS 84 [deg], [deg], [m]; the altitude in the datum of the home's.
    geodetic
        The same three, shape (3,).

    """

    config: GnssFile
    channels = (('horizontal', 2), ('vertical', 1), ('velocity', 3))
    readings = (
        Reading('gps/fix', NAV_SAT_FIX, (
            Quantity('geodetic', ('deg', 'deg', 'm'), ('horizontal', 'horizontal', 'vertical')),
        )),
        Reading('gps/vel', VELOCITY, (Quantity('velocity_w', 'm/s', ('velocity',)),), frame='map'),
    )  # fmt: skip
    latitude = longitude = altitude = 0.0

    def __init__(self, carrier: Carrier, config: GnssFile) -> None:
        super().__init__(carrier, config)
        self.position_w, self.velocity_w = self.values[:3], self.values[3:]
        self.geodetic = np.zeros(3)
        self._surface = Fluids.of(carrier.simulation.model, carrier.simulation.streams).surface
        self._frame = LocalFrame(carrier.simulation.scene.home)

    def _measure(self, values: Array) -> bool:
        values[:3] = self._position_w()
        values[3:] = self._velocity_b() @ self._rotation_bw()
        return bool(values[2] >= self._surface)

    def _convert(self) -> None:
        place = self._frame.geodetic(*self.position_w.tolist())
        self.geodetic[:] = self.latitude, self.longitude, self.altitude = place
