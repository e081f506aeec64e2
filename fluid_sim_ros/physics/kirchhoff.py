# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A rigid body in an ideal fluid: Kirchhoff's equations as an ordinary differential equation.

Lamb (1932), ch. 6. The reference that simulations with added mass are measured against:
`kirchhoff_motion` integrates it by DOP853 at 1e-12. State: position of the reference point O in
the world [m], attitude quaternion body -> world (w, x, y, z), velocity of O [m/s] and angular
velocity [rad/s] in body axes; shape (13,).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.added_mass import added_mass_coriolis, momentum
from fluid_sim_ros.physics.arrays import Array, positive, vectors
from fluid_sim_ros.physics.matrix6 import shift_reference_point

BodyWrench = Callable[
    [float, Array], Array
]  # time, state -> force_b, torque_b about O, shape (6,)


def rotation_wb(quat_wb_wxyz: ArrayLike) -> Array:
    """
    Return the rotation matrix body -> world of a quaternion.

    Parameters
    ----------
    quat_wb_wxyz
        Quaternion body -> world, w first, any length but 0, shape (4,).

    Returns
    -------
    Turns components in body axes into components in world axes, shape (3, 3).

    """
    w, x, y, z = (q := np.asarray(quat_wb_wxyz, dtype=np.float64)) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def rigid_body_matrix(mass: float, inertia_b: ArrayLike, mass_center_b: ArrayLike) -> Array:
    """
    Return the 6x6 mass matrix of a rigid body about its reference point O.

    Parameters
    ----------
    mass
        [kg].
    inertia_b
        About the centre of mass, body axes [kg m^2], shape (3,) for principal axes or (3, 3).
    mass_center_b
        Centre of mass from O [m], shape (3,).

    """
    inertia = np.asarray(inertia_b, dtype=np.float64)
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = float(positive(mass, 'mass [kg]')) * np.eye(3)
    matrix[3:, 3:] = np.diag(inertia) if inertia.ndim == 1 else inertia
    return shift_reference_point(matrix, -vectors(mass_center_b, 'mass_center_b'))


def kirchhoff_rhs(
    time: float,
    state: Array,
    total_matrix: ArrayLike,
    flow_w: ArrayLike = (0.0, 0.0, 0.0),
    wrench: BodyWrench | None = None,
) -> Array:
    """
    Return the time derivative of the state of a body in an ideal fluid.

    (p, l) = M (v_rel, w), M d(nu_rel)/dt = (p x w, p x v_rel + l x w) + wrench, M the sum of the
    body's and the fluid's matrices about O. In a uniform, steady current everything holds for
    v_rel = v - R^T u. Without ``wrench`` it conserves energy and both impulses.

    Parameters
    ----------
    time
        [s], handed to ``wrench``.
    state
        See the head of this file, shape (13,).
    total_matrix
        Rigid body plus added mass about O, any symmetric positive definite 6x6 matrix.
    flow_w
        Uniform, steady velocity of the medium, world axes [m/s], shape (3,).
    wrench
        Force [N] and torque [N m] about O in body axes from time and state, or None.

    Returns
    -------
    Derivative of the state, shape (13,).

    """
    matrix = np.asarray(total_matrix, dtype=np.float64)
    rotation = rotation_wb(state[3:7])
    flow_b = rotation.T @ vectors(flow_w, 'flow_w')
    v, omega = state[7:10], state[10:13]
    load = np.concatenate(added_mass_coriolis(matrix, v - flow_b, omega))
    if wrench is not None:
        load = load + wrench(time, state)
    nu_dot = np.linalg.solve(matrix, load)
    # Components of a constant current turn in the body frame: d(R^T u)/dt = -w x R^T u.
    v_dot = nu_dot[:3] - np.cross(omega, flow_b)
    w, x, y, z = state[3:7]
    p, q, r = omega
    quat_dot = 0.5 * np.array(
        [
            -x * p - y * q - z * r,
            w * p + y * r - z * q,
            w * q + z * p - x * r,
            w * r + x * q - y * p,
        ]
    )
    return np.concatenate([rotation @ v, quat_dot, v_dot, nu_dot[3:]])


def kirchhoff_motion(
    start: ArrayLike,
    times: ArrayLike,
    total_matrix: ArrayLike,
    flow_w: ArrayLike = (0.0, 0.0, 0.0),
    wrench: BodyWrench | None = None,
) -> Array:
    """
    Return the states of `kirchhoff_rhs` at given times, by DOP853 with tolerances of 1e-12.

    Parameters
    ----------
    start
        State at time 0, shape (13,).
    times
        Rising, from 0 on [s], shape (n,).
    total_matrix, flow_w, wrench
        As for `kirchhoff_rhs`.

    Returns
    -------
    States, unit quaternions, shape (n, 13).

    """
    grid = np.asarray(times, dtype=np.float64)
    solution = solve_ivp(
        kirchhoff_rhs, (0.0, float(grid[-1])), np.asarray(start, dtype=np.float64),
        method='DOP853', t_eval=grid, rtol=1e-12, atol=1e-13, args=(total_matrix, flow_w, wrench),
    )  # fmt: skip
    states: Array = solution.y.T
    states[:, 3:7] /= np.linalg.norm(states[:, 3:7], axis=1, keepdims=True)
    return states


def kinetic_energy(
    state: Array, total_matrix: ArrayLike, flow_w: ArrayLike = (0.0, 0.0, 0.0)
) -> float:
    """
    Return T = nu_rel . M nu_rel / 2 of body and fluid, in the frame of the current.

    Parameters
    ----------
    state
        See the head of this file, shape (13,).
    total_matrix
        M = rigid body plus added mass about the reference point, body axes, shape (6, 6).
    flow_w
        Velocity of the uniform current [m/s], world axes, shape (3,).

    Returns
    -------
    [J].

    """
    v_rel = state[7:10] - rotation_wb(state[3:7]).T @ vectors(flow_w, 'flow_w')
    linear, angular = momentum(total_matrix, v_rel, state[10:13])
    return float(0.5 * (linear @ v_rel + angular @ state[10:13]))


def impulses(
    time: float, state: Array, total_matrix: ArrayLike, flow_w: ArrayLike = (0.0, 0.0, 0.0)
) -> tuple[Array, Array]:
    """
    Return the linear and the angular impulse of body and fluid.

    P = R p and L = R l + x x P; both about the world origin, in the frame that moves with the
    current (x - u t). Constant without outer forces.

    Parameters
    ----------
    time
        [s].
    state
        See the head of this file, shape (13,).
    total_matrix
        M = rigid body plus added mass about the reference point, body axes, shape (6, 6).
    flow_w
        Velocity of the uniform current [m/s], world axes, shape (3,).

    Returns
    -------
    linear_w, angular_w
        [N s] and [N m s], world axes, shape (3,) each.

    """
    flow = vectors(flow_w, 'flow_w')
    rotation = rotation_wb(state[3:7])
    linear, angular = momentum(total_matrix, state[7:10] - rotation.T @ flow, state[10:13])
    impulse = rotation @ linear
    return impulse, rotation @ angular + np.cross(state[:3] - time * flow, impulse)
