# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
RotorPy at the tasks in air.

``Multirotor.step`` calls ``scipy.integrate.solve_ivp`` anew for each timestep, so the timestep
bounds the adaptive one from above; the solver and its tolerances are the constructor's
``integrator_kwargs``. The rotors spin at constant speed; in the fall they stand.
"""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from rotorpy.vehicles.hummingbird_params import quad_params
from rotorpy.vehicles.multirotor import Multirotor

from benchmarks.peers.peer_tasks import (
    INERTIA,
    MASS,
    SAMPLE,
    TIMES,
    AirTask,
    Array,
    Run,
    milliseconds,
)

_K = quad_params['k_eta']  # [N/(rad/s)^2]
SOLVERS: dict[str, dict[str, Any]] = {
    'RotorPy default': {'method': 'RK45'},
    'RotorPy DOP853': {'method': 'DOP853', 'rtol': 1e-10, 'atol': 1e-12},
}


def parameters(task: AirTask, speed: float) -> dict[str, Any]:
    """Return a quadrotor with the task's forces at a rotor speed [rad/s]."""
    ixx, iyy, izz = INERTIA
    body = MASS * task.drag
    return quad_params | {
        'mass': MASS, 'Ixx': ixx, 'Iyy': iyy, 'Izz': izz,
        'c_Dx': body, 'c_Dy': body, 'c_Dz': body,
        'k_d': MASS * task.rotor_drag / (4 * speed) if speed else 0.0,
        'k_z': 0.0, 'k_h': 0.0, 'k_flap': 0.0,
        'rotor_speed_min': 0.0, 'rotor_speed_max': 2 * speed + 1, 'motor_noise_std': 0.0,
    }  # fmt: skip


def rotorpy_runs(task: AirTask, timesteps: Iterable[float]) -> list[Run]:
    """Return runs by ``Multirotor.step``, one call a timestep."""
    reference = task.reference(TIMES)
    speed = float(np.sqrt(MASS * task.thrust / 4 / _K))
    half = task.tilt / 2
    first = {
        'x': np.zeros(3), 'v': np.zeros(3), 'q': np.array([0, np.sin(half), 0, np.cos(half)]),
        'w': np.array([task.spin, 0, 0]), 'wind': np.zeros(3), 'rotor_speeds': np.full(4, speed),
    }  # fmt: skip
    command = {'cmd_motor_speeds': np.full(4, speed)}

    def prepare(solver: dict[str, Any], timestep: float) -> Callable[[], Callable[[], Array]]:
        vehicle = Multirotor(parameters(task, speed), integrator_kwargs=solver)

        def simulate() -> Array:
            state, out = first, np.empty((len(TIMES), 3))
            for row in out:
                for _ in range(round(SAMPLE / timestep)):
                    state = vehicle.step(state, command, timestep)
                row[:] = state['x']
            return out

        return lambda: simulate

    return [
        Run(name, milliseconds(h), prepare(solver, h), reference)
        for name, solver in SOLVERS.items()
        for h in timesteps
    ]
