# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs a sweep to its end: cuts what is left into portions, and collects the rows."""

import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.sweep.case_runs import LARGEST_PORTION, CaseRunner
from fluid_sim_ros.sweep.compare import against_cpu
from fluid_sim_ros.sweep.results import Portion, Results, gaps, statistics
from fluid_sim_ros.sweep.sweep_file import SweepFile
from fluid_sim_ros.sweep.warp_worlds import WarpRuns
from fluid_sim_ros.sweep.workers import on_ray, on_threads

#: Most steps of a portion of more than one run: some tenths of a second of work.
_MOST_STEPS = 100_000
#: A portion is this part of a worker's share of what is left, so that all workers end together.
_PARTS_OF_SHARE = 4

#: Called after each finished portion, with the runs done so far and the number of all runs.
Report = Callable[[int, int], None]


def run_sweep(
    sweep: SweepFile,
    out: Path,
    *,
    workers: int | None = None,
    ray_address: str | None = None,
    device: str | None = None,
    report: Report = lambda done, total: None,
) -> dict[str, Any]:
    """
    Run a sweep to its end; what an earlier try left in ``out`` is kept.

    A run's numbers depend on its index only, so the rows are the same bits whoever flies them;
    except on a device, which has single precision.

    Parameters
    ----------
    sweep
        What is run.
    out
        Folder of the results.
    workers
        Threads, or Ray workers (default: one per core), or worlds at a time on a device.
    ray_address
        ``local`` starts Ray on this machine; else the address of a cluster on which this package
        is installed. None: threads.
    device
        Device of Warp (``cuda:0``, ``cpu``) on which mujoco_warp flies the runs as worlds.
    report
        Called after each portion.

    Returns
    -------
    dict
        Numbers of runs, wall time, how the runs ended, and the range of each column; for a device
        also how far some runs are from the processor's (``compare.against_cpu``).

    Raises
    ------
    ConfigError, MissingExtraError
        If the sweep does not fit its scene or the device, ``out`` holds another one, or Ray or the
        device is not there.

    """
    if workers is not None and workers < 1:
        raise ConfigError(f'--workers {workers}: must be 1 or more')
    if device is not None and ray_address is not None:
        raise ConfigError(f'--device {device} and --ray {ray_address}: choose one of them')
    runner = CaseRunner(sweep)
    steps = runner.check()
    worlds = None if device is None else WarpRuns(sweep, device, workers)
    results = Results(out, sweep, worlds.device.description if worlds else '')
    total = len(runner.cases)
    left = gaps(results.kept(), total)
    kept = done = total - sum(end - begin for begin, end in left)
    report(done, total)
    start = time.perf_counter()
    if worlds is not None:
        finished = worlds.portions(left)
        who: dict[str, Any] = {'worlds': worlds.most, 'device': worlds.device.description}
    else:
        workers = workers or os.cpu_count() or 1
        who = {'workers': workers}
        most = min(LARGEST_PORTION, max(1, _MOST_STEPS // steps))
        portions = _portions(left, workers, most)
        finished = (
            on_threads(sweep, portions, workers)
            if ray_address is None
            else on_ray(sweep, portions, workers, ray_address)
        )
    for rows in finished:
        results.add(rows)
        done += len(rows)
        report(done, total)
    table = results.finish()
    wall = time.perf_counter() - start
    result = {
        'scene': sweep.scene,
        'runs': total,
        'runs_kept_from_before': kept,
        **who,
        'wall_s': wall,
        'table': str(results.table_path),
        'warnings': list(runner.load_warnings),
        **statistics(table),
    }
    if worlds is not None:
        result['against_cpu'] = against_cpu(runner, table)
        result['warnings'] += [_NOT_WATCHED]
    return result


#: Said of every sweep on a device.
_NOT_WATCHED = (
    'no watchdog looks at runs on a device (energy, grids, limits of the engine), so the column '
    'warnings is empty; fly the same sweep without --device, or a part of it, to have them'
)


def _portions(left: Sequence[Portion], workers: int, most: int) -> list[Portion]:
    """Cut what is left into portions of ``most`` runs, and smaller ones at the end."""
    cut = []
    remaining = sum(end - begin for begin, end in left)
    for begin, end in left:
        while begin < end:
            share = remaining // (workers * _PARTS_OF_SHARE)
            size = min(max(1, share), most, end - begin)
            cut.append((begin, begin + size))
            begin += size
            remaining -= size
    return cut
