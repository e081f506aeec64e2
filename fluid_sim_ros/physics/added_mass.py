"""
Added-mass forces: the ellipsoid's diagonal form and the full 6x6 form.

Sign of A: positive for a positive mass of fluid (A = -X_udot of ship theory, SNAME). Body axes
FLU; velocities at the reference point O, relative to the undisturbed medium; nu = (v, omega).
"""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, Wrench, column, cross_matrix, vectors

# FLU <-> FRD: y and z of linear and of angular quantities change sign; its own inverse.
_FLIP = np.array([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])


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


def matrix6(values: ArrayLike, name: str) -> Array:
    """
    Return a 6x6 matrix from 6, 21 or 36 numbers, or raise a `ConfigError`.

    6: the diagonal; 21: the upper triangle row by row (11 12 13 14 15 16 22 23 ... 66) of a
    symmetric matrix; 36: row by row. Order of rows: x y z roll pitch yaw.
    """
    flat = np.asarray(values, dtype=np.float64).reshape(-1)
    if not np.all(np.isfinite(flat)):
        raise ConfigError(f'{name}: {flat.tolist()}; allowed: finite numbers')
    if flat.size == 6:
        return np.diag(flat)
    if flat.size == 21:
        upper = np.zeros((6, 6))
        upper[np.triu_indices(6)] = flat
        return upper + np.triu(upper, 1).T
    if flat.size == 36:
        return flat.reshape(6, 6)
    raise ConfigError(f'{name}: {flat.size} numbers; allowed: 6, 21 or 36')


def added_mass_matrix(values: ArrayLike, name: str = 'added_mass') -> Array:
    """
    Return the added-mass matrix A from 6, 21 or 36 numbers (order: `matrix6`), checked.

    Blocks: A_vv [kg], A_vw [kg m], A_ww [kg m^2], all of the sign of a mass.

    Raises
    ------
    ConfigError
        If A is not symmetric and positive semi-definite to 1e-9 of its largest entry.

    """
    matrix = matrix6(values, name)
    tolerance = 1e-9 * np.abs(matrix).max()
    if np.abs(matrix - matrix.T).max() > tolerance:
        raise ConfigError(f'{name}: not symmetric; allowed: A = A^T')
    matrix = 0.5 * (matrix + matrix.T)
    lowest = float(np.linalg.eigvalsh(matrix)[0])
    if lowest < -tolerance:
        raise ConfigError(f'{name}: lowest eigenvalue {lowest:.6g}; allowed: >= 0')
    return matrix


def shift_reference_point(matrix: ArrayLike, offset_b: ArrayLike) -> Array:
    """
    Return a 6x6 mass (or added-mass) matrix for another reference point of the same body.

    A' = H^T A H with H = [[1, S(offset)], [0, 1]]: the old point's velocity is
    v_old = v_new + offset x omega. Keeps the kinetic energy, symmetry and rank.

    Parameters
    ----------
    matrix
        About the old point, body axes, shape (..., 6, 6).
    offset_b
        From the old to the new point [m], body axes, shape (..., 3).

    """
    offset = cross_matrix(offset_b)
    H = np.zeros((*offset.shape[:-2], 6, 6))
    H[...] = np.eye(6)
    H[..., :3, 3:] = offset
    return np.swapaxes(H, -1, -2) @ np.asarray(matrix, dtype=np.float64) @ H


def rotate_matrix6(matrix: ArrayLike, rot_bg: ArrayLike) -> Array:
    """
    Return a 6x6 matrix given in axes g in body axes b: diag(R, R) A diag(R, R)^T.

    ``rot_bg`` of shape (..., 3, 3) turns components in g into components in b; same point.
    """
    rotation = np.asarray(rot_bg, dtype=np.float64)
    both = np.zeros((*rotation.shape[:-2], 6, 6))
    both[..., :3, :3] = rotation
    both[..., 3:, 3:] = rotation
    return both @ np.asarray(matrix, dtype=np.float64) @ np.swapaxes(both, -1, -2)


def frd_to_flu_matrix(matrix_frd: ArrayLike) -> Array:
    """
    Return a 6x6 matrix of FRD axes (ship theory, SNAME) in FLU axes: T A T.

    T = diag(1, -1, -1, 1, -1, -1) is its own inverse, so the same function leads back. Only the
    entries that couple {x, roll} with {y, z, pitch, yaw} change sign.
    """
    return np.asarray(matrix_frd, dtype=np.float64) * np.outer(_FLIP, _FLIP)


def momentum(matrix: ArrayLike, v: Array, omega: Array) -> tuple[Array, Array]:
    """Return (p, l) = A (v, omega), the impulse of the fluid, shape (..., 3) each."""
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

    Arguments as in `added_mass_coriolis`; ``v_dot_b`` and ``omega_dot_b`` are the time derivatives
    of the components of v_rel_b and omega_b in the body frame (`relative_acceleration`).
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

    ``accel_b`` is the inertial acceleration of the reference point and ``flow_accel_b`` the
    material acceleration Du/Dt of the undisturbed flow there, both in body axes, shape (..., 3).
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
        Centre of volume from the reference point [m], shape (..., 3).
    flow_accel_b
        Du/Dt [m/s^2], body axes, shape (..., 3).

    """
    accel = vectors(flow_accel_b, 'flow_accel_b')
    linear, angular = momentum(matrix, accel, np.zeros_like(accel))
    pressure = column(displaced_mass) * accel
    return linear + pressure, angular + np.cross(vectors(center_b, 'center_b'), pressure)
