# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Carries a state along rates and specific force, corrects it by poses, and smooths it backwards.

An error-state Kalman filter (Sola 2017, Quaternion kinematics for the error-state Kalman filter,
ch. 5) and the smoother of Rauch, Tung and Striebel (1965).
"""

from typing import TYPE_CHECKING

import numpy as np

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

#: Errors: position, velocity, turn, biases of accelerometer and gyro, turn of the followed axes,
#: place of the followed point.
_P, _V, _T, _A, _G, _M, _R = (slice(3 * i, 3 * i + 3) for i in range(7))
_SIZE = 21
#: What is not known of them at the begin: [m], [m/s], [rad], [m/s^2], [rad/s], [rad], [m].
_FIRST = np.repeat([0.05, 0.3, 0.05, 0.3, 0.05, 0.05, 0.03], 3)
#: The filter takes steps of about this length [s]: faster samples are averaged.
_STEP = 0.008
#: Biases walk by so much in the square root of a second: [m/s^2], [rad/s].
_WALKS = (1e-3, 1e-3)
#: What shakes faster than this is noise of gyro and accelerometer [s].
_SMOOTH = 0.05
#: Least noise: pose [m], [rad]; [m/s^2], [rad/s]: a log rounds.
_LEAST = (1e-4, 2e-4, 0.02, 2e-3)
#: So many poses are not looked at for surprise: the filter finds its constants first.
_FEW = 25
#: What the state is made of.
NEEDED = ('position', 'attitude', 'rates', 'specific_force')


def rotations_of(matrices: Array) -> 'Rotation':
    """
    Return SciPy's rotations of matrices.

    Parameters
    ----------
    matrices
        Shape (n, 3, 3) or (3, 3).

    """
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(matrices)


def _cross(v: Array) -> Array:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def _turn(v: Array) -> Array:
    """Return the rotation matrix of a rotation vector (Rodrigues)."""
    angle = float(np.sqrt(v @ v))
    k = _cross(v)
    if angle < 1e-6:
        near: Array = np.eye(3) + k + 0.5 * k @ k
        return near
    turned: Array = np.eye(3) + np.sin(angle) / angle * k + (1 - np.cos(angle)) / angle**2 * k @ k
    return turned


def _vector(matrix: Array) -> Array:
    """Return the rotation vector of a small rotation matrix."""
    v = 0.5 * np.array([
        matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]
    ])  # fmt: skip
    sine = float(np.sqrt(v @ v))
    if sine < 1e-9:
        return v
    angle = float(np.arctan2(sine, 0.5 * (np.trace(matrix) - 1.0)))
    return v * (angle / sine)


def _rough(values: Array, width: int) -> float:
    """Return the rms of one axis of what is faster than a running mean."""
    kernel = np.ones(max(3, width)) / max(3, width)
    mean = np.stack([np.convolve(v, kernel, mode='valid') for v in values.T], axis=1)
    cut = (len(values) - len(mean)) // 2
    return float(np.sqrt(((values[cut : cut + len(mean)] - mean) ** 2).mean()))


class Strapdown:
    """
    Filter and smoother over one flight.

    Parameters
    ----------
    flight
        With ``NEEDED``.

    Attributes
    ----------
    times
        [s], shape (n,).
    position, velocity, turn
        State: [m], [m/s], rotation matrices, shape (n, 3), (n, 3), (n, 3, 3).
    constants
        Biases of accelerometer and gyro, turn of the followed axes, place of the followed point:
        [m/s^2], [rad/s], [rad], [m], shape (n, 12).
    cover
        Covariances of the errors, shape (n, 21, 21).
    noise
        Of a step's specific force [m/s^2] and rates [rad/s], shape (2,).
    surprise
        Rms of what poses differ from their forecast by, over what was expected.

    """

    def __init__(self, flight: Flight) -> None:
        signals = flight.signals
        rates, pose, facing = signals['rates'], signals['position'], signals['attitude']
        every = max(1, int(_STEP * rates.rate + 1e-9))
        first = max(signals[name].times[0] for name in NEEDED)
        last = min(signals[name].times[-1] for name in NEEDED)
        inside = (rates.times >= first) & (rates.times <= last)
        fine = rates.times[inside]
        count = (len(fine) - 1) // every
        self.times: Array = fine[: count * every + 1 : every]
        # the mean of a step: of its samples, both ends by half
        weight = np.r_[0.5, np.ones(every - 1), 0.5] / every
        index = np.arange(count)[:, None] * every + np.arange(every + 1)
        self.rates = np.einsum('kij,i->kj', rates.between(fine)[index], weight)
        force = signals['specific_force'].between(fine)
        self.force = np.einsum('kij,i->kj', force[index], weight)
        half = max(3, round(_SMOOTH * rates.rate))
        # noise of a step's mean; what shakes goes with it
        self.noise = np.array([
            max(_LEAST[2], _rough(force, half)), max(_LEAST[3], _rough(rates.values, half))
        ]) * np.sqrt(1.0 / every)  # fmt: skip
        third = [
            np.sqrt((np.diff(s.values, 3, axis=0) ** 2).mean() / 20.0) for s in (pose, facing)
        ]
        self.sigma = np.array([max(_LEAST[0], third[0]), max(_LEAST[1], 2.0 * third[1])])
        self.seen = pose.times
        self.places = pose.values
        self.facing = rotations(_unit(facing.between(pose.times))).as_matrix()
        self.measured_velocity = signals.get('velocity')
        self.surprise = 1.0
        size = len(self.times)
        self.position, self.velocity = np.zeros((size, 3)), np.zeros((size, 3))
        self.turn, self.constants = np.zeros((size, 3, 3)), np.zeros((size, 12))
        self.cover = np.zeros((size, _SIZE, _SIZE))
        self._before = [np.zeros((size, 3)), np.zeros((size, 3)), np.zeros((size, 3, 3)),
                        np.zeros((size, 12)), np.zeros((size, _SIZE, _SIZE))]  # fmt: skip
        self._steps = np.zeros((size, _SIZE, _SIZE))

    def forth(self) -> None:
        """Filter from the begin to the end."""
        near = np.searchsorted(self.times, self.seen, side='right') - 1
        start = max(0, int(np.searchsorted(self.seen, self.times[0])))
        p, v = self.places[start].copy(), np.zeros(3)
        later = min(len(self.seen) - 1, start + 5)
        if later > start:
            v = (self.places[later] - p) / (self.seen[later] - self.seen[start])
        r, c, cover = self.facing[start].copy(), np.zeros(12), np.diag(_FIRST**2)
        surprises: list[Array] = []
        wide = np.median(np.diff(self.times))
        for k in range(len(self.times)):
            if k:
                p, v, r, cover = self._carried(k - 1, p, v, r, c, cover, float(wide))
            for part, value in zip(self._before, (p, v, r, c, cover), strict=True):
                part[k] = value
            first, last = np.searchsorted(near, (k, k + 1))
            for i in range(first, last):
                p, v, r, c, cover, off = self._corrected(k, i, p, v, r, c, cover)
                surprises.append(off)
            self.position[k], self.velocity[k], self.turn[k] = p, v, r
            self.constants[k], self.cover[k] = c, cover
        if len(surprises) > _FEW:
            self.surprise = float(np.sqrt((np.array(surprises[_FEW:]) ** 2).mean()))

    def _carried(
        self, k: int, p: Array, v: Array, r: Array, c: Array, cover: Array, wide: float
    ) -> tuple[Array, Array, Array, Array]:
        h = float(self.times[k + 1] - self.times[k])
        force, rates = self.force[k] - c[:3], self.rates[k] - c[3:6]
        half = r @ _turn(0.5 * h * rates)
        gained = half @ force - np.array([0.0, 0.0, GRAVITY])
        step = np.eye(_SIZE)
        by_turn = -half @ _cross(force)
        step[_P, _V], step[_P, _T], step[_P, _A] = (
            h * np.eye(3),
            0.5 * h * h * by_turn,
            -0.5 * h * h * half,
        )
        step[_V, _T], step[_V, _A] = h * by_turn, -h * half
        step[_T, _T], step[_T, _G] = _turn(-h * rates), -h * np.eye(3)
        self._steps[k] = step
        grown = step @ cover @ step.T
        lost = max(1.0, h / wide)  # a hole in the log
        grown[_V, _V] += np.eye(3) * (self.noise[0] * h) ** 2 * lost
        grown[_T, _T] += np.eye(3) * (self.noise[1] * h) ** 2 * lost
        grown[_A, _A] += np.eye(3) * _WALKS[0] ** 2 * h
        grown[_G, _G] += np.eye(3) * _WALKS[1] ** 2 * h
        return p + h * v + 0.5 * h * h * gained, v + h * gained, r @ _turn(h * rates), grown

    def _corrected(
        self, k: int, i: int, p: Array, v: Array, r: Array, c: Array, cover: Array
    ) -> tuple[Array, Array, Array, Array, Array, Array]:
        late = float(self.seen[i] - self.times[k])
        now = r @ _turn(late * (self.rates[min(k, len(self.rates) - 1)] - c[3:6]))
        mounted = _turn(c[6:9])
        off = np.r_[
            self.places[i] - (p + late * v + now @ c[9:]),
            _vector((now @ mounted).T @ self.facing[i]),
        ]
        seen = np.zeros((6, _SIZE))
        seen[:3, _P], seen[:3, _V] = np.eye(3), late * np.eye(3)
        seen[:3, _T], seen[:3, _R] = -now @ _cross(c[9:]), now
        seen[3:, _T], seen[3:, _M] = mounted.T, np.eye(3)
        noise = np.diag(np.repeat(self.sigma**2, 3))
        expected = seen @ cover @ seen.T + noise
        gain = np.linalg.solve(expected, seen @ cover).T
        by = gain @ off
        rest = np.eye(_SIZE) - gain @ seen
        cover = rest @ cover @ rest.T + gain @ noise @ gain.T
        moved = p + by[_P], v + by[_V], r @ _turn(by[_T]), c + by[9:]
        return *moved, cover, off / np.sqrt(np.diag(expected))

    def back(self) -> None:
        """Smooth from the end to the begin."""
        before_p, before_v, before_r, before_c, before_cover = self._before
        for k in range(len(self.times) - 2, -1, -1):
            gain = np.linalg.solve(before_cover[k + 1], self._steps[k] @ self.cover[k]).T
            by = gain @ np.r_[
                self.position[k + 1] - before_p[k + 1], self.velocity[k + 1] - before_v[k + 1],
                _vector(before_r[k + 1].T @ self.turn[k + 1]),
                self.constants[k + 1] - before_c[k + 1],
            ]  # fmt: skip
            self.position[k] += by[_P]
            self.velocity[k] += by[_V]
            self.turn[k] = self.turn[k] @ _turn(by[_T])
            self.constants[k] += by[9:]
            self.cover[k] += gain @ (self.cover[k + 1] - before_cover[k + 1]) @ gain.T

    def apart(self) -> tuple[float, float | None, float]:
        """Return the rms of measured less smoothed position, velocity and attitude."""
        inside = (self.seen >= self.times[0]) & (self.seen <= self.times[-1])
        seen = self.seen[inside]
        at = np.clip(np.searchsorted(self.times, seen, side='right') - 1, 0, len(self.rates) - 1)
        late = seen - self.times[at]
        middle = self.constants[len(self.times) // 2]
        turned = np.stack([
            self.turn[k] @ _turn(h * (self.rates[k] - self.constants[k, 3:6]))
            for k, h in zip(at, late, strict=True)
        ])  # fmt: skip
        place = self.position[at] + late[:, None] * self.velocity[at] + turned @ middle[9:]
        place_off = float(np.sqrt(((self.places[inside] - place) ** 2).mean()))
        back = np.swapaxes(turned @ _turn(middle[6:9]), 1, 2)
        turn_off = rotations_of(back @ self.facing[inside]).as_rotvec()
        velocity_off = None
        if self.measured_velocity is not None:
            measured = self.measured_velocity.between(self.times)
            velocity_off = float(np.sqrt(((measured - self.velocity) ** 2).mean()))
        return place_off, velocity_off, float(np.sqrt((turn_off**2).mean()))


def _unit(wxyz: Array) -> Array:
    unit: Array = wxyz / np.linalg.norm(wxyz, axis=1, keepdims=True)
    return unit
