# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Irregular seas: the JONSWAP spectrum, directional spreading, and components drawn from both."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, not_negative, positive
from fluid_sim_ros.physics.environment.wave_dispersion import checked_height, dispersion_wavenumber
from fluid_sim_ros.physics.environment.waves import Sea, unit_direction

#: Lowest frequency of a sea over the peak's: below it JONSWAP holds 2e-9 of the energy.
LOWEST = 0.5
#: Intervals of the midpoint rules, per bin of the spectrum and of the spreading function.
_BIN_POINTS, _TURN_POINTS = 64, 4096


def jonswap_shape(ratio: ArrayLike, gamma: float) -> Array:
    """
    Return the JONSWAP spectrum over the frequency ratio r = omega/omega_p, without its factor.

    r^-5 exp(-5/4 r^-4) gamma^exp(-(r - 1)^2/(2 sigma^2)), sigma = 0.07 up to the peak and 0.09
    above it; Hasselmann et al. (1973), Dtsch. Hydrogr. Z. A8(12). gamma = 1 is the
    Pierson-Moskowitz spectrum of a fully developed sea, 3.3 the mean of JONSWAP.

    Parameters
    ----------
    ratio
        r [-], above 0, shape (...).
    gamma
        Peakedness [-], 1 to 10.

    Returns
    -------
    [-], shape (...).

    """
    r = np.asarray(ratio, dtype=np.float64)
    sigma = np.where(r <= 1.0, 0.07, 0.09)
    peak = np.exp(-0.5 * ((r - 1.0) / sigma) ** 2)
    shape: Array = r**-5.0 * np.exp(-1.25 * r**-4.0) * gamma**peak
    return shape


def jonswap_spectrum(
    omega: ArrayLike, significant_height: float, peak_period: float, gamma: float = 3.3
) -> Array:
    """
    Return S(omega): the variance of the surface per angular frequency.

    With the factor 5/16 H_s^2 omega_p^4 omega^-5 (1 - 0.287 ln gamma) of DNV-RP-C205, 3.5.5, by
    which its integral is H_s^2/16 within 0.3 % for gamma from 1 to 5 (1.8 % at 7).

    Parameters
    ----------
    omega
        Angular frequency [rad/s], above 0, shape (...).
    significant_height, peak_period
        H_s [m] and T_p [s].
    gamma
        Peakedness [-], 1 to 10.

    Returns
    -------
    [m^2 s/rad], one-sided, shape (...).

    """
    omega_p = 2.0 * np.pi / float(positive(peak_period, 'peak period [s]'))
    norm = 5.0 / 16.0 * significant_height**2 / omega_p * (1.0 - 0.287 * np.log(gamma))
    density: Array = norm * jonswap_shape(np.asarray(omega) / omega_p, gamma)
    return density


def jonswap_waves(
    significant_height: float,
    peak_period: float,
    *,
    gamma: float = 3.3,
    direction: ArrayLike = (1.0, 0.0),
    spreading: float = 0.0,
    components: int = 64,
    repeat: float | None = None,
    cutoff: float = 4.0,
    seed: int = 0,
    depth: float = np.inf,
    gravity: float = 9.81,
) -> Sea:
    """
    Return a random sea of a JONSWAP spectrum that repeats exactly.

    All frequencies are multiples of 2 pi/repeat. The band from `LOWEST` to ``cutoff`` times the
    peak is cut into bins whose widths grow by a constant factor; each component has the whole
    energy of its bin and a multiple drawn from within it. So sum a^2/2 = H_s^2/16, and the
    variance at any place over one repeat is exactly that (harmonics are orthogonal), whatever the
    seed; in between the sea does not nearly repeat, as equal steps of frequency would. One
    direction per component keeps this true in a short-crested sea (Jefferys 1987, Applied Ocean
    Research 9:235).

    Parameters
    ----------
    significant_height, peak_period
        H_s = 4 sqrt(m_0) [m], 0 up to `breaking_height` at T_p, and T_p [s], > 0.
    gamma
        Peakedness, 1 to 10.
    direction
        Mean direction of travel, world x y, shape (2,).
    spreading
        s of cos^2s((chi - mean)/2) (Longuet-Higgins et al. 1963); 0: all waves run along
        ``direction``. Wind sea about 5 to 15, swell 25 to 75 (Goda 2010).
    components
        How many; the energy of the cut band is divided among them.
    repeat
        Period of the whole sea [s]; None: 200 peak periods.
    cutoff
        Highest frequency over the peak's. Beyond 4 lies 0.3 % of the energy (gamma 3.3).
    seed
        Of frequencies, phases and directions: a whole number from 0 to 2^53.
    depth, gravity
        As in `dispersion_wavenumber`.

    Raises
    ------
    ConfigError
        If a number is out of range, or ``repeat`` too short for that many components.

    """
    omega_p = 2.0 * np.pi / float(positive(peak_period, 'peak period [s]'))
    if not 1.0 <= gamma <= 10.0:
        raise ConfigError(f'gamma: {gamma}; allowed: 1 to 10')
    period = 200.0 * peak_period if repeat is None else float(positive(repeat, 'repeat [s]'))
    step = 2.0 * np.pi / period
    edges = _edges(omega_p / step, components, cutoff)
    variance = checked_height(significant_height, peak_period, depth, gravity) ** 2 / 16.0
    draw = uniforms(seed, 3 * components).reshape(components, 3)
    multiple = edges[:-1] + np.floor(draw[:, 0] * np.diff(edges))
    omega = step * multiple
    angle = spread_angle(draw[:, 2], spreading)
    along = unit_direction(direction)
    turned = np.stack([-along[1], along[0]])
    return Sea(
        amplitude=np.sqrt(2.0 * variance * _energy_shares(step / omega_p * (edges - 0.5), gamma)),
        omega=omega,
        wavenumber=dispersion_wavenumber(omega, depth, gravity),
        direction=np.cos(angle)[:, np.newaxis] * along + np.sin(angle)[:, np.newaxis] * turned,
        phase=2.0 * np.pi * draw[:, 1],
        depth=float(depth),
        repeat=period,
    )


