# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Throughput of a sweep on threads against bare stepping.

Short runs of the ROV, each with a current of its own, by `fluid_sim sweep` with its table, against
`mj_step(model, data, n)` of such runs in one thread per core (each with its own model and data; a
thread takes the next runs when it has done some). 10,000 runs each, several times; the median
counts. Target: 0.9 of bare stepping.

Sweep and bare stepping are two processes that take turns of a quarter of a second, one stopped
while the other runs, so that a processor whose speed wanders is as fast for the one as for the
other.
"""

import multiprocessing
import os
import resource
import signal
import statistics
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from pathlib import Path

import mujoco
import numpy as np

from benchmarks.common import arguments, write
from fluid_sim_ros import Simulation
from fluid_sim_ros.sweep.run_sweep import run_sweep
from fluid_sim_ros.sweep.sweep_file import SweepFile

_SECONDS = 1.0
_SCENE = 'rov'
#: Runs that a thread of bare stepping takes at a time.
_CHUNK = 10
#: Length of a turn [s].
_TURN = 0.25


def bare(workers: int) -> Callable[[int], None]:
    """Return what flies so many runs by bare stepping."""
    simulations = [Simulation(_SCENE) for _ in range(workers)]
    steps = round(_SECONDS / simulations[0].timestep)

    def sweep_runs(runs: int) -> None:
        chunks = iter(range(0, runs, _CHUNK))

        def loop(simulation: Simulation) -> None:
            for begin in chunks:
                random = np.random.default_rng(begin)
                for _ in range(min(_CHUNK, runs - begin)):
                    # the motions of the sweep: elsewhere a step may cost more, or less
                    simulation.reset()
                    simulation.set_current([random.normal(0.0, 0.5), 0.0, 0.0])
                    mujoco.mj_step(simulation.model, simulation.data, steps)

        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(loop, simulations))

    return sweep_runs


def swept(workers: int) -> Callable[[int], None]:
    """Return what flies so many runs by a sweep, its table included."""

    def sweep_runs(runs: int) -> None:
        sweep = SweepFile.model_validate({
            'scene': _SCENE, 'duration': _SECONDS, 'sample_rate': 5, 'runs': runs,
            'vary': {'current.x': {'normal': [0, 0.5]}},
        })  # fmt: skip
        with tempfile.TemporaryDirectory() as folder:
            result = run_sweep(sweep, Path(folder), workers=workers)
        if result['status'] != {'ok': runs}:
            raise SystemExit(f'runs ended badly: {result["status"]}')

    return sweep_runs


def child(
    prepare: Callable[[int], Callable[[int], None]], workers: int, runs: int, pipe: Connection
) -> None:
    """Get ready, wait for the start, fly, and tell the processor time [s]."""
    sweep_runs = prepare(workers)
    sweep_runs(20)  # imports, caches
    pipe.send('ready')
    pipe.recv()
    before = resource.getrusage(resource.RUSAGE_SELF)
    sweep_runs(runs)
    after = resource.getrusage(resource.RUSAGE_SELF)
    pipe.send(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def take_turns(workers: int, runs: int) -> tuple[list[float], list[float]]:
    """Return wall and processor time [s] of bare stepping and of the sweep."""
    context = multiprocessing.get_context('spawn')
    processes, pipes = [], []
    for prepare in (bare, swept):
        ours, theirs = context.Pipe()
        process = context.Process(target=child, args=(prepare, workers, runs, theirs))
        process.start()
        ours.recv()  # ready
        os.kill(process.pid, signal.SIGSTOP)
        ours.send('go')
        processes.append(process)
        pipes.append(ours)
    wall, cpu = [0.0, 0.0], [0.0, 0.0]
    flying = [0, 1]
    try:
        while flying:
            for i in list(flying):
                os.kill(processes[i].pid, signal.SIGCONT)
                begin = time.perf_counter()
                done = pipes[i].poll(_TURN)
                wall[i] += time.perf_counter() - begin
                if done:
                    cpu[i] = pipes[i].recv()
                    flying.remove(i)
                else:
                    os.kill(processes[i].pid, signal.SIGSTOP)
    finally:
        for process in processes:
            os.kill(process.pid, signal.SIGCONT)
            process.join()
    return wall, cpu


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'sweep_throughput')
    runs, rounds = (1000, 1) if options.quick else (10_000, 3)
    workers = os.cpu_count() or 1
    steps = round(_SECONDS / Simulation(_SCENE).timestep)
    walls, cpus = zip(*(take_turns(workers, runs) for _ in range(rounds)), strict=True)
    ratios = [bare_s / swept_s for bare_s, swept_s in walls]
    ratio = statistics.median(ratios)
    bare_us, swept_us = (1e6 * statistics.median(c[i] for c in cpus) / runs for i in (0, 1))
    print(
        f'{ratio:.3f} of bare stepping on {workers} threads (of {rounds} times: '
        f'{min(ratios):.3f} to {max(ratios):.3f}); processor time of a run: {swept_us:.0f} us, '
        f'bare {bare_us:.0f} us'
    )
    write(
        options.json,
        {
            'target_ratio': 0.9,
            'ratio': ratio,
            'ratios': ratios,
            'runs': runs,
            'steps_per_run': steps,
            'workers': workers,
            'bare_cpu_us_per_run': bare_us,
            'sweep_cpu_us_per_run': swept_us,
            'bare_steps_per_s': [runs * steps / wall[0] for wall in walls],
            'sweep_steps_per_s': [runs * steps / wall[1] for wall in walls],
            # own processor time over that of all cores: below 1 by waiting, or where others ran
            'bare_cores_had': [c[0] / w[0] / workers for c, w in zip(cpus, walls, strict=True)],
            'sweep_cores_had': [c[1] / w[1] / workers for c, w in zip(cpus, walls, strict=True)],
        },
    )


if __name__ == '__main__':
    main()
