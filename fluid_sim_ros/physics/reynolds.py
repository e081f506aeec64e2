"""Reynolds number and terminal speeds."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Array, not_negative, positive


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
    Return the speed at which Stokes and quadratic drag together carry the weight [m/s].

    W = b v + k v^2 with b = 6 pi beta r and k = rho K; v = 2 W / (b + sqrt(b^2 + 4 k W)), the form
    of the root that does not cancel. Tends to the two others for k -> 0 and b -> 0. Arguments as
    in `terminal_speed_stokes` and `terminal_speed_quadratic`; b = k = 0 is refused there.
    """
    w = np.asarray(weight, dtype=np.float64)
    linear = 6.0 * np.pi * not_negative(viscosity, 'viscosity [Pa s]') * positive(radius, 'radius')
    quadratic = not_negative(density, 'density') * not_negative(drag_area, 'drag area [m^2]')
    positive(linear + quadratic, 'resistance (viscosity or density times drag area)')
    root = linear + np.sqrt(linear**2 + 4.0 * quadratic * np.abs(w))
    # No weight and no viscosity: root is 0 and so is the speed.
    return 2.0 * w / np.where(root > 0, root, 1.0)
