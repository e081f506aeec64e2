# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The tasks in air that the peers share: a rigid body, its closed form, its equations for SciPy.

World ENU, body FLU, SI units, per kilogram:

    v' = -g e_z + R (T e_z - c P R^T v) - k |v| v        R = R_y(tilt) R_x(spin t)

with the thrust T, drag k of the body, drag c of the rotors in their plane (P takes the part in
it). Nothing turns the body but its first spin: that is about a principal axis.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]

G = 9.81  # [m/s^2]
MASS, INERTIA = 2.0, (0.02, 0.02, 0.04)  # of an x500, rounded [kg], [kg m^2]
DURATION, SAMPLE = 5.0, 1.0  # of a run; between two positions that are asked for [s]
TIMES = SAMPLE * np.arange(1, round(DURATION / SAMPLE) + 1)


class Run(NamedTuple):
    """
    One way to do a task.

    ``prepare`` returns what is timed; that returns the positions at ``TIMES`` [m], shape (n, 3),
    or raises `DivergedError`.
    """

    peer: str
    setting: str
    prepare: Callable[[], Callable[[], Array]]
    reference: Array
    vehicles: int = 1  # stepped at once; times are stated for one


@dataclass(frozen=True)
class AirTask:
    """A rigid body in still air from the origin; ``reference`` gives its positions at times."""

    name: str
    title: str
    reference: Callable[[Array], Array]
    spin: float = 0.0  # about body x [rad/s]
    tilt: float = 0.0  # about body y, nose down [rad]
    thrust: float = 0.0  # T [m/s^2]
    drag: float = 0.0  # k [1/m]
    rotor_drag: float = 0.0  # c [1/s]


def milliseconds(timestep: float) -> str:
    """Return a timestep [s] as the name of a setting."""
    return f'{1e3 * timestep:g} ms'


def fall() -> AirTask:
    """Return a fall with v' = -g + k v^2: z = -ln cosh(g t/v_t)/k, v_t = sqrt(g/k)."""
    drag = 0.02  # terminal speed 22 m/s

    def reference(times: Array) -> Array:
        height = -np.log(np.cosh(np.sqrt(G * drag) * times)) / drag
        return np.outer(height, [0, 0, 1])

    return AirTask('fall', 'Fall with quadratic drag', reference, drag=drag)


def rolling_hover() -> AirTask:
    """Return a hover whose vehicle rolls: x'' = g (0, -sin p t, cos p t - 1)."""
    spin = 3.0

    def reference(times: Array) -> Array:
        angle, scale = spin * times, G / spin**2
        return np.c_[
            0 * times, -scale * (angle - np.sin(angle)),
            scale * (1 - np.cos(angle)) - G * times**2 / 2,
        ]  # fmt: skip

    return AirTask('rolling_hover', 'Hover thrust while rolling', reference, spin=spin, thrust=G)


def forward_flight() -> AirTask:
    """Return a flight at a held tilt: linear drag in the rotor plane, none along the thrust."""
    tilt, drag = 0.3, 0.6  # drag: about five times that of an x500, for its effect to count
    thrust = G / np.cos(tilt)

    def reference(times: Array) -> Array:
        in_plane, normal = G * np.sin(tilt), thrust - G * np.cos(tilt)
        along = in_plane / drag * (times + np.expm1(-drag * times) / drag)
        across = normal * times**2 / 2
        axes = np.array([[np.cos(tilt), 0, -np.sin(tilt)], [np.sin(tilt), 0, np.cos(tilt)]])
        return np.c_[along, across] @ axes

    return AirTask(
        'forward_flight', 'Forward flight with rotor drag', reference,
        tilt=tilt, thrust=thrust, rotor_drag=drag,
    )  # fmt: skip


TASKS = (fall, rolling_hover, forward_flight)


def air_rates(task: AirTask) -> Callable[[float, Array], Array]:
    """Return y' of a plain six-degree-of-freedom model: position, quaternion, velocity, rates."""
    inertia = np.array(INERTIA)
    out = np.empty(13)

    def rates(_time: float, y: Array) -> Array:
        rotation = matrix(y[3:7])
        v, w = y[7:10], y[10:13]
        body = rotation.T @ v
        force = np.array([-task.rotor_drag * body[0], -task.rotor_drag * body[1], task.thrust])
        out[:3] = v
        out[3:7] = quaternion_rate(y[3:7], w)
        out[7:10] = rotation @ force - task.drag * np.sqrt(v @ v) * v
        out[9] -= G
        out[10:] = turning(inertia, w)
        return out.copy()

    return rates


def matrix(quaternion: Array) -> Array:
    """Return the rotation body -> world of a quaternion wxyz of about unit length."""
    w, x, y, z = quaternion.tolist()
    n = 2 / (w * w + x * x + y * y + z * z)
    return np.array([
        [1 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y)],
        [n * (x * y + w * z), 1 - n * (x * x + z * z), n * (y * z - w * x)],
        [n * (x * z - w * y), n * (y * z + w * x), 1 - n * (x * x + y * y)],
    ])  # fmt: skip


def quaternion_rate(quaternion: Array, omega: Array) -> tuple[float, ...]:
    """Return the rate of a quaternion wxyz under a body rate [rad/s]."""
    w, x, y, z = quaternion.tolist()
    p, q, r = (0.5 * omega).tolist()
    return (
        -x * p - y * q - z * r, w * p + y * r - z * q,
        w * q + z * p - x * r, w * r + x * q - y * p,
    )  # fmt: skip


def turning(inertia: Array, w: Array) -> Array:
    """Return w' of a body without torque, principal axes."""
    (a, b, c), (p, q, r) = inertia.tolist(), w.tolist()
    return np.array([(b - c) * q * r / a, (c - a) * r * p / b, (a - b) * p * q / c])


def air_start(task: AirTask) -> Array:
    """Return the state of `air_rates` at time 0."""
    half = task.tilt / 2
    return np.r_[0, 0, 0, np.cos(half), 0, np.sin(half), 0, 0, 0, 0, task.spin, 0, 0]


def scipy_runs(
    start: Array,
    rates: Callable[[float, Array], Array],
    reference: Array,
    tolerances: Iterable[float],
) -> list[Run]:
    """Return runs by ``solve_ivp`` over the whole task, per method and relative tolerance."""

    def prepare(method: str, tolerance: float) -> Callable[[], Callable[[], Array]]:
        options: dict[str, Any] = {'method': method, 'rtol': tolerance, 'atol': 1e-3 * tolerance}

        def simulate() -> Array:
            solved = solve_ivp(rates, (0, TIMES[-1]), start, t_eval=TIMES, **options)
            positions: Array = solved.y[:3].T
            return positions

        return lambda: simulate

    return [
        Run(f'SciPy {method}', f'rtol {tolerance:g}', prepare(method, tolerance), reference)
        for method in ('RK45', 'DOP853')
        for tolerance in tolerances
    ]
