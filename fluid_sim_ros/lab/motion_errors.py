# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How far two motions are apart: norms of the error, sensitivity to the start, regime."""

from typing import Any, NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from fluid_sim_ros.lab.problems.body_watch import OMEGA, POSITION, QUATERNION, VELOCITY
from fluid_sim_ros.lab.problems.problem import Problem, Trajectory, run_rung
from fluid_sim_ros.physics.arrays import Array

#: Added to every velocity at the start to see whether it grows [m/s], [rad/s].
NUDGE = 1e-9
#: A motion counts as chaotic when a nudge grows by e within this share of the run.
LYAPUNOV_SHARE = 0.2
#: A motion is unstable when something moves this many times as fast as it should.
FASTER = 2.0
#: The largest speed of a body counts as at least this share of the largest of all bodies ...
_SHARE = 0.1
#: ... and as at least so much [m/s], [rad/s].
_LEAST_SPEED, _LEAST_RATE = 1e-3, 1e-2
#: A nudge that grows by more than this factor means chaos, however early it grows.
SURE_GROWTH = 1e6


def position_error(states: Array, reference: Array) -> Array:
    """
    Return the distance of the body that is farthest off.

    Parameters
    ----------
    states, reference
        Two motions, world positions in columns 0 to 2 [m], shape (n, bodies, 13).

    Returns
    -------
    Array
        [m], shape (n,).

    """
    return np.asarray(distances(states, reference).max(axis=-1))


def attitude_error(states: Array, reference: Array) -> Array:
    """
    Return the angle between the attitudes of the body that is farthest off.

    Parameters
    ----------
    states, reference
        Two motions, quaternions (w, x, y, z) in columns 3 to 6, shape (n, bodies, 13).

    Returns
    -------
    Array
        [rad], from 0 to pi, shape (n,).

    """
    return np.asarray(angles(states, reference).max(axis=-1))


def distances(states: Array, reference: Array) -> Array:
    """
    Return how far each body is from where it should be.

    Parameters
    ----------
    states, reference
        Two motions, world positions in columns 0 to 2 [m], shape (n, bodies, 13); a reference of
        one time, shape (1, bodies, 13), stands for all.

    Returns
    -------
    Array
        [m], shape (n, bodies).

    """
    return np.asarray(np.linalg.norm(states[..., POSITION] - reference[..., POSITION], axis=-1))


def angles(states: Array, reference: Array) -> Array:
    """
    Return the angle between the attitude that each body has and the one that it should have.

    2 atan2(|q_v|, |q_w|) of q_ref^-1 q: no floor at 1e-8, as the trace of the matrix has.

    Parameters
    ----------
    states, reference
        Two motions, quaternions (w, x, y, z) in columns 3 to 6, shape (n, bodies, 13); a
        reference of one time, shape (1, bodies, 13), stands for all.

    Returns
    -------
    Array
        [rad], from 0 to pi, shape (n, bodies).

    """
    q, r = np.broadcast_arrays(states[..., QUATERNION], reference[..., QUATERNION])
    turn = _rotation(r).inv() * _rotation(q)
    return np.asarray(turn.magnitude().reshape(q.shape[:-1]))


def _rotation(quat_wxyz: Array) -> Rotation:
    return Rotation.from_quat(np.roll(quat_wxyz.reshape(-1, 4), -1, axis=1))


def drift(values: Array) -> Array:
    """
    Return the size of the change of a quantity from its start, relative to its size at the start.

    Parameters
    ----------
    values
        Over time, shape (n,) or (n, k).

    Returns
    -------
    Array
        [-], shape (n,).

    """
    table = values.reshape(len(values), -1)
    size = np.linalg.norm(table[0]) or 1.0
    return np.asarray(np.linalg.norm(table - table[0], axis=1) / size)


def errors(problem: Problem, trajectory: Trajectory, reference: Array) -> dict[str, float]:
    """
    Return every error of a complete run.

    Parameters
    ----------
    problem
        Whose run it is; its invariants are compared with their values at the start.
    trajectory
        The run.
    reference
        States at the same times, shape (n, bodies, 13).

    Returns
    -------
    dict
        ``position_m`` [m], ``attitude_rad`` [rad] and one relative ``<invariant>_drift`` each, at
        the end; with ``_max`` behind the name, the largest over time.

    """
    found = {
        'position_m': position_error(trajectory.states, reference),
        'attitude_rad': attitude_error(trajectory.states, reference),
    }
    if problem.invariants is not None:
        kept = problem.invariants(problem.times, trajectory.states)
        found |= {f'{name}_drift': drift(values) for name, values in kept.items()}
    ends = {name: float(series[-1]) for name, series in found.items()}
    return ends | {f'{name}_max': float(series.max()) for name, series in found.items()}


