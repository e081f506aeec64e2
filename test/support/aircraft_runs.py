# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The simulated Aerosonde as aircraft_equations describes it: trim, modes, flight."""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import fsolve

from fluid_sim_ros import Simulation
from fluid_sim_ros.physics.electric_motor import AEROSONDE_MOTOR
from fluid_sim_ros.plugins.native import THRUSTER_VALUES, native
from test.support.aircraft_equations import wind_axes

Array = NDArray[np.float64]

NAME = 'aerosonde'
FLIP = np.array([1.0, -1.0, -1.0])  # FRD to FLU and back
_PROPELLER = {
    'torque_coefficients': (0.00523, 0.00497, -0.01664), 'diameter': 0.508, 'density': 1.2682,
}  # fmt: skip


class Aircraft:
    """The scene without its events, set and read in the book's variables (FRD, Euler angles)."""

    def __init__(self) -> None:
        self.simulation = Simulation(NAME)
        self.simulation.enable_wind(False)
        self.model, self.data = self.simulation.model, self.simulation.data
        highest = self.simulation.vehicles[NAME].thrust_range[0, 1]
        limit = self._read(highest)['rad_s']
        self._thrust_per_square = highest / limit**2  # [N/(rad/s)^2] at rest

    def _read(self, thrust: float) -> dict[str, float]:
        """Return THRUSTER_VALUES of the propeller at a command [N]."""
        self.data.ctrl[0] = thrust
        mujoco.mj_forward(self.model, self.data)
        out = np.zeros(len(THRUSTER_VALUES))
        native().thruster(self.model._address, self.data._address, 0, out.ctypes.data)
        return dict(zip(THRUSTER_VALUES, out.tolist(), strict=True))

    def place(self, state: Array, surfaces: Sequence[float], speed: float) -> None:
        """Set state, deflections (elevator, aileron, rudder) and propeller speed [rad/s]."""
        data, (elevator, aileron, rudder) = self.data, surfaces
        v, w, (phi, theta, psi) = FLIP * state[:3], FLIP * state[3:6], state[6:9]
        mujoco.mju_euler2Quat(data.qpos[3:7], np.array([-psi, -theta, phi]), 'zyx')
        mujoco.mju_rotVecQuat(data.qvel[:3], v, data.qpos[3:7])
        data.qvel[3:6] = w
        # the drawn surfaces where they are at rest
        data.qpos[7:] = (aileron, -aileron, elevator - rudder, elevator + rudder)
        data.qvel[6:] = 0.0
        data.ctrl[:] = (self._thrust_per_square * speed**2, 0, aileron, elevator, rudder)

    def rates(self, state: Array, surfaces: Sequence[float], speed: float) -> Array:
        """Return the derivative of u, v, w, p, q, r as the simulation has it."""
        self.place(state, surfaces, speed)
        mujoco.mj_forward(self.model, self.data)
        inverse, linear = np.zeros(4), np.zeros(3)
        mujoco.mju_negQuat(inverse, self.data.qpos[3:7])
        mujoco.mju_rotVecQuat(linear, self.data.qacc[:3], inverse)
        # of the velocity's components in turning axes
        linear -= np.cross(self.data.qvel[3:6], FLIP * state[:3])
        return np.r_[FLIP * linear, FLIP * self.data.qacc[3:6]]

    def trim(self, airspeed: float) -> dict[str, float]:
        """Return steady level flight with level wings: where the simulation's qacc vanishes."""

        def unbalanced(x: Array) -> Array:
            return self.rates(*_steady(airspeed, x))

        # from a throttle at which the propeller is below its limit, beyond which nothing changes
        x = fsolve(unbalanced, [0.05, 0, -0.1, 0, 0, 0.9], xtol=1e-12)
        names = ('alpha', 'beta', 'elevator', 'aileron', 'rudder', 'throttle')
        found = dict(zip(names, (float(value) for value in x), strict=True))
        self.rates(*_steady(airspeed, x))
        reading = self._read(float(self.data.ctrl[0]))
        # once more from the shaft torque that the plugin reports
        found['throttle_by_torque'] = AEROSONDE_MOTOR.throttle(reading['rad_s'], reading['torque'])
        return {**found, 'speed': reading['rad_s']}

    def modes(self, airspeed: float) -> Array:
        """Return the eigenvalues [1/s] of free motion about the trim, propeller speed held."""
        found = self.trim(airspeed)
        alpha, beta = found['alpha'], found['beta']
        u, v, w = wind_axes(airspeed, alpha, beta)
        state = np.array([u, v, w, 0, 0, 0, 0, np.arctan2(w, u), 0])
        surfaces = (found['elevator'], found['aileron'], found['rudder'])
        matrix = np.zeros((8, 8))
        for i in range(8):
            step = 1e-5 * np.eye(9)[i]
            ahead, behind = (
                self.rates(state + s, surfaces, found['speed']) for s in (step, -step)
            )
            matrix[:6, i] = (ahead - behind) / 2e-5
        # of the angles, about level wings without a turn: phi' = p + r tan(theta), theta' = q
        matrix[6, [3, 5]] = 1.0, np.tan(state[7])
        matrix[7, 4] = 1.0
        eigenvalues: Array = np.linalg.eigvals(matrix)
        return eigenvalues

    def flight(
        self, start: Array, surfaces: Sequence[float], speed: float, seconds: float, every: int
    ) -> tuple[Array, Array]:
        """Return times [s] and rows of u v w p q r under a constant input."""
        self.simulation.reset()
        self.simulation.enable_wind(False)
        self.place(start, surfaces, speed)
        times, rows = [], []
        for _ in range(round(seconds / self.simulation.timestep / every)):
            self.simulation.step(every)
            state = self.simulation.snapshot().vehicles[NAME]
            times.append(self.simulation.time)
            rows.append(np.r_[FLIP * state.velocity_b, FLIP * state.omega_b])
        return np.array(times), np.array(rows)


def _steady(airspeed: float, x: Array) -> tuple[Array, tuple[float, ...], float]:
    alpha, beta, elevator, aileron, rudder, throttle = x
    u, v, w = wind_axes(airspeed, alpha, beta)
    state = np.array([u, v, w, 0, 0, 0, 0, np.arctan2(w, u), 0])
    return state, (elevator, aileron, rudder), AEROSONDE_MOTOR.speed(throttle, u, **_PROPELLER)
