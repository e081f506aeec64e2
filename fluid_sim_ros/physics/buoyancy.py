# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Buoyancy, righting moment and the slamming force of a body that enters water."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.added_mass import momentum
from fluid_sim_ros.physics.arrays import Array, Wrench, column, not_negative, positive, vectors


def buoyancy_wrench(
    density: ArrayLike, volume: ArrayLike, center_b: ArrayLike, gravity_b: ArrayLike
) -> Wrench:
    """
    Return the buoyancy of a displaced volume.

    f = -rho V g at the centre of the displaced volume; Archimedes. Conservative in a uniform
    medium: the torque rights a body whose centre of volume is above its centre of mass.

    Parameters
    ----------
    density
        Of the medium [kg/m^3], shape (...).
    volume
        Displaced [m^3], shape (...).
    center_b
        Centre of the displaced volume from the reference point [m], body axes, shape (..., 3).
    gravity_b
        Acceleration of gravity (points down) [m/s^2], body axes, shape (..., 3).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the reference point, shape (..., 3) each.

    """
    rho = not_negative(density, 'density [kg/m^3]')
    displaced = column(rho * not_negative(volume, 'volume [m^3]'))
    force = -displaced * vectors(gravity_b, 'gravity_b')
    return force, np.cross(vectors(center_b, 'center_b'), force)


def layered_buoyancy_wrench(
    density_below: ArrayLike,
    density_above: ArrayLike,
    volume: ArrayLike,
    center_b: ArrayLike,
    wet_volume: ArrayLike,
    wet_center_b: ArrayLike,
    gravity_b: ArrayLike,
) -> Wrench:
    """
    Return the buoyancy of a body partly in water and partly in air (or two other layers).

    Each part displaces its own medium: rho_above V at the body's centre of volume plus
    (rho_below - rho_above) V_wet at the centre of the wet part.

    Parameters
    ----------
    density_below, density_above
        Of the lower and the upper medium [kg/m^3], shape (...).
    volume, center_b
        Whole volume of the body [m^3], shape (...), and its centre from the reference point [m],
        body axes, shape (..., 3).
    wet_volume, wet_center_b
        Of the part in the lower medium, likewise.
    gravity_b
        Acceleration of gravity (points down) [m/s^2], body axes, shape (..., 3).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the reference point, body axes, shape (..., 3) each.

    """
    whole = buoyancy_wrench(density_above, volume, center_b, gravity_b)
    below = buoyancy_wrench(density_below, wet_volume, wet_center_b, gravity_b)
    above = buoyancy_wrench(density_above, wet_volume, wet_center_b, gravity_b)
    return whole[0] + below[0] - above[0], whole[1] + below[1] - above[1]


def righting_torque(
    weight_mass: ArrayLike,
    mass_center_b: ArrayLike,
    density: ArrayLike,
    volume: ArrayLike,
    center_b: ArrayLike,
    gravity_b: ArrayLike,
) -> Array:
    """
    Return the torque of weight and buoyancy together about the reference point [N m].

    (m r_G - rho V r_B) x g; Fossen (2021), restoring forces. Zero in the upright attitude.

    Parameters
    ----------
    weight_mass
        Mass of the body [kg], shape (...).
    mass_center_b
        Its centre from the reference point [m], body axes, shape (..., 3).
    density
        Of the medium [kg/m^3], shape (...).
    volume
        Displaced [m^3], shape (...).
    center_b
        Centre of the displaced volume from the reference point [m], body axes, shape (..., 3).
    gravity_b
        Acceleration of gravity (points down) [m/s^2], body axes, shape (..., 3).

    Returns
    -------
    [N m], body axes, shape (..., 3).

    """
    gravity = vectors(gravity_b, 'gravity_b')
    lift = buoyancy_wrench(density, volume, center_b, gravity)[1]
    heavy = column(weight_mass) * gravity
    torque: Array = lift + np.cross(vectors(mass_center_b, 'mass_center_b'), heavy)
    return torque


def wetted_share(wet_volume: ArrayLike, volume: ArrayLike) -> Array:
    """
    Return s = V_wet / V in [0, 1]; rounding outside of it is taken off.

    Parameters
    ----------
    wet_volume
        Volume of the part under water [m^3], shape (...).
    volume
        Whole volume [m^3], shape (...).

    Returns
    -------
    [-], shape (...).

    Raises
    ------
    ConfigError
        If the whole volume is not above zero.

    """
    share: Array = np.clip(np.asarray(wet_volume) / positive(volume, 'volume [m^3]'), 0.0, 1.0)
    return share


def slamming_wrench(
    matrix_slope: ArrayLike, share_rate: ArrayLike, v_rel_b: ArrayLike, omega_b: ArrayLike
) -> Wrench:
    """
    Return the force of the fluid that a body entering water must set in motion.

    -(ds/dt)+ (dA/ds) nu; von Karman (1929), NACA TN 321. On exit nothing: the fluid keeps its
    momentum. With it a body that enters without other forces ends at m/(m + A) of its speed, and
    the energy of body and fluid never rises: dT/dt = -|ds/dt| nu . (dA/ds) nu / 2.

    Parameters
    ----------
    matrix_slope
        dA/ds, for A proportional to the wetted share the whole added-mass matrix, body axes,
        shape (..., 6, 6).
    share_rate
        ds/dt [1/s], shape (...); positive on entry.
    v_rel_b, omega_b
        Relative velocity of the reference point [m/s] and angular velocity [rad/s], body axes,
        shape (..., 3).

    Returns
    -------
    force_b, torque_b
        [N], [N m] about the reference point, body axes, shape (..., 3) each.

    """
    linear, angular = momentum(
        matrix_slope, vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    )
    entry = column(np.maximum(share_rate, 0.0))
    return -entry * linear, -entry * angular
