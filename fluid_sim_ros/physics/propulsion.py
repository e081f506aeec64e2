# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Rotors and propellers: thrust and shaft torque, command and lag.

With `rotor_effects` the twin of ``fluid_sim.thruster``. Speeds omega [rad/s] and revolutions
n = omega/(2 pi) [1/s] are signed; thrust is positive along the thrust axis, inflow V [m/s] is the
velocity of the rotor along that axis relative to the fluid.
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, not_negative, positive, vectors


def advance_ratio(inflow: ArrayLike, omega: ArrayLike, diameter: ArrayLike) -> Array:
    """
    Return J = V/(n D) [-]; infinite for a rotor at rest in a flow, 0 for no flow.

    For charts only: forces are written without it, see `propeller_load`.

    Parameters
    ----------
    inflow
        V along the thrust axis relative to the medium [m/s], shape (...).
    omega
        Speed of the rotor [rad/s], shape (...).
    diameter
        D [m], above 0, shape (...).

    Returns
    -------
    [-], shape (...).

    """
    v, turns = np.asarray(inflow, dtype=np.float64), np.asarray(omega) / (2 * np.pi)
    step = turns * positive(diameter, 'diameter [m]')
    ratio = np.divide(v, step, out=np.full(np.broadcast(v, step).shape, np.inf), where=step != 0)
    still: Array = np.where((step == 0) & (v == 0), 0.0, ratio)
    return still


def quadratic_thrust(omega: ArrayLike, forward: ArrayLike, reverse: ArrayLike) -> Array:
    """
    Return the thrust k omega|omega| at rest, with a k for each direction; rising in omega.

    Parameters
    ----------
    omega
        Speed of the rotor [rad/s], shape (...).
    forward, reverse
        k for omega > 0 and omega < 0 [N/(rad/s)^2], shape (...).

    Returns
    -------
    [N] along the thrust axis, shape (...).

    """
    w = np.asarray(omega, dtype=np.float64)
    return np.where(w < 0, reverse, forward) * w * np.abs(w)


def quadratic_speed(thrust: ArrayLike, forward: ArrayLike, reverse: ArrayLike) -> Array:
    """
    Return the speed that gives a thrust at rest: the inverse of `quadratic_thrust`.

    Parameters
    ----------
    thrust
        [N] along the thrust axis, shape (...).
    forward, reverse
        k for thrust > 0 and thrust < 0 [N/(rad/s)^2], shape (...).

    Returns
    -------
    [rad/s], shape (...).

    """
    f = np.asarray(thrust, dtype=np.float64)
    speed: Array = np.sign(f) * np.sqrt(np.abs(f) / np.where(f < 0, reverse, forward))
    return speed


def polynomial_thrust(omega: ArrayLike, forward: ArrayLike, reverse: ArrayLike) -> Array:
    """
    Return sum of c_i omega^i forward and -sum of r_i |omega|^i in reverse [N], i = 1, 2, ...

    Parameters
    ----------
    omega
        [rad/s], shape (...).
    forward, reverse
        Coefficients from the first power on [N/(rad/s)^i], shape (k,) each.

    """
    w = np.asarray(omega, dtype=np.float64)
    size = np.abs(w)
    ahead = np.polynomial.polynomial.polyval(size, np.r_[0.0, forward])
    back = np.polynomial.polynomial.polyval(size, np.r_[0.0, reverse])
    return np.where(w < 0, -back, ahead)


