# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Stock MuJoCo against fluid_sim: the accuracy table of the README.

Each row is one fact with a reference that neither engine computed: a closed form, the published
equations integrated in numpy, a table of measurements. Both sides run at the same timestep. Stock
gets what MuJoCo offers for the case: the ellipsoid model, gravcomp for the weight that buoyancy
carries, a wind set anew at every step. Writes the rows as JSON,
from which ``make docs`` makes the table, and a picture.
Run: ``python -m benchmarks.plugins.plugin_stock_vs_ours [--quick] [--json PATH]``.
"""

from typing import Any

import matplotlib as mpl
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from benchmarks.plugins.stock_vs_ours_cases import Row, measure
from test.support.plugin_models import (
    Array,
)


def cell(row: Row, value: float | None) -> str:
    """Return a value with its error, as the table shows it."""
    if value is None:
        return 'no free surface'
    error = row.error(value)
    if row.exact == 0:
        return f'{value:.2g}'
    if error < 1e-12:
        return f'{value:.4g} (to rounding)'
    # two digits, never as a power of ten
    size = f'{float(f"{100 * error:.2g}"):g} %' if error >= 1e-3 else f'{error:.0e}'
    return f'{value:.4g} ({size})'


def table(result: dict[str, Any]) -> str:
    """Return the rows of a result as a table in Markdown."""
    lines = ['| Case | Reference | Stock MuJoCo | fluid_sim |', '|---|---|---|---|']
    for row in (Row(**values) for values in result['rows']):
        case = f'{row.case} [{row.unit}]' if row.unit else row.case
        lines.append(
            f'| {case} | {row.exact:.4g} | {cell(row, row.stock)} | {cell(row, row.ours)} |'
        )
    return '\n'.join(lines) + '\n'


def draw(rows: list[Row]) -> None:
    """Draw both errors of each row."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axis = plt.subplots(figsize=(10, 5), layout='constrained')
    height: Array = np.arange(len(rows), dtype=float)
    ours = np.maximum([row.error(row.ours) for row in rows], 1e-16)
    stock = np.array([np.nan if r.stock is None else r.error(r.stock) for r in rows])
    axis.hlines(height, ours, stock, color='0.8', zorder=1)
    axis.plot(stock, height, 'C3o', label='stock MuJoCo')
    axis.plot(ours, height, 'C0o', label='fluid_sim')
    axis.set_xscale('log')
    axis.set_yticks(height, [row.case for row in rows])
    axis.invert_yaxis()
    axis.grid(axis='x', alpha=0.3)
    axis.set_xlabel('error relative to the reference (first row: in metres)')
    axis.legend(loc='lower left', bbox_to_anchor=(0, 1), ncols=2, frameon=False)
    figure.savefig(RESULTS / 'plugin_stock_vs_ours.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__, 'plugin_stock_vs_ours')
    rows = measure(13 if options.quick else 61)
    result = {'rows': [row._asdict() for row in rows]}
    print(table(result))
    write(options.json, result)
    if not options.quick:
        draw(rows)


if __name__ == '__main__':
    main()
