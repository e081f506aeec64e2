"""
Speed against accuracy of the laboratory's problems: charts, tables, orders, Pareto fronts.

Every problem of lab/catalogue.py, measured as ``fluid_sim chart`` does. Errors are repeatable to
the bit: the Kirchhoff body is measured twice, and compared; so are the two Pareto fronts, which
rest on processor times. Writes JSON, and for the full volume a picture and a CSV per problem.
Run: ``python benchmarks/lab_chart.py [--quick] [--json PATH] [--only NAME ...]``.
"""

import json
from typing import Any

from common import RESULTS, arguments, write

from fluid_sim_ros.lab.catalogue import PROBLEMS, problem
from fluid_sim_ros.lab.chart import draw
from fluid_sim_ros.lab.measure import measure
from fluid_sim_ros.lab.pareto import judged
from fluid_sim_ros.lab.results import write_csv

SETTING = ('rung', 'integrator', 'timestep_s')
QUICK = ('kirchhoff', 'spin_down')
STEPS = (0.02, 0.01, 0.005)  # of the quick volume and of the comparison [s]
STOCK = ('none', 'inertia', 'ellipsoid')


def front(result: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the Pareto front, cheapest first."""
    points = [point for point in result['points'] if point['pareto']]
    return [
        {
            **{key: point[key] for key in SETTING},
            'cpu_us_per_s': point['cpu_us_per_s'],
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


def twice() -> dict[str, Any]:
    """Return whether two charts of the Kirchhoff body agree: errors to the bit, and the front."""
    first, second = (measure(problem('kirchhoff'), timesteps=STEPS) for _ in range(2))
    keys = (*SETTING, 'error', 'discretisation', 'status')
    same = all(
        a[key] == b[key]
        for a, b in zip(first['points'], second['points'], strict=True)
        for key in keys
    )
    fronts = [
        {tuple(point[key] for key in SETTING) for point in front(result)}
        for result in (first, second)
    ]
    return {
        'errors_the_same_to_the_bit': same,
        'fronts': [sorted(map(list, points)) for points in fronts],
        'fronts_the_same': fronts[0] == fronts[1],
    }


def main() -> None:
    """Measure, print, write JSON, pictures and tables."""
    options = arguments(__doc__, 'lab_chart', list(PROBLEMS))
    charts: dict[str, Any] = {}
    if options.only and options.json.exists():
        charts = json.loads(options.json.read_text(encoding='utf-8'))['charts']
    for name in options.only or (QUICK if options.quick else PROBLEMS):
        result = measure(
            problem(name), timesteps=STEPS if options.quick else (),
            repeats=1 if options.quick else 2,
        )  # fmt: skip
        charts[name] = summary(result)
        print(f'{name}: orders {result["orders"][list(result["rungs"])[-1]]}', flush=True)
        for rung, error in charts[name]['smallest_error'].items():
            print(f'  {rung:26} smallest error {error:.2g} {result["judged_by"]}')
        if not options.quick:
            draw(result, RESULTS / f'lab_chart_{name}.png')
            write_csv(result, RESULTS / f'lab_chart_{name}.csv')
        write(options.json, {'charts': charts})  # what is done stays, whatever comes next
    best = charts['kirchhoff']['smallest_error']
    agree = twice()
    print('two runs:', agree)
    out = {
        'kirchhoff_stock_best_m': min(best[rung] for rung in STOCK),
        'kirchhoff_ours_best_m': best['+ added inertia'],
        'twice': agree,
        'charts': charts,
    }
    write(options.json, out)


if __name__ == '__main__':
    main()