def propeller_load(
    omega: ArrayLike,
    inflow: ArrayLike,
    *,
    density: ArrayLike,
    diameter: ArrayLike,
    thrust: ArrayLike,
    torque: ArrayLike = (0.0, 0.0, 0.0),
    reverse: ArrayLike = (1.0, 1.0),
) -> tuple[Array, Array]:
    """
    Return thrust and shaft torque of a propeller given by CT(J) and CQ(J).

    T = rho D^4 (c0 n|n| + c1 |n| V/D + c2 V|V|/D^2), Q = rho D^5 (...): the usual
    rho n^2 D^4 (c0 + c1 J + c2 J^2) of forward flight (Carlton 2018, ch. 6) without the division
    by n, so that it is finite at n = 0. Four-quadrant rule: both are odd, T(-n, -V) = -T(n, V),
    continuous, and at n = 0 what is left is the drag of the stopped propeller. With c1, c2 <= 0
    the part of the inflow always opposes it. Outside of n V >= 0 this is a continuation, not a
    measurement. In reverse (n < 0) c0 is multiplied by ``reverse``.

    Parameters
    ----------
    omega, inflow
        [rad/s] and [m/s], shape (...).
    density, diameter
        [kg/m^3], [m], shape (...).
    thrust, torque
        (c0, c1, c2) of CT and CQ [-].
    reverse
        Factor of c0 of thrust and torque for n < 0 [-].

    Returns
    -------
    thrust, torque
        [N], [N m]; the torque has the sign of omega at rest.

    """
    rho = not_negative(density, 'density [kg/m^3]')
    d = positive(diameter, 'diameter [m]')
    n, v = np.asarray(omega) / (2 * np.pi), np.asarray(inflow, dtype=np.float64)
    loads = []
    for c, scale in zip(
        (vectors(thrust, 'thrust'), vectors(torque, 'torque')),
        vectors(reverse, 'reverse', 2),
        strict=True,
    ):
        rest = np.where(n < 0, scale, 1.0) * c[0] * n * np.abs(n) * d**2
        loads.append(rho * d**2 * (rest + c[1] * np.abs(n) * v * d + c[2] * v * np.abs(v)))
    return loads[0], loads[1] * d


def lagged_speed(
    start: ArrayLike, target: ArrayLike, elapsed: ArrayLike, up: float, down: float
) -> Array:
    """
    Return omega after a first-order lag under a constant command, exactly.

    omega = u + (omega_0 - u) exp(-t/tau). tau is ``up`` where the speed grows in size, ``down``
    where it shrinks; a reversal goes through zero with ``down`` and on from there with ``up``.
    Composes: a lag over t1 + t2 is one over t1, then one over t2.

    Parameters
    ----------
    start, target
        [rad/s], shape (...).
    elapsed
        [s], shape (...).
    up, down
        Time constants [s], positive.

    """
    positive([up, down], 'time constants [s]')
    w, u, t = np.broadcast_arrays(
        np.asarray(start, dtype=np.float64), np.asarray(target, dtype=np.float64),
        not_negative(elapsed, 'elapsed [s]'),
    )  # fmt: skip
    reversing = w * u < 0
    crossing = down * np.log1p(-w / np.where(reversing, u, np.inf))
    falling = np.where(reversing, t < crossing, np.abs(u) < np.abs(w))
    rest = np.where(reversing & ~falling, t - crossing, t)
    begin = np.where(reversing & ~falling, 0.0, w)
    tau = np.where(falling, down, up)
    speed: Array = u + (begin - u) * np.exp(-rest / tau)
    return speed


def pulse_thrust(pulse: ArrayLike, table: ArrayLike) -> Array:
    """
    Return the thrust at a pulse width, by linear interpolation; constant beyond the ends.

    Parameters
    ----------
    pulse
        Pulse width [us], shape (...).
    table
        Rows (pulse [us], thrust [N]), pulses rising strictly, shape (n, 2).

    Returns
    -------
    [N], shape (...).

    Raises
    ------
    ConfigError
        If the table has another shape or its pulses do not rise.

    """
    rows = np.asarray(table, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 2 or not np.all(np.diff(rows[:, 0]) > 0):
        raise ConfigError('table: allowed: rows (pulse, thrust) with rising pulse, shape (n, 2)')
    return np.interp(np.asarray(pulse, dtype=np.float64), rows[:, 0], rows[:, 1])
