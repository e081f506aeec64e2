# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A current on a grid: a neutral body in an eddy against the exact path, over the spacing; its cost.

The eddy is u = curl of psi = U L exp(-r^2/2L^2), steady; the body has no drag, so it must move
with the water. Cost per step with a grid over t, x, y, z, as a ratio to none within one run.
Run: ``python -m benchmarks.weather.grid [--quick] [--json PATH]``.
"""

import time
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.common import RESULTS, ROOT, arguments, write
from fluid_sim_ros.physics.environment.grid import Grid, checked_grid
from fluid_sim_ros.scene.grid_files import grid_numbers
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, text, world

SPEED, SIZE = 0.8, 4.0  # U [m/s], L [m]
START, SECONDS = np.array([3.0, 0.0]), 40.0
SPACINGS = (2.0, 1.0, 0.5, 0.25, 0.125)
BLOCK = 60  # steps that are timed at once: less than a scheduler's slice


def eddy(x: Array, y: Array) -> tuple[Array, Array]:
    """Return u and v [m/s]."""
    shape = SPEED / SIZE * np.exp(-(x * x + y * y) / (2 * SIZE**2))
    return -y * shape, x * shape


def sampled(spacing: float) -> Grid:
    """Return the eddy on a grid over 16 m."""
    axis = np.arange(-8, 8 + spacing / 2, spacing)
    x, y = np.meshgrid(axis, axis, indexing='ij')
    velocity = np.stack([*eddy(x, y), np.zeros_like(x)], axis=-1)
    return checked_grid(([0.0], axis, axis, [0.0]), velocity[np.newaxis, :, :, np.newaxis])


def model_in(grid: Grid | None, **options: Any) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a neutral sphere in the current of a grid."""
    plugin = body_plugin(volume='auto', added_mass='auto', drag='none')
    medium: dict[str, Any] = {'density': 1000}
    extra = ''
    if grid is not None:
        numbers = grid_numbers(grid)
        medium['current_grid'] = 'flow'
        extra = (
            f'<custom><numeric name="flow" size="{len(numbers)}" data="{text(numbers)}"/></custom>'
        )
    return load(
        world(
            free_body(ellipsoid([0.1] * 3, 1000) + plugin), medium=medium, extra=extra, **options
        )
    )


def path(spacing: float) -> Array:
    """Return the path of the body, x and y, every 0.2 s."""
    grid = sampled(spacing)
    model, data = model_in(grid, timestep=0.02)
    data.qpos[:2] = START
    data.qvel[:2] = [float(part) for part in eddy(*START)]
    rows = [START]
    for _ in range(round(SECONDS / 0.2)):
        mujoco.mj_step(model, data, 10)
        rows.append(data.qpos[:2].copy())
    return np.array(rows)


def convergence() -> tuple[dict[str, Any], dict[float, Array]]:
    """Return how far the body is from the exact place at the end, and the paths."""
    exact = solve_ivp(
        lambda _t, at: np.array(eddy(*at)), (0, SECONDS), START, rtol=1e-11, atol=1e-12
    ).y[:, -1]
    paths = {spacing: path(spacing) for spacing in SPACINGS}
    off = [float(np.linalg.norm(way[-1] - exact)) for way in paths.values()]
    orders = np.log2(np.array(off[:-1]) / off[1:]).tolist()
    return {'spacing_m': SPACINGS, 'off_m': off, 'order': orders}, paths


def cost(rounds: int) -> dict[str, float]:
    """Return microseconds per step without and with a grid of 4 x 20 x 20 x 10 points."""
    axes = (np.arange(4) * 10.0, *(np.linspace(-9, 9, 20),) * 2, np.linspace(-5, 5, 10))
    field = np.random.default_rng(1).normal(size=(4, 20, 20, 10, 3)) * 0.1
    setups = {
        'none': model_in(None, integrator='implicitfast', timestep=0.002),
        'grid': model_in(checked_grid(axes, field), integrator='implicitfast', timestep=0.002),
    }
    best = dict.fromkeys(setups, np.inf)
    for _ in range(rounds):
        for name, (model, data) in setups.items():
            mujoco.mj_resetData(model, data)
            start = time.perf_counter()
            mujoco.mj_step(model, data, BLOCK)
            best[name] = min(best[name], (time.perf_counter() - start) / BLOCK * 1e6)
    return {
        'microseconds_without': float(best['none']),
        'microseconds_with': float(best['grid']),
        'ratio': float(best['grid'] / best['none']),
    }


def draw(result: dict[str, Any], paths: dict[float, Array]) -> None:
    """Draw the eddy with the paths, and the distance over the spacing."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, (plane, order) = plt.subplots(1, 2, figsize=(9, 4.2), layout='constrained')
    x, y = np.meshgrid(np.arange(-8, 8.1, 1), np.arange(-8, 8.1, 1), indexing='ij')
    plane.quiver(x, y, *eddy(x, y), color='0.6', width=0.003)
    for spacing, color in ((2.0, 'tab:orange'), (0.25, 'tab:blue')):
        plane.plot(*paths[spacing].T, color=color, label=f'grid of {spacing:g} m')
    plane.plot(*START, 'k.', label='start')
    plane.set(xlabel='x [m]', ylabel='y [m]', title=f'neutral body in an eddy, {SECONDS:g} s')
    plane.set_aspect('equal')
    plane.legend(loc='upper right', fontsize=8)
    off = np.array(result['off_m'])
    order.loglog(SPACINGS, off, 'o-', label='off at the end')
    order.loglog(
        SPACINGS, off[-1] * (np.array(SPACINGS) / SPACINGS[-1]) ** 2, 'k--', label='order 2'
    )
    order.set(xlabel='spacing of the grid [m]', ylabel='distance from the exact place [m]')
    order.set_xticks(SPACINGS, [f'{spacing:g}' for spacing in SPACINGS])
    order.set_xticks([], minor=True)
    order.grid(alpha=0.3)
    order.legend()
    figure.savefig(ROOT / 'doc' / 'img' / 'grid.png', dpi=90)


def main() -> None:
    """Measure, print, write JSON and the picture."""
    options = arguments(__doc__ or '', 'grid')
    result, paths = convergence()
    measured = {'convergence': result, 'cost': cost(20 if options.quick else 400)}
    for name, value in measured.items():
        print(f'{name}: {value}')
    write(options.json, measured)
    if not options.quick and options.json.parent == RESULTS:
        draw(result, paths)


if __name__ == '__main__':
    main()
