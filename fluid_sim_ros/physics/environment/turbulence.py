# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Continuous turbulence of Dryden and von Karman: MIL-F-8785C (1980), 3.7; MIL-HDBK-1797 (1997).

Spectra are one-sided in angular frequency [rad/s] as the vehicle meets them, omega = Omega V:
sigma^2 is their integral over omega > 0. Lengths are in the notation of MIL-F-8785C; MIL-HDBK-1797
writes 2 L for those of v and w. Axes: u along the mean relative wind, w up.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Array, positive
from fluid_sim_ros.physics.environment.coloured_noise import NoiseFilter

#: a of 1 + (a L Omega)^2 in von Karman's spectra.
VON_KARMAN = 1.339


# ---- spectra and covariances --------------------------------------------------------------------


def dryden_spectra(omega: ArrayLike, length: float, airspeed: float) -> tuple[Array, Array]:
    """
    Return the longitudinal and the lateral spectrum of Dryden for sigma = 1.

    (2 tau/pi) / (1 + x^2) and (tau/pi) (1 + 3 x^2) / (1 + x^2)^2 with x = tau omega, tau = L/V.

    Parameters
    ----------
    omega
        Angular frequency that the vehicle meets [rad/s], shape (...).
    length
        L [m].
    airspeed
        V [m/s].

    Returns
    -------
    longitudinal, lateral
        [s/rad], one-sided, shape (...) each.

    """
    tau = length / airspeed
    square = (tau * np.asarray(omega, dtype=np.float64)) ** 2
    return 2 * tau / np.pi / (1 + square), tau / np.pi * (1 + 3 * square) / (1 + square) ** 2


def von_karman_spectra(omega: ArrayLike, length: float, airspeed: float) -> tuple[Array, Array]:
    """
    Return the longitudinal and the lateral spectrum of von Karman for sigma = 1.

    (2 tau/pi) / (1 + x^2)^(5/6) and (tau/pi) (1 + 8/3 x^2) / (1 + x^2)^(11/6) with
    x = 1.339 tau omega, tau = L/V.

    Parameters
    ----------
    omega
        Angular frequency that the vehicle meets [rad/s], shape (...).
    length
        L [m].
    airspeed
        V [m/s].

    Returns
    -------
    longitudinal, lateral
        [s/rad], one-sided, shape (...) each.

    """
    tau = length / airspeed
    square = (VON_KARMAN * tau * np.asarray(omega, dtype=np.float64)) ** 2
    return (
        2 * tau / np.pi / (1 + square) ** (5 / 6),
        tau / np.pi * (1 + 8 / 3 * square) / (1 + square) ** (11 / 6),
    )


def dryden_covariance(lag: ArrayLike, length: float, airspeed: float) -> tuple[Array, Array]:
    """
    Return the longitudinal and the lateral covariance of Dryden for sigma = 1.

    e^-s and (1 - s/2) e^-s with s = |lag| V/L: the Fourier transforms of `dryden_spectra`.

    Parameters
    ----------
    lag
        Between two times [s], shape (...).
    length
        L [m].
    airspeed
        V [m/s].

    Returns
    -------
    longitudinal, lateral
        [-], shape (...) each.

    """
    s = np.abs(np.asarray(lag, dtype=np.float64)) * airspeed / length
    return np.exp(-s), (1 - s / 2) * np.exp(-s)


def angular_rate_spectra(
    omega: ArrayLike, lateral: ArrayLike, vertical: ArrayLike, length_w: float, airspeed: float,
    span: float,
) -> tuple[Array, Array, Array]:  # fmt: skip
    """
    Return the spectra of p, q, r, per sigma_w^2, sigma_w^2 and sigma_v^2 [1/(m^2) s/rad].

    MIL-F-8785C, 3.7.5: 0.8 (pi L_w/4b)^(1/3) / (V L_w) / (1 + (4 b omega/pi V)^2) for p;
    (omega/V)^2 / (1 + (4 b omega/pi V)^2) of the spectrum of w for q; with 3 b and v for r.

    Parameters
    ----------
    omega
        [rad/s], shape (...).
    lateral, vertical
        Spectra of v and w for sigma = 1 there.
    length_w
        L_w [m].
    airspeed, span
        V [m/s] and b [m].

    """
    w = np.asarray(omega, dtype=np.float64)
    lag_q, lag_r = 4 * span / (np.pi * airspeed), 3 * span / (np.pi * airspeed)
    p = 0.8 * (np.pi * length_w / (4 * span)) ** (1 / 3) / (airspeed * length_w)
    return (
        p / (1 + (lag_q * w) ** 2),
        (w / airspeed) ** 2 / (1 + (lag_q * w) ** 2) * np.asarray(vertical),
        (w / airspeed) ** 2 / (1 + (lag_r * w) ** 2) * np.asarray(lateral),
    )


