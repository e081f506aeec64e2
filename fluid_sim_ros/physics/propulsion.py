"""
Rotors and propellers: thrust and shaft torque, command, lag, the ground and the free surface.

The twin of ``fluid_sim.thruster``. Speeds omega [rad/s] and revolutions n = omega/(2 pi) [1/s]
are signed; thrust is positive along the thrust axis, inflow V [m/s] is the velocity of the rotor
along that axis relative to the fluid.
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, not_negative, positive, vectors


def advance_ratio(inflow: ArrayLike, omega: ArrayLike, diameter: ArrayLike) -> Array:
    """
    Return J = V/(n D) [-]; infinite for a rotor at rest in a flow, 0 for no flow.

    For charts only: forces are written without it, see `propeller_load`.
    """
    v, turns = np.asarray(inflow, dtype=np.float64), np.asarray(omega) / (2 * np.pi)
    step = turns * positive(diameter, 'diameter [m]')
    ratio = np.divide(v, step, out=np.full(np.broadcast(v, step).shape, np.inf), where=step != 0)
    still: Array = np.where((step == 0) & (v == 0), 0.0, ratio)
    return still


def quadratic_thrust(omega: ArrayLike, forward: ArrayLike, reverse: ArrayLike) -> Array:
    """Return k omega|omega| [N] with k for each direction [N/(rad/s)^2]; rising in omega."""
    w = np.asarray(omega, dtype=np.float64)
    return np.where(w < 0, reverse, forward) * w * np.abs(w)


def quadratic_speed(thrust: ArrayLike, forward: ArrayLike, reverse: ArrayLike) -> Array:
    """Return omega [rad/s] that gives a thrust [N] at rest: the inverse of `quadratic_thrust`."""
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
    """Return thrust [N] by linear interpolation of (pulse [us], thrust [N]) rows, shape (n, 2)."""
    rows = np.asarray(table, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 2 or not np.all(np.diff(rows[:, 0]) > 0):
        raise ConfigError('table: allowed: rows (pulse, thrust) with rising pulse, shape (n, 2)')
    return np.interp(np.asarray(pulse, dtype=np.float64), rows[:, 0], rows[:, 1])


def ground_effect_factor(
    height: ArrayLike, radius: ArrayLike, strength: float | None = None
) -> Array:
    """
    Return thrust near the ground over thrust far from it, at the same speed.

    1/(1 - (R/4z)^2), Cheeseman and Bennett (1955), ARC R&M 3021; with ``strength`` C the form
    1 + C (R/4z)^2 of fitted models (Panerati et al. 2021, IROS, for small quadrotors). Held at its
    value of z = R/2 below that.

    Parameters
    ----------
    height
        z of the rotor above the ground, along its wake [m], shape (...).
    radius
        R [m], shape (...).
    strength
        C [-], or None for Cheeseman and Bennett.

    """
    r = positive(radius, 'radius [m]')
    square = (r / (4 * np.maximum(height, 0.5 * r))) ** 2
    factor: Array = 1 / (1 - square) if strength is None else 1 + strength * square
    return factor


def disc_share(depth: ArrayLike, radius: ArrayLike, axis_z: ArrayLike) -> Array:
    """
    Return the share of a rotor disc below a level surface [-].

    Circular segment, 1/2 + (p sqrt(1 - p^2) + asin p)/pi with p = depth/(R sqrt(1 - a_z^2)) in
    -1..1. A disc within 0.1 rad of level counts as tilted by that, so that it does not leap.

    Parameters
    ----------
    depth
        Of the centre below the surface [m], shape (...).
    radius
        R [m], shape (...).
    axis_z
        Vertical component of the unit axis [-], shape (...).

    """
    tilt = np.maximum(np.sqrt(np.maximum(1 - np.square(axis_z), 0)), 0.1)
    p = np.clip(np.asarray(depth) / (positive(radius, 'radius [m]') * tilt), -1, 1)
    share: Array = 0.5 + (p * np.sqrt(1 - p**2) + np.arcsin(p)) / np.pi
    return share


def rotor_drag(
    omega: ArrayLike,
    v_rel_b: ArrayLike,
    axis_b: ArrayLike,
    *,
    across: float,
    along: float = 0.0,
    rolling: float = 0.0,
    spin: float = 1.0,
) -> tuple[Array, Array]:
    """
    Return drag and rolling moment of a rigid rotor in edgewise flow (no flapping).

    f = -|omega| (k v_across + k_z v_along), Martin and Salaun (2010), ICRA;
    m = -omega s c v_across, Furrer et al. (2016), RotorS. Dissipative: f . v <= 0; zero at
    rest.

    Parameters
    ----------
    omega
        [rad/s], shape (...).
    v_rel_b, axis_b
        Velocity relative to the fluid [m/s] and unit thrust axis, any one frame, shape (..., 3).
    across, along
        k and k_z [N/((rad/s)(m/s))].
    rolling
        c [N m/((rad/s)(m/s))].
    spin
        s: +1 where a positive speed turns about the thrust axis (counter-clockwise seen against
        it), -1 the other way.

    """
    v, a = vectors(v_rel_b, 'v_rel_b'), vectors(axis_b, 'axis_b')
    w = np.asarray(omega, dtype=np.float64)[..., np.newaxis]
    v_along = np.sum(v * a, axis=-1, keepdims=True) * a
    v_across = v - v_along
    return -np.abs(w) * (across * v_across + along * v_along), -w * spin * rolling * v_across


def gyroscopic_torque(
    omega: ArrayLike, omega_b: ArrayLike, axis_b: ArrayLike, *, inertia: float, spin: float = 1.0
) -> Array:
    """
    Return -omega_b x (J s omega a) [N m]: what a rotor's angular momentum does to a turning body.

    Euler's equation with a rotor of inertia J [kg m^2] about its axis; no work on the body.
    ``omega`` [rad/s] of the rotor relative to the body, ``omega_b`` [rad/s] and unit ``axis_b`` in
    body axes, shape (..., 3). The reaction of spinning up, -J s domega/dt a, acts along the axis.
    """
    momentum = inertia * spin * np.asarray(omega)[..., np.newaxis] * vectors(axis_b, 'axis_b')
    return -np.cross(vectors(omega_b, 'omega_b'), momentum)
