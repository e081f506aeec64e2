# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A neutrally buoyant cable between two fixed ends in a uniform current, by the equations of a line.

Written once more, without reading a model. With the arc length s, the tangent t and the tension T,

    dr/ds = t,    d(T t)/ds + f_n + f_t = 0,
    f_n = rho C_n d |u_n| u_n / 2,    f_t = rho C_t pi d |u_t| u_t / 2,

u_n and u_t the parts of the current across and along the cable (the independence principle;
Berteaux 1976, Buoy Engineering, ch. 4). Inextensible, without bending stiffness.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares


@dataclass(frozen=True)
class Cable:
    """Length, diameter [m], density of the water [kg/m^3], coefficients across and along."""

    length: float = 16.0
    diameter: float = 0.0076
    density: float = 1000.0
    across: float = 1.2
    along: float = 0.02

    def load(self, tangent, current):
        """Return the force of the current per length [N/m], shape (3,)."""
        half = 0.5 * self.density * self.diameter
        u_t = (current @ tangent) * tangent
        u_n = current - u_t
        normal = half * self.across * np.linalg.norm(u_n) * u_n
        return normal + half * np.pi * self.along * np.linalg.norm(u_t) * u_t


def shape(cable, start, end, current, points):
    """
    Return places at so many equal steps of arc length, and the forces on both ends.

    Parameters
    ----------
    cable
        A ``Cable``.
    start, end, current
        Places of the ends [m], velocity of the water [m/s], shape (3,).
    points
        How many places, both ends included.

    Returns
    -------
    places, pull
        [m], shape (points, 3); what the cable pulls its ends with [N], shape (2, 3).

    """
    start, end, current = (np.asarray(v, dtype=float) for v in (start, end, current))
    arc = np.linspace(0.0, cable.length, points)

    def slope(_, state):
        force = state[3:]
        tangent = force / np.linalg.norm(force)
        return np.concatenate([tangent, -cable.load(tangent, current)])

    def fly(force):
        return solve_ivp(
            slope, (0.0, cable.length), [*start, *force], t_eval=arc, rtol=1e-10, atol=1e-12
        ).y

    # the mean of what a slack cable carries, against the current at the start
    chord = end - start
    guess = 0.5 * cable.length * cable.load(np.array([0.0, 0.0, 1.0]), current)
    sag = np.sqrt(max(cable.length**2 - chord @ chord, 1e-3))
    guess = guess + np.linalg.norm(guess) * chord / sag
    found = least_squares(lambda force: fly(force)[:3, -1] - end, guess, xtol=1e-13, ftol=1e-13)
    assert np.abs(found.fun).max() < 1e-6, 'the boundary problem has no solution here'
    state = fly(found.x)
    return state[:3].T, np.array([found.x, -state[3:, -1]])
