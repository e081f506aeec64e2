# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Added-mass forces: the ellipsoid's diagonal form and the full 6x6 form.

Sign of A: positive for a positive mass of fluid (A = -X_udot of ship theory, SNAME). Body axes
FLU; velocities at the reference point O, relative to the undisturbed medium; nu = (v, omega).
`matrix6` reads A and moves it to other points and axes.
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Array, Wrench, column, vectors


def ellipsoid_added_mass_wrench(
    mass_a_b: ArrayLike,
    inertia_a_b: ArrayLike,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike,
    v_dot_b: ArrayLike = (0.0, 0.0, 0.0),
    omega_dot_b: ArrayLike = (0.0, 0.0, 0.0),
) -> Wrench:
    """
    Return the added-mass wrench on a body with three planes of symmetry, compact form.

    f = -m_A o dv/dt + (m_A o v) x w
    g = -I_A o dw/dt + (m_A o v) x v + (I_A o w) x w;  Lamb (1932), ch. 5-6; MuJoCo, "Added mass".

    Without accelerations it does no work (f . v + g . w = 0) and is what MuJoCo applies; with
    them it conserves the energy and both impulses of body and fluid. The velocity part is even
    in (v, w).

    Parameters
    ----------
    mass_a_b, inertia_a_b
        Added masses [kg] and moments of inertia [kg m^2] along the axes, shape (..., 3).
    v_rel_b, omega_b
        Velocity relative to the medium at the centre [m/s], angular velocity [rad/s], (..., 3).
    v_dot_b, omega_dot_b
        Time derivatives of those components in the body frame [m/s^2], [rad/s^2], (..., 3); see
        `relative_acceleration` for the way from an inertial acceleration.

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the centre, shape (..., 3) each.

    """
    m_a, i_a = vectors(mass_a_b, 'mass_a_b'), vectors(inertia_a_b, 'inertia_a_b')
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    momentum = m_a * v
    force = -m_a * vectors(v_dot_b, 'v_dot_b') + np.cross(momentum, omega)
    torque = (
        -i_a * vectors(omega_dot_b, 'omega_dot_b')
        + np.cross(momentum, v)
        + np.cross(i_a * omega, omega)
    )
    return force, torque


def momentum(matrix: ArrayLike, v: Array, omega: Array) -> tuple[Array, Array]:
    """
    Return (p, l) = A (v, omega), the impulse of the fluid.

    Parameters
    ----------
    matrix
        A about the reference point, body axes, shape (..., 6, 6): [kg], [kg m], [kg m^2].
    v, omega
        Relative velocity of the reference point [m/s], angular velocity [rad/s], body axes,
        shape (..., 3).

    Returns
    -------
    p_b, l_b
        Linear [N s] and angular [N m s] part, body axes, shape (..., 3) each.

    """
    both = np.concatenate(np.broadcast_arrays(v, omega), axis=-1)
    product = (np.asarray(matrix, dtype=np.float64) @ both[..., np.newaxis])[..., 0]
    return product[..., :3], product[..., 3:]


def added_mass_coriolis(matrix: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike) -> Wrench:
    """
    Return the velocity-dependent wrench -C_A(nu) nu of a full added-mass (or mass) matrix.

    (p, l) = A (v, w): f = p x w, g = p x v + l x w; Lamb (1932) art. 124, Fossen (2021) ch. 6.
    Does no work: f . v + g . w = 0. Even in (v, w).

    Parameters
    ----------
    matrix
        A about the reference point, shape (..., 6, 6).
    v_rel_b, omega_b
        Relative velocity of the reference point [m/s], angular velocity [rad/s], shape (..., 3).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the reference point, shape (..., 3) each.

    """
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    linear, angular = momentum(matrix, v, omega)
    return np.cross(linear, omega), np.cross(linear, v) + np.cross(angular, omega)


def added_mass_wrench(
    matrix: ArrayLike,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike,
    v_dot_b: ArrayLike,
    omega_dot_b: ArrayLike,
) -> Wrench:
    """
    Return the whole added-mass wrench -A dnu/dt - C_A(nu) nu.

    Lamb (1932) art. 124, Fossen (2021) ch. 6; conserves the energy and the impulses of
    body and fluid.

    Parameters
    ----------
    matrix
        A about the reference point, body axes, shape (..., 6, 6).
    v_rel_b, omega_b
        Relative velocity of the reference point [m/s], angular velocity [rad/s], body axes,
        shape (..., 3).
    v_dot_b, omega_dot_b
        Time derivatives of those components in the body frame [m/s^2], [rad/s^2], shape (..., 3);
        see `relative_acceleration`.

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the reference point, body axes, shape (..., 3) each.

    """
    force, torque = added_mass_coriolis(matrix, v_rel_b, omega_b)
    linear, angular = momentum(
        matrix, vectors(v_dot_b, 'v_dot_b'), vectors(omega_dot_b, 'omega_dot_b')
    )
    return force - linear, torque - angular


def relative_acceleration(
    accel_b: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike, flow_accel_b: ArrayLike
) -> Array:
    """
    Return d(v_rel_b)/dt = a - Du/Dt - w x v_rel, components in the body frame [m/s^2].

    Parameters
    ----------
    accel_b
        Inertial acceleration of the reference point [m/s^2], body axes, shape (..., 3).
    v_rel_b, omega_b
        Velocity relative to the medium [m/s] and angular velocity [rad/s], body axes,
        shape (..., 3).
    flow_accel_b
        Material acceleration Du/Dt of the undisturbed flow at that point [m/s^2], body axes,
        shape (..., 3).

    Returns
    -------
    [m/s^2], body axes, shape (..., 3).

    """
    spin = np.cross(vectors(omega_b, 'omega_b'), vectors(v_rel_b, 'v_rel_b'))
    return vectors(accel_b, 'accel_b') - vectors(flow_accel_b, 'flow_accel_b') - spin


def accelerating_flow_wrench(
    matrix: ArrayLike, displaced_mass: ArrayLike, center_b: ArrayLike, flow_accel_b: ArrayLike
) -> Wrench:
    """
    Return the wrench (rho V + A) Du/Dt of an accelerating flow.

    Maxey and Riley (1983), Phys. Fluids 26:883: the pressure gradient of the undisturbed flow
    acts on the displaced mass at the centre of volume, and the added mass follows the flow. Du/Dt
    is the material derivative of the flow at the body, not a difference along the body's path: a
    body towed through a steady profile feels none.

    Parameters
    ----------
    matrix
        A about the reference point, shape (..., 6, 6).
    displaced_mass
        rho V [kg], shape (...).
    center_b
        Centre of volume from the reference point [m], body axes, shape (..., 3).
    flow_accel_b
        Du/Dt [m/s^2], body axes, shape (..., 3).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the reference point, body axes, shape (..., 3) each.

    """
    accel = vectors(flow_accel_b, 'flow_accel_b')
    linear, angular = momentum(matrix, accel, np.zeros_like(accel))
    pressure = column(displaced_mass) * accel
    return linear + pressure, angular + np.cross(vectors(center_b, 'center_b'), pressure)
