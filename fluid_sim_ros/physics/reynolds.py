# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reynolds number, terminal speeds, and drag that depends on the Reynolds number."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import (
    Array,
    column,
    norm,
    not_negative,
    positive,
    positive_vectors,
    vectors,
)
from fluid_sim_ros.physics.drag import Area, blunt_slender_drag, drag_area


def reynolds_number(
    speed: ArrayLike, length: ArrayLike, density: ArrayLike, viscosity: ArrayLike
) -> Array:
    """
    Return Re = rho u l / beta.

    Parameters
    ----------
    speed, length
        Characteristic speed relative to the medium [m/s] and length [m] (sphere: diameter),
        shape (...).
    density, viscosity
        Of the medium [kg/m^3] and [Pa s], shape (...).

    Returns
    -------
    [-], shape (...).

    """
    beta = positive(viscosity, 'viscosity [Pa s]')
    number: Array = np.asarray(density) * np.abs(speed) * np.asarray(length) / beta
    return number


def terminal_speed_stokes(weight: ArrayLike, radius: ArrayLike, viscosity: ArrayLike) -> Array:
    """
    Return W / (6 pi beta r) [m/s]: speed at which the Stokes resistance carries the weight.

    Parameters
    ----------
    weight
        Submerged weight, gravity less buoyancy [N], shape (...); negative rises.
    radius
        Of the equivalent sphere [m], shape (...).
    viscosity
        [Pa s], shape (...).

    """
    beta = positive(viscosity, 'viscosity [Pa s]')
    return np.asarray(weight) / (6.0 * np.pi * beta * positive(radius, 'radius [m]'))


def terminal_speed_quadratic(weight: ArrayLike, drag_area: ArrayLike, density: ArrayLike) -> Array:
    """
    Return sign(W) sqrt(|W| / (rho K)) [m/s]: speed at which quadratic drag carries the weight.

    Parameters
    ----------
    weight
        Submerged weight [N], shape (...).
    drag_area
        K in drag = rho K v^2 [m^2], shape (...): C_blunt times area, or half of a textbook Cd
        times area.
    density
        Of the medium [kg/m^3], shape (...).

    """
    w = np.asarray(weight, dtype=np.float64)
    resistance = positive(density, 'density [kg/m^3]') * positive(drag_area, 'drag area [m^2]')
    return np.sign(w) * np.sqrt(np.abs(w) / resistance)


def terminal_speed_combined(
    weight: ArrayLike,
    radius: ArrayLike,
    drag_area: ArrayLike,
    density: ArrayLike,
    viscosity: ArrayLike,
) -> Array:
    """
    Return the speed at which Stokes and quadratic drag together carry the weight.

    W = b v + k v^2 with b = 6 pi beta r and k = rho K; v = 2 W / (b + sqrt(b^2 + 4 k W)), the form
    of the root that does not cancel. Tends to `terminal_speed_stokes` for k -> 0 and to
    `terminal_speed_quadratic` for b -> 0.

    Parameters
    ----------
    weight
        W, less the buoyancy [N], shape (...).
    radius
        r of the equivalent sphere [m], shape (...).
    drag_area
        K [m^2] of the quadratic drag rho K v^2, shape (...).
    density, viscosity
        Of the medium [kg/m^3] and dynamic [Pa s], shape (...).

    Returns
    -------
    [m/s], shape (...).

    Raises
    ------
    ConfigError
        If a number is out of range, or nothing resists (b = k = 0).

    """
    w = np.asarray(weight, dtype=np.float64)
    linear = 6.0 * np.pi * not_negative(viscosity, 'viscosity [Pa s]') * positive(radius, 'radius')
    quadratic = not_negative(density, 'density') * not_negative(drag_area, 'drag area [m^2]')
    positive(linear + quadratic, 'resistance (viscosity or density times drag area)')
    root = linear + np.sqrt(linear**2 + 4.0 * quadratic * np.abs(w))
    # No weight and no viscosity: root is 0 and so is the speed.
    return 2.0 * w / np.where(root > 0, root, 1.0)


