"""
Throughput of ``Simulation.step(10)`` as a share of a bare ``mj_step(m, d, 10)`` loop.

Both are timed in turns in one run, so that a noisy machine disturbs them alike; the ratio is that
of the medians. Target: 0.9 or more.
"""

import statistics

import mujoco

from benchmarks.common import arguments, wall_seconds, write
from fluid_sim_ros import Simulation

SCENES = ('sphere', 'rov')
STEPS_PER_CALL = 10


def measure(scene: str, rounds: int, calls: int) -> dict[str, float]:
    """Return microseconds per step of both loops and the ratio of their throughputs."""
    simulation = Simulation(scene)
    model, data = simulation.model, mujoco.MjData(simulation.model)

    def bare() -> None:
        for _ in range(calls):
            mujoco.mj_step(model, data, STEPS_PER_CALL)

    def watched() -> None:
        for _ in range(calls):
            simulation.step(STEPS_PER_CALL)

    times: dict[str, list[float]] = {'bare': [], 'watched': []}
    for _ in range(rounds):
        times['bare'].append(wall_seconds(bare))
        times['watched'].append(wall_seconds(watched))
    per_step = {
        name: statistics.median(values) / (calls * STEPS_PER_CALL) * 1e6
        for name, values in times.items()
    }
    return {
        'bare_us_per_step': per_step['bare'],
        'simulation_us_per_step': per_step['watched'],
        'throughput_ratio': per_step['bare'] / per_step['watched'],
    }


def main() -> None:
    """Measure every scene and write the result."""
    options = arguments(__doc__, 'step_overhead')
    rounds, calls = (10, 100) if options.quick else (60, 300)
    scenes = {scene: measure(scene, rounds, calls) for scene in SCENES}
    for scene, row in scenes.items():
        print(f'{scene}: {row["throughput_ratio"]:.3f} of a bare loop')
    write(options.json, {'target_ratio': 0.9, 'scenes': scenes})


if __name__ == '__main__':
    main()
