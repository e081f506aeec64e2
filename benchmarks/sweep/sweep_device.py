# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Sweeps on a device against the processor: error of single precision, and throughput.

Error: the same runs by mujoco_warp as worlds in single precision, and by MuJoCo in double
precision: three scenes of stock fluid forces, with flows, thrust and masses that vary. Stated for
each column: the largest difference, and the same over the largest value of its kind (position,
attitude, velocity, rate). Target: 1e-3.

Throughput: worlds times steps per second of one sweep on the device (after a first one, for which
kernels are compiled) against a sweep of the same scene on threads, one per core. `--device` names
the device; without it the first GPU is taken, or where there is none Warp's own processor device,
which is no GPU: its throughput says nothing of one.
"""

import os
import statistics
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.common import arguments, write
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.compare import against_cpu
from fluid_sim_ros.sweep.run_sweep import run_sweep
from fluid_sim_ros.sweep.sweep_file import SweepFile
from fluid_sim_ros.sweep.warp_device import PRECISION, WarpDevice

_SWEEPS: dict[str, dict[str, Any]] = {
    'sphere': {
        'scene': 'sphere',
        'vary': {'current.x': {'normal': [0, 1]}, 'mass.sphere': {'uniform': [0.8, 1.5]}},
    },
    'quadrotor': {
        'scene': 'quadrotor',
        'vary': {
            'wind.x': {'normal': [0, 4]}, 'wind.y': {'normal': [0, 4]},
            'mass.x500': {'uniform': [0.8, 1.2]}, 'thrust.x500': {'uniform': [0.7, 1]},
        },
    },
    'rov_ellipsoid': {
        'scene': 'rov', 'fluid': 'ellipsoid',
        'vary': {
            'current.x': {'normal': [0, 0.5]}, 'thrust.bluerov2_heavy': {'uniform': [0, 0.5]},
        },
    },
}  # fmt: skip
#: Time that suffices for every kernel to run [s].
_WARM_UP = 0.01
#: The scene whose throughput is measured.
_TIMED = 'quadrotor'


def sweep_rows(keys: dict[str, Any], **how: Any) -> tuple[dict[str, Any], Any]:
    """Return the result of a sweep, and its table."""
    import pyarrow.parquet as pq

    with tempfile.TemporaryDirectory() as folder:
        result = run_sweep(SweepFile.model_validate(keys), Path(folder), **how)
        return result, pq.read_table(result['table'])


def error_of(keys: dict[str, Any], device: str, runs: int, seconds: float) -> dict[str, Any]:
    """Return how far the device is from the processor, in all runs."""
    keys = {**keys, 'runs': runs, 'duration': seconds, 'seed': 1}
    _, table = sweep_rows(keys, device=device)
    check = against_cpu(CaseRunner(SweepFile.model_validate(keys)), table, most=runs)
    return {'duration_s': seconds, **check}


def throughput(device: str, worlds: int, rounds: int, seconds: float) -> dict[str, Any]:
    """Return steps per second on the device and on threads, in rounds that alternate."""
    # without masses: threads would compile a model for each run, which is another question
    vary = {k: v for k, v in _SWEEPS[_TIMED]['vary'].items() if not k.startswith('mass.')}
    keys = {**_SWEEPS[_TIMED], 'vary': vary, 'runs': worlds, 'duration': seconds}
    simulation_steps = CaseRunner(SweepFile.model_validate(keys)).check()
    on = {'device': {'device': device, 'workers': worlds}, 'threads': {}}
    sweep_rows({**keys, 'duration': _WARM_UP}, **on['device'])  # kernels are compiled
    walls: dict[str, list[float]] = {name: [] for name in on}
    for _ in range(rounds):
        for name, how in on.items():
            walls[name].append(sweep_rows(keys, **how)[0]['wall_s'])
    speed = {name: worlds * simulation_steps / statistics.median(w) for name, w in walls.items()}
    return {
        'scene': _TIMED,
        'worlds': worlds,
        'steps_per_run': simulation_steps,
        'device_steps_per_s': speed['device'],
        'threads_steps_per_s': speed['threads'],
        'threads': os.cpu_count(),
        'device_over_threads': speed['device'] / speed['threads'],
        'wall_s': walls,
    }


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'sweep_device', more={'device': 'device of Warp'})
    wp = WarpDevice('cpu').wp
    name = options.device or ('cuda:0' if wp.is_cuda_available() else 'cpu')
    device = wp.get_device(name)
    runs, seconds, rounds = (4, 0.2, 1) if options.quick else (32, 2.0, 3)
    errors = {title: error_of(keys, name, runs, seconds) for title, keys in _SWEEPS.items()}
    worst = {title: error['largest_relative'] for title, error in errors.items()}
    print('largest relative difference: ' + ', '.join(f'{k} {v:.2g}' for k, v in worst.items()))
    worlds = (4096 if device.is_cuda else 256) // (16 if options.quick else 1)
    timed = throughput(name, worlds, rounds, seconds / 4)
    print(f'{timed["device_over_threads"]:.3g} times the threads of this machine, on {device}')
    write(
        options.json,
        {
            'device': str(device),
            'device_name': device.name if device.is_cuda else 'processor',
            'is_gpu': bool(device.is_cuda),
            'precision': PRECISION,
            'warp': wp.__version__,
            'target_relative': 1e-3,
            'largest_relative': worst,
            'errors': errors,
            'throughput': timed,
        },
    )


if __name__ == '__main__':
    main()
