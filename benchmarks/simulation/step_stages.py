# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What of MuJoCo's step each scene takes, and in how long blocks: no timing, the same everywhere.

Every scene as it is written, stages after its first steps (``Simulation.stages``). Blocks are the
steps of one call of the compiled library: in ``Simulation.step(1000)``, gaits and events of the
scene included, and in a run with watchdogs, as ``fluid_sim run`` has them.
"""

from typing import Any

import mujoco

from benchmarks.common import arguments, write
from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.loop.watchdogs import Watchdogs

STEPS, FLEET_STEPS = 1000, 100
LARGE = 20  # bodies, beyond which fewer steps say enough


def shortest_block(simulation: Simulation, *, watched: bool) -> int:
    """Return the fewest steps of a compiled call, the last one aside."""
    steps = FLEET_STEPS if simulation.model.nbody > LARGE else STEPS
    taken: list[int] = []
    step = simulation._engine_step

    def counted(n: int, tick: int) -> int:
        taken.append(n)
        return step(n, tick)

    simulation._engine_step = counted  # type: ignore[method-assign]
    if watched:
        Runner(simulation, NoSource(), [Watchdogs(simulation)], Pacing()).run(until=steps)
    else:
        simulation.step(steps)
    simulation._engine_step = step  # type: ignore[method-assign]
    return min(taken[:-1], default=taken[-1])


def describe(scene: str) -> dict[str, Any]:
    """Return what a scene takes."""
    simulation = Simulation(scene)
    alone = shortest_block(simulation, watched=False)
    stages = simulation.stages()
    simulation.reset()
    integrator = mujoco.mjtIntegrator(simulation.model.opt.integrator).name
    return {
        'integrator': integrator.removeprefix('mjINT_'),
        'whole': stages.whole,
        'contacts': stages.contacts,
        'without_contacts': stages.without_contacts,
        'constraints': stages.constraints,
        'geoms': f'{stages.moved_geoms} of {stages.geoms}',
        'moments_by_tree': stages.moments_by_tree,
        'fluid_by_chain': stages.fluid_by_chain,
        'gaits': list(simulation.scene.gait),
        'block': alone,
        'block_of_a_run': shortest_block(simulation, watched=True),
    }


def table(result: dict[str, Any]) -> str:
    """Return the stages as a table in Markdown."""
    names = (
        'contacts', 'other constraints', 'geoms at every evaluation', 'moments', "MuJoCo's fluid",
        'gait',
        'steps a call', 'steps a call in a run',
    )  # fmt: skip
    lines = [f'| Scene | {" | ".join(names)} |', '|---' * (len(names) + 1) + '|']
    for scene, row in result['scenes'].items():
        contacts = row['contacts']
        if contacts == 'watched':
            contacts += ', off now' if row['without_contacts'] else ', on now'
        cells = (
            row['whole'] or contacts,
            'always' if row['constraints'] else 'none',
            row['geoms'],
            'by tree' if row['moments_by_tree'] else "MuJoCo's",
            'by chain' if row['fluid_by_chain'] else '',
            'compiled' if row['gaits'] else '',
            str(row['block']),
            str(row['block_of_a_run']),
        )
        lines.append(f'| {scene} | {" | ".join(cells)} |')
    return '\n'.join(lines)


def main() -> None:
    """Describe every scene and write the result."""
    options = arguments(__doc__, 'step_stages')
    result = {'scenes': {scene: describe(scene) for scene in scene_names()}}
    print(table(result))
    write(options.json, result)


if __name__ == '__main__':
    main()
