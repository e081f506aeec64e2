# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
REMUS 100: the published coefficients, and its equations of motion once more, solved by SciPy.

Prestero (2001), appendix C, with Yvv and Nrr as the hull's symmetry has them. Nothing here reads a
model. Body axes FLU, origin in the centre of buoyancy, SI units; about the origin, with the rigid
body's M and the added mass A (Fossen 2021, ch. 3 and 6),

    (M + A) nu' = -C_M(nu) nu - C_A(nu) nu + damping + body lift + fins + weight, buoyancy
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from test.support.vehicle_equations import Array, quat_rate, rotation

#: Name -> value; ship axes (forward, right, down). Cross terms are totals, fins and added mass in.
PUBLISHED = {
    'Xuu': -1.62, 'Yvv': -131.0, 'Yrr': 0.632, 'Zww': -131.0, 'Zqq': -0.632, 'Kpp': -0.13,
    'Mww': 3.18, 'Mqq': -188.0, 'Nvv': -3.18, 'Nrr': -188.0,
    'Yuv': -28.6, 'Yur': 5.22, 'Zuw': -28.6, 'Zuq': -5.22, 'Muw': 24.0, 'Muq': -2.0, 'Nuv': -24.0,
    'Nur': -2.0,
    'Yuudr': 9.64, 'Nuudr': -6.15, 'Zuuds': -9.64, 'Muuds': -6.15,
}  # fmt: skip
#: Forces and velocities in the order of the letters; FRD to FLU is this sign on both.
FORCES, VELOCITIES, FLIP = 'XYZKMN', 'uvwpqr', np.array([1, -1, -1, 1, -1, -1])
MASS, HEIGHT_B_OVER_G, WEIGHT, BUOYANCY = 30.48, 0.0196, 299.0, 306.0  # [kg], [m], [N], [N]
INERTIA = np.array([0.177, 3.45, 3.45])  # [kg m^2] about the origin
DENSITY, FIN_AREA, FIN_X, FIN_RADIUS = 1030.0, 0.00665, -0.638, 0.108  # [kg/m^3], [m^2], [m], [m]
FIN_SLOPE, FIN_RATIO, FIN_STALL, FIN_NORMAL = 9.64 / (DENSITY * FIN_AREA), 2.21, 0.4, 0.558


def _added_mass() -> Array:
    """Return A; the couplings of sway with yaw and heave with pitch keep their sign in FLU."""
    a = np.diag([0.93, 35.5, 35.5, 0.0704, 4.88, 4.88])
    a[1, 5] = a[5, 1] = -1.93
    a[2, 4] = a[4, 2] = 1.93
    return a


def _rigid_body() -> Array:
    m = np.diag([MASS, MASS, MASS, *INERTIA])
    m[0, 4] = m[4, 0] = -MASS * HEIGHT_B_OVER_G
    m[1, 3] = m[3, 1] = MASS * HEIGHT_B_OVER_G
    return m


@dataclass(frozen=True)
class Fin:
    """A fin at rest on the hull: place [m] and the unit vector across it, body axes."""

    place: tuple[float, float, float]
    across: tuple[float, float, float]

    def wrench(self, v: Array, w: Array) -> Array:
        """Return force and torque about the origin in a motion relative to the water."""
        place, across = np.array(self.place), np.array(self.across)
        local = v + np.cross(w, place)
        ahead, up = local[0], local @ across
        speed = np.hypot(ahead, up)
        if speed == 0:
            return np.zeros(6)
        alpha = np.arctan2(-up, ahead)
        # in flow from behind the angle counts from the trailing edge
        angle = alpha - np.copysign(np.pi, alpha) if abs(alpha) > np.pi / 2 else alpha
        edges = np.exp(50 * (angle - FIN_STALL)), np.exp(-50 * (angle + FIN_STALL))
        attached = 1 / ((1 + edges[0]) * (1 + edges[1]))  # share of the flow
        lift = FIN_SLOPE * angle
        drag = lift**2 / (np.pi * FIN_RATIO)
        normal = FIN_NORMAL * np.sin(alpha) * abs(np.sin(alpha))
        lift = attached * lift + (1 - attached) * normal * np.cos(alpha)
        drag = attached * drag + (1 - attached) * normal * np.sin(alpha)
        scale = 0.5 * DENSITY * FIN_AREA * speed
        force = scale * (lift * -up - drag * ahead) * np.array([1.0, 0, 0])
        force = force + scale * (lift * ahead - drag * up) * across
        return np.r_[force, np.cross(place, force)]


