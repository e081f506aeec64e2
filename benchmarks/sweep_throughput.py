"""
Throughput of a sweep on threads against bare stepping.

The same number of steps: 10,000 runs of the ROV with a current of their own each, against
``mj_step(model, data, n)`` of such runs in one thread per core (each with its own data).
Several rounds in turn; the medians count. Target: 0.9 of bare stepping.
"""

import os
import statistics
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import mujoco
import numpy as np
from common import arguments, write

from fluid_sim_ros import Simulation
from fluid_sim_ros.lab.sweep.conduct import conduct
from fluid_sim_ros.lab.sweep.sweep_file import SweepFile

_SECONDS = 1.0
_SCENE = 'rov'


def bare(workers: int, runs: int, steps: int) -> float:
    """Return steps per second of bare stepping on threads."""
    simulations = [Simulation(_SCENE) for _ in range(workers)]

    def loop(simulation: Simulation) -> None:
        random = np.random.default_rng(1)
        for _ in range(runs // workers):
            # the motions of the sweep: elsewhere a step may cost more, or less
            simulation.reset()
            simulation.set_current([random.normal(0.0, 0.5), 0.0, 0.0])
            mujoco.mj_step(simulation.model, simulation.data, steps)

    with ThreadPoolExecutor(workers) as pool:
        begin = time.perf_counter()
        list(pool.map(loop, simulations))
        wall = time.perf_counter() - begin
    return runs // workers * workers * steps / wall


def swept(workers: int, runs: int, steps: int) -> float:
    """Return steps per second of a sweep, its table included."""
    sweep = SweepFile.model_validate({
        'scene': _SCENE, 'duration': _SECONDS, 'sample_rate': 5, 'runs': runs,
        'vary': {'current.x': {'normal': [0, 0.5]}},
    })  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        result = conduct(sweep, Path(folder), workers=workers)
    if result['status'] != {'ok': runs}:
        raise SystemExit(f'runs ended badly: {result["status"]}')
    return runs * steps / result['wall_s']


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'sweep_throughput')
    runs, rounds = (200, 2) if options.quick else (10_000, 3)
    workers = os.cpu_count() or 1
    steps = round(_SECONDS / Simulation(_SCENE).timestep)
    pairs = []
    for _ in range(rounds):
        pairs.append((bare(workers, runs, steps), swept(workers, runs, steps)))
    ratio = statistics.median(b / a for a, b in pairs)
    print(f'{ratio:.3f} of bare stepping on {workers} threads')
    write(
        options.json,
        {
            'target_ratio': 0.9,
            'ratio': ratio,
            'ratios': [b / a for a, b in pairs],
            'runs': runs,
            'steps_per_run': steps,
            'workers': workers,
            'bare_steps_per_s': [a for a, _ in pairs],
            'sweep_steps_per_s': [b for _, b in pairs],
        },
    )


if __name__ == '__main__':
    main()
