# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The vehicles against SciPy on the same equations, and what they cost.

Top speeds and free decay of the BlueROVs, hover command and speed against tilt of the
multirotors, and a manoeuvre in all six directions of each; one picture per vehicle in doc/img.
Cost: one step of bluerov2_heavy (eight thrusters with lag and curve, added mass, damping,
buoyancy) over the stock rov model (rung ellipsoid of the scene rov), and of x500 over the stock
quadrotor, timed in turns in one run.
Run: ``python -m benchmarks.vehicles.vehicles [--quick] [--json PATH]``.
"""

import time
from collections.abc import Callable
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import ROOT, arguments, write
from fluid_sim_ros import Scene
from fluid_sim_ros.schema.settings import RunSettings
from test.support import vehicle_runs as runs
from test.support.plugin_models import Array
from test.support.vehicle_equations import EQUATIONS, G

IMAGES = ROOT / 'doc' / 'img'
ROVS = ('bluerov2_heavy', 'bluerov2')
COPTERS = ('x500', 'crazyflie')
TILTS_DEG = (2.5, 5.0, 10.0, 15.0, 20.0, 25.0)
#: Vehicle -> command [N] of the manoeuvre (of the hover thrust for a multirotor), length [s].
MANOEUVRES: dict[str, tuple[list[float], float]] = {
    'bluerov2_heavy': ([-3, -2, 2, 3, 3, 4, 3, 4], 4.0),
    'bluerov2': ([-5, -3, 4, 6, 10, 8], 5.0),
    'x500': ([1.05, 0.99, 1.01, 0.98], 0.4),
    'crazyflie': ([1.05, 0.99, 1.01, 0.98], 0.4),
}
LABELS = ('u [m/s]', 'v [m/s]', 'w [m/s]', 'p [rad/s]', 'q [rad/s]', 'r [rad/s]')
#: Vehicle -> (scene, rung) of the stock model that its cost is compared with.
STOCK: dict[str, tuple[str, str | None]] = {
    'bluerov2_heavy': ('rov', 'ellipsoid'),
    'x500': ('quadrotor', None),
}


def rov(name: str) -> dict[str, Any]:
    """Return top speeds [m/s] and decays of a BlueROV2, measured and solved."""
    equations, result = EQUATIONS[name], {'top_speed': {}, 'decay': {}}  # fmt: skip
    count = len(equations.rotors.axis)
    for direction, axis in runs.TOP_SPEEDS.items():
        solved = float(equations.top_velocity(runs.top_command(direction, count))[axis])
        measured = runs.top_speed(name, direction)
        result['top_speed'][direction] = {
            'measured': measured, 'solved': solved, 'error': measured / solved - 1,
        }  # fmt: skip
    for axis, initial in ((2, 1.0), (5, 1.5)):
        times, measured_rows = runs.decay(name, axis, initial, 6.0)
        start = initial * np.eye(6)[axis]
        solved_rows = equations.flight(times, np.zeros(count), v=start[:3], w=start[3:])[:, axis]
        result['decay'][LABELS[axis]] = {
            'time': times, 'measured': measured_rows, 'solved': solved_rows,
            'error_of_initial': float(np.abs(measured_rows - solved_rows).max() / initial),
        }  # fmt: skip
    return result


def copter(name: str, tilts: tuple[float, ...]) -> dict[str, Any]:
    """Return hover command [N] and speeds [m/s] against tilt of a multirotor."""
    equations, rows = EQUATIONS[name], []
    for tilt in np.deg2rad(tilts):
        thrust, solved = equations.level_flight(tilt)
        measured = float(runs.tilted(name, tilt, thrust, 90.0, 0.8 * solved)[-1, 0])
        rows.append({
            'tilt_deg': float(np.rad2deg(tilt)), 'measured': measured, 'solved': solved,
            'error': measured / solved - 1,
        })  # fmt: skip
    thrust, _ = equations.level_flight(0.0)
    velocity = runs.tilted(name, 0.0, thrust, 3.0, 0.0)[500:, 2]
    drift = float(abs(velocity[-1] - velocity[0]) / 2.0 / G)
    return {'hover_thrust': thrust, 'hover_acceleration_g': drift, 'tilt': rows}


def manoeuvre(name: str) -> dict[str, Any]:
    """Return body velocities under a constant command, measured and solved, and the error."""
    equations = EQUATIONS[name]
    values, seconds = MANOEUVRES[name]
    hover = equations.mass * G / 4 if name in COPTERS else 0.0
    command = np.array(values) * (hover or 1.0)
    simulation = runs.start(name, 500 if hover else -50)
    simulation.set_thrust(name, command)
    times, measured = runs.free(simulation, name, seconds, 5)
    solved = equations.flight(times, command, thrust=hover)
    gap, size = np.abs(measured - solved).max(axis=0), np.abs(solved).max(axis=0)
    return {
        'command': command, 'time': times, 'measured': measured, 'solved': solved,
        'error_linear': float(gap[:3].max() / size[:3].max()),
        'error_angular': float(gap[3:].max() / size[3:].max()),
    }  # fmt: skip


def cost(*, quick: bool) -> dict[str, Any]:
    """Return microseconds a step of vehicle and stock model, medians of turns, and their ratio."""
    steps, rounds = (2000, 7) if quick else (5000, 25)
    result: dict[str, Any] = {}
    for name, (scene, rung) in STOCK.items():
        times: dict[str, list[float]] = {'vehicle': [], 'stock': []}
        both: dict[str, mujoco.MjModel] = {
            'vehicle': Scene.load(name).compile().model,
            'stock': Scene.load(scene).compile(RunSettings(fluid=rung)).model,
        }
        for _ in range(rounds):
            for kind, model in both.items():
                data = mujoco.MjData(model)
                mujoco.mj_resetDataKeyframe(model, data, 0)
                data.ctrl[:] = data.ctrl if name in COPTERS else 3.0
                data.qvel[:] = (0.3, 0.1, -0.2, 0.1, -0.1, 0.05)
                begin = time.perf_counter()
                mujoco.mj_step(model, data, steps)
                times[kind].append((time.perf_counter() - begin) / steps * 1e6)
        ours, stock = (float(np.median(times[kind])) for kind in ('vehicle', 'stock'))
        result[name] = {
            'over': f'{scene}, {rung or "as it is"}', 'vehicle_us': ours, 'stock_us': stock,
            'ratio': ours / stock,
        }  # fmt: skip
    return result


def plot_pairs(axes: Any, times: Array, measured: Array, solved: Array, columns: slice) -> None:
    """Draw simulated columns as dots over solved lines."""
    every = max(1, len(times) // 40)
    for i in range(*columns.indices(6)):
        line = axes.plot(times, solved[:, i], lw=1.2, label=LABELS[i])[0]
        axes.plot(times[::every], measured[::every, i], '.', color=line.get_color(), ms=5)
    axes.set(xlabel='t [s]')
    axes.legend(fontsize=8)


def draw(name: str, steady: dict[str, Any], flown: dict[str, Any]) -> None:
    """Draw the validation picture of one vehicle: dots the simulation, lines SciPy."""
    from matplotlib import pyplot as plt

    figure, (first, second, third) = plt.subplots(1, 3, figsize=(12, 3.8), layout='constrained')
    if name in ROVS:
        speeds = steady['top_speed']
        place = np.arange(len(speeds))
        first.bar(place, [abs(v['solved']) for v in speeds.values()], color='0.8', label='SciPy')
        first.plot(place, [abs(v['measured']) for v in speeds.values()], 'o', label='simulation')
        first.set_xticks(place, list(speeds), fontsize=8)
        first.set(ylabel='top speed [m/s]', title='full command, 16 V, held level')
        first.margins(y=0.25)
    else:
        rows = steady['tilt']
        tilts = [row['tilt_deg'] for row in rows]
        first.plot(tilts, [row['solved'] for row in rows], lw=1.2, label='SciPy')
        first.plot(tilts, [row['measured'] for row in rows], 'o', label='simulation')
        first.set(xlabel='tilt [deg]', ylabel='speed [m/s]', title='level flight, tilt held')
    first.legend(fontsize=8)
    seconds = flown['time'], flown['measured'], flown['solved']
    plot_pairs(second, *seconds, slice(0, 3))
    plot_pairs(third, *seconds, slice(3, 6))
    second.set(title='a command to every thruster: lines SciPy')
    third.set(title='dots the simulation')
    figure.suptitle(name)
    figure.savefig(IMAGES / f'{name}_validation.png', dpi=80)
    plt.close(figure)


def plain(value: Any) -> Any:
    """Return a result without its curves, as JSON can hold it."""
    if isinstance(value, dict):
        curves = [
            key for key in ('time', 'measured', 'solved')
            if isinstance(value.get(key), np.ndarray)
        ]  # fmt: skip
        return {key: plain(content) for key, content in value.items() if key not in curves}
    if isinstance(value, list):
        return [plain(v) for v in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


def main() -> None:
    """Measure, print, write JSON and pictures."""
    options = arguments(__doc__ or '', 'vehicles')
    mpl.use('Agg')
    tilts = TILTS_DEG[1:3] if options.quick else TILTS_DEG
    steady: dict[str, Callable[[], dict[str, Any]]] = {
        **{name: (lambda name=name: rov(name)) for name in ROVS},
        **{name: (lambda name=name: copter(name, tilts)) for name in COPTERS},
    }
    result: dict[str, Any] = {'vehicles': {}}
    for name, measure in steady.items():
        at_rest, flown = measure(), manoeuvre(name)
        result['vehicles'][name] = plain({**at_rest, 'manoeuvre': flown})
        rows = at_rest['tilt'] if name in COPTERS else [*at_rest['top_speed'].values()]
        worst = max(abs(row['error']) for row in rows)
        linear, angular = flown['error_linear'], flown['error_angular']
        print(
            f'{name}: steady speeds {worst:.1e} off, manoeuvre {linear:.1e} (linear), '
            f'{angular:.1e} (angular)'
        )
        if not options.quick:
            draw(name, at_rest, flown)
    result['cost'] = cost(quick=options.quick)
    for name, row in result['cost'].items():
        print(f'{name} over {row["over"]}: {row["stock_us"]:.2f} -> {row["vehicle_us"]:.2f} us, '
              f'ratio {row["ratio"]:.2f}')  # fmt: skip
    write(options.json, result)


if __name__ == '__main__':
    main()
