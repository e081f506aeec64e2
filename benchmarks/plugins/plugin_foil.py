# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
fluid_sim.foil against theory and measurement: fly wing, lift slope, flat plate, order, cost.

Dickinson et al. (1999), Science 284:1954: C_L = 0.225 + 1.58 sin(2.13 a - 7.2 deg), C_D = 1.92 -
1.55 cos(2.04 a - 9.82 deg), robotic fly wing at Re 136. Helmbold's lift slope by aspect ratio.
Stalled plate: force normal to it. Order with RK4 of an Aerosonde in free flight. Cost: one step of
an aircraft and of a body with four wings of ten panels over the same body without foils.
Run: ``python -m benchmarks.plugins.plugin_foil [--quick] [--json PATH]``.
"""

import time
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros.physics.foil import wing_coefficients
from test.support.foil_models import (
    AEROSONDE,
    AIR,
    DICKINSON,
    foil_world,
    generalized,
    in_flow,
    lift_drag,
    wing_params,
)
from test.support.plugin_models import Array, load

RATIOS = (1, 1.5, 2, 3, 4, 5, 6, 8, 10)
ORDER_STEPS = (0.04, 0.02, 0.01, 0.005)
FLY_WING = {'span': 0.25, 'chord': 0.067, **DICKINSON}


def dickinson(alpha: Array) -> tuple[Array, Array]:
    """Return the fitted lift and drag coefficients of the robotic fly wing."""
    degrees = np.rad2deg(alpha)
    lift = 0.225 + 1.58 * np.sin(np.deg2rad(2.13 * degrees - 7.2))
    return lift, 1.92 - 1.55 * np.cos(np.deg2rad(2.04 * degrees - 9.82))


def fly_wing() -> dict[str, Any]:
    """Return the rms of both coefficients over 0 to 90 deg."""
    alphas = np.deg2rad(np.arange(0, 91, 1.0))
    model, data = load(foil_world(FLY_WING))
    rows = lift_drag(model, data, alphas, FLY_WING['span'] * FLY_WING['chord'])
    rms = [
        float(np.sqrt(np.mean((found - wanted) ** 2)))
        for found, wanted in zip(rows.T, dickinson(alphas), strict=True)
    ]
    return {'set': DICKINSON, 'rms_lift': rms[0], 'rms_drag': rms[1]}


def lift_slope() -> dict[str, Any]:
    """Return measured and Helmbold's lift slope [1/rad] by aspect ratio."""
    measured, helmbold = [], []
    for ratio in RATIOS:
        model, data = load(foil_world({'span': 0.2 * ratio, 'chord': 0.2}))
        rows = lift_drag(model, data, [-1e-3, 1e-3], 0.04 * ratio)
        measured.append(float(rows[1, 0] - rows[0, 0]) / 2e-3)
        helmbold.append(float(2 * np.pi * ratio / (2 + np.sqrt(ratio**2 + 4))))
    worst = float(np.max(np.abs(np.array(measured) / helmbold - 1)))
    return {
        'aspect_ratio': list(RATIOS), 'measured': measured, 'helmbold': helmbold, 'worst': worst,
    }  # fmt: skip


def flat_plate() -> dict[str, Any]:
    """Return the largest error of a stalled plate's force: normal Cn sin^p, nothing along it."""
    result = {}
    for plate, normal, power in (('newton', 2.0, 2), ('sine', 1.2, 1)):
        values = {'span': 2.0, 'chord': 0.5, 'plate': plate, 'plate_normal': normal}
        model, data = load(foil_world(values))
        worst = 0.0
        for alpha in np.deg2rad(np.r_[45:136, -135:-44]):
            data.qvel[:3] = in_flow(float(alpha))
            force = generalized(model, data)[:3] / (0.5 * AIR)
            wanted = normal * np.sign(alpha) * np.abs(np.sin(alpha)) ** power
            worst = max(worst, float(np.max(np.abs(force - [0, 0, wanted]))))
        result[plate] = worst
    return result


def glide(integrator: str, step: float) -> Array:
    """Return the state of an Aerosonde after 2 s of free flight."""
    model, data = load(
        foil_world(
            AEROSONDE, site='pos="0 0 0"',
            option=f'timestep="{step!r}" integrator="{integrator}"',
        )
    )  # fmt: skip
    model.body_mass[1] = 11
    model.body_inertia[1] = [0.8244, 1.135, 1.759]
    mujoco.mj_setConst(model, data)
    data.qvel[:] = [25, 0.5, -1, 0.1, 0.05, -0.1]
    mujoco.mj_step(model, data, round(2 / step))
    return np.r_[data.qpos, data.qvel]


def order() -> dict[str, Any]:
    """Return the error of the flight by timestep with RK4 and implicitfast, and the orders."""
    exact = glide('RK4', 2.0**-11)
    result: dict[str, Any] = {'timestep': list(ORDER_STEPS)}
    for integrator in ('RK4', 'implicitfast'):
        errors = [float(np.max(np.abs(glide(integrator, step) - exact))) for step in ORDER_STEPS]
        slope = float(np.polyfit(np.log(ORDER_STEPS), np.log(errors), 1)[0])
        result[integrator] = {'error': errors, 'order': slope}
    return result


