# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How ``fluid_sim chart`` and ``fluid_sim advise`` show what they found."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli.shared import unbroken

#: So many lines on what was not tried; all of them are in the JSON.
_MOST = 6
#: Processor time of a simulated second.
_COST = 'µs per s'


def fronts_table(
    found: Sequence[dict[str, Any]], files: Sequence[Path], lines: Sequence[str] = ()
) -> Any:
    """
    Return the Pareto fronts as tables, one for each problem.

    Parameters
    ----------
    found
        Results of charts.
    files
        What was written.
    lines
        What else a reader must know.

    Returns
    -------
    renderable
        For rich.

    """
    from rich.console import Group
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab.charts.pareto import judged

    tables: list[Any] = []
    for result in found:
        by = result['judged_by']
        title = f'{escape(result["problem"])}: Pareto front by {by} error'
        table = Table('rung', 'integrator', 'timestep', _COST, 'error', title=title)
        front = [point for point in result['points'] if point['pareto']]
        for point in sorted(front, key=lambda p: float(p['cpu_us_per_s'])):
            table.add_row(
                escape(point['rung']), point['integrator'], _ms(point['timestep_s']),
                f'{point["cpu_us_per_s"]:.4g}', f'{judged(point, by):.3g}',
            )  # fmt: skip
        tables.append(table)
        if result.get('note'):
            tables.append(escape(f'Note: {result["note"]}.'))
    return Group(*tables, unbroken(files), escape('\n'.join(lines)))


def _ms(seconds: float) -> str:
    return f'{seconds * 1e3:.3g} ms'


def advice_table(advice: dict[str, Any], asked: str) -> Any:
    """
    Return the candidates as a table and the choice in words; ``asked`` is the metric's name.

    Parameters
    ----------
    advice
        Result of ``lab.advise``.
    asked
        Name of the metric that the user asked for.

    Returns
    -------
    renderable
        For rich.

    """
    from rich.console import Group
    from rich.markup import escape
    from rich.table import Table

    table = Table(
        'fluid', 'integrator', 'timestep', 'error', _COST, 'fails at',
        title=f'{advice["scene"]}: within {advice["tolerance"]:g} ({advice["metric"]}), '
        'cheapest first',
    )  # fmt: skip
    for each in advice['candidates']:
        known, tried = each['fails_at_s'], each['tried_to_s']
        fails = _ms(known) if known else f'> {_ms(tried)}' if tried > each['timestep'] else ''
        table.add_row(
            each['rung'], each['integrator'], _ms(each['timestep']),
            f'{each["error"]:.2g}', f'{each["cpu_us_per_s"]:.4g}', fails,
        )  # fmt: skip
    return Group(table, escape('\n'.join(_lines(advice, asked))), unbroken(advice['written']))


def _lines(advice: dict[str, Any], asked: str) -> list[str]:
    from fluid_sim_ros.lab.advisor.advice import snippet

    lines = []
    if advice['note']:
        lines.append(f'Note: {advice["note"]}.')
    if advice['metric'] != asked:
        lines.append('The motion forgets its start: judged by its regime, not point by point.')
    lines += _left_out(advice['not_tried'])
    choice, baseline = advice['choice'], advice['baseline']
    if choice is None:
        return [*lines, f'Nothing meets {advice["tolerance"]:g}: {advice["missing"]}']
    bound = 'at least ' if choice['margin_is_a_bound'] else ''
    return [
        *lines,
        f'{advice["cheaper_than_baseline"]:.3g} times cheaper than RK4 at '
        f'{baseline["timestep"] * 1e3:g} ms with everything on; '
        f'{bound}{choice["margin"]:.3g} times below the step at which it fails.',
        snippet(advice),
        *(['Written:'] if advice['written'] else []),
    ]


def _left_out(rows: list[dict[str, Any]]) -> list[str]:
    """Return what a budget or a model's own error left out; dearer settings go without saying."""
    lines = []
    for row in rows:
        if 'evaluations' in row['why']:
            continue
        named = ', '.join(filter(None, (row['rung'], row['integrator'])))
        if row['from_timestep']:
            named += f', {row["from_timestep"] * 1e3:g} ms and less'
        lines.append(f'Not tried: {named} ({row["why"]}).')
    more = len(lines) - _MOST
    return lines if more <= 0 else [*lines[:_MOST], f'and {more} more (--json).']
