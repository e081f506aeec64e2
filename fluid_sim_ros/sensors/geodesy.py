# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Places of the world on the Earth: WGS 84, in closed form."""

import math

from fluid_sim_ros.schema.scene import Home

#: WGS 84 (NGA.STND.0036, 2014): semi-major axis [m] and flattening.
SEMI_MAJOR_AXIS = 6_378_137.0
FLATTENING = 1.0 / 298.257223563
_E2 = FLATTENING * (2.0 - FLATTENING)

Triple = tuple[float, float, float]


def geodetic_to_ecef(latitude: float, longitude: float, altitude: float) -> Triple:
    """
    Return the Earth-centred coordinates of a place.

    Parameters
    ----------
    latitude, longitude
        [rad].
    altitude
        Above the ellipsoid [m].

    Returns
    -------
    tuple
        x, y, z [m].

    """
    sine, cosine = math.sin(latitude), math.cos(latitude)
    radius = SEMI_MAJOR_AXIS / math.sqrt(1.0 - _E2 * sine * sine)
    return (
        (radius + altitude) * cosine * math.cos(longitude),
        (radius + altitude) * cosine * math.sin(longitude),
        (radius * (1.0 - _E2) + altitude) * sine,
    )


def ecef_to_geodetic(x: float, y: float, z: float) -> Triple:
    """
    Return latitude, longitude and height of a place.

    The closed form of Vermeille, *J. Geodesy* 76 (2002) 451-454; valid everywhere but within 43 km
    of the Earth's centre.

    Parameters
    ----------
    x, y, z
        Earth-centred coordinates [m].

    Returns
    -------
    tuple
        Latitude and longitude [rad], height above the ellipsoid [m].

    """
    a, e4 = SEMI_MAJOR_AXIS, _E2 * _E2
    across = math.hypot(x, y)
    p = (across / a) ** 2
    q = (1.0 - _E2) * (z / a) ** 2
    r = (p + q - e4) / 6.0
    s = e4 * p * q / (4.0 * r**3)
    t = math.cbrt(1.0 + s + math.sqrt(s * (2.0 + s)))
    u = r * (1.0 + t + 1.0 / t)
    v = math.sqrt(u * u + e4 * q)
    w = _E2 * (u + v - q) / (2.0 * v)
    k = math.sqrt(u + v + w * w) - w
    d = k * across / (k + _E2)
    distance = math.hypot(d, z)
    latitude = 2.0 * math.atan2(z, d + distance)
    return latitude, math.atan2(y, x), (k + _E2 - 1.0) / k * distance


class LocalFrame:
    """
    The world's axes (east, north, up) at their home: a plane that touches the ellipsoid there.

    So a place far out at z = 0 lies above the ellipsoid, by d^2/(2 R): 0.08 m at 1 km.

    Parameters
    ----------
    home
        Where the world's origin lies.

    """

    def __init__(self, home: Home) -> None:
        latitude, longitude = math.radians(home.latitude), math.radians(home.longitude)
        self._origin = geodetic_to_ecef(latitude, longitude, home.altitude)
        sine, cosine = math.sin(latitude), math.cos(latitude)
        se, ce = math.sin(longitude), math.cos(longitude)
        self._east = (-se, ce, 0.0)
        self._north = (-sine * ce, -sine * se, cosine)
        self._up = (cosine * ce, cosine * se, sine)

    def ecef(self, east: float, north: float, up: float) -> Triple:
        """
        Return the Earth-centred coordinates of a place in the world.

        Parameters
        ----------
        east, north, up
            World axes, from the origin [m].

        Returns
        -------
        tuple
            x, y, z [m].

        """
        x, y, z = (
            origin + east * e + north * n + up * u
            for origin, e, n, u in zip(
                self._origin, self._east, self._north, self._up, strict=True
            )
        )
        return x, y, z

    def geodetic(self, east: float, north: float, up: float) -> Triple:
        """
        Return latitude, longitude and height of a place in the world.

        Parameters
        ----------
        east, north, up
            World axes, from the origin [m].

        Returns
        -------
        tuple
            Latitude and longitude [deg], height above the ellipsoid [m].

        """
        latitude, longitude, height = ecef_to_geodetic(*self.ecef(east, north, up))
        return math.degrees(latitude), math.degrees(longitude), height
