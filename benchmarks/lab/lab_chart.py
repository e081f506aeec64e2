# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Speed against accuracy of the laboratory's problems: charts, tables, orders, Pareto fronts.

Every problem of lab/problems/catalogue.py, charted twice: errors must be the same to the bit, and
Pareto fronts, which rest on measured times, the same set. Errors take minutes and do not mind a
busy machine; times are measured after all of them, by a process for each of the two charts (the
second keeps the first one's factor within which costs are equal while no ratio is near it), and
with ``--times`` anew for errors that are there already (in out/lab_chart). Writes JSON, and for
the full volume a picture and a CSV per problem (of the second chart). Run: ``python -m
benchmarks.lab.lab_chart [--quick] [--times] [--json PATH] [--only NAME ...]``.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarks.common import RESULTS, ROOT, arguments, write
from fluid_sim_ros.lab import results
from fluid_sim_ros.lab.charts.cost import ROUNDS
from fluid_sim_ros.lab.charts.pareto import judged
from fluid_sim_ros.lab.drawing.chart import draw
from fluid_sim_ros.lab.problems.catalogue import PROBLEMS

SETTING = ('rung', 'integrator', 'timestep_s')
QUICK = ('kirchhoff', 'spin_down')
QUICK_OPTIONS = ('--timesteps', '0.02', '0.01', '0.005')
TIMES = 'measure times only, of errors that are in out/lab_chart'
STOCK = ('none', 'inertia', 'ellipsoid')


def chart(*words: str) -> None:
    """Run ``fluid_sim chart`` in a process of its own."""
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'chart', *words, '--json', os.devnull]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def errors_of(names: Sequence[str], folder: Path, options: Sequence[str]) -> None:
    """Chart problems into a folder, with times that do not count."""
    for name in names:
        chart(name, *options, '--rounds', '1', '--out', str(folder))


def times_of(names: Sequence[str], folder: Path, rounds: int) -> dict[str, dict[str, Any]]:
    """Return the charts of a folder with their times measured."""
    files = [str(folder / f'{name}.json') for name in names]
    chart('--from', *files, '--time-again', '--rounds', str(rounds), '--out', str(folder))
    return {name: results.load(folder / f'{name}.json', 'points') for name in names}


def front(result: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the Pareto front, cheapest first."""
    points = [point for point in result['points'] if point['pareto']]
    return [
        {
            **{key: point[key] for key in SETTING},
            'cpu_us_per_s': point['cpu_us_per_s'],
            'wall_us_per_s': point['wall_us_per_s'],
            'error': judged(point, result['judged_by']),
        }
        for point in sorted(points, key=lambda p: float(p['cpu_us_per_s']))
    ]


def summary(result: dict[str, Any]) -> dict[str, Any]:
    """Return a chart without its points (those are in its CSV)."""
    kept = {key: value for key, value in result.items() if key != 'points'}
    failed = [point for point in result['points'] if point['status'] == 'failed']
    best: dict[str, float] = {}
    for point in result['points']:
        error = judged(point, result['judged_by'])
        if error is not None:
            best[point['rung']] = min(error, best.get(point['rung'], error))
    return {
        **kept, 'settings': len(result['points']), 'failed': len(failed),
        'smallest_error': best, 'front': front(result),
    }  # fmt: skip


def agreement(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Return whether two charts of a problem agree, and where their fronts differ."""
    keys = (*SETTING, 'error', 'discretisation', 'status', 'fault')
    fronts = [{tuple(p[key] for key in SETTING) for p in front(each)} for each in (first, second)]
    return {
        'errors_the_same_to_the_bit': [
            [point[key] for key in keys] for point in first['points']
        ] == [[point[key] for key in keys] for point in second['points']],
        'fronts_the_same': fronts[0] == fronts[1],
        'on_one_front_only': sorted(map(list, fronts[0] ^ fronts[1])),
        'on_both': len(fronts[0] & fronts[1]),
        'clear_by': [each['same_cost']['clear'] for each in (first, second)],
    }  # fmt: skip


def main() -> None:
    """Measure, print, write JSON, pictures and tables."""
    options = arguments(__doc__, 'lab_chart', list(PROBLEMS), flags={'times': TIMES})
    names = options.only or (QUICK if options.quick else list(PROBLEMS))
    out: dict[str, Any] = {'charts': {}, 'twice': {}}
    if options.only and options.json.exists():
        before = json.loads(options.json.read_text(encoding='utf-8'))
        out = {key: before[key] for key in out}
    folders = [ROOT / 'out' / 'lab_chart' / run for run in ('first', 'second')]
    begin = time.perf_counter()
    if not options.times:
        for folder in folders:
            errors_of(names, folder, QUICK_OPTIONS if options.quick else ())
    timed_from = time.perf_counter()
    rounds = 10 if options.quick else ROUNDS
    first = times_of(names, folders[0], rounds)
    for name in names:  # one chart, measured again: the factor of equal costs is known
        again = results.load(folders[1] / f'{name}.json', 'points')
        results.save(again | {'same_cost': first[name]['same_cost']}, folders[1] / f'{name}.json')
    second = times_of(names, folders[1], rounds)
    spent = {'errors': timed_from - begin, 'times': time.perf_counter() - timed_from}
    for name, result in second.items():
        out['charts'][name] = summary(result)
        out['twice'][name] = agreement(first[name], result)
        print(f'{name}: orders {result["orders"][list(result["rungs"])[-1]]}')
        print(f'  smallest errors {out["charts"][name]["smallest_error"]} {result["judged_by"]}')
        print(f'  two runs: {out["twice"][name]}', flush=True)
        if not options.quick:
            draw(result, RESULTS / f'lab_chart_{name}.png')
            results.write_csv(result, RESULTS / f'lab_chart_{name}.csv')
    best = out['charts']['kirchhoff']['smallest_error']
    agreed = out['twice'].values()
    write(options.json, {
        'kirchhoff_stock_best_m': min(best[rung] for rung in STOCK),
        'kirchhoff_ours_best_m': best['+ added inertia'],
        'errors_the_same_to_the_bit': all(row['errors_the_same_to_the_bit'] for row in agreed),
        'fronts_the_same': all(row['fronts_the_same'] for row in agreed),
        'spent_s': spent,
        **out,
    })  # fmt: skip


if __name__ == '__main__':
    main()
