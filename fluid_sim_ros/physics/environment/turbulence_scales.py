# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Intensity and length of atmospheric turbulence by height: MIL-F-8785C (1980), 3.7."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.physics.arrays import Array

FOOT = 0.3048  # [m]
#: Length scale above 2000 ft [m].
HIGH_LENGTH = {'dryden': 1750 * FOOT, 'von_karman': 2500 * FOOT}

# Heights of MIL-F-8785C, 3.7.3.4 [ft]: the low-altitude model counts from 10 ft and ends at
# 1000 ft, the other begins at 2000 ft.
_LOWEST, _LOW, _HIGH = 10.0, 1000.0, 2000.0
#: MIL-F-8785C, figure 7: altitude [ft], and rms turbulence [ft/s] by probability of exceedance.
ALTITUDES = (500, 1750, 3750, 7500, 15000, 25000, 35000, 45000, 55000, 65000, 75000, 80000)
EXCEEDANCE = {
    '2e-1': (3.2, 2.2, 1.5, 0, 0, 0, 0, 0, 0, 0, 0, 0),
    '1e-1': (4.2, 3.6, 3.3, 1.6, 0, 0, 0, 0, 0, 0, 0, 0),
    '1e-2': (6.6, 6.9, 7.4, 6.7, 4.6, 2.7, 0.4, 0, 0, 0, 0, 0),
    '1e-3': (8.6, 9.6, 10.6, 10.1, 8.0, 6.6, 5.0, 4.2, 2.7, 0, 0, 0),
    '1e-4': (11.8, 13.0, 16.0, 15.1, 11.6, 9.7, 8.1, 8.2, 7.9, 4.9, 3.2, 2.1),
    '1e-5': (15.6, 17.6, 23.0, 23.6, 22.1, 20.0, 16.0, 15.1, 12.1, 7.9, 6.2, 5.1),
    '1e-6': (18.7, 21.5, 28.4, 30.2, 30.7, 31.0, 25.2, 23.1, 17.5, 10.7, 8.4, 7.2),
}


def turbulence_intensity(
    height: ArrayLike, wind_6m: float, exceedance: str = '1e-2'
) -> tuple[Array, Array]:
    """
    Return sigma of u, v, w [m/s] and its slope over the height [1/s], shape (..., 3) each.

    Up to 1000 ft sigma_w = 0.1 W20 and sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4, h
    in ft and at least 10 (figure 11); from 2000 ft on the curve of figure 7; linear between.

    Parameters
    ----------
    height
        Above the ground [m], shape (...).
    wind_6m
        W20, the mean wind 20 ft (6 m) above the ground [m/s].
    exceedance
        Probability that the intensity is exceeded; a key of ``EXCEEDANCE``.

    Raises
    ------
    ConfigError
        For a probability without a curve.

    """
    if exceedance not in EXCEEDANCE:
        raise ConfigError(f"exceedance '{exceedance}'; allowed: {listed(EXCEEDANCE)}")
    feet, vertical = np.asarray(height, dtype=np.float64) / FOOT, 0.1 * wind_6m
    base = 0.177 + 0.000823 * np.clip(feet, _LOWEST, _LOW)
    horizontal = vertical / base**0.4
    slope = np.where(feet < _LOWEST, 0.0, -0.4 * 0.000823 / FOOT * horizontal / base)

    curve = np.array(EXCEEDANCE[exceedance]) * FOOT
    at_high = np.interp(_HIGH, ALTITUDES, curve)
    slopes = np.concatenate([[0.0], np.diff(curve) / np.diff(ALTITUDES) / FOOT, [0.0]])
    high = np.interp(feet, ALTITUDES, curve)
    high_slope = slopes[np.searchsorted(ALTITUDES, feet, side='right')]

    middle_slope = (at_high - vertical) / (_HIGH - _LOW) / FOOT
    middle = vertical + middle_slope * FOOT * (feet - _LOW)
    isotropic = np.where(feet < _HIGH, middle, high)
    isotropic_slope = np.where(feet < _HIGH, middle_slope, high_slope)
    low = feet <= _LOW
    sigma = np.stack([np.where(low, s, isotropic) for s in (horizontal, horizontal, vertical)], -1)
    rise = np.stack([np.where(low, s, isotropic_slope) for s in (slope, slope, 0.0)], -1)
    return sigma, rise


def turbulence_length(height: ArrayLike, kind: str = 'dryden') -> Array:
    """
    Return the length scales of u, v, w.

    MIL-F-8785C, 3.7.3.

    Up to 1000 ft L_w = h and L_u = L_v = h / (0.177 + 0.000823 h)^1.2, h in ft and at least 10
    (figure 10); from 2000 ft on ``HIGH_LENGTH``; linear between.

    Parameters
    ----------
    height
        Above the ground [m], shape (...).
    kind
        ``dryden`` or ``von_karman``.

    Returns
    -------
    [m], shape (..., 3).

    """
    feet = np.maximum(np.asarray(height, dtype=np.float64) / FOOT, _LOWEST)
    low = np.minimum(feet, _LOW)
    horizontal = low / (0.177 + 0.000823 * low) ** 1.2
    share = np.clip((feet - _LOW) / (_HIGH - _LOW), 0.0, 1.0)
    rest = share * (HIGH_LENGTH[kind] / FOOT - _LOW)
    lengths: Array = FOOT * np.stack([horizontal + rest, horizontal + rest, low + rest], -1)
    return lengths
