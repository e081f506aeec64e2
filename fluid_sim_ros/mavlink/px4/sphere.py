# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The Earth as PX4 projects it: a sphere of 6371 km, on which 1 m is 1 m in every direction."""

import math

from fluid_sim_ros.schema.scene import Home

#: PX4's CONSTANTS_RADIUS_OF_EARTH [m].
RADIUS = 6_371_000.0


class SphereFrame:
    """
    Geodetic places of local ones, by the azimuthal equidistant projection (Snyder 1987, p. 191).

    It is the inverse of PX4's own, so PX4 finds the very metres of the simulation; on WGS 84 it
    finds 0.3 % less to the east and west.

    Parameters
    ----------
    home
        Where the origin of the world lies.

    """

    def __init__(self, home: Home) -> None:
        self._home = home
        latitude = math.radians(home.latitude)
        self._sine, self._cosine = math.sin(latitude), math.cos(latitude)

    def geodetic(self, east: float, north: float, up: float) -> tuple[float, float, float]:
        """
        Return the place on the Earth.

        Parameters
        ----------
        east, north, up
            From the origin of the world [m].

        Returns
        -------
        tuple
            Latitude and longitude [deg], altitude [m] in the datum of the home's.

        """
        home, distance = self._home, math.hypot(east, north)
        if distance == 0.0:
            return home.latitude, home.longitude, home.altitude + up
        angle = distance / RADIUS
        sine, cosine = math.sin(angle), math.cos(angle)
        north_share, east_share = north / distance, east / distance
        latitude = math.asin(cosine * self._sine + north_share * sine * self._cosine)
        turn = math.atan2(
            east_share * sine, self._cosine * cosine - north_share * self._sine * sine
        )
        return (
            math.degrees(latitude), home.longitude + math.degrees(turn), home.altitude + up
        )  # fmt: skip
