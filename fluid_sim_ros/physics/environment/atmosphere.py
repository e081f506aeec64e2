# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The standard atmosphere, and the pressure under water."""

import math

#: ISO 2533:1975, sea level and troposphere.
PRESSURE = 101_325.0  # [Pa]
TEMPERATURE = 288.15  # [K]
DENSITY = 1.225  # [kg/m^3]
GRAVITY = 9.80665  # [m/s^2]
GAS_CONSTANT = 287.05287  # specific, of air [J/(kg K)]
LAPSE = -0.0065  # [K/m]
TROPOPAUSE = 11_000.0  # [m], geopotential
TOP = 20_000.0  # [m], geopotential: end of the isothermal layer
EARTH_RADIUS = 6_356_766.0  # nominal, of the standard [m]

_EXPONENT = -GRAVITY / (GAS_CONSTANT * LAPSE)
_AT_TROPOPAUSE = 1.0 + LAPSE * TROPOPAUSE / TEMPERATURE
TROPOPAUSE_PRESSURE = PRESSURE * math.pow(_AT_TROPOPAUSE, _EXPONENT)


def standard_temperature(altitude: float) -> float:
    """
    Return the temperature of the standard atmosphere.

    ISO 2533: T = T0 + L h with the lapse rate L up to 11 km (geopotential), constant above.

    Parameters
    ----------
    altitude
        Geometric, above mean sea level [m].

    Returns
    -------
    [K].

    """
    return TEMPERATURE + LAPSE * min(_geopotential(altitude), TROPOPAUSE)


def standard_pressure(altitude: float) -> float:
    """
    Return the pressure of the standard atmosphere.

    ISO 2533: p = p0 (T/T0)^(-g/(R L)) with the lapse rate L up to 11 km, and exponential in the
    isothermal layer above. Beyond 20 km (geopotential) the layer is continued.

    Parameters
    ----------
    altitude
        Geometric, above mean sea level [m].

    Returns
    -------
    [Pa].

    """
    height = _geopotential(altitude)
    if height <= TROPOPAUSE:
        return PRESSURE * math.pow(1.0 + LAPSE * height / TEMPERATURE, _EXPONENT)
    scale = GAS_CONSTANT * TEMPERATURE * _AT_TROPOPAUSE / GRAVITY
    return TROPOPAUSE_PRESSURE * math.exp((TROPOPAUSE - height) / scale)


def pressure_altitude(pressure: float) -> float:
    """
    Return the geometric altitude at which the standard troposphere has a pressure.

    The inverse of ``standard_pressure`` below 11 km, continued beyond.

    Parameters
    ----------
    pressure
        [Pa]; below 0 it counts as 0.

    Returns
    -------
    Above mean sea level [m].

    """
    ratio = math.pow(max(pressure, 0.0) / PRESSURE, 1.0 / _EXPONENT)
    height = TEMPERATURE / LAPSE * (ratio - 1.0)
    return EARTH_RADIUS * height / (EARTH_RADIUS - height)


def _geopotential(altitude: float) -> float:
    return EARTH_RADIUS * altitude / (EARTH_RADIUS + altitude)
