# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Charts as one interactive HTML file."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros.lab.charts.pareto import judged
from fluid_sim_ros.lab.drawing.colors import INTEGRATOR_COLORS, rung_colors
from fluid_sim_ros.output.html_page import write_page

_TEMPLATE = Path(__file__).with_name('chart.html')
#: Logarithmic axes end here.
_LEAST = 1e-16
_REAL_TIME = 1e6  # [us per simulated second]


def write_chart_page(results: Sequence[dict[str, Any]], path: Path) -> Path:
    """
    Write charts into one interactive HTML page.

    Parameters
    ----------
    results
        Charts, as ``measure`` returns them.
    path
        HTML file to write.

    Returns
    -------
    Path
        The file.

    """
    title = 'Speed against accuracy: ' + ', '.join(result['problem'] for result in results)
    return write_page(_TEMPLATE, title, [_chart(result) for result in results], path)


def _chart(result: dict[str, Any]) -> dict[str, Any]:
    by, colors = result['judged_by'], rung_colors(list(result['rungs']))
    total = _plot(
        f'error against the reference: {by}', result['points'],
        lambda p: (f'{p["rung"]}, {p["integrator"]}', colors[p['rung']]),
        lambda p: judged(p, by),
    )  # fmt: skip
    total['floors'] = [
        {'color': colors[rung], 'y': facts['model_error']}
        for rung, facts in result['rungs'].items()
        if facts['model_error']
    ]
    plots = [total]
    richest = list(result['rungs'])[-1]
    if not result['sensitivity']['chaotic']:
        plots.append(
            _plot(
                f'{richest}: error by the timestep, after {result["discretisation_at_s"]:g} s',
                [p for p in result['points'] if p['rung'] == richest],
                lambda p: (p['integrator'], INTEGRATOR_COLORS[p['integrator']]),
                lambda p: p['discretisation'],
            )
        )
    about = f'{result["stands_for"]}. {result["duration_s"]:g} s; reference: {result["reference"]}'
    if result.get('note'):
        about += f'. {result["note"]}'
    return {'title': result['title'], 'about': about, 'plots': plots}


def _plot(
    title: str,
    points: Sequence[dict[str, Any]],
    series: Callable[[dict[str, Any]], tuple[str, str]],
    error: Callable[[dict[str, Any]], float | None],
) -> dict[str, Any]:
    """Return a plot: points grouped by ``series`` (name, color), with ``error`` upward."""
    lines: dict[str, dict[str, Any]] = {}
    for point in points:
        name, color = series(point)
        line = lines.setdefault(name, {'name': name, 'color': color, 'points': []})
        height = error(point)
        line['points'].append({
            'x': point['cpu_us_per_s'],
            'y': None if height is None else max(height, _LEAST),
            'front': point['pareto'],
            'text': _text(point, height),
        })  # fmt: skip
    return {
        'title': title, 'xlabel': 'processor time per simulated second [µs]',
        'real_time': _REAL_TIME,
        'series': list(lines.values()), 'floors': [],
    }  # fmt: skip


def _text(point: dict[str, Any], error: float | None) -> str:
    setting = f'{point["rung"]}, {point["integrator"]}, {point["timestep_s"] * 1e3:g} ms'
    cost = (
        f'{point["cpu_us_per_s"]:.4g} µs per s '
        f'(quartiles {point["cpu_quartile_low_us_per_s"]:.4g}, '
        f'{point["cpu_quartile_high_us_per_s"]:.4g}; wall {point["wall_us_per_s"]:.4g})'
    )
    outcome = point['fault'] or ('no converged run' if error is None else f'error {error:.3g}')
    return f'{setting}: {cost}, {outcome}'
