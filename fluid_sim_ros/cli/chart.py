"""``fluid_sim chart``: speed against accuracy of problems and scenes."""

import argparse
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli.lab_tables import fronts_table
from fluid_sim_ros.cli.shared import Show, add_command, progress_of_parts
from fluid_sim_ros.errors import ConfigError

#: Timesteps of a quick chart [s].
_QUICK = (0.02, 0.01, 0.005, 0.002)


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``chart`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'chart speed against accuracy of a problem or scene'
    chart = add_command(commands, 'chart', text, _chart, show)
    chart.add_argument(
        'problem', metavar='PROBLEM', nargs='*',
        help='problems or scenes; all: every problem; none: list them',
    )  # fmt: skip
    chart.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/chart'))
    chart.add_argument('--integrators', nargs='+', metavar='NAME', help='default: all five')
    chart.add_argument('--timesteps', nargs='+', type=float, metavar='S', help='[s]')
    chart.add_argument(
        '--rounds', type=int, default=60, help='timed bursts of steps per curve (default 60)'
    )
    chart.add_argument('--quick', action='store_true', help='four timesteps, ten bursts')
    chart.add_argument(
        '--from', dest='saved', nargs='+', type=Path, metavar='JSON',
        help='draw results of an earlier chart again, without running',
    )  # fmt: skip
    chart.add_argument(
        '--time-again', action='store_true',
        help='with --from: measure the times anew, on this machine, and keep the errors',
    )  # fmt: skip


def _chart(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.drawing.chart import draw
    from fluid_sim_ros.lab.drawing.chart_page import write_chart_page

    if arguments.time_again and not arguments.saved:
        raise ConfigError('--time-again: needs --from JSON, the charts to time')
    if arguments.saved:
        found = [results.load(path, 'points') for path in arguments.saved]
        if arguments.time_again:
            found = _timed_again(found, 10 if arguments.quick else arguments.rounds)
    elif arguments.problem:
        found = _measured(arguments)
    else:
        return _list_problems(arguments, show)
    folder: Path = arguments.out
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for result in found:
        stem = folder / result['problem']
        files += [
            results.save(result, stem.with_suffix('.json')),
            results.write_csv(result, stem.with_suffix('.csv')),
            draw(result, stem.with_suffix('.png')),
        ]
    files.append(write_chart_page(found, folder / 'chart.html'))
    show(
        arguments.json,
        fronts_table(found, files),
        {'charts': found, 'files': [str(file) for file in files]},
    )
    return 0


def _measured(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    from fluid_sim_ros.lab.charts.measure import measure
    from fluid_sim_ros.lab.problems.catalogue import PROBLEMS, problem
    from fluid_sim_ros.lab.problems.problem import INTEGRATORS

    names = list(PROBLEMS) if arguments.problem == ['all'] else arguments.problem
    problems = [problem(name) for name in names]
    with progress_of_parts() as report:
        return [
            measure(
                each,
                integrators=arguments.integrators or INTEGRATORS,
                timesteps=arguments.timesteps or (_QUICK if arguments.quick else ()),
                rounds=10 if arguments.quick else arguments.rounds,
                report=report,
            )
            for each in problems
        ]


def _timed_again(found: list[dict[str, Any]], rounds: int) -> list[dict[str, Any]]:
    from fluid_sim_ros.lab.charts.measure import time_again
    from fluid_sim_ros.lab.problems.catalogue import problem

    with progress_of_parts() as report:
        return [
            time_again(each, problem(each['problem']), rounds=rounds, report=report)
            for each in found
        ]


def _list_problems(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab.problems.catalogue import PROBLEMS

    table = Table('problem', 'what moves', 'stands for', title='Problems (every scene is one too)')
    rows = []
    for name, make in PROBLEMS.items():
        each = make()
        rows.append({'name': name, 'title': each.title, 'stands_for': each.stands_for})
        table.add_row(name, escape(each.title), escape(each.stands_for))
    show(arguments.json, table, rows)
    return 0
