# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The vehicles' equations of motion, written down once more, and solved by SciPy.

Numbers as in models/*.xml, from the same sources, but by hand: nothing here reads a model. Body
axes FLU, origin in the centre of mass, SI units. Fossen (2021): with M = m + A and J = I + A_r,

    M v' = f - w x (M v)        J w' = t - w x (J w) - v x (A v)

Rotors: T = k W|W|, W' = (command - W)/tau, reaction -s c T about the axis, drag -|W| (k_d v_across
+ k_z v_along). Airframe of a multirotor: MuJoCo's inertia box (its documentation, Computation,
fluid forces).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

Array = NDArray[np.float64]
G = 9.81  # [m/s^2]


@dataclass(frozen=True)
class Rotors:
    """
    Rotors of one kind.

    ``position`` [m] from the centre of mass and unit ``axis``, shape (n, 3); ``spin`` +1 counter-
    clockwise; ``k`` forward and reverse [N/(rad/s)^2]; ``tau`` up and down [s]; ``torque_ratio``
    [m]; ``drag`` across and along [N/((rad/s)(m/s))].
    """

    position: Array
    axis: Array
    spin: Array
    k: tuple[float, float]
    tau: tuple[float, float]
    torque_ratio: float = 0.0
    drag: tuple[float, float] = (0.0, 0.0)

    def speed(self, thrust: ArrayLike) -> Array:
        """Return the speeds [rad/s] that give thrusts [N] at rest."""
        f = np.asarray(thrust, dtype=float)
        speed: Array = np.sign(f) * np.sqrt(np.abs(f) / np.where(f < 0, self.k[1], self.k[0]))
        return speed

    def thrust(self, speed: Array) -> Array:
        """Return the thrusts [N] at rest."""
        thrust: Array = np.where(speed < 0, self.k[1], self.k[0]) * speed * np.abs(speed)
        return thrust


@dataclass(frozen=True)
class Equations:
    """
    A free vehicle: mass [kg], moments of inertia [kg m^2], what the fluid does, its rotors.

    ``added``, ``linear``, ``quadratic``: surge, sway, heave, roll, pitch, yaw. ``buoyancy`` [N] at
    ``center_of_buoyancy``. ``box``: half sides of the inertia box [m] with its ``density`` and
    ``viscosity``. ``origin``: of base_link from the centre of mass [m].
    """

    mass: float
    inertia: Array
    rotors: Rotors
    added: Array = field(default_factory=lambda: np.zeros(6))
    linear: Array = field(default_factory=lambda: np.zeros(6))
    quadratic: Array = field(default_factory=lambda: np.zeros(6))
    buoyancy: float = 0.0
    center_of_buoyancy: Array = field(default_factory=lambda: np.zeros(3))
    box: Array | None = None
    density: float = 0.0
    viscosity: float = 0.0
    origin: Array = field(default_factory=lambda: np.zeros(3))

    def acceleration(self, quat: Array, v: Array, w: Array, speed: Array) -> tuple[Array, Array]:
        """Return v' and w' in body axes; ``speed`` of the rotors [rad/s]."""
        up = rotation(quat)[2]
        force = (self.buoyancy - self.mass * G) * up
        torque = np.cross(self.center_of_buoyancy, self.buoyancy * up)
        nu = np.r_[v, w]
        damping = -(self.linear + self.quadratic * np.abs(nu)) * nu
        force, torque = force + damping[:3], torque + damping[3:]
        for wrench in (self._airframe(v, w), self._rotors(v, w, speed)):
            force, torque = force + wrench[:3], torque + wrench[3:]
        mass, inertia = self.mass + self.added[:3], self.inertia + self.added[3:]
        linear = (force - np.cross(w, mass * v)) / mass
        turning = np.cross(w, inertia * w) + np.cross(v, self.added[:3] * v)
        return linear, (torque - turning) / inertia

    def _airframe(self, v: Array, w: Array) -> Array:
        if self.box is None:
            return np.zeros(6)
        r, rho, beta = self.box, self.density, self.viscosity
        sides = np.array([r[1] * r[2], r[2] * r[0], r[0] * r[1]])
        fourth = np.sum(r**4) - r**4
        mean = r.mean()
        force = -2 * rho * sides * np.abs(v) * v - 6 * beta * np.pi * mean * v
        torque = -0.5 * rho * r * fourth * np.abs(w) * w - 8 * beta * np.pi * mean**3 * w
        return np.r_[force, torque]

    def _rotors(self, v: Array, w: Array, speed: Array) -> Array:
        rotors = self.rotors
        thrust = rotors.thrust(speed)[:, np.newaxis] * rotors.axis
        flow = v + np.cross(w, rotors.position)
        along = np.sum(flow * rotors.axis, axis=1, keepdims=True) * rotors.axis
        across_k, along_k = rotors.drag
        drag = -np.abs(speed)[:, np.newaxis] * (across_k * (flow - along) + along_k * along)
        forces = thrust + drag
        reaction = -rotors.torque_ratio * rotors.spin[:, np.newaxis] * thrust
        torque = np.cross(rotors.position, forces) + reaction
        return np.r_[forces.sum(axis=0), torque.sum(axis=0)]

    def flight(
        self,
        times: Array,
        command: ArrayLike,
        *,
        v: ArrayLike = (0, 0, 0),
        w: ArrayLike = (0, 0, 0),
        thrust: ArrayLike = 0.0,
    ) -> Array:
        """
        Return velocity of the base_link origin and angular velocity, body axes, shape (n, 6).

        From level, under a constant ``command`` [N per rotor]; ``v``, ``w``, ``thrust``: at the
        start, of the centre of mass.
        """
        target = self.rotors.speed(command)
        up, down = self.rotors.tau
        start = np.r_[1, 0, 0, 0, v, w, self.rotors.speed(np.broadcast_to(thrust, target.shape))]

        def rates(_: float, y: Array) -> Array:
            quat, v, w, speed = y[:4] / np.linalg.norm(y[:4]), y[4:7], y[7:10], y[10:]
            tau = np.where(np.abs(target) > np.abs(speed), up, down)
            return np.r_[
                0.5 * quat_rate(quat, w), *self.acceleration(quat, v, w, speed),
                (target - speed) / tau,
            ]  # fmt: skip

        solved = solve_ivp(rates, (0, times[-1]), start, t_eval=times, rtol=1e-9, atol=1e-10)
        v, w = solved.y[4:7].T, solved.y[7:10].T
        return np.c_[v + np.cross(w, self.origin), w]

    def top_velocity(self, command: ArrayLike) -> Array:
        """Return the steady velocity [m/s] under a command [N], held level, body axes."""
        speed, level = self.rotors.speed(command), np.array([1.0, 0, 0, 0])

        def rest(along: float, axis: int) -> float:  # held level, no axis acts on another
            v = along * np.eye(3)[axis]
            return float(self.acceleration(level, v, np.zeros(3), speed)[0][axis])

        return np.array([brentq(rest, -9, 9, args=(axis,), xtol=1e-12) for axis in range(3)])

    def level_flight(self, tilt: float) -> tuple[float, float]:
        """Return thrust per rotor [N] and speed [m/s] of steady level flight at a tilt [rad]."""
        quat = np.array([np.cos(tilt / 2), 0, np.sin(tilt / 2), 0])
        frame = rotation(quat)

        def unbalanced(x: Array) -> Array:
            speed = np.full(len(self.rotors.axis), self.rotors.speed(x[0]))
            v = frame.T @ np.array([x[1], 0, 0])
            rest = frame @ self.acceleration(quat, v, np.zeros(3), speed)[0]
            return rest[[0, 2]]

        hover = self.mass * G / len(self.rotors.axis)
        thrust, speed = fsolve(unbalanced, [hover, 5.0], xtol=1e-12)
        return float(thrust), float(speed)


def rotation(quat: Array) -> Array:
    """Return the matrix from body to world axes of a quaternion wxyz."""
    a, b, c, d = quat
    return np.array([
        [a*a + b*b - c*c - d*d, 2 * (b*c - a*d), 2 * (b*d + a*c)],
        [2 * (b*c + a*d), a*a - b*b + c*c - d*d, 2 * (c*d - a*b)],
        [2 * (b*d - a*c), 2 * (c*d + a*b), a*a - b*b - c*c + d*d],
    ])  # fmt: skip


def quat_rate(quat: Array, w: Array) -> Array:
    """Return twice the rate of a quaternion wxyz under a body rate [rad/s]."""
    real, vector = quat[0], quat[1:]
    return np.r_[-vector @ w, real * w + np.cross(vector, w)]


def _array(rows: Sequence[Sequence[float]]) -> Array:
    return np.array(rows, dtype=float)


def _directions(rows: Sequence[Sequence[float]]) -> Array:
    array = _array(rows)
    unit: Array = array / np.linalg.norm(array, axis=1, keepdims=True)
    return unit


#: T = k W|W| of the T200, from thrust [N] and speed [rpm] of full command at 16 V.
T200_K = (51.4 / (3533 * np.pi / 30) ** 2, 39.9 / (3465 * np.pi / 30) ** 2)
VECTORED = [[-1, -1, 0], [-1, 1, 0], [1, -1, 0], [1, 1, 0]]

HEAVY = Equations(
    mass=13.5, inertia=np.array([0.26, 0.23, 0.37]),
    added=np.array([6.36, 7.12, 18.68, 0.189, 0.135, 0.222]),
    linear=np.array([13.7, 0, 33, 0, 0.8, 0]),
    quadratic=np.array([141, 217, 190, 1.19, 0.47, 1.5]),
    buoyancy=1000 * 0.0134 * G, center_of_buoyancy=np.array([0, 0, 0.01]),
    rotors=Rotors(
        position=_array([
            [0.156, -0.111, -0.085], [0.156, 0.111, -0.085], [-0.156, -0.111, -0.085],
            [-0.156, 0.111, -0.085], [0.12, -0.218, 0], [0.12, 0.218, 0], [-0.12, -0.218, 0],
            [-0.12, 0.218, 0],
        ]),
        axis=_directions([*VECTORED, *[[0, 0, -1]] * 4]),
        spin=np.ones(8), k=T200_K, tau=(0.029, 0.029),
    ),
)  # fmt: skip
BLUEROV2 = Equations(
    mass=11.4, inertia=np.array([0.21, 0.245, 0.245]),
    added=np.array([2.6, 18.5, 13.3, 0.054, 0.0173, 0.28]),
    linear=np.array([0.09, 0.26, 0.19, 0.895, 0.287, 4.64]),
    quadratic=np.array([34.96, 103.25, 74.23, 0.084, 0.028, 0.43]),
    buoyancy=1000 * 0.0115 * G, center_of_buoyancy=np.array([0, 0, 0.1]),
    rotors=Rotors(
        position=_array([
            [0.14, -0.092, -0.011], [0.14, 0.092, -0.011], [-0.15, -0.092, -0.011],
            [-0.15, 0.092, -0.011], [0, -0.109, 0.066], [0, 0.109, 0.066],
        ]),
        axis=_directions([*VECTORED, *[[0, 0, -1]] * 2]),
        spin=np.ones(6), k=T200_K, tau=(0.029, 0.029),
    ),
)  # fmt: skip


def _box(mass: float, inertia: Array) -> Array:
    """Return the half sides [m] of a box with a mass and moments of inertia."""
    half: Array = np.sqrt(1.5 / mass * (inertia.sum() - 2 * inertia))
    return half


# base of 2 kg and four rotors of .01608 kg, .06 m up: centre of mass, moments about it
_X500_MASS, _ROTOR = 2 + 4 * 0.01608, 0.01608
_X500_UP = 4 * _ROTOR * 0.06 / _X500_MASS
_X500_INERTIA = np.array([
    0.021667 + 4 * _ROTOR * (0.174**2 + 0.06**2) - _X500_MASS * _X500_UP**2,
    0.021667 + 4 * _ROTOR * (0.174**2 + 0.06**2) - _X500_MASS * _X500_UP**2,
    0.04 + 4 * _ROTOR * 2 * 0.174**2,
])  # fmt: skip
X500 = Equations(
    mass=_X500_MASS, inertia=_X500_INERTIA, origin=np.array([0, 0, -_X500_UP]),
    box=_box(_X500_MASS, _X500_INERTIA), density=1.225, viscosity=1.79e-5,
    rotors=Rotors(
        position=_array([
            [0.174, -0.174, 0.06 - _X500_UP], [-0.174, 0.174, 0.06 - _X500_UP],
            [0.174, 0.174, 0.06 - _X500_UP], [-0.174, -0.174, 0.06 - _X500_UP],
        ]),
        axis=_array([[0, 0, 1]] * 4), spin=np.array([1.0, 1, -1, -1]),
        k=(8.54858e-6, 8.54858e-6), tau=(0.0125, 0.025), torque_ratio=0.016,
        drag=(8.06428e-5, 0),
    ),
)  # fmt: skip
_CF_K = 3.16e-10 / (np.pi / 30) ** 2
CRAZYFLIE = Equations(
    mass=0.027, inertia=np.array([1.4e-5, 1.4e-5, 2.17e-5]),
    rotors=Rotors(
        position=_array([
            [0.028, -0.028, 0], [-0.028, -0.028, 0], [-0.028, 0.028, 0], [0.028, 0.028, 0],
        ]),
        axis=_array([[0, 0, 1]] * 4), spin=np.array([1.0, -1, 1, -1]),
        k=(_CF_K, _CF_K), tau=(0.072, 0.072), torque_ratio=7.94e-12 / 3.16e-10,
        drag=(9.1785e-7, 1.0311e-6),
    ),
)  # fmt: skip
EQUATIONS = {
    'bluerov2_heavy': HEAVY, 'bluerov2': BLUEROV2, 'x500': X500, 'crazyflie': CRAZYFLIE,
}  # fmt: skip
