# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Coloured noise on a fixed tick: linear filters of white noise, discretised exactly.

x' = A x + b n(t) with white noise n of unit intensity. Sampled every h seconds,
x+ = exp(A h) x + root N with standard normal N and root root' = Q(h), it has exactly the
covariance of the continuous process. Between the ticks a cubic gives a value with an exact
derivative.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm, solve_continuous_lyapunov

from fluid_sim_ros.physics.arrays import Array


@dataclass(frozen=True)
class NoiseFilter:
    """
    One filter and what it adds to the outputs.

    Attributes
    ----------
    a, b
        Of x' = A x + b n, shapes (n, n) and (n,) [1/s], [s^-1/2].
    outputs
        Output index -> weights of x, shape (n,).

    """

    a: Array
    b: Array
    outputs: dict[int, Array]


def stationary_covariance(a: ArrayLike, b: ArrayLike) -> Array:
    """
    Return the covariance of a filter that has run for long: P of A P + P A' + b b' = 0.

    Parameters
    ----------
    a, b
        Of x' = A x + b n, shapes (n, n) and (n,) [1/s], [s^-1/2]; A with eigenvalues of negative
        real part.

    Returns
    -------
    P, shape (n, n).

    """
    drift, noise = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    covariance: Array = solve_continuous_lyapunov(drift, -np.outer(noise, noise))
    return covariance


def discretise(a: ArrayLike, b: ArrayLike, tick: float) -> tuple[Array, Array]:
    """
    Return exp(A h) and the covariance Q(h) of what the noise brings in one tick.

    Van Loan (1978), IEEE Trans. Automatic Control 23:395: both stand in the exponential of
    [[-A, b b'], [0, A']] h.

    Parameters
    ----------
    a, b
        Of x' = A x + b n, shapes (n, n) and (n,) [1/s], [s^-1/2].
    tick
        h [s].

    Returns
    -------
    phi, covariance
        exp(A h) and Q(h), shape (n, n) each.

    """
    drift, noise = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    n = len(noise)
    block = np.zeros((2 * n, 2 * n))
    block[:n, :n], block[:n, n:], block[n:, n:] = -drift, np.outer(noise, noise), drift.T
    exponential = expm(block * tick)
    phi: Array = exponential[n:, n:].T
    return phi, phi @ exponential[:n, n:]


def normal_numbers(seed: int, stream: int, ticks: int, count: int) -> Array:
    """
    Return the standard normal numbers of the first ticks.

    Counter-based: Philox4x64-10 (Salmon et al. 2011) with the key (seed, stream), the counter
    running on through the ticks in blocks of four words, and Box and Muller's transform.

    Parameters
    ----------
    seed, stream
        The key: two whole numbers from 0 to 2^64 - 1.
    ticks
        How many ticks, from tick 0 on.
    count
        How many numbers each tick has.

    Returns
    -------
    [-], shape (ticks, count).

    """
    blocks = -(-count // 4)
    # numpy's generator advances its counter before the first block: start one before 0
    start = np.full(4, 2**64 - 1, dtype=np.uint64)
    generator = np.random.Philox(key=np.array([seed, stream], dtype=np.uint64), counter=start)
    words = generator.random_raw(4 * blocks * ticks).reshape(ticks, blocks, 2, 2)
    uniform = ((words >> np.uint64(11)) + np.uint64(1)) * 2.0**-53
    radius, angle = np.sqrt(-2 * np.log(uniform[..., 0])), 2 * np.pi * uniform[..., 1]
    normal = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    numbers: Array = normal.reshape(ticks, 4 * blocks)[:, :count]
    return numbers


def noise_stream(name: str) -> int:
    """
    Return the key of a vehicle's noise: the 64-bit FNV-1a hash of its name.

    So the gusts of one vehicle do not depend on which others there are. Fowler, Noll and Vo.

    Parameters
    ----------
    name
        Name of the vehicle.

    Returns
    -------
    A whole number from 0 to 2^64 - 1.

    """
    value = 0xCBF29CE484222325
    for byte in name.encode():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


def noise_samples(
    filters: Sequence[NoiseFilter], outputs: int, tick: float, seed: int, stream: int, ticks: int
) -> Array:
    """
    Return the outputs at the ticks -1, 0, 1, ...

    The sample at tick -1 is drawn from the stationary distribution.

    Parameters
    ----------
    filters
        What drives which output.
    outputs
        How many outputs there are.
    tick
        [s].
    seed, stream
        The key of the random numbers, see `normal_numbers`.
    ticks
        How many samples.

    Returns
    -------
    In the unit of the filters' weights, shape (ticks, outputs).

    """
    states = sum(len(f.b) for f in filters)
    normal = normal_numbers(seed, stream, ticks, states)
    samples = np.zeros((ticks, outputs))
    first = 0
    for f in filters:
        n = len(f.b)
        phi, covariance = discretise(f.a, f.b, tick)
        root = np.linalg.cholesky(covariance)
        kicks = normal[:, first : first + n] @ root.T
        x = np.linalg.cholesky(stationary_covariance(f.a, f.b)) @ normal[0, first : first + n]
        states_x = np.empty((ticks, n))
        states_x[0] = x
        for k in range(1, ticks):
            states_x[k] = x = phi @ x + kicks[k]
        for output, weights in f.outputs.items():
            samples[:, output] += states_x @ weights
        first += n
    return samples


def between_ticks(samples: ArrayLike, tick: float, time: float) -> tuple[Array, Array]:
    """
    Return value and derivative at a time >= 0 from the samples at the ticks -1, 0, 1, ...

    Catmull-Rom: the cubic whose slopes at both ends are (next - previous) / 2 h. The derivative is
    continuous. Fourth-order methods keep their order where steps begin at ticks.

    Parameters
    ----------
    samples
        At the ticks -1, 0, 1, ..., shape (ticks, outputs).
    tick
        h [s].
    time
        [s], at least 0; two samples must follow its tick.

    Returns
    -------
    value, rate
        In the unit of the samples, and that per second, shape (outputs,) each.

    """
    held = np.asarray(samples, dtype=np.float64)
    k = int(np.floor(time / tick))
    s = time / tick - k
    p0, p1, p2, p3 = held[k : k + 4]
    m1, m2 = (p2 - p0) / 2, (p3 - p1) / 2
    c2, c3 = 3 * (p2 - p1) - 2 * m1 - m2, 2 * (p1 - p2) + m1 + m2
    value: Array = p1 + s * (m1 + s * (c2 + s * c3))
    rate: Array = (m1 + s * (2 * c2 + 3 * s * c3)) / tick
    return value, rate
