# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Stability maps over two parameters, kept point by point so that a run can go on."""

import itertools
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.lab.problems.bodies import AXES, Body, family
from fluid_sim_ros.lab.problems.problem import INTEGRATORS, known_integrators
from fluid_sim_ros.lab.results import conditions
from fluid_sim_ros.lab.stability.outcomes import OUTCOMES, outcome
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import check_limit, limit

Key = tuple[str, float, float]
#: What a cell of a file has besides its key.
_CELL = {'outcome', 'largest', 'last', 'reset_at_s', 'alarm'}


def plan(
    name: str,
    *,
    x: str = '',
    y: str = '',
    x_range: Sequence[float] = (),
    y_range: Sequence[float] = (),
    cells: int = 24,
    integrators: Sequence[str] = INTEGRATORS,
    fixed: Mapping[str, float] | None = None,
) -> dict[str, Any]:
    """
    Return what a map runs over, ready for JSON: the head of its file.

    Parameters
    ----------
    name
        One of FAMILIES.
    x, y
        Axes of the map, of AXES; empty: those of the family.
    x_range, y_range
        Lowest and highest value; empty: those of the axis.
    cells
        Per axis.
    integrators
        Names of integrators.
    fixed
        Parameters that stay the same, by name of AXES.

    Returns
    -------
    dict
        What ``run_map`` takes.

    Raises
    ------
    ConfigError
        For an unknown problem, axis or integrator, or a range that is not rising.

    """
    kind = family(name)
    axes = {'x': x or kind.x, 'y': y or kind.y}
    ranges = {}
    for key, given in (('x', x_range), ('y', y_range)):
        axis = axes[key]
        if axis not in AXES:
            hint = did_you_mean(axis, AXES)
            raise ConfigError(f"axis '{axis}' is not known{hint} allowed: {listed(AXES)}")
        low, high = given or (AXES[axis].low, AXES[axis].high)
        if not 0 < low < high < np.inf:
            raise ConfigError(f'range of {axis}: {low:g} {high:g}; allowed: 0 < low < high')
        ranges[key] = [float(low), float(high)]
    if axes['x'] == axes['y']:
        raise ConfigError(f"both axes are '{axes['x']}'; give two different ones")
    if cells < 1:
        raise ConfigError(f'{cells} cells per axis: must be at least 1')
    integrators = known_integrators(integrators)
    kind.body.with_values(fixed or {})
    return {
        'problem': name, **axes, 'x_range': ranges['x'], 'y_range': ranges['y'], 'cells': cells,
        'integrators': integrators, 'fixed': dict(fixed or {}),
    }  # fmt: skip


def values(head: Mapping[str, Any], axis: str) -> list[float]:
    """
    Return the values of an axis of a map, ``x`` or ``y``: middles of its cells.

    Parameters
    ----------
    head
        Of the map.
    axis
        ``x`` or ``y``.

    Returns
    -------
    list
        In the unit of the axis, rising; logarithmically spaced.

    """
    low, high = np.log(head[f'{axis}_range'])
    middles = (np.arange(head['cells']) + 0.5) / head['cells']
    return [float(f'{value:.9g}') for value in np.exp(low + (high - low) * middles)]


def run_map(
    head: Mapping[str, Any],
    path: Path,
    *,
    restart: bool = False,
    report: Report = silent,
) -> dict[str, Any]:
    """
    Run the cells of a map that its file does not have yet; return the whole map.

    The file has the head in its first line and one line per cell, written as the cell is done.

    Parameters
    ----------
    head
        As ``plan`` returns it.
    path
        File that keeps the cells.
    restart
        Whether to forget what the file has.
    report
        Told how far it is.

    Returns
    -------
    dict
        The head, the cells as ``map``, and what times depend on.

    Raises
    ------
    ConfigError
        If the file is that of another map.

    """
    planned = list(itertools.product(head['integrators'], values(head, 'x'), values(head, 'y')))
    cells = {} if restart else _kept(head, path, frozenset(planned))
    todo = [key for key in planned if key not in cells]
    path.parent.mkdir(parents=True, exist_ok=True)
    # the file is replaced in one move: a line that was cut off must not merge with the next one
    begun = path.with_suffix('.begun')
    lines = [dict(head), *(_row(key, cells[key]) for key in cells)]
    begun.write_text(''.join(json.dumps(line) + '\n' for line in lines), encoding='utf-8')
    begun.replace(path)
    total = len(todo) + len(cells)
    with path.open('a', encoding='utf-8') as file:
        for key in todo:
            report(f'{head["problem"]}: map', len(cells), total)
            cells[key] = _cell(head, *key)
            file.write(json.dumps(_row(key, cells[key])) + '\n')
            file.flush()
    rows = [_row(key, cells[key]) for key in sorted(cells)]
    return {**head, 'map': rows, 'conditions': conditions()}


def _row(key: Key, cell: Mapping[str, Any]) -> dict[str, Any]:
    return {'integrator': key[0], 'x': key[1], 'y': key[2], **cell}


def _kept(
    head: Mapping[str, Any], path: Path, planned: frozenset[Key]
) -> dict[Key, dict[str, Any]]:
    """Return the cells of an earlier run up to a line that was cut off, or is of no cell."""
    if not path.exists():
        return {}
    with open_data(path) as file:
        text = file.read(limit('result_bytes') + 1)
    check_limit('result_bytes', len(text), f'{path}: size')
    first, *lines = text.splitlines() or [b'']
    try:
        same = json.loads(first) == dict(head)
    except (ValueError, RecursionError):
        same = False
    if not same:
        raise ConfigError(f'{path}: is of another map; name another folder, or use --restart')
    cells = {}
    for line in lines:
        try:
            row = json.loads(line)
            key = str(row.pop('integrator')), float(row.pop('x')), float(row.pop('y'))
        except (ValueError, TypeError, LookupError, AttributeError, RecursionError, OverflowError):
            break  # what follows is computed again
        if key not in planned or set(row) != _CELL or row['outcome'] not in OUTCOMES:
            break
        cells[key] = row
    return cells


def _cell(head: Mapping[str, Any], integrator: str, x: float, y: float) -> dict[str, Any]:
    given = {**head['fixed'], head['x']: x, head['y']: y}
    found = outcome(body_at(head, given), integrator, given.get('timestep', 0.01))
    return {
        'outcome': found.word, 'largest': min(found.largest, 1e300),
        'last': min(found.last, 1e300), 'reset_at_s': found.reset_at, 'alarm': found.alarm,
    }  # fmt: skip


def body_at(head: Mapping[str, Any], given: Mapping[str, float]) -> Body:
    """
    Return the body of one cell of a map.

    Parameters
    ----------
    head
        Of the map.
    given
        Parameters of the cell, by name of AXES.

    Returns
    -------
    Body
        The body.

    """
    return family(head['problem']).body.with_values(given)
