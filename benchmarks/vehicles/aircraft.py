# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The Aerosonde against SciPy on the same equations: trim, free modes, a manoeuvre.

Trim: angle of attack, deflections and throttle of level flight, where the simulation's
accelerations vanish. Modes: eigenvalues of the simulation's and of the equations' finite
differences. Draws doc/img/aerosonde_validation.png.
Run: ``python -m benchmarks.vehicles.aircraft [--quick] [--json PATH]``.
"""

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np

from benchmarks.common import ROOT, arguments, write
from test.support import aircraft_equations as equations
from test.support.aircraft_runs import Aircraft
from test.support.plugin_models import Array

PICTURE = ROOT / 'doc' / 'img' / 'aerosonde_validation.png'
#: Airspeeds of the trim [m/s]; the motor ends at 32.5.
AIRSPEEDS = (18.0, 20.0, 22.5, 25.0, 27.5, 30.0, 32.0)
#: Change of elevator, aileron, rudder [rad] and share of the propeller's speed, from the trim.
MANOEUVRE = ((-0.03, 0.02, -0.02), 1.05)
SECONDS = 4.0


def trims(aircraft: Aircraft, airspeeds: Sequence[float]) -> list[dict[str, Any]]:
    """Return trim at each airspeed, measured and solved, and the largest share of error."""
    rows = []
    for airspeed in airspeeds:
        measured, solved = aircraft.trim(airspeed), equations.trim(airspeed)
        error = max(abs(measured[key] / solved[key] - 1) for key in solved)
        rows.append({
            'airspeed': airspeed, 'measured': measured, 'solved': solved, 'error': error,
        })  # fmt: skip
    return rows


def modes(aircraft: Aircraft, airspeed: float) -> dict[str, dict[str, float]]:
    """Return each free mode: its eigenvalue [1/s], measured and solved, and the share of error."""
    measured, solved = (
        np.sort_complex(source.modes(airspeed)) for source in (aircraft, equations)
    )
    # by speed of decay
    names = ('roll', 'short period', '', 'dutch roll', '', 'phugoid', '', 'spiral')
    return {
        name: {
            'real': float(ours.real), 'imaginary': float(abs(ours.imag)),
            'error': float(abs(ours - theirs) / abs(theirs)),
        }
        for name, ours, theirs in zip(names, measured, solved, strict=True) if name
    }  # fmt: skip


def manoeuvre(aircraft: Aircraft, airspeed: float) -> dict[str, Any]:
    """Return u v w p q r after a change of every input, measured and solved, and the error."""
    trim, (change, faster) = equations.trim(airspeed), MANOEUVRE
    start = np.r_[
        equations.wind_axes(airspeed, trim['alpha'], trim['beta']), 0, 0, 0, 0, trim['alpha'], 0
    ]
    held = (trim['elevator'], trim['aileron'], trim['rudder'])
    inputs = tuple(np.add(held, change)), faster * trim['speed']
    times, measured = aircraft.flight(start, *inputs, SECONDS, 5)
    solved = equations.flight(times, start, *inputs)[:, :6]
    # of the largest change of each component
    error = np.abs(measured - solved).max(axis=0) / np.abs(solved - start[:6]).max(axis=0)
    return {'time': times, 'measured': measured, 'solved': solved, 'error': float(error.max())}


def draw(rows: list[dict[str, Any]], flown: dict[str, Any]) -> None:
    """Draw dots of the simulation over lines of SciPy."""
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8), layout='constrained')
    dense = np.linspace(AIRSPEEDS[0], AIRSPEEDS[-1], 60)
    solved = [equations.trim(speed) for speed in dense]
    labels = {
        'alpha': ('angle of attack [deg]', 180 / np.pi),
        'elevator': ('elevator [deg]', 180 / np.pi), 'throttle': ('throttle [%]', 100),
    }  # fmt: skip
    right = axes[0].twinx()
    for key, (label, scale) in labels.items():
        place, color = (right, 'C2') if key == 'throttle' else (axes[0], f'C{key == "elevator":d}')
        place.plot(dense, [scale * t[key] for t in solved], color=color, lw=1.2, label=label)
        place.plot(
            [row['airspeed'] for row in rows], [scale * row['measured'][key] for row in rows],
            'o', color=color, ms=5,
        )  # fmt: skip
    axes[0].set(xlabel='airspeed [m/s]', ylabel='[deg]', title='level trim', ylim=(-35, 12))
    right.set(ylabel='throttle [%]', ylim=(20, 102))
    handles = [*axes[0].get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
    axes[0].legend(handles=handles, fontsize=8, loc='lower right')
    names = ('u - 25 m/s', 'v', 'w', 'p', 'q', 'r')
    shift = np.array([25.0, 0, 0, 0, 0, 0])
    for place, columns, unit in ((axes[1], range(3), 'm/s'), (axes[2], range(3, 6), 'rad/s')):
        plot_columns(place, flown, shift, columns, names)
        place.set(xlabel='t [s]', ylabel=f'[{unit}]')
    axes[1].set(title='every input changed: lines SciPy')
    axes[2].set(title='dots the simulation')
    figure.suptitle('aerosonde')
    figure.savefig(PICTURE, dpi=80)
    plt.close(figure)


def plot_columns(
    place: Any, flown: dict[str, Any], shift: Array, columns: range, names: Sequence[str]
) -> None:
    """Draw some columns of a manoeuvre."""
    every = max(1, len(flown['time']) // 32)
    for i in columns:
        line = place.plot(flown['time'], flown['solved'][:, i] - shift[i], lw=1.2, label=names[i])
        dots = flown['measured'][::every, i] - shift[i]
        place.plot(flown['time'][::every], dots, '.', color=line[0].get_color(), ms=5)
    place.legend(fontsize=8)


def main() -> None:
    """Measure, print, write JSON and the picture."""
    options = arguments(__doc__ or '', 'aircraft')
    mpl.use('Agg')
    aircraft = Aircraft()
    rows = trims(aircraft, AIRSPEEDS[1::2] if options.quick else AIRSPEEDS)
    found, flown = modes(aircraft, 25.0), manoeuvre(aircraft, 25.0)
    for row in rows:
        trim = row['measured']
        print(
            f'{row["airspeed"]:g} m/s: alpha {np.rad2deg(trim["alpha"]):.2f} deg, elevator '
            f'{np.rad2deg(trim["elevator"]):.2f} deg, throttle {100 * trim["throttle"]:.1f} %, '
            f'{row["error"]:.1e} off'
        )
    for name, mode in found.items():
        print(
            f'{name}: {mode["real"]:.3f} +- {mode["imaginary"]:.3f}i 1/s, {mode["error"]:.1e} off'
        )
    print(f'manoeuvre: {flown["error"]:.1e} off')
    if not options.quick:
        draw(rows, flown)
    write(options.json, {'trim': rows, 'modes': found, 'manoeuvre_error': flown['error']})


if __name__ == '__main__':
    main()
