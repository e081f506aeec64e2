# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""current_grid and wind_grid of fluid_sim.medium: the twin's flow, closed forms, refusals."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.environment.grid import checked_grid, grid_flow
from fluid_sim_ros.scene.grid_files import grid_numbers
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    refusal,
    set_medium,
    text,
    world,
)

AXES = ([0.0, 1.0, 4.0], [-2.0, 0.0, 0.5, 3.0], [1.0, 2.0], [-5.0, -1.0, 0.0])
GRID = checked_grid(AXES, np.random.default_rng(2).normal(size=(3, 4, 2, 3, 3)))
LOW, HIGH = np.array([[axis[0], axis[-1]] for axis in AXES]).T
VOLUME = 4 / 3 * np.pi * 0.1**3
DAMPED = body_plugin(linear_damping=[1, 1, 1, 0, 0, 0])


def numeric(numbers, name='flow'):
    return (
        f'<custom><numeric name="{name}" size="{len(numbers)}" data="{text(numbers)}"/></custom>'
    )


def grid_world(plugin, medium, grid=GRID, **options):
    body = free_body(ellipsoid([0.1] * 3, 1000) + plugin)
    return world(body, medium={'density': 1000} | medium, extra=numeric(grid_numbers(grid)),
                 **options)  # fmt: skip


def felt(model, data, point, time):
    data.qpos[:3], data.time = point, time
    return explicit_force(model, data)[:3]


def test_the_flow_is_that_of_the_numpy_twin_inside_and_outside():
    damped = load(grid_world(DAMPED, {'current_grid': 'flow'}))
    pushed = load(grid_world(body_plugin(volume='auto'), {'current_grid': 'flow'}))
    at = np.random.default_rng(3).uniform(LOW - 1, HIGH + 1, (200, 4))
    at = np.r_[at, [[axis[1] for axis in AXES], LOW, HIGH]]  # and on grid points
    for time, *point in at:
        flow = grid_flow(GRID, point, time)
        np.testing.assert_allclose(felt(*damped, point, time), flow.velocity, atol=1e-12)
        push = felt(*pushed, point, time) / (1000 * VOLUME)
        np.testing.assert_allclose(push, flow.acceleration, rtol=1e-9, atol=1e-9)


def test_it_adds_to_the_mean_which_carries_it():
    model, data = load(grid_world(body_plugin(volume='auto'), {
        'current_grid': 'flow', 'current': [0.4, -0.2, 0.1], 'current_slew': 0,
    }))  # fmt: skip
    point, time = [1.1, 1.4, -2.0], 0.6
    flow = grid_flow(GRID, point, time)
    carried = flow.rate + flow.gradient @ np.add(flow.velocity, [0.4, -0.2, 0.1])
    push = felt(model, data, point, time) / (1000 * VOLUME)
    np.testing.assert_allclose(push, carried, rtol=1e-9)
    set_medium(model, data, current=[0, 0, 0])
    push = felt(model, data, point, time) / (1000 * VOLUME)
    np.testing.assert_allclose(push, flow.acceleration, rtol=1e-9)


@pytest.mark.parametrize(('height', 'stream'), [(-0.5, 'current'), (0.5, 'wind')])
def test_below_the_surface_the_current_above_it_the_wind(height, stream):
    for key in ('current', 'wind'):
        medium = {f'{key}_grid': 'flow', 'surface': 0, 'density_above': 1.2,
                  'viscosity': 1e-3, 'viscosity_above': 1e-3}  # fmt: skip
        model, data = load(grid_world(DAMPED, medium))
        force = felt(model, data, [0.2, 1.5, height], 2.0)
        expected = grid_flow(GRID, [0.2, 1.5, height], 2.0).velocity if key == stream else 0
        np.testing.assert_allclose(force, expected, atol=1e-12)


def test_a_neutral_body_runs_along_the_hyperbola_of_a_stagnation_flow():
    """U = (a x, -a y, 0), linear, so exact on the grid: x = x0 e^(a t), y = y0 e^(-a t)."""
    x = np.linspace(-4, 4, 9)
    field = np.zeros((1, 9, 9, 1, 3))
    field[..., 0], field[..., 1] = 0.5 * x[:, None, None], -0.5 * x[None, :, None]
    grid = checked_grid(([0.0], x, x, [0.0]), field)
    plugin = body_plugin(volume='auto', added_mass='auto')
    model, data = load(grid_world(plugin, {'current_grid': 'flow'}, grid))
    data.qpos[:2], data.qvel[:2] = [1.0, 3.0], [0.5, -1.5]
    mujoco.mj_step(model, data, 200)
    np.testing.assert_allclose(data.qpos[:3], [np.e, 3 / np.e, 0], atol=1e-7)


def test_stock_drag_feels_the_grid_too():
    """A grid is no plain opt.wind: MuJoCo's own forces get the local flow."""
    field = np.zeros((1, 2, 1, 1, 3))
    field[0, 1, 0, 0, 1] = 4.0
    grid = checked_grid(([0.0], [0.0, 10.0], [0.0], [0.0]), field)
    body = free_body('<geom type="box" size=".1 .1 .1" density="500"/>')
    extra = numeric(grid_numbers(grid))
    model, data = load(
        world(body, option='density="1.2"', medium={'wind_grid': 'flow'}, extra=extra)
    )
    uniform, still = load(world(body, option='density="1.2" wind="0 2 0"'))
    data.qpos[0] = 5.0
    for m, d in ((model, data), (uniform, still)):
        mujoco.mj_forward(m, d)
    np.testing.assert_allclose(data.qfrc_passive, still.qfrc_passive, rtol=1e-12, atol=1e-12)
    assert abs(data.qfrc_passive[1]) > 0.01


GOOD = grid_numbers(GRID)


def changed(index, value):
    numbers = GOOD.copy()
    numbers[index] = value
    return numbers


@pytest.mark.parametrize(
    ('numbers', 'name', 'words'),
    [
        (GOOD, 'other', ["current_grid = 'other'", '<numeric>']),
        (GOOD[:-1], 'flow', ['4 sizes', f'it has {len(GOOD) - 1} numbers']),
        (GOOD[:3], 'flow', ['4 sizes', 'it has 3 numbers']),
        (changed(0, 2.5), 'flow', ['4 sizes']),
        (changed(1, 0), 'flow', ['4 sizes']),
        (changed(1, -4), 'flow', ['4 sizes']),
        (changed(1, 1e300), 'flow', ['4 sizes']),
        (changed(5, 0.0), 'flow', ['axis t rising strictly']),
        (changed(8, -9.0), 'flow', ['axis x rising strictly']),
    ],
)
def test_bad_grids_are_refused_with_one_line(numbers, name, words):
    body = free_body(ellipsoid([0.1] * 3, 1000) + DAMPED)
    medium = {'density': 1000, 'current_grid': name}
    line = refusal(world(body, medium=medium, extra=numeric(numbers)), 'fluid_sim.medium')
    for word in words:
        assert word in line


def test_gaps_are_refused():
    body = free_body(ellipsoid([0.1] * 3, 1000) + DAMPED)
    spec = mujoco.MjSpec.from_string(world(body, medium={'density': 1000, 'wind_grid': 'flow'}))
    numbers = changed(-1, np.nan)
    spec.add_numeric(name='flow', data=numbers, size=len(numbers))
    with pytest.raises(ValueError, match="wind_grid = 'flow'; allowed: finite numbers"):
        spec.compile()
