# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Speed at equal error of this package, stock MuJoCo, JSBSim, RotorPy, drone-models and SciPy.

Four tasks of 5 s, the same for all, in one run: a fall with quadratic drag, hover thrust on a
rolling vehicle, forward flight with rotor drag (closed forms), and a BlueROV2 Heavy in a current
(DOP853 of Fossen's equations). Each simulator hands out the position every second, so that steps
of up to 1 s count; the error is the largest distance from the reference. Time is that of the
processor, of stepping alone: medians over repeats in mixed order. Needs the extra ``peers``.

Not the same: JSBSim's planet is round (its reference too); RotorPy and SciPy choose their steps
themselves, the timestep or tolerance only bounds them; fluid_sim and MuJoCo take all steps between
two positions in one call, JSBSim and RotorPy need one call from Python for each step. drone-models
has equations alone, for arrays of vehicles: RK4 in numpy steps them, 1 or 100 at once, and the
time is that of one.
"""

import random
import statistics
import time
from collections.abc import Iterable, Sequence
from importlib.metadata import version
from importlib.util import find_spec
from itertools import pairwise
from typing import Any

import numpy as np

from benchmarks.common import arguments, write
from benchmarks.peers.peer_mujoco import own_runs, stock_runs
from benchmarks.peers.peer_tasks import (
    DURATION,
    TASKS,
    TIMES,
    AirTask,
    Run,
    air_rates,
    air_start,
    scipy_runs,
)
from benchmarks.peers.peer_underwater import underwater_runs
from fluid_sim_ros.errors import DivergedError

PEERS = ('jsbsim', 'rotorpy', 'drone_models')
TARGETS = (1e-3, 1e-6)  # errors at which times are compared [m]
_LEAST_WALL = 0.02  # of one timing: short runs are repeated [s]
_MOST_RUNS = 20


class Ladder:
    """Timesteps [s] and tolerances of a comparison."""

    def __init__(self, quick: bool) -> None:
        steps = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 5e-3, 2e-3, 1e-3, 5e-4)
        self.timesteps = (0.1, 0.01) if quick else steps
        self.rotorpy = (0.1,) if quick else steps[:5]
        self.drone_models = (0.1,) if quick else steps[1:8]
        self.tolerances = (
            (1e-3, 1e-6) if quick else (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12)
        )
        self.repeats = 1 if quick else 3


def missing() -> str:
    """Return one line that says what to install, or nothing."""
    names = [name for name in PEERS if find_spec(name) is None]
    if not names:
        return ''
    return f"{', '.join(names)} not installed; type: pip install 'fluid_sim_ros[peers]'"


def air_runs(task: AirTask, ladder: Ladder) -> list[Run]:
    """Return the runs of every contestant at a task in air."""
    from benchmarks.peers.peer_drone_models import drone_models_runs
    from benchmarks.peers.peer_jsbsim import jsbsim_runs
    from benchmarks.peers.peer_rotorpy import rotorpy_runs

    return [
        *own_runs(task, ladder.timesteps),
        *stock_runs(task, ladder.timesteps),
        *jsbsim_runs(task, ladder.timesteps),
        *rotorpy_runs(task, ladder.rotorpy),
        *drone_models_runs(task, ladder.drone_models),
        *scipy_runs(air_start(task), air_rates(task), task.reference(TIMES), ladder.tolerances),
    ]


def point(run: Run) -> dict[str, Any]:
    """Return a run's error, or when it diverged."""
    found: dict[str, Any] = {'peer': run.peer, 'setting': run.setting}
    try:
        apart = np.linalg.norm(run.prepare()() - run.reference, axis=1)
    except DivergedError as end:
        return found | {'error_m': None, 'diverged_at_s': end.time}
    return found | {'error_m': float(apart.max()), 'diverged_at_s': None}


def timing(run: Run) -> tuple[float, float]:
    """Return processor and wall time per simulated second [us]."""
    processor = wall = 0.0
    count = 0
    while wall < _LEAST_WALL and count < _MOST_RUNS:
        count += 1
        simulate = run.prepare()
        begin, begin_wall = time.process_time(), time.perf_counter()
        simulate()
        processor += time.process_time() - begin
        wall += time.perf_counter() - begin_wall
    scale = 1e6 / (count * DURATION * run.vehicles)
    return processor * scale, wall * scale


def compare(runs: Sequence[Run], repeats: int) -> dict[str, Any]:
    """Return errors and times of runs, and the times at equal error."""
    points = [point(run) for run in runs]
    good = [i for i, found in enumerate(points) if found['error_m'] is not None]
    shuffled = random.Random(1)
    times: dict[int, list[tuple[float, float]]] = {i: [] for i in good}
    for _ in range(repeats):
        for i in shuffled.sample(good, len(good)):
            times[i].append(timing(runs[i]))
    for i in good:
        processor, wall = zip(*times[i], strict=True)
        points[i] |= {
            'us_per_s': statistics.median(processor),
            'us_per_s_range': [min(processor), max(processor)],
            'wall_us_per_s': statistics.median(wall),
        }
    return {
        'points': points,
        'time_at': {f'{target:g}': times_at(points, target) for target in TARGETS},
    }


def times_at(points: Iterable[dict[str, Any]], target: float) -> dict[str, Any]:
    """
    Return each contestant's time at an error [us per simulated second], fastest first.

    Interpolated in the logarithms; ``bound`` says that its coarsest setting is better already;
    None: not reached.
    """
    curves: dict[str, list[tuple[float, float]]] = {}
    for found in points:
        curve = curves.setdefault(found['peer'], [])
        if found['error_m'] is not None:
            curve.append((found['us_per_s'], max(found['error_m'], 1e-16)))
    out = {peer: _crossing(sorted(curve), target) for peer, curve in curves.items()}
    order = sorted(out, key=lambda peer: (out[peer] or {'us_per_s': np.inf})['us_per_s'])
    return {peer: out[peer] for peer in order}


def _crossing(curve: Sequence[tuple[float, float]], target: float) -> dict[str, Any] | None:
    if curve and curve[0][1] <= target:
        return {'us_per_s': curve[0][0], 'bound': True}
    for (cost, error), (next_cost, next_error) in pairwise(curve):
        if next_error <= target:
            share = np.log(error / target) / np.log(error / next_error)
            return {'us_per_s': float(cost * (next_cost / cost) ** share), 'bound': False}
    return None


def table(result: dict[str, Any]) -> str:
    """Return the times at equal error as a table in Markdown, the fastest of a column bold."""
    tasks = result['tasks']
    columns = [
        (f'{task["title"]}, {target} m', row, lost(task))
        for task in tasks.values()
        for target, row in task['time_at'].items()
    ]
    peers = dict.fromkeys(peer for task in tasks.values() for peer in sorted(peers_of(task)))
    lines = [
        'Processor time per simulated second [us] at an error; "<": the coarsest run is better.\n',
        '| | ' + ' | '.join(title for title, _, _ in columns) + ' |',
        '|---' * (len(columns) + 1) + '|',
    ]
    for peer in peers:
        cells = ['diverges' if peer in off else _cell(peer, row) for _, row, off in columns]
        lines.append(f'| {peer} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines) + '\n'


def peers_of(task: dict[str, Any]) -> set[str]:
    """Return who takes part in a task."""
    return {found['peer'] for found in task['points']}


def lost(task: dict[str, Any]) -> set[str]:
    """Return who diverges at every setting."""
    return peers_of(task) - {p['peer'] for p in task['points'] if p['error_m'] is not None}


def _cell(peer: str, row: dict[str, Any]) -> str:
    if peer not in row:
        return ''
    if not row[peer]:
        return 'not reached'
    cost = ('< ' if row[peer]['bound'] else '') + f'{row[peer]["us_per_s"]:.0f}'
    return f'**{cost}**' if peer == next(iter(row)) else cost


def measure(quick: bool) -> dict[str, Any]:
    """Return the whole comparison."""
    ladder = Ladder(quick)
    tasks = {}
    for make in TASKS:
        task = make()
        tasks[task.name] = {'title': task.title} | compare(air_runs(task, ladder), ladder.repeats)
        print(f'{task.name}: done')
    runs = underwater_runs(ladder.timesteps, ladder.tolerances)
    tasks['underwater'] = {'title': 'BlueROV2 Heavy in a current'} | compare(runs, ladder.repeats)
    return {
        'versions': {name: version(name) for name in (*PEERS, 'numpy', 'scipy')},
        'repeats': ladder.repeats,
        'duration_s': DURATION,
        'tasks': tasks,
    }


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__, 'peer_simulators')
    if line := missing():
        raise SystemExit(f'peer_simulators: {line}')
    from benchmarks.peers.peer_picture import draw

    result = measure(options.quick)
    print(table(result))
    write(options.json, result)
    draw(result, options.json.with_suffix('.png'))


if __name__ == '__main__':
    main()
