# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The advisor on every scene: what it chooses, what that costs, and whether a finer run agrees.

Each scene at a tolerance of 1 % and of 5 %. A choice is verified by an independent run with a
fourth of its step on the next richer rung. Cost is processor time per simulated second over that
of RK4 at 1 ms with everything on, both timed in one interleaved loop. A scene in which nothing
happens is refused, which is stated. Writes JSON, a table, and the advice at 1 % into each scene's
file, as its advised settings.
Run: ``python -m benchmarks.lab.lab_advise [--quick] [--json PATH] [--only NAME ...]``.
"""

import json
import time
from typing import Any

import numpy as np

from benchmarks.common import arguments, write
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.lab.advisor.advice import advised, verify
from fluid_sim_ros.lab.advisor.advise import advise
from fluid_sim_ros.lab.advisor.scene_settings import keep
from fluid_sim_ros.scene import scene_names

TOLERANCES = (0.01, 0.05)
SHIPPED = 0.01  # written into config/scenes
QUICK = ('sphere', 'ellipsoid')


def case(scene: str, tolerance: float) -> dict[str, Any]:
    """Return the advice for a scene, its verification, and the time it took."""
    begin, processor = time.perf_counter(), time.process_time()
    try:
        found = advise(scene, tolerance)
    except FluidSimError as error:
        return {
            'scene': scene, 'tolerance': tolerance, 'fault': str(error),
            'advise_wall_s': time.perf_counter() - begin,
            'advise_cpu_s': time.process_time() - processor,
        }  # fmt: skip
    row = {
        key: found[key]
        for key in (
            'scene', 'tolerance', 'metric', 'duration_s', 'note', 'reference', 'choice',
            'runner_up', 'baseline', 'cheaper_than_baseline', 'missing', 'not_tried',
        )
    }  # fmt: skip
    row |= {
        'advise_wall_s': time.perf_counter() - begin,
        'advise_cpu_s': time.process_time() - processor,
        'runs': len(found['tried']),
    }
    if found['choice']:
        row |= {'verified': verify(scene, found), 'advised': advised(found)}
    return row


def ship(row: dict[str, Any]) -> None:
    """Put the advice into the scene's file, beside the settings that are in force."""
    if row['tolerance'] == SHIPPED and 'advised' in row:
        keep(row['scene'], row['advised'])


def table(result: dict[str, Any]) -> str:
    """Return the choices of a result in Markdown."""
    lines = [
        '| Scene | Tolerance | Metric | Fluid | Integrator | Timestep | Error '
        '| Cheaper than RK4 at 1 ms | Fails at | Verified |',
        '|---' * 10 + '|',
    ]
    for row in result['rows']:
        head = f'| `{row["scene"]}` | {row["tolerance"]:.0%} | '
        choice = row.get('choice')
        if not choice:
            why = row.get('missing') or row['fault'].removeprefix(f'{row["scene"]}: ')
            if 'fault' not in row or row['tolerance'] == SHIPPED:  # refused at any tolerance
                lines.append(f'{head}| | | none: {why} | | | | |')
            continue
        verified = _percent(row['verified']['error'])
        limit = choice['margin'] * choice['timestep'] * 1e3
        bound = ('> ' if choice['margin_is_a_bound'] else '') + f'{limit:.3g} ms'
        lines.append(
            f'{head}{row["metric"]} | {choice["rung"]} | {choice["integrator"]} | '
            f'{choice["timestep"] * 1e3:g} ms | {_percent(choice["error"])} | '
            f'{row["cheaper_than_baseline"]:.3g} x | {bound} | {verified} |'
        )
    return '\n'.join(lines) + '\n'


def _percent(share: float | None) -> str:
    return 'lost' if share is None else f'{100 * share:.2g} %'


def main() -> None:
    """Advise, verify, print, write JSON and table."""
    options = arguments(__doc__, 'lab_advise', scene_names())
    rows = []
    if options.only and options.json.exists():
        rows = json.loads(options.json.read_text(encoding='utf-8'))['rows']
        rows = [row for row in rows if row['scene'] in set(scene_names()) - set(options.only)]
    for scene in options.only or (QUICK if options.quick else scene_names()):
        for tolerance in TOLERANCES:
            rows.append(case(scene, tolerance))
            if not options.quick:
                ship(rows[-1])
            print(table({'rows': rows[-1:]}).splitlines()[-1], flush=True)
    rows.sort(key=lambda row: (row['scene'], row['tolerance']))
    chosen = [row for row in rows if row.get('choice')]
    gains = [row['cheaper_than_baseline'] for row in chosen]
    summary = {
        'cases': len(rows),
        'with_a_choice': len(chosen),
        'refused': {row['scene']: row['fault'] for row in rows if 'fault' in row},
        'verified': sum(row['verified']['within'] for row in chosen),
        'cheaper_geometric_mean': float(np.exp(np.mean(np.log(gains)))),
        'cheaper_median': float(np.median(gains)),
        'longest_advise_wall_s': max(row['advise_wall_s'] for row in rows),
        'longest_advise_cpu_s': max(row['advise_cpu_s'] for row in rows),
    }
    print(summary)
    write(options.json, {'summary': summary, 'rows': rows})


if __name__ == '__main__':
    main()
