# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hypothesis strategies and small helpers that the physics tests share."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays


def floats(low, high):
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


def vectors(limit=10.0):
    # Below 1e-6 becomes 0: products of denormals are tested on their own, not in every bound.
    elements = floats(-limit, limit).map(lambda x: x if abs(x) > 1e-6 else 0.0)
    return arrays(float, 3, elements=elements)


def axes(low=0.01, high=1.0):
    """Return positive triples, log-uniform so that thin shapes occur often."""
    return arrays(float, 3, elements=floats(np.log(low), np.log(high))).map(np.exp)


def seeds():
    return st.integers(0, 2**32 - 1)


def rotation(seed):
    """Return a proper rotation matrix, uniform over attitudes."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def positive_matrix(seed, size=6):
    """Return a random symmetric positive definite matrix."""
    a = np.random.default_rng(seed).normal(size=(size, size))
    return a @ a.T + 0.1 * np.eye(size)


# A signed permutation keeps an ellipsoid's axes on the coordinate axes: the covariance that
# formulas in principal axes can be asked for.
CYCLE = np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])
FLIPS = [np.diag(s).astype(float) for s in ([1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1])]
