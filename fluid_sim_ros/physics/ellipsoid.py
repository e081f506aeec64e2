# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The ellipsoid model: all its terms together, as MuJoCo's ``fluidshape="ellipsoid"``."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.added_mass import ellipsoid_added_mass_wrench
from fluid_sim_ros.physics.arrays import Wrench, vectors
from fluid_sim_ros.physics.drag import (
    Area,
    angular_drag,
    blunt_slender_drag,
    viscous_resistance,
)
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass
from fluid_sim_ros.physics.lift import kutta_force, magnus_force


class FluidCoef(NamedTuple):
    """The five coefficients [-] in the order of MuJoCo's ``fluidcoef``, with its defaults."""

    blunt: float = 0.5
    slender: float = 0.25
    angular: float = 1.5
    kutta: float = 1.0
    magnus: float = 1.0


def ellipsoid_wrench(
    axes: ArrayLike,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike,
    *,
    density: ArrayLike,
    viscosity: ArrayLike,
    coef: FluidCoef = FluidCoef(),  # noqa: B008  an immutable tuple
    v_dot_b: ArrayLike = (0.0, 0.0, 0.0),
    omega_dot_b: ArrayLike = (0.0, 0.0, 0.0),
    area: Area = 'lemma',
) -> dict[str, Wrench]:
    """
    Return every term of the ellipsoid model as term -> (force_b, torque_b).

    MuJoCo documentation, chapter "Fluid forces", section "Ellipsoid model"; where its text and
    the engine differ, the engine. With the default accelerations of zero and the lemma's area the
    sum is what MuJoCo applies; with the body's accelerations ``added_mass`` is complete. At rest
    every term is zero.

    Parameters
    ----------
    axes
        Semi-axes [m], shape (..., 3).
    v_rel_b, omega_b
        Velocity relative to the medium at the centre [m/s] and angular velocity [rad/s],
        ellipsoid axes, shape (..., 3).
    density, viscosity
        Of the medium [kg/m^3] and [Pa s], shape (...).
    coef
        The five coefficients.
    v_dot_b, omega_dot_b
        Time derivatives of the components of v_rel_b and omega_b [m/s^2], [rad/s^2], (..., 3).
    area
        Projected area of the drag: ``lemma`` (engine) or ``true``.

    Returns
    -------
    Terms ``drag``, ``viscous``, ``added_mass``, ``magnus``, ``kutta``: force [N] and torque [N m]
    about the centre, ellipsoid axes, shape (..., 3) each.

    """
    v, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    mass_a, inertia_a = ellipsoid_added_mass(axes, density)
    drag_force = blunt_slender_drag(
        axes, v, density=density, c_blunt=coef.blunt, c_slender=coef.slender, area=area
    )
    drag_torque = angular_drag(
        axes, omega, density=density, c_angular=coef.angular, c_slender=coef.slender
    )
    magnus = magnus_force(axes, v, omega, density=density, c_magnus=coef.magnus)
    kutta = kutta_force(axes, v, density=density, c_kutta=coef.kutta)
    return {
        'drag': (drag_force, drag_torque),
        'viscous': viscous_resistance(axes, v, omega, viscosity),
        'added_mass': ellipsoid_added_mass_wrench(
            mass_a, inertia_a, v, omega, v_dot_b, omega_dot_b
        ),
        'magnus': (magnus, np.zeros_like(magnus)),
        'kutta': (kutta, np.zeros_like(kutta)),
    }
