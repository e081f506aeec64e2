# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
drone-models at the tasks in air: equations for arrays of vehicles, stepped by RK4 in numpy.

``drone_models.first_principles.dynamics`` in batches of 1 and of 100 vehicles, all alike. Its drag
is linear in body axes; the quadratic drag of the fall is handed in as its disturbance force. The
rates of its quaternions are ours, as its documentation asks; they are made unit after each step.
"""

import os
import warnings
from collections.abc import Callable, Iterable

# drone_models refuses to load after SciPy without it
os.environ.setdefault('SCIPY_ARRAY_API', '1')

import numpy as np
from drone_models.first_principles import dynamics

from benchmarks.peers.peer_tasks import (
    INERTIA,
    MASS,
    SAMPLE,
    TIMES,
    AirTask,
    Array,
    G,
    Run,
    air_start,
    milliseconds,
)

_COUNTS = (1, 100)
_K = 1e-9  # thrust of a rotor per square of its speed [N/rpm^2]; chosen, it cancels
_MIXING = np.array([[-1.0, -1, 1, 1], [-1, 1, 1, -1], [-1, 1, -1, 1]])
State = tuple[Array, Array, Array, Array]  # position, quaternion xyzw, velocity, body rates


def rates_of(task: AirTask, count: int) -> Callable[[State], State]:
    """Return the rates of ``count`` vehicles."""
    parameters = {
        'mass': MASS, 'L': 0.17, 'prop_inertia': 0.0, 'gravity_vec': np.array([0, 0, -G]),
        'J': np.diag(INERTIA), 'J_inv': np.diag(1 / np.array(INERTIA)),
        'rpm2thrust': np.array([0, 0, _K]), 'rpm2torque': np.array([0, 0, 0.016 * _K]),
        'mixing_matrix': _MIXING, 'rotor_dyn_coef': np.ones(4),
        'drag_matrix': -MASS * task.rotor_drag * np.diag([1.0, 1, 0]),
    }  # fmt: skip
    speeds = np.full((count, 4), np.sqrt(MASS * task.thrust / 4 / _K))

    def rates(state: State) -> State:
        velocity = state[2]
        force = None
        if task.drag:
            fast = np.linalg.norm(velocity, axis=1, keepdims=True)
            force = -MASS * task.drag * fast * velocity
        found = dynamics(*state, speeds, dist_f=force, **parameters)
        return found[0], _turning(state[1], state[3]), found[2], found[3]

    return rates


def _turning(quaternion: Array, omega: Array) -> Array:
    """Return the rates of quaternions xyzw: drone_models says not to use its own."""
    vector, scalar = quaternion[:, :3], quaternion[:, 3:]
    along = -(vector * omega).sum(axis=1, keepdims=True)
    return 0.5 * np.hstack([scalar * omega + np.cross(vector, omega), along])


def drone_models_runs(task: AirTask, timesteps: Iterable[float]) -> list[Run]:
    """Return runs by RK4, one call of Python a stage."""
    reference, start = task.reference(TIMES), air_start(task)
    # the rotors follow their command at once, as the task has it
    warnings.filterwarnings('ignore', 'Rotor velocity not provided')

    def prepare(count: int, timestep: float) -> Callable[[], Callable[[], Array]]:
        rates = rates_of(task, count)
        w, x, y, z = start[3:7]
        parts = (start[:3], (x, y, z, w), start[7:10], start[10:])
        first = tuple(np.tile(np.asarray(part, dtype=float), (count, 1)) for part in parts)

        def simulate() -> Array:
            state, out = first, np.empty((len(TIMES), 3))
            for row in out:
                for _ in range(round(SAMPLE / timestep)):
                    state = _step(rates, state, timestep)
                row[:] = state[0][0]
            return out

        return lambda: simulate

    return [
        Run(f'drone-models, {count} at once', milliseconds(h), prepare(count, h), reference, count)
        for count in _COUNTS
        for h in timesteps
    ]


def _step(rates: Callable[[State], State], state: State, h: float) -> State:
    """Return the state after a step of the classical Runge-Kutta scheme."""

    def moved(by: State, time: float) -> State:
        return tuple(part + time * rate for part, rate in zip(state, by, strict=True))

    a = rates(state)
    b = rates(moved(a, h / 2))
    c = rates(moved(b, h / 2))
    d = rates(moved(c, h))
    mean = tuple((p + 2 * q + 2 * r + s) / 6 for p, q, r, s in zip(a, b, c, d, strict=True))
    position, quaternion, velocity, omega = moved(mean, h)
    quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
    return position, quaternion, velocity, omega
