# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How far the runs of a device are from the same runs on the processor."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pyarrow as pa

from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.compiled_run import COLUMNS

#: Runs that are flown again.
_CHECKED = 8
#: Below this [m], [m/s], [rad/s] a vehicle is at rest, and a relative difference says nothing.
_AT_REST = 1e-3
_KINDS = {
    'position': ('x_m', 'y_m', 'z_m', 'farthest_m'),
    'attitude': ('qw', 'qx', 'qy', 'qz', 'largest_tilt_rad'),
    'velocity': ('vx_m_s', 'vy_m_s', 'vz_m_s', 'largest_speed_m_s'),
    'rate': ('wx_rad_s', 'wy_rad_s', 'wz_rad_s'),
}
_KIND_OF = {column: kind for kind, columns in _KINDS.items() for column in columns}


def against_cpu(runner: CaseRunner, table: pa.Table, most: int = _CHECKED) -> dict[str, Any]:
    """
    Fly some runs of a table again in double precision on the processor, and compare.

    Parameters
    ----------
    runner
        The sweep.
    table
        Its results from elsewhere, in the order of the runs.
    most
        How many runs, evenly spread over those that went through.

    Returns
    -------
    dict
        ``runs``, how many there were; ``difference``, the largest one of each column in its unit;
        ``relative``, the same over the largest value of its kind (position, attitude, velocity,
        rate) and vehicle, None at rest; ``largest_relative`` of all; ``status_differs``, how many
        ended otherwise on the processor.

    """
    sound = np.flatnonzero(np.array(table.column('status').to_pylist()) == 'ok')
    spread = np.unique(np.linspace(0, len(sound) - 1, most).astype(int))
    picked = sound[spread] if len(sound) else []
    theirs = [table.slice(int(i), 1).to_pylist()[0] for i in picked]
    ours = [runner.row(int(row['run'])) for row in theirs]
    pairs = [(a, b) for a, b in zip(theirs, ours, strict=True) if b['status'] == 'ok']
    difference, relative = {}, {}
    for name in table.column_names:
        vehicle, _, column = name.rpartition('.')
        if not pairs or column not in COLUMNS or not vehicle:
            continue
        size = max(abs(a[name] - b[name]) for a, b in pairs)
        scale = _scale(vehicle, _KIND_OF[column], [b for _, b in pairs])
        difference[name] = size
        relative[name] = size / scale if scale > _AT_REST else None
    stated = [share for share in relative.values() if share is not None]
    return {
        'runs': len(picked),
        'status_differs': len(picked) - len(pairs),
        'largest_relative': max(stated, default=None),
        'difference': difference,
        'relative': relative,
    }


def _scale(vehicle: str, kind: str, rows: list[Mapping[str, Any]]) -> float:
    if kind == 'attitude':
        return 1.0
    columns = [f'{vehicle}.{column}' for column in _KINDS[kind]]
    return max(abs(float(row[column])) for row in rows for column in columns)