def spread_angle(share: ArrayLike, spreading: float) -> Array:
    """
    Return the angle from the mean direction below which a share of the energy lies [rad].

    The inverse of the distribution with the density cos^2s(chi/2) on (-pi, pi), by the midpoint
    rule and linear interpolation; 0 for spreading 0 (long-crested waves).

    Parameters
    ----------
    share
        In [0, 1], shape (...).
    spreading
        s [-], >= 0.

    """
    s, u = float(not_negative(spreading, 'spreading')), np.asarray(share, dtype=np.float64)
    if s == 0:
        return np.zeros_like(u)
    step = 2.0 * np.pi / _TURN_POINTS
    knots = -np.pi + step * np.arange(_TURN_POINTS + 1)
    below = np.r_[0.0, np.cumsum(np.cos(0.5 * (knots[:-1] + 0.5 * step)) ** (2.0 * s))]
    angle: Array = np.interp(u * below[-1], below, knots)
    return angle


def uniforms(seed: int, count: int) -> Array:
    """
    Return numbers in [0, 1), the same on every machine, from a seed and their index.

    SplitMix64 (Steele, Lea and Flood 2014, OOPSLA): the mixed 64-bit sum of the seed's own mix
    and (index + 1) golden-ratio steps; its upper 53 bits.

    Parameters
    ----------
    seed
        Whole number from 0 to 2^53.
    count
        How many.

    """
    if not (isinstance(seed, int) and 0 <= seed <= 2**53):
        raise ConfigError(f'seed: {seed}; allowed: a whole number from 0 to 2^53')
    golden = np.uint64(0x9E3779B97F4A7C15)
    index = np.arange(1, count + 1, dtype=np.uint64)
    mixed = _mix(_mix(np.full(1, seed, dtype=np.uint64)) + index * golden)
    draws: Array = (mixed >> np.uint64(11)).astype(np.float64) * 2.0**-53
    return draws


def _mix(state: np.typing.NDArray[np.uint64]) -> np.typing.NDArray[np.uint64]:
    state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return state ^ (state >> np.uint64(31))


def _edges(peak: float, components: int, cutoff: float) -> Array:
    """Return the first multiple of each bin, and the one after the last, shape (n + 1,)."""
    if not (components >= 1 and cutoff > 1):
        raise ConfigError(f'components {components}, cutoff {cutoff}; allowed: >= 1, > 1')
    ratio = cutoff / LOWEST
    needed = 1.0 / (LOWEST * (ratio ** (1.0 / components) - 1.0))
    if peak < needed:  # the first bin, the narrowest, holds no multiple
        raise ConfigError(
            f'repeat: {peak:.6g} peak periods; allowed: >= {needed:.6g} '
            f'for {components} components'
        )
    growth = ratio ** (np.arange(components + 1) / components)
    edges: Array = np.floor(LOWEST * peak * growth + 0.5)
    return edges


def _energy_shares(ratios: Array, gamma: float) -> Array:
    """Return the share of the spectrum's energy between each two frequency ratios."""
    middles = (np.arange(_BIN_POINTS) + 0.5) / _BIN_POINTS
    width = np.diff(ratios)[:, np.newaxis]
    energy = jonswap_shape(ratios[:-1, np.newaxis] + middles * width, gamma).mean(axis=1)
    energy = energy * width[:, 0]
    shares: Array = energy / energy.sum()
    return shares
