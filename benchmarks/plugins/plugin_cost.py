# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Cost per step of the plugins, as ratios within one run: stock ellipsoid model against ours.

One free body and 1 to 20 free bodies; stock with nothing, stock ellipsoid fluid, plugin with
added mass, buoyancy and damping, and with the local ellipsoid drag on top. Variants take turns in
short blocks, of which the fastest counts, by the processor time of the thread. And the x500, with
lag, torque and drag of its rotors, against the stock quadrotor: the same airframe with plain
motors. Run: ``python -m benchmarks.plugins.plugin_cost [--quick] [--json PATH]``.
"""

import time
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros import Simulation
from fluid_sim_ros.plugins.native import ROW_WIDTH, native
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, world

AXES = (0.25, 0.2, 0.15)
DEFAULTS = (0.5, 0.25, 1.5, 1.0, 1.0)
SEA = {'density': 1000, 'viscosity': 1e-3}
LAKE = {**SEA, 'density_above': 1.2, 'viscosity_above': 1.8e-5, 'surface': 50}
VEHICLE = {
    'added_mass': 'auto', 'volume': 'auto',
    'linear_damping': [4, 6, 5, 0.1, 0.1, 0.1], 'quadratic_damping': [18, 21, 37, 1.5, 1.5, 1.5],
}  # fmt: skip
LOCAL = {'added_mass': 'auto', 'volume': 'auto', 'drag': 'ellipsoid', 'drag_area': 'true'}
STOCK_FLUID = 'density="1000" viscosity="1e-3"'

# name -> (plugin configuration or None, <option> attributes, medium or None)
VARIANTS: dict[str, tuple[dict[str, Any] | None, str, dict[str, Any] | None]] = {
    'stock, no fluid': (None, '', None),
    'stock ellipsoid': (None, STOCK_FLUID, None),
    'added mass + stock drag': ({'added_mass': 'auto'}, STOCK_FLUID, None),
    'added mass + buoyancy + damping': (VEHICLE, '', SEA),
    'the same with a surface': (VEHICLE, '', LAKE),
    'added mass + buoyancy + local drag': (LOCAL, '', SEA),
}


def model_of(variant: str, integrator: str, count: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return ``count`` free bodies in slow motion."""
    values, option, medium = VARIANTS[variant]
    inside = ellipsoid(AXES, 1000, DEFAULTS) + ('' if values is None else body_plugin(**values))
    bodies = ''.join(
        free_body(inside, name=f'b{i}', position=(3 * i, 0, -2)) for i in range(count)
    )
    if values is None:  # as a stock user would write it: MuJoCo keeps its own short cut
        bodies = bodies.replace(' simple="false"', '')
    model, data = load(
        world(
            bodies,
            integrator=integrator,
            timestep=0.002,
            gravity=(0, 0, -9.81),
            option=option,
            medium=medium,
        )
    )
    data.qvel[:] = np.tile([0.3, 0.1, -0.2, 0.4, -0.3, 0.2], count)
    return model, data


