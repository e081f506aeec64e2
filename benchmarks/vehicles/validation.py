# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The models against measurements on the real vehicles and bodies, not against their own equations.

Of each: what was measured (with its source), what the shipped model gives, the difference and why.
Where an option that is off by default mends it, what the model gives with it. The page is
doc/validation.md.

The recorded flights of a Crazyflie are not part of the project: ``--flights FOLDER`` says where
they are (``crazyflie_figure8_00.usd`` and so on). Without it their rows are left out, and the
result says so.
Run: ``python -m benchmarks.vehicles.validation [--flights FOLDER] [--json PATH]``.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from benchmarks.vehicles.validation_bodies import SPHERES, bodies, settle
from benchmarks.vehicles.validation_flights import LOGS, crazyflie
from benchmarks.vehicles.validation_row import Row
from benchmarks.vehicles.validation_vehicles import vehicles


def number(value: float | None) -> str:
    """Return a value with three digits, or a dash."""
    return '–' if value is None else f'{value:.3g}'


def percent(value: float | None) -> str:
    """Return a share as percent with its sign, or a dash."""
    return '–' if value is None else f'{100 * value:+.0f} %'


def table(result: dict[str, Any]) -> str:
    """Return the table of doc/validation.md."""
    lines = [
        '| | Quantity | Measured | Model | Off by | With an option | Why, and source |',
        '|---|---|---|---|---|---|---|',
    ]
    for row in result['rows']:
        option = '–'
        if row['mended'] is not None:
            option = f'{number(row["mended"])} ({percent(row["difference_mended"])})'
            option += f', `{row["option"]}`'
        why = '; '.join(part for part in (row['why'], row['source']) if part)
        lines.append(
            f'| {row["subject"]} | {row["quantity"]} [{row["unit"]}] | {number(row["measured"])} '
            f'| {number(row["model"])} | {percent(row["difference"])} | {option} | {why} |'
        )
    left_out = [f'Left out: {words}.' for words in result['left_out']]
    return '\n'.join([*lines, *(['', *left_out] if left_out else [])])


def draw(rows: Sequence[Row]) -> None:
    """Draw the ratios of model to measurement, and the spheres over time."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    judged = [row for row in rows if row.difference is not None][::-1]
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(13, 0.27 * len(judged) + 1.2), width_ratios=(1.7, 1), layout='constrained'
    )
    places = np.arange(len(judged))
    left.axvspan(0.9, 1.1, color='0.9')
    left.axvline(1, color='0.5', lw=1)
    left.plot([1 + (row.difference or 0) for row in judged], places, 'o', label='as shipped')
    mended = [(1 + (r.difference_mended or 0), y) for r, y in zip(judged, places, strict=True)
              if r.difference_mended is not None]  # fmt: skip
    if mended:
        left.plot(*zip(*mended, strict=True), 'D', ms=5, mfc='none', label='with an option')
    left.set_yticks(places, [f'{row.subject}: {row.quantity}' for row in judged], fontsize=8)
    left.set(xscale='log', xlim=(0.2, 2.2), xlabel='model / measured (grey: within 10 %)')
    left.set_xticks([0.25, 0.5, 1, 2], ['0.25', '0.5', '1', '2'])
    left.minorticks_off()
    left.legend(fontsize=8, loc='upper left')
    for i, (name, (diameter, ratio, terminal, time)) in enumerate(SPHERES.items()):
        times = np.linspace(0, 3 * time, 200)
        right.plot(times, terminal * (1 - np.exp(-3 * times / time)), 'k--', lw=1,
                   label='measured (their fit)' if i == 0 else None)  # fmt: skip
        right.plot(*settle(diameter, ratio, 3 * time), f'C{i}:', lw=1.2)
        mended = settle(diameter, ratio, 3 * time, history='dorgan_loth')
        right.plot(*mended, f'C{i}', lw=1.2, label=name)
    right.set(xlabel='t [s]', ylabel='[m/s]')
    right.set_title('Spheres that sink in water (dotted: without history)')
    right.legend(fontsize=8)
    for axis in (left, right):
        axis.grid(alpha=0.3)
    figure.savefig(RESULTS / 'validation.png', dpi=80)
    plt.close(figure)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(
        __doc__, 'validation', more={'flights': 'folder of the recorded flights of a Crazyflie'}
    )
    folder = Path(options.flights) if options.flights else None
    left_out = []
    if folder is None or not all((folder / name).exists() for name in LOGS):
        left_out = [f'recorded flights of a Crazyflie ({LOGS[0]} and so on; --flights FOLDER)']
        folder = None
    rows = [*vehicles(), *crazyflie(folder), *bodies()]
    for row in rows:
        print(f'{row.subject}, {row.quantity}: measured {number(row.measured)}, model '
              f'{number(row.model)} {row.unit} ({percent(row.difference)}), with '
              f'{row.option or "no option"} {number(row.mended)}')  # fmt: skip
    for words in left_out:
        print(f'left out: {words}')
    write(options.json, {'rows': [row.as_json() for row in rows], 'left_out': left_out})
    if not options.quick:
        draw(rows)


if __name__ == '__main__':
    main()
