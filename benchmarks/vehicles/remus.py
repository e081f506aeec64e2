# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The remus100 against its published coefficients and against SciPy on the same equations.

Every coefficient measured on the model, the moment of drift with each part switched off, straight
speed against thrust, free decay in heave and yaw, and the cost of a step over a free body with the
same hull and no fins. Run: ``python -m benchmarks.vehicles.remus [--quick] [--json PATH]``.
"""

import time
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import ROOT, arguments, write
from test.support import remus_equations as equations
from test.support import remus_runs as remus
from test.support import vehicle_runs as runs

IMAGE = ROOT / 'doc' / 'img' / 'remus100_validation.png'
THRUSTS = (1.0, 2.5, 3.86, 6.0, 10.0)  # [N]
DECAYS = {'heave': (2, 0.5), 'yaw': (5, 0.5)}  # axis, start [m/s], [rad/s]
SECONDS = 10.0


def coefficients() -> dict[str, Any]:
    """Return each published coefficient, as measured, and Muw with parts switched off."""
    model = remus.variant({})
    rows = {
        name: {'measured': remus.coefficient(model, name), 'published': value}
        for name, value in equations.PUBLISHED.items() if name != 'Xuu'
    }  # fmt: skip
    switched = {
        'as it is': remus.coefficient(model, 'Muw'),
        'added mass off': remus.coefficient(
            remus.variant({'added_mass': None}), 'Muw', added=False
        ),
        'fins off': remus.coefficient(remus.variant({}, fins=False), 'Muw'),
    }
    return {'table': rows, 'Muw': switched}


def decays() -> dict[str, Any]:
    """Return velocities that die out, measured and solved, and the largest gap."""
    result = {}
    for name, (axis, initial) in DECAYS.items():
        times, measured = runs.decay('remus100', axis, initial, SECONDS)
        solved = equations.decay(times, initial * np.eye(6)[axis])[:, axis]
        gap = float(np.abs(measured - solved).max() / initial)
        result[name] = {
            'time': times, 'measured': measured, 'solved': solved, 'error_of_initial': gap,
        }  # fmt: skip
    return result


def cost(*, quick: bool) -> dict[str, float]:
    """Return microseconds a step with and without fins, medians of turns, and their ratio."""
    steps, rounds = (2000, 5) if quick else (5000, 15)
    models = {'vehicle': remus.variant({}).model, 'hull': remus.variant({}, fins=False).model}
    times: dict[str, list[float]] = {name: [] for name in models}
    for _ in range(rounds):
        for name, model in models.items():
            data = mujoco.MjData(model)
            mujoco.mj_resetDataKeyframe(model, data, 0)
            data.ctrl[0], data.qvel[:6] = 3.86, (1.5, 0.1, -0.1, 0.1, -0.1, 0.05)
            begin = time.perf_counter()
            mujoco.mj_step(model, data, steps)
            times[name].append((time.perf_counter() - begin) / steps * 1e6)
    vehicle, hull = (float(np.median(times[name])) for name in models)
    return {'vehicle_us': vehicle, 'without_fins_us': hull, 'ratio': vehicle / hull}


def draw(speeds: list[dict[str, float]], dying: dict[str, Any]) -> None:
    """Draw the validation picture: dots the simulation, lines SciPy."""
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8), layout='constrained')
    thrusts = [row['thrust'] for row in speeds]
    line = np.linspace(0, max(thrusts), 100)
    axes[0].plot(line, np.sqrt(line / 1.62), lw=1.2, label='closed form')
    axes[0].plot(thrusts, [row['measured'] for row in speeds], 'o', label='simulation')
    axes[0].axvline(3.86, color='0.8', lw=1)
    axes[0].set(xlabel='thrust [N]', ylabel='speed [m/s]', title='straight, W = B, depth held')
    for axis, (name, row), unit in zip(axes[1:], dying.items(), ('m/s', 'rad/s'), strict=True):
        axis.plot(row['time'], row['solved'], lw=1.2, label='SciPy')
        axis.plot(row['time'][::15], row['measured'][::15], '.', ms=5, label='simulation')
        axis.set(xlabel='t [s]', ylabel=f'{name} [{unit}]', title=f'free decay in {name}')
    for axis in axes:
        axis.legend(fontsize=8)
    figure.suptitle('remus100')
    figure.savefig(IMAGE, dpi=80)
    plt.close(figure)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'remus')
    mpl.use('Agg')
    measured, dying = coefficients(), decays()
    speeds = [
        {'thrust': thrust, 'measured': remus.straight_speed(thrust),
         'solved': equations.straight_speed(thrust)}
        for thrust in (THRUSTS[2:3] if options.quick else THRUSTS)
    ]  # fmt: skip
    worst = max(abs(row['measured'] / row['published'] - 1) for row in measured['table'].values())
    print(f'{len(measured["table"])} coefficients: {worst:.1e} off; Muw {measured["Muw"]}')
    for row in speeds:
        print(f'{row["thrust"]} N: {row["measured"]:.4f} m/s, closed form {row["solved"]:.4f}')
    for name, row in dying.items():
        print(f'decay in {name}: {row["error_of_initial"]:.1e} of the start')
    timing = cost(quick=options.quick)
    print(f'fins and joints: {timing["ratio"]:.2f} times the hull alone')
    if not options.quick:
        draw(speeds, dying)
    gaps = {name: row['error_of_initial'] for name, row in dying.items()}
    write(options.json, {'coefficients': measured, 'straight': speeds, 'decay': gaps,
                         'cost': timing})  # fmt: skip


if __name__ == '__main__':
    main()