FINS = [
    Fin((FIN_X, 0, sign * FIN_RADIUS), (0, 1, 0)) for sign in (1, -1)
] + [
    Fin((FIN_X, sign * FIN_RADIUS, 0), (0, 0, 1)) for sign in (1, -1)
]  # fmt: skip
ADDED, RIGID = _added_mass(), _rigid_body()


def convection(matrix: Array, nu: Array) -> Array:
    """Return -C(nu) nu of a mass matrix: the momentum carried along (Lamb 1932, art. 124)."""
    momentum = matrix @ nu
    return np.r_[
        np.cross(momentum[:3], nu[3:]),
        np.cross(momentum[:3], nu[:3]) + np.cross(momentum[3:], nu[3:]),
    ]


def hull_wrench(nu: Array) -> Array:
    """Return drag and lift of the hull alone: the published numbers less those of the fins."""
    wrench = np.zeros(6)
    fin = DENSITY * FIN_AREA * FIN_NORMAL  # a pair across the flow: force fin |v| v
    arm = abs(FIN_X)
    of_fins = {
        'Yvv': -fin, 'Zww': -fin, 'Yrr': fin * arm**2, 'Zqq': -fin * arm**2,
        'Mww': -fin * arm, 'Nvv': fin * arm, 'Mqq': -fin * arm**3, 'Nrr': -fin * arm**3,
        'Kpp': -2 * fin * FIN_RADIUS**3,
        'Yuv': -9.64, 'Zuw': -9.64, 'Yur': 9.64 * arm, 'Zuq': -9.64 * arm, 'Muw': -9.64 * arm,
        'Nuv': 9.64 * arm, 'Muq': -9.64 * arm**2, 'Nur': -9.64 * arm**2,
    }  # fmt: skip
    # of the added mass, Prestero's Yura, Zuqa, Muqa, Nura and the Munk moment
    of_added = {
        'Yur': -0.93, 'Zuq': 0.93, 'Muw': 35.5 - 0.93, 'Nuv': -(35.5 - 0.93), 'Muq': 1.93,
        'Nur': 1.93,
    }  # fmt: skip
    for name, value in PUBLISHED.items():
        if 'uud' in name:
            continue
        row, first, second = (
            FORCES.index(name[0]), VELOCITIES.index(name[1]), VELOCITIES.index(name[2]),
        )  # fmt: skip
        own = value - of_fins.get(name, 0) - of_added.get(name, 0)
        # both axes turned alike leave every coefficient its sign; |u| v also in sternway
        wrench[row] += FLIP[row] * FLIP[second] * own * abs(nu[first]) * nu[second]
    return wrench


def acceleration(quat: Array, nu: Array) -> Array:
    """Return nu' without thrust and deflection."""
    up = rotation(quat)[2]
    wrench = convection(RIGID, nu) + convection(ADDED, nu) + hull_wrench(nu)
    for fin in FINS:
        wrench += fin.wrench(nu[:3], nu[3:])
    wrench[:3] += (BUOYANCY - WEIGHT) * up
    wrench[3:] += np.cross([0, 0, -HEIGHT_B_OVER_G], -WEIGHT * up)
    result: Array = np.linalg.solve(RIGID + ADDED, wrench)
    return result


def decay(times: Array, start: ArrayLike) -> Array:
    """Return the body velocities, shape (n, 6), from level with the velocities ``start``."""

    def rates(_: float, y: Array) -> Array:
        quat = y[:4] / np.linalg.norm(y[:4])
        return np.r_[0.5 * quat_rate(quat, y[7:]), acceleration(quat, y[4:])]

    initial = np.r_[1, 0, 0, 0, np.asarray(start, dtype=float)]
    solved = solve_ivp(rates, (0, times[-1]), initial, t_eval=times, rtol=1e-9, atol=1e-10)
    rows: Array = solved.y[4:].T
    return rows


def straight_speed(thrust: float) -> float:
    """Return the steady speed [m/s] under a thrust [N], attitude and depth held."""
    return float(np.sqrt(thrust / -PUBLISHED['Xuu']))
