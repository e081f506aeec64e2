# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Where a step's time goes: shares of MuJoCo's stages, of a bare ``mj_step`` loop of each scene.

By MuJoCo's own timers (``mjData.timer``), whose clock is part of what they time: a stage of many
short timings looks larger than it is. Passive forces hold the fluid and its plugins; where these
factor the inertia matrix, both have that time. The rest is the integrator's own work beside
evaluations, and checks. Every scene as it is written, from its first state, the fastest of many
short rounds.
"""

from typing import Any

import mujoco
import numpy as np

from benchmarks.common import arguments, write
from fluid_sim_ros import Simulation, scene_names

TIMER = mujoco.mjtTimer
#: Stage -> the timers that add up to it.
STAGES = {
    'kinematics': (TIMER.mjTIMER_POS_KINEMATICS,),
    'inertia': (TIMER.mjTIMER_POS_INERTIA,),
    'collision': (TIMER.mjTIMER_POS_COLLISION,),
    'constraints': (
        TIMER.mjTIMER_POS_MAKE, TIMER.mjTIMER_POS_PROJECT, TIMER.mjTIMER_CONSTRAINT,
    ),
    'velocity, passive': (TIMER.mjTIMER_VELOCITY,),
    'actuation': (TIMER.mjTIMER_ACTUATION,),
    'integration': (TIMER.mjTIMER_ADVANCE,),
}  # fmt: skip


def measure(scene: str, integrator: str, rounds: int, steps: int) -> dict[str, float]:
    """Return the share of each stage, of the fastest round."""
    simulation = Simulation(scene, integrator=integrator)
    model, data = simulation.model, simulation.data
    if model.nbody > 20:
        steps = max(1, steps // 10)
    least, out = np.inf, dict.fromkeys(STAGES, 0.0)
    for _ in range(rounds):
        simulation.reset()
        for timer in data.timer:
            timer.duration = 0.0
        mujoco.mj_step(model, data, steps)
        whole = data.timer[TIMER.mjTIMER_STEP].duration
        if whole >= least:
            continue
        least = whole
        for name, timers in STAGES.items():
            out[name] = sum(data.timer[i].duration for i in timers) / whole
    return {**out, 'rest': max(0.0, 1 - sum(out.values()))}


def table(result: dict[str, Any]) -> str:
    """Return the shares [%] as a table in Markdown."""
    names = [*STAGES, 'rest']
    lines = [
        f'| Scene | Integrator | {" | ".join(names)} |', '|---|---' + '|---' * len(names) + '|',
    ]  # fmt: skip
    for scene, rows in result['scenes'].items():
        for integrator, row in rows.items():
            cells = ' | '.join(f'{100 * row[name]:.0f}' for name in names)
            lines.append(f'| {scene} | {integrator} | {cells} |')
    return '\n'.join(lines)


def main() -> None:
    """Measure every scene and write the result."""
    options = arguments(__doc__, 'step_profile')
    rounds, steps = (20, 20) if options.quick else (200, 30)
    scenes: dict[str, dict[str, dict[str, float]]] = {}
    for scene in scene_names():
        own = mujoco.mjtIntegrator(Simulation(scene).model.opt.integrator).name
        name = 'RK4' if own.endswith('RK4') else 'implicitfast'
        scenes[scene] = {name: measure(scene, name, rounds, steps)}
    print(table({'scenes': scenes}))
    write(options.json, {'scenes': scenes})


if __name__ == '__main__':
    main()
