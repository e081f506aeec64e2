"""
Throughput of a sweep on threads against bare stepping.

Short runs of the ROV, each with a current of its own, by `fluid_sim sweep` with its table,
against `mj_step(model, data, n)` of such runs in one thread per core (each with its own model and
data; a thread takes the next runs when it has done some). 20,000 runs each, in rounds that
alternate, so that a noisy machine disturbs both alike; the ratio is that of the medians. Target:
0.9 of bare stepping.

What the sweep itself costs is stated apart, as processor time per run beyond bare stepping.
"""

import os
import resource
import statistics
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
from common import arguments, write

from fluid_sim_ros import Simulation
from fluid_sim_ros.lab.sweep.conduct import conduct
from fluid_sim_ros.lab.sweep.sweep_file import SweepFile

_SECONDS = 1.0
_SCENE = 'rov'
#: Runs that a thread of bare stepping takes at a time.
_CHUNK = 10


class Cost(NamedTuple):
    """Wall and processor time of some runs [s]."""

    wall: float
    cpu: float


def cost_of(work: Callable[[], object]) -> Cost:
    """Return what a call takes, all threads of this process counted."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    cpu, wall = usage.ru_utime + usage.ru_stime, time.perf_counter()
    work()
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return Cost(time.perf_counter() - wall, usage.ru_utime + usage.ru_stime - cpu)


def bare(simulations: list[Simulation], runs: int, steps: int) -> Cost:
    """Return the cost of bare stepping on threads."""
    chunks = iter(range(0, runs, _CHUNK))

    def loop(simulation: Simulation) -> None:
        for begin in chunks:
            random = np.random.default_rng(begin)
            for _ in range(min(_CHUNK, runs - begin)):
                # the motions of the sweep: elsewhere a step may cost more, or less
                simulation.reset()
                simulation.set_current([random.normal(0.0, 0.5), 0.0, 0.0])
                mujoco.mj_step(simulation.model, simulation.data, steps)

    with ThreadPoolExecutor(len(simulations)) as pool:
        return cost_of(lambda: list(pool.map(loop, simulations)))


def swept(workers: int, runs: int) -> Cost:
    """Return the cost of a sweep, its table included."""
    sweep = SweepFile.model_validate({
        'scene': _SCENE, 'duration': _SECONDS, 'sample_rate': 5, 'runs': runs,
        'vary': {'current.x': {'normal': [0, 0.5]}},
    })  # fmt: skip
    result = {}
    with tempfile.TemporaryDirectory() as folder:
        cost = cost_of(lambda: result.update(conduct(sweep, Path(folder), workers=workers)))
    if result['status'] != {'ok': runs}:
        raise SystemExit(f'runs ended badly: {result["status"]}')
    return cost


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'sweep_throughput')
    runs, rounds = (200, 2) if options.quick else (2500, 8)
    workers = os.cpu_count() or 1
    simulations = [Simulation(_SCENE) for _ in range(workers)]
    steps = round(_SECONDS / simulations[0].timestep)
    bare(simulations, 50, steps)
    swept(workers, 50)  # imports, caches
    walls: list[tuple[Cost, Cost]] = []
    for turn in range(rounds):
        if turn % 2:
            second, first = swept(workers, runs), bare(simulations, runs, steps)
        else:
            first, second = bare(simulations, runs, steps), swept(workers, runs)
        walls.append((first, second))
    ratios = [a.wall / b.wall for a, b in walls]
    ratio = statistics.median(a.wall for a, _ in walls) / statistics.median(
        b.wall for _, b in walls
    )
    low, _, high = statistics.quantiles(ratios, n=4)
    extra = statistics.median(b.cpu - a.cpu for a, b in walls) / runs
    print(
        f'{ratio:.3f} of bare stepping on {workers} threads (half of the rounds {low:.3f} to '
        f'{high:.3f}); {1e6 * extra:.0f} us of processor time per run beyond it'
    )
    write(
        options.json,
        {
            'target_ratio': 0.9,
            'ratio': ratio,
            'ratio_quartiles': [low, high],
            'ratios': ratios,
            'runs': runs * rounds,
            'rounds': rounds,
            'steps_per_run': steps,
            'workers': workers,
            'extra_cpu_us_per_run': 1e6 * extra,
            'bare_cpu_us_per_run': 1e6 * statistics.median(a.cpu for a, _ in walls) / runs,
            'bare_steps_per_s': [runs * steps / a.wall for a, _ in walls],
            'sweep_steps_per_s': [runs * steps / b.wall for _, b in walls],
            # own processor time over what the threads could have had: below 1 where others ran
            'bare_cores_had': [a.cpu / a.wall / workers for a, _ in walls],
            'sweep_cores_had': [b.cpu / b.wall / workers for _, b in walls],
        },
    )


if __name__ == '__main__':
    main()