# ---- the processes as filters -------------------------------------------------------------------


def turbulence_modes(kind: str) -> tuple[Array, Array]:
    """
    Return the Dryden processes that make up a turbulence: shares of variance and of length.

    Dryden is one. von Karman's (1 + y)^(-5/6) = 1/(2 pi) integral of e^(q/6) / (e^q + 1 + y) dq is
    a sum of Lorentzians with positive weights; the trapezoidal rule with the nodes
    1.3, 5.1, 8.9, and all that lies below them in one at q -> -infinity, is within 0.1 dB of it up
    to 15 corner frequencies, with its variance. The lateral spectrum (Phi - omega Phi')/2 of a sum
    is the sum of the lateral spectra.

    Parameters
    ----------
    kind
        ``dryden`` or ``von_karman``.

    Returns
    -------
    variances, lengths
        Shares of sigma^2 and factors on the length scale [-], shape (n,) each.

    """
    if kind == 'dryden':
        return np.ones(1), np.ones(1)
    first, step = 1.3, 3.8
    q = first + step * np.arange(-1, 3)
    a, weight = np.sqrt(1 + np.exp(q)), np.exp(q / 6)
    a[0], weight[0] = 1.0, weight[0] / (1 - math.exp(-step / 6))
    variance = weight / a
    return variance / variance.sum(), VON_KARMAN / a


def turbulence_filters(
    kind: str, length: ArrayLike, airspeed: float, span: float | None = None
) -> list[NoiseFilter]:
    """
    Return the filters of u, v, w (outputs 0 to 2) and, with a span, p, q, r (3 to 5), sigma = 1.

    Longitudinal sqrt(2 tau) / (1 + tau s); lateral sqrt(tau) (1 + sqrt(3) tau s) / (1 + tau s)^2,
    both driven by white noise of unit two-sided intensity. p has the spectrum of
    ``angular_rate_spectra``; q and r follow from w and v: q = (s/V) / (1 + 4 b s/(pi V)) w and
    r = -(s/V) / (1 + 3 b s/(pi V)) v, the rigid rotation of air whose pattern passes along +x.

    Parameters
    ----------
    kind
        ``dryden`` or ``von_karman``.
    length
        L of u, v, w [m], shape (3,).
    airspeed, span
        V [m/s] and b [m].

    """
    lengths = np.asarray(positive(length, 'length [m]'))
    filters = []
    lag_q = lag_r = 0.0
    if span is not None:
        lag_q, lag_r = 4 * span / (np.pi * airspeed), 3 * span / (np.pi * airspeed)
    for variance, factor in zip(*turbulence_modes(kind), strict=True):
        tau_u, tau_v, tau_w = lengths * factor / airspeed
        filters.append(
            NoiseFilter(np.array([[-1 / tau_u]]), np.sqrt([2 / tau_u]), {0: np.sqrt([variance])})
        )
        filters.append(_lateral(1, tau_v, variance, lag_r, 5, -1 / airspeed))
        filters.append(_lateral(2, tau_w, variance, lag_q, 4, 1 / airspeed))
    if span is not None:
        ratio = np.pi * lengths[2] / (4 * span)
        sigma_p = np.sqrt(0.8 * ratio ** (1 / 3) * np.pi**2 / (8 * span * lengths[2]))
        filters.append(
            NoiseFilter(np.array([[-1 / lag_q]]), np.sqrt([2 / lag_q]), {3: np.array([sigma_p])})
        )
    return filters


def _lateral(
    output: int, tau: float, variance: float, lag: float, rate: int, per_speed: float
) -> NoiseFilter:
    """Return a cascade of two lags, and behind it the lag of an angular rate."""
    c = np.sqrt(variance / 2) * np.array([np.sqrt(3), 1 - np.sqrt(3)])
    a = np.array([[-1 / tau, 0], [1 / tau, -1 / tau]])
    b = np.array([np.sqrt(2 / tau), 0])
    if lag == 0:
        return NoiseFilter(a, b, {output: c})
    a = np.block([[a, np.zeros((2, 1))], [c / lag, -1 / lag]])
    return NoiseFilter(
        a, np.append(b, 0.0),
        {output: np.append(c, 0.0), rate: per_speed / lag * np.append(c, -1.0)},
    )  # fmt: skip