def runs_away(states: Array, reference: Array) -> bool:
    """
    Return whether a motion is unstable: some body moves or turns far faster than it should.

    An error alone does not tell: that of a tumbling card grows to the size of the motion at a
    timestep at which nothing blows up.

    Parameters
    ----------
    states, reference
        Two motions, shape (n, bodies, 13).

    Returns
    -------
    bool
        Whether a largest speed is above FASTER times that of the reference.

    """
    for part, least in ((VELOCITY, _LEAST_SPEED), (OMEGA, _LEAST_RATE)):
        found, wanted = (
            np.linalg.norm(each[..., part], axis=-1).max(axis=0) for each in (states, reference)
        )
        if np.any(found > FASTER * np.maximum(wanted, max(_SHARE * wanted.max(), least))):
            return True
    return False


class Regime(NamedTuple):
    """The numbers of a chaotic motion that can still be compared."""

    descent: float  # mean vertical speed over the second half [m/s]
    frequency: float  # of the vertical velocity, rms(dv/dt)/(2 pi rms(v)) (Rice 1945) [Hz]


def regime(times: Array, states: Array) -> Regime:
    """
    Return mean descent and frequency of the first vehicle over the second half of a run.

    Parameters
    ----------
    times
        Evenly spaced [s], shape (n,).
    states
        Motion at these times, shape (n, bodies, 13).

    Returns
    -------
    Regime
        Mean descent [m/s] and frequency [Hz].

    """
    half = len(times) // 2
    height = states[half:, 0, POSITION][:, 2]
    step = times[1] - times[0]
    speed = np.diff(height) / step
    wave = speed - speed.mean()
    size = float(np.sqrt(np.mean(wave**2)))
    rate = float(np.sqrt(np.mean((np.diff(wave) / step) ** 2)))
    return Regime(float(speed.mean()), rate / (2 * np.pi * size) if size > 0 else 0.0)


def regime_error(found: Regime, wanted: Regime) -> float:
    """
    Return the larger relative difference of mean descent and frequency.

    Parameters
    ----------
    found, wanted
        Two regimes; the difference is taken relative to the second.

    Returns
    -------
    float
        [-].

    """
    pairs = zip(found, wanted, strict=True)
    return max(abs(a - b) / (abs(b) or 1.0) for a, b in pairs)


class Sensitivity(NamedTuple):
    """How a nudge of the start grows."""

    growth: float  # of the largest deviation over the run, as a factor
    lyapunov_time: float  # time to grow by e from the first to the last quarter [s]
    chaotic: bool

    def as_dict(self) -> dict[str, Any]:
        """Return the fields for JSON."""
        time = self.lyapunov_time
        return {
            'growth_of_1e-9': self.growth,
            'lyapunov_time_s': time if np.isfinite(time) else None,
            'chaotic': self.chaotic,
        }


def sensitivity(
    problem: Problem, integrator: str, timestep: float, plain: Trajectory
) -> Sensitivity:
    """
    Return how a start changed by 1e-9 moves away from ``plain``, on the richest rung.

    Deviations are those of velocity [m/s] and angular velocity [rad/s] together, so that the
    linear growth of a distance does not count. The growth is taken from the first quarter of the
    run to the last, so that a transient at the start does not count either.

    Parameters
    ----------
    problem
        What is run.
    integrator
        By which integrator.
    timestep
        [s].
    plain
        The run of the richest rung by this integrator and timestep, without a nudge.

    Returns
    -------
    Sensitivity
        Growth, time to grow by e, and whether that counts as chaotic.

    """
    nudged = run_rung(problem, problem.rungs[problem.richest], integrator, timestep, NUDGE)
    count = min(len(nudged.states), len(plain.states))
    both = slice(VELOCITY.start, OMEGA.stop)
    apart = np.linalg.norm(
        nudged.states[:count, :, both] - plain.states[:count, :, both], axis=(1, 2)
    )
    if not apart[0] > 0:
        return Sensitivity(1.0, np.inf, False)
    growth = float(apart.max() / apart[0])
    quarter = max(count // 4, 1)
    later = float(apart[-quarter:].max() / apart[:quarter].max())
    time = float(0.75 * problem.duration / np.log(later)) if later > 1 else np.inf
    chaotic = time < LYAPUNOV_SHARE * problem.duration or growth > SURE_GROWTH
    return Sensitivity(growth, time, bool(chaotic))
