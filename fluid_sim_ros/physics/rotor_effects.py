# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
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


def inflow_thrust(
    omega: ArrayLike,
    thrust: ArrayLike,
    inflow: ArrayLike,
    *,
    zero_advance: float,
    diameter: float,
    density: float | None = None,
    measured_advance: float = 0.0,
) -> tuple[Array, Array]:
    """
    Return thrust in an axial inflow, and the change of the shaft torque, by the thrust at rest.

    Without ``density`` the straight line T = T0 (1 - J/J0) of Blanke (1981) and Fossen (2021),
    ch. 9, through T0 at J_m. With it momentum theory (Leishman 2006, ch. 2 and 3): blades with a
    pitch of J0 D in the flow that the disc draws, T/T0 = (V_p - V - w)/(V_p - v_h) and
    T = 2 rho A (V + w) w, V_p = J0 n D; the torque changes by that of T (V + w)/omega. It exists
    where v_h < V_p, and is bounded for any inflow from behind, where it is a continuation (no
    vortex ring state). Reverse is the mirror image.

    Parameters
    ----------
    omega
        Speed of the rotor [rad/s], shape (...).
    thrust
        T0 [N], of the sign of omega, shape (...).
    inflow
        V along the thrust axis relative to the fluid [m/s], shape (...).
    zero_advance
        J0 = V/(n D) at which the thrust vanishes [-].
    diameter
        D [m].
    density
        rho [kg/m^3], for momentum theory.
    measured_advance
        J_m at which T0 was measured [-], below J0; 0 with momentum theory.

    Returns
    -------
    thrust, torque
        [N], shape (...); [N m], 0 without ``density``.

    """
    w, t0 = np.asarray(omega, dtype=np.float64), np.asarray(thrust, dtype=np.float64)
    pitch_speed = zero_advance * positive(diameter, 'diameter [m]') * np.abs(w) / (2 * np.pi)
    moves = pitch_speed > 1e-9
    speed = np.where(moves, pitch_speed, 1.0)
    v = np.where(moves, np.where(w < 0, -1.0, 1.0) * np.asarray(inflow), 0.0)
    if density is None:
        measured = measured_advance / zero_advance
        return np.where(moves, t0 * (1 - v / speed) / (1 - measured), t0), np.zeros_like(t0)
    area = np.pi / 4 * diameter**2
    hover = np.sqrt(np.abs(t0) / (2 * density * area))
    # 2 rho A (V + w) w = T0 (V_p - V - w)/(V_p - v_h), solved for w
    ratio = hover**2 / np.where(moves, speed - hover, 1.0)
    drawn = (np.sqrt((v + ratio) ** 2 + 4 * ratio * (speed - v)) - v - ratio) / 2
    found = np.where(moves, t0 * (speed - v - drawn) / np.where(moves, speed - hover, 1.0), t0)
    torque = np.where(moves, (found * (v + drawn) - t0 * hover) / np.where(moves, np.abs(w), 1), 0)
    return found, torque
