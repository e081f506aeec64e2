# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Result files of the laboratory: JSON that charts are drawn from, and CSV for other programs."""

import csv
import json
import os
import platform
import re
from pathlib import Path
from typing import Any

import mujoco

from fluid_sim_ros import __version__
from fluid_sim_ros.errors import ConfigError, printable
from fluid_sim_ros.lab.charts.pareto import judged
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import check_limit, limit

#: A problem's name becomes that of files.
_NAME = re.compile(r'\w[\w .+-]{0,199}')


def save(result: dict[str, Any], path: Path) -> Path:
    """
    Write a result as JSON.

    Parameters
    ----------
    result
        What to write.
    path
        File to write; its folder is made where it is not there.

    Returns
    -------
    Path
        The file.

    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with new_file(path) as file:
        file.write_text(json.dumps(result, indent=1, allow_nan=False) + '\n', encoding='utf-8')
    return path


def load(path: Path, key: str) -> dict[str, Any]:
    """
    Read a result that holds ``key``.

    Parameters
    ----------
    path
        JSON file.
    key
        That the result must have.

    Returns
    -------
    dict
        The result.

    Raises
    ------
    ConfigError
        If the file cannot be read or is something else.

    """
    try:
        with open_data(path) as file:
            text = file.read(limit('result_bytes') + 1)
        check_limit('result_bytes', len(text), f'{path}: size')
        result = json.loads(text)
    except (OSError, ValueError, RecursionError) as error:
        reason = printable(' '.join(str(error).split()))
        raise ConfigError(f'{path}: cannot be read as a result ({reason})') from None
    if not isinstance(result, dict) or key not in result:
        raise ConfigError(f"{path}: is no result of this kind: it has no '{key}'")
    name = result.get('problem')
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ConfigError(
            f"{path}: key 'problem': must be a name that files can have: letters, digits, _ . -"
        )
    return result


def write_csv(result: dict[str, Any], path: Path) -> Path:
    """
    Write the points of a chart, one row each.

    Parameters
    ----------
    result
        A chart, as ``measure`` returns it.
    path
        File to write.

    Returns
    -------
    Path
        The file.

    """
    fields = (
        'rung', 'integrator', 'timestep_s', 'status', 'cpu_us_per_s', 'cpu_quartile_low_us_per_s',
        'cpu_quartile_high_us_per_s', 'wall_us_per_s', 'wall_quartile_low_us_per_s',
        'wall_quartile_high_us_per_s', 'error', 'discretisation', 'pareto', 'failed_at_s', 'fault',
    )  # fmt: skip
    names = sorted({name for point in result['points'] for name in point['error'] or ()})
    with new_file(path) as made, made.open('w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file)
        writer.writerow([*fields, *names])
        for point in result['points']:
            row = point | {'error': judged(point, result['judged_by'])}
            every = point['error'] or {}
            writer.writerow([*(row[f] for f in fields), *(every.get(name) for name in names)])
    return path


def conditions() -> dict[str, Any]:
    """Return what times depend on."""
    return {
        'fluid_sim_ros': __version__,
        'mujoco': mujoco.__version__,
        'python': platform.python_version(),
        'architecture': platform.machine(),
        'cores': os.cpu_count(),
    }
