"""What a rotor meets beside its thrust: the ground, the surface, drag, gyroscopic torque."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Array, positive, vectors


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
    Return -omega_b x (J s omega a): what a rotor's angular momentum does to a turning body.

    Euler's equation; does no work on the body. The
    reaction of spinning up, -J s domega/dt a, acts along the axis.

    Parameters
    ----------
    omega
        Speed of the rotor relative to the body [rad/s], shape (...).
    omega_b
        Angular velocity of the body [rad/s], body axes, shape (..., 3).
    axis_b
        Unit vector along the rotor's axis, body axes, shape (..., 3).
    inertia
        J of the rotor about its axis [kg m^2].
    spin
        s: 1 where a positive speed turns about +a, -1 where about -a.

    Returns
    -------
    On the body [N m], body axes, shape (..., 3).

    """
    momentum = inertia * spin * np.asarray(omega)[..., np.newaxis] * vectors(axis_b, 'axis_b')
    return -np.cross(vectors(omega_b, 'omega_b'), momentum)
