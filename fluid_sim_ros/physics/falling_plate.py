# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Falling plate in two dimensions: the quasi-steady model that the ellipsoid model grew from.

Andersen, Pesavento and Wang (2005), Analysis of transitions between fluttering, tumbling and
steady descent of falling cards, J. Fluid Mech. 541:91-104. Dimensionless: lengths by the half
width a, speeds by U = sqrt((rho_s/rho_f - 1) g b) with b the half thickness, times by a/U.
"""

from typing import NamedTuple

import numpy as np

from fluid_sim_ros.physics.arrays import Array


class PlateParams(NamedTuple):
    """Parameters [-]; defaults are the ones of the paper's section on the transition."""

    inertia: float  # I* = rho_s b / (rho_f a)
    c_translation: float = 1.2  # C_T, lift by angle of attack
    c_rotation: float = np.pi  # C_R, lift by rotation
    a_drag: float = 1.4  # A
    b_drag: float = 1.0  # B
    mu_linear: float = 0.2  # mu_1, torque linear in the angular velocity
    mu_quadratic: float = 0.2  # mu_2, torque quadratic in it


def falling_plate_rhs(_time: float, state: Array, params: PlateParams) -> Array:
    """
    Return the time derivative of the state of a falling plate.

    I* vx' = (I* + 1) w vy - G vy - sin th - Fx
    (I* + 1) vy' = -I* w vx + G vx - cos th - Fy
    (I* + 1/2)/4 w' = -vx vy - (mu1 + mu2 |w|) w
    G = 2/pi (-C_T vx vy/|v| + C_R w),  F = (1/pi) (A - B (vx^2 - vy^2)/|v|^2) |v| v

    for a thin plate (thickness << width); no NaN at rest. Fixed points: edge-on descent at
    sqrt(pi/(A - B)), broadside at sqrt(pi/(A + B)).

    Parameters
    ----------
    _time
        Not used; the equations are autonomous.
    state
        (x, y, th, vx, vy, w): position in the room frame (y up), angle, velocity along the plate's
        axes (x along its width, y along its thickness), angular velocity; shape (6,).
    params
        See `PlateParams`.

    Returns
    -------
    Derivative of the state, shape (6,).

    """
    _, _, theta, vx, vy, omega = state
    speed = np.hypot(vx, vy)
    # The quotients are bounded by |v|, so they vanish with it.
    safe = speed if speed > 0 else 1.0
    circulation = 2 / np.pi * (-params.c_translation * vx * vy / safe + params.c_rotation * omega)
    ratio = (vx - vy) * (vx + vy) / safe**2
    drag = (params.a_drag - params.b_drag * ratio) * speed / np.pi
    torque = -vx * vy - (params.mu_linear + params.mu_quadratic * abs(omega)) * omega
    sine, cosine = np.sin(theta), np.cos(theta)
    inertia = params.inertia
    return np.array(
        [
            vx * cosine - vy * sine,
            vx * sine + vy * cosine,
            omega,
            ((inertia + 1) * omega * vy - circulation * vy - sine - drag * vx) / inertia,
            (-inertia * omega * vx + circulation * vx - cosine - drag * vy) / (inertia + 1),
            torque * 4 / (inertia + 0.5),
        ]
    )


def fixed_point_speeds(params: PlateParams) -> tuple[float, float]:
    """
    Return the speeds of steady edge-on and broadside descent, sqrt(pi/(A -+ B)).

    Parameters
    ----------
    params
        See `PlateParams`; A > B.

    Returns
    -------
    edge_on, broadside
        [-], in units of U.

    """
    edge_on = np.sqrt(np.pi / (params.a_drag - params.b_drag))
    broadside = np.sqrt(np.pi / (params.a_drag + params.b_drag))
    return float(edge_on), float(broadside)