def cost(*, quick: bool) -> dict[str, Any]:
    """Return microseconds a step: a body alone, an aircraft, four wings of ten panels."""
    option = 'timestep="1e-3" integrator="{}" gravity="0 0 0"'
    sites = ''.join(f'<site name="w{i}" pos="0 {i} 0"/>' for i in range(4))
    four = {'site': 'w0 w1 w2 w3', 'span': 1.0, 'chord': 0.2, 'panels': 10}
    steps, rounds = (2000, 5) if quick else (10000, 15)
    result: dict[str, Any] = {}
    for integrator in ('implicitfast', 'RK4'):
        chosen = option.format(integrator)
        bare = foil_world(AEROSONDE, option=chosen)
        first, last = bare.index('<plugin plugin="fluid_sim.foil">'), bare.index('</extension>')
        cases = {
            'bare': load(bare[:first] + bare[last:]),
            'aircraft': load(bare),
            'four_wings': load(foil_world(four, option=chosen, inside=sites)),
        }
        times: dict[str, list[float]] = {name: [] for name in cases}
        for _ in range(rounds):
            for name, (model, data) in cases.items():
                mujoco.mj_resetData(model, data)
                data.qvel[0] = 1e-3  # slow: nothing happens, everything is computed
                begin = time.perf_counter()
                mujoco.mj_step(model, data, steps)
                times[name].append((time.perf_counter() - begin) / steps * 1e6)
        medians = {f'{name}_us': float(np.median(kept)) for name, kept in times.items()}
        result[integrator] = medians | {
            f'{name}_ratio': medians[f'{name}_us'] / medians['bare_us'] for name in cases
        }
    return result


def draw(result: dict[str, Any]) -> None:
    """Draw the fly wing, coefficients around the clock, the lift slope and the order."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(10, 7.5), layout='constrained')
    (fly, clock), (slope, orders) = axes
    alphas = np.deg2rad(np.arange(0, 91, 1.0))
    model, data = load(foil_world(FLY_WING))
    rows = lift_drag(model, data, alphas, FLY_WING['span'] * FLY_WING['chord'])
    for i, (name, color) in enumerate((('C_L', 'C0'), ('C_D', 'C3'))):
        fly.plot(np.rad2deg(alphas), dickinson(alphas)[i], 'k--', lw=1)
        fly.plot(np.rad2deg(alphas), rows[:, i], color, label=f'{name} of the plugin')
    fly.set(
        xlabel='angle of attack [deg]', title='fly wing (dashed: Dickinson et al. 1999)',
    )  # fmt: skip
    fly.legend()
    around = np.deg2rad(np.arange(-180, 181, 1.0))
    wing = {'span': 1.2, 'chord': 0.2, 'drag_0': 0.01, 'stall_angle': 0.26}
    c = wing_coefficients(wing_params(wing), around)
    model, data = load(foil_world(wing))
    marks = around[::10]
    measured = lift_drag(model, data, marks, 0.24)
    for i, (values, name) in enumerate(((c.lift, 'C_L'), (c.drag, 'C_D'))):
        clock.plot(np.rad2deg(around), values, f'C{i}', label=f'{name}, numpy')
        clock.plot(np.rad2deg(marks), measured[:, i], f'C{i}o', ms=3, label=f'{name}, plugin')
    clock.set(xlabel='angle of attack [deg]', title='wing of aspect ratio 6, all angles')
    clock.set_ylim(-1, 2.5)
    clock.legend(loc='upper center', ncols=4, fontsize=7)
    slopes = result['lift_slope']
    fine = np.linspace(0.5, 10, 100)
    slope.plot(fine, 2 * np.pi * fine / (2 + np.sqrt(fine**2 + 4)), 'k--', label='Helmbold')
    slope.plot(fine, 2 * np.pi * fine / (fine + 2), 'C2:', label='lifting line, elliptic')
    slope.plot(fine, np.pi * fine / 2, 'C1:', label='Jones, AR to 0')
    slope.plot(slopes['aspect_ratio'], slopes['measured'], 'o', label='plugin')
    slope.set(
        xlabel='aspect ratio', ylabel='lift slope [1/rad]', ylim=(0, 6.5), title='lift slope'
    )
    slope.legend()
    measured_order = result['order']
    for integrator in ('RK4', 'implicitfast'):
        row = measured_order[integrator]
        orders.loglog(
            measured_order['timestep'], row['error'], 'o-',
            label=f'{integrator}: order {row["order"]:.2f}',
        )  # fmt: skip
    orders.set(
        xlabel='timestep [s]', ylabel='largest error of the state',
        title='Aerosonde, 2 s of free flight',
    )  # fmt: skip
    orders.legend()
    figure.savefig(RESULTS / 'plugin_foil.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_foil')
    result = {
        'dickinson': fly_wing(),
        'lift_slope': lift_slope(),
        'flat_plate': flat_plate(),
        'order': order(),
        'cost': cost(quick=options.quick),
    }
    fly = result['dickinson']
    print(f'fly wing: rms C_L {fly["rms_lift"]:.3f}, C_D {fly["rms_drag"]:.3f}')
    print(f'lift slope against Helmbold: {result["lift_slope"]["worst"]:.1e}')
    print(f'flat plate: {result["flat_plate"]}')
    for integrator in ('RK4', 'implicitfast'):
        print(f'{integrator}: order {result["order"][integrator]["order"]:.2f}')
    print(result['cost'])
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
