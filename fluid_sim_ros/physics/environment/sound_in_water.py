# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How far sound reaches in water: absorption, and the range at which an echo is lost."""

import math

#: No sonar is asked for more [m].
_FARTHEST = 1e5


def absorption(frequency: float, temperature: float, salinity: float, depth: float) -> float:
    """
    Return the absorption of sound in water.

    Ainslie and McColm (1998), J. Acoust. Soc. Am. 103(3), 1671, at pH 8: boric acid, magnesium
    sulphate and viscosity; within 10 % of Francois and Garrison (1982), J. Acoust. Soc. Am. 72(3),
    896 and 72(6), 1879, from 100 Hz to 1 MHz, where one of these varies from 10 degC, 35 psu and
    the surface: -6 to 35 degC, 5 to 50 psu, 0 to 7 km. Without salt only viscosity is left.

    Parameters
    ----------
    frequency
        [Hz].
    temperature
        [degC].
    salinity
        [g/kg].
    depth
        [m].

    Returns
    -------
    float
        [dB/m].

    """
    f, z, t, s = frequency / 1e3, depth / 1e3, temperature, salinity
    boric = 0.78 * math.sqrt(s / 35.0) * math.exp(t / 26.0)  # relaxation frequencies [kHz]
    magnesium = 42.0 * math.exp(t / 17.0)
    first = 0.106 * boric * f * f / (boric * boric + f * f)  # pH 8: exp((8 - 8)/0.56) = 1
    second = (
        0.52 * (1.0 + t / 43.0) * (s / 35.0) * magnesium * f * f / (magnesium**2 + f * f)
    ) * math.exp(-z / 6.0)
    third = 4.9e-4 * f * f * math.exp(-(t / 27.0 + z / 17.0))
    return (first + second + third) / 1e3


def audible_range(
    loss: float, frequency: float, temperature: float, salinity: float, depth: float
) -> float:
    """
    Return the distance of an object whose echo has lost so much.

    Transmission loss there and back by spherical spreading and absorption,
    2 (20 log10(r / 1 m) + a r) = loss (Urick 1983, Principles of Underwater Sound, ch. 5).

    Parameters
    ----------
    loss
        [dB], above 0.
    frequency, temperature, salinity, depth
        As for ``absorption``.

    Returns
    -------
    float
        [m], 1 or more, 100 km at most; 0 where it is lost within the first metre.

    """
    rate = absorption(frequency, temperature, salinity, depth)

    def excess(distance: float) -> float:
        return 2.0 * (20.0 * math.log10(distance) + rate * distance) - loss

    if excess(_FARTHEST) < 0.0:
        return _FARTHEST
    if excess(1.0) >= 0.0:
        return 0.0
    from scipy.optimize import brentq  # late: SciPy takes 30 MiB wherever a log is opened

    return float(brentq(excess, 1.0, _FARTHEST, xtol=1e-9))