def sphere_cd_brown_lawler(reynolds: ArrayLike) -> Array:
    """
    Return the drag coefficient of a smooth sphere, on 1/2 rho v^2 and the projected area.

    Cd = 24/Re (1 + 0.15 Re^0.681) + 0.407/(1 + 8710/Re); Brown and Lawler (2003), J. Environ. Eng.
    129:222. For 0 < Re < 2e5: no drag crisis.

    Parameters
    ----------
    reynolds
        Re by the diameter [-], above 0, shape (...).

    Returns
    -------
    [-], shape (...).

    """
    re = positive(reynolds, 'Re')
    cd: Array = 24.0 / re * (1.0 + 0.15 * re**0.681) + 0.407 * re / (re + 8710.0)
    return cd


def blunt_coefficient(reynolds: ArrayLike) -> Array:
    """
    Return C_blunt(Re) = (Cd(Re) - 24/Re)/2 [-], the coefficient to use beside the Stokes term.

    The part 24/Re of the curve is the Stokes resistance, which `viscous_resistance` applies; the
    half is because MuJoCo's drag has no 1/2. Cd as in `sphere_cd_brown_lawler`.

    Parameters
    ----------
    reynolds
        Re by the diameter [-], above 0, shape (...).

    Returns
    -------
    [-], shape (...).

    """
    re = positive(reynolds, 'Re')
    coefficient: Array = 0.5 * (3.6 * re**-0.319 + 0.407 * re / (re + 8710.0))
    return coefficient


def blunt_drag_factor(
    speed: ArrayLike, radius: ArrayLike, density: ArrayLike, viscosity: ArrayLike
) -> Array:
    """
    Return rho C_blunt(Re) |v| [kg/(m^2 s)], finite and zero at rest, shape (...).

    With Re = rho |v| 2 r / beta written out nothing is divided by the speed:
    (3.6 (rho |v|)^0.681 (beta/(2 r))^0.319 + 0.407 rho |v| q/(q + 8710 beta))/2, q = 2 r rho |v|.
    Times area and velocity it is the drag force. At beta = 0 it is 0.407 rho |v|/2 (Re infinite).

    Parameters
    ----------
    speed
        Relative to the medium [m/s], shape (...).
    radius
        Of the equivalent sphere [m], shape (...).
    density, viscosity
        Of the medium [kg/m^3] and [Pa s], shape (...).

    """
    r, beta = positive(radius, 'radius [m]'), not_negative(viscosity, 'viscosity [Pa s]')
    flux = not_negative(density, 'density [kg/m^3]') * np.abs(speed)
    q = 2.0 * r * flux
    total = q + 8710.0 * beta
    inertial = 0.407 * flux * q / np.where(total > 0, total, 1.0)
    factor: Array = 0.5 * (3.6 * flux**0.681 * (beta / (2.0 * r)) ** 0.319 + inertial)
    return factor


def reynolds_drag(
    axes: ArrayLike,
    v_rel_b: ArrayLike,
    *,
    density: ArrayLike,
    viscosity: ArrayLike,
    c_slender: ArrayLike = 0.25,
    area: Area = 'lemma',
) -> Array:
    """
    Return the blunt and slender drag of an ellipsoid with C_blunt by its Reynolds number.

    f = -(rho C_blunt(Re) |v| A + rho C_slender |v| (A_max - A)) v, Re by the equivalent sphere
    r_eq = (r_x + r_y + r_z)/3; use together with `viscous_resistance`. For a sphere the sum is the
    standard drag curve within 5.3 % in Cd up to Re 5e4, 7.2 % to 1e5, 7.6 % to 2e5. Dissipates,
    odd in v, smooth at rest.

    Parameters
    ----------
    axes, v_rel_b, density, c_slender, area
        As in `blunt_slender_drag`.
    viscosity
        Of the medium [Pa s], shape (...).

    Returns
    -------
    Force [N], ellipsoid axes, shape (..., 3).

    """
    v = vectors(v_rel_b, 'v_rel_b')
    r_eq = positive_vectors(axes, 'semi-axes [m]').mean(axis=-1)
    shadow = drag_area(axes, v, area)
    factor = blunt_drag_factor(norm(v)[..., 0], r_eq, density, viscosity)
    slender = blunt_slender_drag(
        axes, v, density=density, c_blunt=0.0, c_slender=c_slender, area=area
    )
    return slender - column(factor * shadow) * v
