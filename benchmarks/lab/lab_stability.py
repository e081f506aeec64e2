# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Where integration fails: boundaries that theory predicts, outcomes, watchdogs, maps.

The drag number x = h K |v|/(m + m_A) of each predicted boundary, measured by bisection of one
step; bodies on which one integrator fails and another survives, with what the watchdogs say of
each; 1,000 random runs that are stable by construction, in which no watchdog may speak up; maps.
Writes JSON, and for the full volume the maps of lab/problems/bodies.py.
Run: ``python -m benchmarks.lab.lab_stability [--quick] [--json PATH]``.
"""

from collections import Counter
from typing import Any

import numpy as np

from benchmarks.common import RESULTS, ROOT, arguments, write
from fluid_sim_ros.lab.drawing.stability_chart import draw_map
from fluid_sim_ros.lab.problems.bodies import FAMILIES, Body, family
from fluid_sim_ros.lab.problems.boundaries import EXPLICIT
from fluid_sim_ros.lab.problems.problem import INTEGRATORS
from fluid_sim_ros.lab.stability.false_alarms import random_run
from fluid_sim_ros.lab.stability.limits import largest_steps, measured_numbers
from fluid_sim_ros.lab.stability.outcomes import outcome
from fluid_sim_ros.lab.stability.stability_map import plan, run_map

#: A body, changes to it, and a timestep [s]: there one integrator fails, another does not.
SCENES: dict[str, tuple[str, dict[str, float], float]] = {
    'light sphere, stock drag': ('drag', {}, 0.01),
    'thin plate, stock drag': ('plate', {}, 0.01),
    'glycerol-like fluid': ('viscous', {'viscosity': 50.0}, 0.02),
    'tumbling, stock added-mass forces': ('stock_ideal', {}, 0.01),
    'tumbling, added mass 1.6 m': ('kirchhoff', {'added_mass_ratio': 1.6}, 0.01),
    'tumbling, added mass 10 m': ('kirchhoff', {'added_mass_ratio': 10.0}, 0.01),
    'tumbling with drag, added mass 10 m': ('tumbling_drag', {'added_mass_ratio': 10.0}, 0.05),
}
MAPS: dict[str, dict[str, Any]] = {
    'drag': {'x_range': (3e-4, 1.0)},
    'drag_added_mass': {'x_range': (3e-4, 1.0)},
    'stock_ideal': {'x_range': (1e-3, 0.2)},
    'kirchhoff': {'x_range': (1e-3, 0.2)},
    'tumbling_drag': {'x_range': (1e-3, 0.2)},
}
#: Fates that leave a state that looks sound, and MuJoCo's warnings silent.
SILENT = ('energy gain', 'energy loss', 'blow-up')
CELLS, RUNS = 14, 1000


def boundaries() -> dict[str, Any]:
    """Return predicted and measured drag numbers by family and integrator."""
    return {
        name: {kind: measured_numbers(each, kind) for kind in EXPLICIT}
        for name, each in FAMILIES.items()
        if each.drag
    }


def failures() -> dict[str, Any]:
    """Return the outcome of each integrator on each of SCENES."""
    out: dict[str, Any] = {}
    for name, (kind, changes, timestep) in SCENES.items():
        body = family(kind).body.with_values(changes)
        found = {each: outcome(body, each, timestep) for each in INTEGRATORS}
        words = {each: result.word for each, result in found.items()}
        out[name] = {
            'timestep_s': timestep,
            'outcomes': words,
            'one_fails_another_survives': len({'stable', *words.values()}) > 1
            and 'stable' in words.values(),
            'silent': [each for each, word in words.items() if word in SILENT],
            'silent_and_caught': [
                each for each, word in words.items() if word in SILENT and found[each].alarm
            ],
            'alarms': {each: result.alarm for each, result in found.items()},
        }
    return out


def false_alarms(runs: int) -> dict[str, Any]:
    """Return how many runs that are stable by construction were called something else."""
    rng = np.random.default_rng(2026)
    called, alarmed = 0, 0
    for _ in range(runs):
        body, integrator, timestep = random_run(rng)
        found = outcome(body, integrator, timestep)
        called += found.word != 'stable'
        alarmed += bool(found.alarm)
    return {'runs': runs, 'not_called_stable': called, 'alarms': alarmed}


def maps() -> dict[str, Any]:
    """Run and draw the maps; return how many cells have which outcome."""
    out: dict[str, Any] = {}
    for name, ranges in MAPS.items():
        head = plan(name, cells=CELLS, **ranges)
        result = run_map(head, ROOT / 'out' / 'lab_stability' / f'{name}.jsonl', restart=True)
        if family(name).drag:
            result['largest_steps'] = largest_steps(head)
        draw_map(result, RESULTS / f'lab_stability_{name}.png')
        out[name] = {
            kind: dict(
                Counter(row['outcome'] for row in result['map'] if row['integrator'] == kind)
            )
            for kind in INTEGRATORS
        }
        print(name, out[name])
    return out


def start_of(body: Body) -> dict[str, float]:
    """Return what a reader needs to know of a body."""
    return {'mass_kg': body.mass, 'added_mass_ratio': body.lightness, 'duration_s': body.duration}


def main() -> None:
    """Measure, print, write JSON and maps."""
    options = arguments(__doc__, 'lab_stability')
    out: dict[str, Any] = {
        'bodies': {name: start_of(each.body) for name, each in FAMILIES.items()},
        'boundaries': boundaries(),
        'failures': failures(),
        'false_alarms': false_alarms(50 if options.quick else RUNS),
    }
    by_kind = [rows for kinds in out['boundaries'].values() for rows in kinds.values()]
    worst = max(row['worst'] for rows in by_kind for row in rows.values())
    print(f'boundaries met within {worst:.2g}')
    for name, row in out['failures'].items():
        print(f'{name}: {row["outcomes"]}')
    print('false alarms:', out['false_alarms'])
    if not options.quick:
        out['maps'] = maps()
    write(options.json, out)


if __name__ == '__main__':
    main()
