# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A new vehicle as numbers: checked, with the thrusts that hold it at rest."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.new_vehicle.fins import Fins
from fluid_sim_ros.new_vehicle.layout import DENSITY, WITH_FINS, Medium, Thruster
from fluid_sim_ros.physics.arrays import Array

GRAVITY = 9.81  # [m/s^2], MuJoCo's default
#: Osmium, the densest metal [kg/m^3] (CRC Handbook of Chemistry and Physics).
_DENSEST = 22590.0
#: Guess: drag coefficient of a blunt face (cube, face on: 1.05; Hoerner 1965, ch. 3).
DRAG_COEFFICIENT = 1.0
#: Guess: drag of a torpedo along its axis, of that of a blunt face; REMUS 100: C_d 0.27 (Prestero
#: 2001, ch. 4).
SLENDER_SHARE = 0.25
#: Guess: speed [m/s] and rate [rad/s] at which linear and quadratic damping are equal.
LINEAR_BELOW = 0.1
#: Guess: centre of buoyancy above the centre of mass, of the height.
RIGHTING_SHARE = 0.05
#: Of the weight, and of it at the longest arm: left over by rounding only.
_MET = 1e-6


@dataclass(frozen=True)
class Design:
    """
    A new vehicle: an even box of ``mass`` [kg] and ``size`` (length, width, height) [m].

    ``buoyancy`` is the net force upward under water [N]; ``hover`` the thrusts at rest [N] in air,
    zeros in water; ``sensors`` their kinds; ``layout`` the preset of the thrusters, or a file.
    """

    name: str
    medium: Medium
    mass: float
    size: Array
    buoyancy: float
    thrusters: list[Thruster]
    hover: Array
    sensors: tuple[str, ...] = ()
    layout: str = ''

    @property
    def fins(self) -> Fins | None:
        """Rudder and planes of a torpedo, None for others."""
        return Fins(self.size, self.mass) if self.layout in WITH_FINS else None

    @property
    def inertia(self) -> Array:
        """Moments of inertia of the even box [kg m^2]."""
        squares = self.size**2
        inertia: Array = self.mass / 12 * (squares.sum() - squares)
        return inertia

    @property
    def volume(self) -> float:
        """Displaced volume under water [m^3]."""
        return (self.mass + self.buoyancy / GRAVITY) / DENSITY['water']

    @property
    def semi_axes(self) -> Array:
        """Semi-axes [m] of the ellipsoid with the displaced volume and the proportions."""
        share = self.volume / (np.pi / 6 * self.size.prod())
        axes: Array = 0.5 * self.size * share ** (1 / 3)
        return axes

    @property
    def quadratic_damping(self) -> Array:
        """
        Damping of the box in water, [N s^2/m^2] x 3, [N m s^2] x 3.

        rho/2 C_d A along an axis; about one, rho/2 C_d s a^4/32 for each pair of faces of width a
        across and s along that axis.
        """
        length, width, height = self.size
        half = 0.5 * DENSITY['water'] * DRAG_COEFFICIENT
        ahead = SLENDER_SHARE if self.fins else 1.0
        return half * np.array([
            ahead * width * height, length * height, length * width,
            length * (width**4 + height**4) / 32, width * (length**4 + height**4) / 32,
            height * (length**4 + width**4) / 32,
        ])  # fmt: skip


def check_body(medium: Medium, mass: float, size: Array, buoyancy: float) -> None:
    """
    Refuse a mass, size or buoyancy that no vehicle has.

    Parameters
    ----------
    medium
        ``air`` or ``water``.
    mass
        [kg].
    size
        Length, width, height of the box [m], shape (3,).
    buoyancy
        Net force upward under water [N].

    Raises
    ------
    ConfigError
        With what is allowed, or by how much it is missed.

    """
    if not (np.isfinite(mass) and mass > 0):
        raise ConfigError(f'--mass {mass:g}: must be above 0 [kg]')
    if not (np.isfinite(size).all() and (size > 0).all()):
        raise ConfigError(f'--size {_text(size)}: all three must be above 0 [m]')
    if not np.isfinite(buoyancy):
        raise ConfigError(f'--buoyancy {buoyancy:g}: must be finite [N]')
    box = float(size.prod())
    density = mass / box
    if density > _DENSEST:
        raise ConfigError(
            f'--mass {mass:g} in --size {_text(size)}: {density:.0f} kg/m^3, denser than any '
            f'metal ({_DENSEST:.0f}); give at most {_DENSEST * box:.4g} kg'
        )
    if medium == 'air':
        if buoyancy:
            raise ConfigError('--buoyancy is for water; in air the thrusters carry the weight')
        if density <= DENSITY['air']:
            raise ConfigError(
                f'--mass {mass:g} in --size {_text(size)}: {density:.3g} kg/m^3, lighter than air '
                f'({DENSITY["air"]}); give more than {DENSITY["air"] * box:.4g} kg'
            )
        return
    displaced = mass + buoyancy / GRAVITY
    if displaced <= 0:
        raise ConfigError(
            f'--buoyancy {buoyancy:g}: pulls down by more than the weight; give more than '
            f'{-mass * GRAVITY:.4g} N'
        )
    most = DENSITY['water'] * box
    if displaced > most:
        raise ConfigError(
            f'--mass {mass:g} in --size {_text(size)}: must displace {displaced:.4g} kg of water, '
            f'and the whole box displaces {most:.4g} kg; {displaced - most:.4g} kg too heavy: '
            f'a larger --size, or --buoyancy {(most - mass) * GRAVITY:.4g} N at most (it sinks)'
        )


def hover_thrusts(thrusters: list[Thruster], weight: float) -> Array:
    """
    Return the thrusts that hold a weight level and at rest.

    Those of least norm where they are within the limits, else the nearest within them.

    Parameters
    ----------
    thrusters
        Of the vehicle.
    weight
        [N].

    Returns
    -------
    Array
        [N], one per thruster, within the limits.

    Raises
    ------
    ConfigError
        If there are none: by how much the lift falls short, or what the layout leaves over.

    """
    limits = np.array([thruster.limits for thruster in thrusters])
    upward = np.array([thruster.direction[2] for thruster in thrusters])
    most = float(np.maximum(upward * limits[:, 0], upward * limits[:, 1]).sum())
    if most < weight:
        raise ConfigError(
            f'hover needs {weight:.4g} N upward and the thrusters give at most {most:.4g} N: '
            f'{weight - most:.4g} N short'
        )
    matrix = np.array([thruster.wrench() for thruster in thrusters]).T
    wanted = np.array([0, 0, weight, 0, 0, 0])
    thrusts = np.linalg.pinv(matrix) @ wanted
    if (thrusts < limits[:, 0]).any() or (thrusts > limits[:, 1]).any():
        thrusts = lsq_linear(matrix, wanted, limits.T, method='bvls', tol=1e-14).x
    left = matrix @ thrusts - wanted
    arm = max(float(np.linalg.norm(thruster.position)) for thruster in thrusters)
    if (np.abs(left) > _MET * weight * np.array([1, 1, 1, arm, arm, arm])).any():
        raise ConfigError(
            'hover is impossible with this layout: within the limits, the nearest thrusts leave '
            f'{_text(left[:3])} N and {_text(left[3:])} N m over (forward, left, up)'
        )
    result: Array = thrusts
    return result


def _text(values: Array) -> str:
    return ' '.join(f'{value:.4g}' for value in values)
