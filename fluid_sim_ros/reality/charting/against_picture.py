# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The chart of a model's rungs against a flight, as a picture."""

from pathlib import Path
from typing import Any

import matplotlib as mpl

from fluid_sim_ros.output.new_file import new_file

_MARKERS = {'Euler': 'o', 'implicitfast': 's', 'RK4': '^', 'implicit': 'D'}


def draw_against(result: dict[str, Any], path: Path) -> Path:
    """
    Draw the error to the flight and the discretisation against processor time.

    Parameters
    ----------
    result
        As ``chart_against`` returns it.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    mpl.use('Agg')
    from matplotlib import pyplot as plt
    from matplotlib.ticker import NullFormatter

    figure, axes = plt.subplots(1, 2, figsize=(11.5, 4.8), layout='constrained')
    colours = plt.get_cmap('viridis')
    names = list(result['rungs'])
    for place, name in enumerate(names):
        colour = colours(place / max(1, len(names) - 1) * 0.9)
        mine = [p for p in result['points'] if p['rung'] == name]
        for integrator in sorted({p['integrator'] for p in mine}):
            rows = sorted((p for p in mine if p['integrator'] == integrator),
                          key=lambda p: p['cpu_us_per_s'])  # fmt: skip
            style = {'marker': _MARKERS.get(integrator, 'x'), 'color': colour, 'markersize': 5}
            label = name if integrator == mine[0]['integrator'] else None
            costs = [p['cpu_us_per_s'] for p in rows]
            axes[0].loglog(costs, [p['position_m'] for p in rows], '-', label=label, **style)
            if place == len(names) - 1:
                axes[1].loglog(costs, [p['discretisation']['position_m'] for p in rows], '-',
                               label=f'discretisation, {integrator}', **style)  # fmt: skip
    gap = result['rungs'][names[-1]]['position_m']
    axes[1].axhline(gap, color='tab:red', linestyle='--', label='gap of the model to the flight')
    axes[0].axhline(result['hold_velocity']['position_m'], color='0.5', linestyle=':',
                    label='velocity held')  # fmt: skip
    horizon = result['horizon_s']
    axes[0].set_title('error to the flight by rung (each with those before it)', fontsize=10)
    axes[1].set_title(f'rung "{names[-1]}": timestep against the gap', fontsize=10)
    for axis in axes:
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.set_xlabel('processor time for each simulated second [us]')
        axis.set_ylabel(f'position after {horizon:g} s, median [m]')
        axis.grid(alpha=0.3, which='both')
        axis.legend(fontsize=8)
    log = Path(result['log']).name
    figure.suptitle(
        f'{result["model"]} against {log}: {result["windows"]} windows, '
        'circles Euler, squares implicitfast, triangles RK4', fontsize=10,
    )  # fmt: skip
    with new_file(path) as file:
        figure.savefig(file, dpi=110)
    plt.close(figure)
    return path
