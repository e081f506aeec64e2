# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flow on a grid: linear between its points, held beyond its ends, with exact derivatives."""

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.interpolate import RegularGridInterpolator

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.environment.grid import checked_grid, grid_flow
from test.support.strategies import floats, seeds

AXES = ([0.0, 1.0, 4.0], [-2.0, 0.0, 0.5, 3.0], [1.0, 2.0], [-5.0, -1.0, 0.0])
SHAPE = (3, 4, 2, 3)
LOW, HIGH = np.array([[axis[0], axis[-1]] for axis in AXES]).T


def random_grid(seed):
    return checked_grid(AXES, np.random.default_rng(seed).normal(size=(*SHAPE, 3)))


@settings(max_examples=20)
@given(seeds())
def test_values_are_those_of_scipy_inside_and_at_the_nearest_edge_outside(seed):
    grid = random_grid(seed)
    at = np.random.default_rng(seed + 1).uniform(LOW - 1, HIGH + 1, (50, 4))
    oracle = RegularGridInterpolator(grid.axes, grid.velocity)
    flow = grid_flow(grid, at[:, 1:], at[:, 0])
    np.testing.assert_allclose(flow.velocity, oracle(np.clip(at, LOW, HIGH)), atol=1e-12)
    # never beyond the data: no overshoot
    assert np.all(np.abs(flow.velocity) <= np.abs(grid.velocity).max(axis=(0, 1, 2, 3)) + 1e-12)


@settings(max_examples=30)
@given(seeds(), floats(-0.9, 4.9), floats(-2.9, 3.9), floats(0.1, 2.9), floats(-5.9, 0.9))
def test_derivatives_are_those_of_the_interpolant(seed, t, x, y, z):
    grid, h = random_grid(seed), 1e-6
    at = np.array([t, x, y, z])
    for axis, knots in enumerate(AXES):  # one-sided within its cell: keep off the knots
        if np.min(np.abs(np.array(knots) - at[axis])) < 1e-3:
            at[axis] += 5e-3
    flow = grid_flow(grid, at[1:], at[0])
    for axis in range(4):
        step = h * np.eye(4)[axis]
        high, low = (grid_flow(grid, (at + s)[1:], (at + s)[0]).velocity for s in (step, -step))
        found = flow.rate if axis == 0 else flow.gradient[:, axis - 1]
        np.testing.assert_allclose(found, (high - low) / (2 * h), atol=1e-7)


def test_a_linear_flow_is_exact():
    """The stagnation flow (a x, -a y, 0): Du/Dt = a^2 (x, y, 0)."""
    x = np.linspace(-4, 4, 5)
    field = np.zeros((1, 5, 5, 1, 3))
    field[..., 0] = 0.7 * x[:, np.newaxis, np.newaxis]
    field[..., 1] = -0.7 * x[np.newaxis, :, np.newaxis]
    flow = grid_flow(checked_grid(([0.0], x, x, [0.0]), field), [1.3, -2.2, 50.0], 9.0)
    np.testing.assert_allclose(flow.velocity, [0.91, 1.54, 0])
    np.testing.assert_allclose(flow.acceleration, 0.49 * np.array([1.3, -2.2, 0]))


def test_beyond_the_ends_nothing_changes():
    grid = random_grid(1)
    flow = grid_flow(grid, [100.0, -100.0, 7.0], 50.0)
    np.testing.assert_array_equal(flow.velocity, grid.velocity[-1, -1, 0, -1])
    np.testing.assert_array_equal(flow.gradient, 0)
    np.testing.assert_array_equal(flow.rate, 0)


@pytest.mark.parametrize(
    ('axes', 'change', 'words'),
    [
        ([[0.0, 1, 1], *AXES[1:]], None, 'axis t: must rise strictly; 1 follows 1 .point 3'),
        ([AXES[0], [3.0, 2, 1, 0], *AXES[2:]], None, 'axis x: must rise strictly'),
        ([*AXES[:3], [0, np.nan, 2]], None, 'axis z: must be finite'),
        ([*AXES[:3], []], None, 'axis z: empty'),
        (
            [*AXES[:3], [0.0, 1.0]],
            None,
            r'velocity: shape \(3, 4, 2, 3, 3\); allowed: \(3, 4, 2, 2',
        ),
        (AXES, np.nan, '1 gaps .not finite., the first at t = 1, x = 0.5, y = 1, z = -5'),
        (AXES, np.inf, '1 gaps'),
    ],
)
def test_bad_grids_are_one_line(axes, change, words):
    velocity = np.zeros((*SHAPE, 3))
    if change is not None:
        velocity[1, 2, 0, 0, 1] = change
    with pytest.raises(ConfigError, match=words) as caught:
        checked_grid(axes, velocity)
    assert '\n' not in str(caught.value)
