# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The Aerosonde's equations of motion, written down once more, and solved by SciPy.

Beard and McLain (2012), Small Unmanned Aircraft, ch. 3 to 5, in the book's own axes: x forward,
y right, z down (FRD), world north east down, Euler angles; the motor and the numbers are those of
the authors' mavsim_public. By hand: nothing here reads a model or the package.

State: u v w [m/s], p q r [rad/s], phi theta psi [rad]. Input: elevator, aileron, rudder [rad],
speed of the propeller [rad/s].
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

Array = NDArray[np.float64]
G, RHO = 9.81, 1.2682  # [m/s^2], [kg/m^3]
MASS = 11.0  # [kg]
INERTIA = np.array([[0.8244, 0, -0.1204], [0, 1.135, 0], [-0.1204, 0, 1.759]])  # [kg m^2]
S, B, C, E = 0.55, 2.8956, 0.18994, 0.9  # wing [m^2], [m], [m]; Oswald's factor
D_PROP = 0.508  # [m]
CT, CQ = (0.09357, -0.06044, -0.1079), (0.00523, 0.00497, -0.01664)  # of J, from the constant up
#: Motor: V s/rad (145 rpm/V), ohm, A, V.
KQ, R, I0, V_MAX = 60 / (2 * np.pi * 145), 0.042, 1.5, 44.4


def propeller(speed: float, airspeed: float) -> tuple[float, float]:
    """Return thrust [N] and torque [N m] at a speed [rad/s] above 0 and an airspeed [m/s]."""
    n = speed / (2 * np.pi)
    j = airspeed / (n * D_PROP)
    thrust, torque = (c[0] + c[1] * j + c[2] * j * j for c in (CT, CQ))
    return RHO * n**2 * D_PROP**4 * thrust, RHO * n**2 * D_PROP**5 * torque


def motor_speed(throttle: float, airspeed: float) -> float:
    """Return the steady speed [rad/s]: the larger root of the book's quadratic."""
    a = RHO * D_PROP**5 * CQ[0] / (2 * np.pi) ** 2
    b = RHO * D_PROP**4 * CQ[1] * airspeed / (2 * np.pi) + KQ**2 / R
    c = RHO * D_PROP**3 * CQ[2] * airspeed**2 - KQ * V_MAX * throttle / R + KQ * I0
    return float((-b + np.sqrt(b * b - 4 * a * c)) / (2 * a))


def rates(state: Array, surfaces: Sequence[float], speed: float) -> Array:
    """Return the time derivative of the state."""
    u, v, w, p, q, r, phi, theta, _ = state
    elevator, aileron, rudder = surfaces
    air = np.sqrt(u * u + v * v + w * w)
    alpha, beta = np.arctan2(w, u), np.arcsin(v / air)
    pressure = 0.5 * RHO * air**2 * S
    p_, q_, r_ = p * B / (2 * air), q * C / (2 * air), r * B / (2 * air)

    linear = 0.23 + 5.61 * alpha
    up, down = np.exp(-50 * (alpha - 0.47)), np.exp(50 * (alpha + 0.47))
    sigma = (1 + up + down) / ((1 + up) * (1 + down))
    plate = 2 * np.sign(alpha) * np.sin(alpha) ** 2 * np.cos(alpha)
    lift = pressure * ((1 - sigma) * linear + sigma * plate + 7.95 * q_ + 0.13 * elevator)
    drag = pressure * (0.043 + linear**2 / (np.pi * E * B * B / S) + 0.0135 * elevator)
    thrust, torque = propeller(speed, u)
    force = np.array([
        lift * np.sin(alpha) - drag * np.cos(alpha) + thrust,
        pressure * (-0.98 * beta + 0.075 * aileron + 0.19 * rudder),
        -lift * np.cos(alpha) - drag * np.sin(alpha),
    ]) + MASS * G * np.array([
        -np.sin(theta), np.cos(theta) * np.sin(phi), np.cos(theta) * np.cos(phi),
    ])  # fmt: skip
    moment = pressure * np.array([
        B * (-0.13 * beta - 0.51 * p_ + 0.25 * r_ + 0.17 * aileron + 0.0024 * rudder),
        C * (0.0135 - 2.74 * alpha - 38.21 * q_ - 0.99 * elevator),
        B * (0.073 * beta + 0.069 * p_ - 0.095 * r_ - 0.011 * aileron - 0.069 * rudder),
    ]) - np.array([torque, 0, 0])  # fmt: skip

    omega = np.array([p, q, r])
    return np.r_[
        force / MASS - np.cross(omega, [u, v, w]),
        np.linalg.solve(INERTIA, moment - np.cross(omega, INERTIA @ omega)),
        p + np.tan(theta) * (q * np.sin(phi) + r * np.cos(phi)),
        q * np.cos(phi) - r * np.sin(phi),
        (q * np.sin(phi) + r * np.cos(phi)) / np.cos(theta),
    ]


def trim(airspeed: float) -> dict[str, float]:
    """
    Return steady level flight with level wings at an airspeed [m/s].

    Angles and deflections [rad], throttle 0 to 1, speed of the propeller [rad/s].
    """

    def unbalanced(x: Array) -> Array:
        state, surfaces, speed = _steady(airspeed, x)
        return rates(state, surfaces, speed)[:6]

    x = fsolve(unbalanced, [0.05, 0, -0.1, 0, 0, 0.5], xtol=1e-12)
    names = ('alpha', 'beta', 'elevator', 'aileron', 'rudder', 'throttle')
    found = dict(zip(names, (float(value) for value in x), strict=True))
    return {**found, 'speed': _steady(airspeed, x)[2]}


def _steady(airspeed: float, x: Array) -> tuple[Array, tuple[float, ...], float]:
    """Return state, surfaces and propeller speed of level flight by the unknowns of ``trim``."""
    alpha, beta, elevator, aileron, rudder, throttle = x
    u, v, w = wind_axes(airspeed, alpha, beta)
    state = np.array([u, v, w, 0, 0, 0, 0, np.arctan2(w, u), 0])
    return state, (elevator, aileron, rudder), motor_speed(throttle, u)


def wind_axes(airspeed: float, alpha: float, beta: float) -> tuple[float, float, float]:
    """Return u, v, w [m/s] of an airspeed, angle of attack and sideslip."""
    ahead = airspeed * np.cos(beta)
    return ahead * np.cos(alpha), airspeed * np.sin(beta), ahead * np.sin(alpha)


def modes(airspeed: float) -> Array:
    """Return the eigenvalues [1/s] of free motion about the trim, propeller speed held."""
    found = trim(airspeed)
    state = np.r_[
        wind_axes(airspeed, found['alpha'], found['beta']), 0, 0, 0, 0, found['alpha'], 0
    ]
    surfaces = (found['elevator'], found['aileron'], found['rudder'])
    columns = []
    for i in range(8):  # the heading changes nothing
        step = 1e-6 * np.eye(9)[i]
        ahead, behind = (rates(state + s, surfaces, found['speed']) for s in (step, -step))
        columns.append((ahead - behind)[:8] / 2e-6)
    eigenvalues: Array = np.linalg.eigvals(np.array(columns).T)
    return eigenvalues


def flight(times: Array, start: ArrayLike, surfaces: Sequence[float], speed: float) -> Array:
    """Return the states at times [s] under a constant input, shape (n, 9)."""
    solved = solve_ivp(
        lambda _, y: rates(y, surfaces, speed), (0, times[-1]), start, t_eval=times, rtol=1e-10,
        atol=1e-12,
    )  # fmt: skip
    rows: Array = solved.y.T
    return rows
