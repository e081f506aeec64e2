# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Speed of ``Simulation.step(10)`` as a multiple of a bare ``mj_step(m, d, 10)`` loop.

Every scene as it is written, its gaits and events included, with RK4 and with implicitfast. The
loops are timed in turns in one run by the processor time of their thread, so that a busy machine
disturbs them little and alike; a ratio is the median of those of the turns. Each call of the bare
loop starts from the state and the controls that the simulation has at the begin of that call,
since a step in motion costs more than one at rest. It is timed twice: as ``import mujoco`` leaves
it, which reads the clock at every stage (``mjData.timer``), and without that clock. Targets: 1.15
or more where nothing touches and no constraint acts, .97 or more elsewhere.
"""

import ctypes
import json
import statistics
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from benchmarks.common import arguments, thread_seconds, write
from fluid_sim_ros import Simulation, scene_names

INTEGRATORS = ('RK4', 'implicitfast')
STEPS_PER_CALL = 10
STATE = mujoco.mjtState.mjSTATE_INTEGRATION
LIBRARY = ctypes.CDLL(str(Path(mujoco.__file__).parent / f'libmujoco.so.{mujoco.__version__}'))
LARGE = 20  # bodies, beyond which fewer calls say enough


@contextmanager
def clock(*, kept: bool) -> Iterator[None]:
    """Take MuJoCo's clock away for a while, unless it is kept."""
    pointer = ctypes.c_void_p.in_dll(LIBRARY, 'mjcb_time')
    was = pointer.value
    if not kept:
        pointer.value = None
    try:
        yield
    finally:
        pointer.value = was


def measure(scene: str, integrator: str, rounds: int, calls: int) -> dict[str, Any]:
    """Return microseconds per step of the loops, the ratios, and what is left out."""
    simulation = Simulation(scene, integrator=integrator)
    model, data = simulation.model, mujoco.MjData(simulation.model)
    if model.nbody > LARGE:
        calls = max(1, calls // 30)
    states = np.empty((calls, mujoco.mj_stateSize(model, STATE)))
    simulation.reset()
    for state in states:
        mujoco.mj_getState(model, simulation.data, state, STATE)
        simulation.step(STEPS_PER_CALL)
    step = partial(mujoco.mj_step, model, data, STEPS_PER_CALL)
    touched = False

    def bare() -> float:
        nonlocal touched
        seconds = 0.0
        for state in states:
            mujoco.mj_setState(model, data, state, STATE)
            seconds += thread_seconds(step)
            touched |= data.nefc > 0
        return seconds

    def own() -> float:
        simulation.reset()
        step = partial(simulation.step, STEPS_PER_CALL)
        return sum(thread_seconds(step) for _ in states)

    times: dict[str, list[float]] = {'bare': [], 'bare_without_clock': [], 'simulation': []}
    for _ in range(rounds):
        for name in ('bare', 'bare_without_clock'):
            with clock(kept=name == 'bare'):
                times[name].append(bare())
        times['simulation'].append(own())
    per_step = {
        name: statistics.median(values) / (calls * STEPS_PER_CALL) * 1e6
        for name, values in times.items()
    }

    def ratio(name: str) -> float:
        turns = zip(times[name], times['simulation'], strict=True)
        return statistics.median(other / ours for other, ours in turns)

    return {
        'free': not touched,
        'us_per_step': per_step,
        'throughput_ratio': ratio('bare'),
        'throughput_ratio_without_clock': ratio('bare_without_clock'),
    }


def main() -> None:
    """Measure every scene and write the result."""
    options = arguments(__doc__, 'step_overhead', scene_names())
    rounds, calls = (5, 20) if options.quick else (25, 50)
    found: dict[str, dict[str, Any]] = {}
    if options.only:
        found = json.loads(options.json.read_text(encoding='utf-8'))['scenes']
    for scene in options.only or scene_names():
        found[scene] = {name: measure(scene, name, rounds, calls) for name in INTEGRATORS}
        for name, row in found[scene].items():
            print(
                f'{scene:24s} {name:13s} {row["throughput_ratio"]:.2f} of a bare loop, '
                f'{row["throughput_ratio_without_clock"]:.2f} of one without clock'
                f'{"" if row["free"] else "; touches, or a constraint acts"}'
            )
    rows = [row for scene in found.values() for row in scene.values()]
    lowest = {
        key: min(row['throughput_ratio'] for row in rows if row['free'] == (key == 'free'))
        for key in ('free', 'other')
    }
    write(options.json, {'lowest_ratio': lowest, 'scenes': found})


if __name__ == '__main__':
    main()
