# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A recorded flight beside the same one with a change."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.recording.damage import LogError, reading
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.pictures import plots as pictures
from fluid_sim_ros.recording.pictures.tracks import track_of
from fluid_sim_ros.recording.replay.resimulate import parse_changes, resimulate

_ODOMETRY = '/odom'


def compare_flights(log: Log, changes: Sequence[str], out: Path) -> dict[str, Any]:
    """
    Fly a log with a change, and draw both flights.

    Parameters
    ----------
    log
        The log.
    changes
        Texts ``KEY=VALUE``; see ``parse_changes``.
    out
        PNG file to write; a number is added for each further vehicle.

    Returns
    -------
    dict
        How far each vehicle is from its recorded flight [m], and when [s]; the plots; notes for
        the reader.

    Raises
    ------
    ConfigError, LogError
        For a wrong change, or a log without odometry or commands.

    """
    outcome = resimulate(log, changes=parse_changes(changes), keep=(_ODOMETRY,))
    if not outcome.pairs:
        raise LogError(f'{log.path}: no odometry in it, nothing to compare')
    differences, files = {}, []
    for number, (topic, pairs) in enumerate(outcome.pairs.items()):
        name, definition = topic.strip('/').removesuffix(_ODOMETRY), log.topic(topic).definition
        times = np.array([time_ns for time_ns, _, _ in pairs]) / 1e9
        with reading(log.path, f"topic '{topic}'"):
            recorded = track_of(name, times, definition, [old for _, old, _ in pairs])
            changed = track_of(name, times, definition, [new for _, _, new in pairs])
        apart = np.linalg.norm(changed.position_w - recorded.position_w, axis=1)
        if not np.isfinite(apart).all():
            raise LogError(f"{log.path}: topic '{topic}': positions that are not finite")
        path = out.with_stem(f'{out.stem}_{number}') if number else out
        files.append(str(pictures.both_flights(recorded, changed, ', '.join(changes), path)))
        largest = int(apart.argmax())
        differences[name] = {
            'largest_apart_m': float(apart[largest]),
            'largest_apart_at_s': float(times[largest]),
            'apart_at_end_m': float(apart[-1]),
        }
    return {
        'log': str(log.path), 'changes': list(changes), 'differences': differences,
        'notes': outcome.notes, 'plots': files,
    }  # fmt: skip