def microseconds(
    setups: dict[str, tuple[mujoco.MjModel, mujoco.MjData]], steps: int, rounds: int
) -> dict[str, float]:
    """Return microseconds per step of each variant: the fastest of ``rounds`` turns."""
    best = dict.fromkeys(setups, np.inf)
    for _ in range(rounds):
        for name, (model, data) in setups.items():
            mujoco.mj_resetData(model, data)
            data.qvel[:] = np.tile([0.3, 0.1, -0.2, 0.4, -0.3, 0.2], model.nv // 6)
            start = time.thread_time()
            mujoco.mj_step(model, data, steps)
            best[name] = min(best[name], (time.thread_time() - start) / steps * 1e6)
    return {name: float(value) for name, value in best.items()}


def observation(rounds: int) -> dict[str, float]:
    """Return microseconds of one reading of all wrenches, and of the forward pass within it."""
    out = {}
    for variant in ('stock ellipsoid', 'added mass + buoyancy + damping'):
        model, data = model_of(variant, 'RK4', 1)
        scratch, row = mujoco.MjData(model), np.zeros(ROW_WIDTH)
        bases = np.array([1], dtype=np.int32)
        where = (model._address, data._address, scratch._address, bases.ctypes.data, 1, 2)
        best = {'observe': np.inf, 'forward': np.inf}
        for _ in range(rounds):
            start = time.thread_time()
            for _ in range(500):
                native().observe(*where, row.ctypes.data)
            middle = time.thread_time()
            for _ in range(500):
                mujoco.mj_forward(model, scratch)
            end = time.thread_time()
            best['observe'] = min(best['observe'], (middle - start) / 500 * 1e6)
            best['forward'] = min(best['forward'], (end - middle) / 500 * 1e6)
        out |= {f'{variant}: {name}': float(value) for name, value in best.items()}
    return out


def rotors(integrator: str, rounds: int) -> dict[str, float]:
    """Return microseconds per step of the x500 and of the stock quadrotor, and their ratio."""
    simulations = {name: Simulation(name, integrator=integrator) for name in ('quadrotor', 'x500')}
    best = dict.fromkeys(simulations, np.inf)
    for _ in range(rounds):
        for name, simulation in simulations.items():
            simulation.reset()
            start = time.thread_time()
            mujoco.mj_step(simulation.model, simulation.data, 200)
            best[name] = min(best[name], (time.thread_time() - start) / 200 * 1e6)
    found = {f'{name}_us': float(value) for name, value in best.items()}
    return {**found, 'ratio': best['x500'] / best['quadrotor']}


def measure(rounds: int) -> dict[str, Any]:
    """Return microseconds and ratios."""
    result: dict[str, Any] = {'one_body': {}, 'rotors': {}, 'bodies': {}}
    result['observation_microseconds'] = observation(rounds)
    for integrator in ('RK4', 'implicitfast'):
        setups = {name: model_of(name, integrator, 1) for name in VARIANTS}
        cost = microseconds(setups, 500, 2 * rounds)
        result['one_body'][integrator] = {
            'microseconds': cost,
            'ratio_to_stock_ellipsoid': {
                name: value / cost['stock ellipsoid'] for name, value in cost.items()
            },
        }
        result['rotors'][integrator] = rotors(integrator, 3 * rounds)
        counts = (1, 5, 10, 20)
        many = {}
        for variant in ('stock ellipsoid', 'added mass + buoyancy + damping'):
            setups = {str(n): model_of(variant, integrator, n) for n in counts}
            cost = microseconds(setups, 100, 2 * rounds)
            slope = cost['20'] / 20 / (cost['10'] / 10)
            many[variant] = {
                'microseconds_per_body': {n: value / int(n) for n, value in cost.items()},
                'per_body_20_over_10': slope,
                'per_body_20_over_1': cost['20'] / 20 / cost['1'],
            }
        result['bodies'][integrator] = many
    return result


def draw(result: dict[str, Any]) -> None:
    """Draw cost per step of one body."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axis = plt.subplots(figsize=(8, 4), layout='constrained')
    names = list(VARIANTS)
    for i, (integrator, values) in enumerate(result['one_body'].items()):
        cost = [values['microseconds'][name] for name in names]
        bars = axis.barh(np.arange(len(names)) + 0.4 * i, cost, height=0.38, label=integrator)
        ratios = values['ratio_to_stock_ellipsoid']
        axis.bar_label(bars, [f' {ratios[name]:.2f}x' for name in names], fontsize=8)
    axis.set_yticks(np.arange(len(names)) + 0.2, names)
    axis.invert_yaxis()
    axis.set_xlabel('microseconds per step, one free body (ratio to stock ellipsoid)')
    axis.margins(x=0.12)
    axis.legend()
    figure.savefig(RESULTS / 'plugin_cost.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_cost')
    result = measure(5 if options.quick else 60)
    for integrator, values in result['one_body'].items():
        for name, ratio in values['ratio_to_stock_ellipsoid'].items():
            print(
                f'{integrator:13} {name:36} {values["microseconds"][name]:6.2f} us {ratio:5.2f}x'
            )
        print(f'{integrator:13} x500 over quadrotor {result["rotors"][integrator]["ratio"]:.2f}x')
        for name, many in result['bodies'][integrator].items():
            print(f'{"":13} {name}: per body 20/10 {many["per_body_20_over_10"]:.2f}, '
                  f'20/1 {many["per_body_20_over_1"]:.2f}')  # fmt: skip
    print('reading all wrenches [us]:', result['observation_microseconds'])
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
