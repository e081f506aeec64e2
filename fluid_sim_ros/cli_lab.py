"""The subcommands of ``fluid_sim`` that belong to the laboratory."""

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli_shared import Show, needing_extra

if TYPE_CHECKING:
    from fluid_sim_ros.lab.measure import Report

#: Timesteps of a quick chart [s].
_QUICK = (0.02, 0.01, 0.005, 0.002)


def add_parsers(commands: Any, show: Show, json_help: str) -> None:
    """Add the subcommands to the parser of ``fluid_sim``."""

    def add(name: str, text: str, function: Callable[..., int]) -> argparse.ArgumentParser:
        parser: argparse.ArgumentParser = commands.add_parser(name, help=text, description=text)
        parser.add_argument('--json', metavar='PATH', help=json_help)
        parser.set_defaults(function=lambda arguments: needing_extra(function, arguments, show))
        return parser

    chart = add('chart', 'chart speed against accuracy of a problem or scene', _chart)
    chart.add_argument(
        'problem', metavar='PROBLEM', nargs='*',
        help='problems or scenes; all: every problem; none: list them',
    )  # fmt: skip
    chart.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/chart'))
    chart.add_argument('--integrators', nargs='+', metavar='NAME', help='default: all five')
    chart.add_argument('--timesteps', nargs='+', type=float, metavar='S', help='[s]')
    chart.add_argument('--repeats', type=int, default=3, help='timed runs per point (default 3)')
    chart.add_argument('--quick', action='store_true', help='four timesteps, one timed run')
    chart.add_argument(
        '--from', dest='saved', nargs='+', type=Path, metavar='JSON',
        help='draw results of an earlier chart again, without running',
    )  # fmt: skip


@contextmanager
def progress() -> Iterator['Report']:
    """Give a function that shows how far a measurement is, on standard error."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    bar = Progress(
        TextColumn('{task.description}'), BarColumn(), TextColumn('{task.completed}/{task.total}'),
        TimeRemainingColumn(), console=Console(stderr=True), transient=True,
    )  # fmt: skip
    with bar:
        tasks: dict[str, Any] = {}

        def report(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what, total=total)
            bar.update(tasks[what], completed=done, visible=done < total)

        yield report


def _chart(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.lab import results

    if arguments.saved:
        found = [results.load(path, 'points') for path in arguments.saved]
    elif arguments.problem:
        found = _measured(arguments)
    else:
        return _list_problems(arguments, show)
    from fluid_sim_ros.lab.chart import draw
    from fluid_sim_ros.lab.chart_page import write_chart_page

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
        _fronts(found, files),
        {'charts': found, 'files': [str(file) for file in files]},
    )
    return 0


def _measured(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    from fluid_sim_ros.lab.catalogue import PROBLEMS, problem
    from fluid_sim_ros.lab.measure import measure
    from fluid_sim_ros.lab.problem import INTEGRATORS

    names = list(PROBLEMS) if arguments.problem == ['all'] else arguments.problem
    problems = [problem(name) for name in names]
    with progress() as report:
        return [
            measure(
                each,
                integrators=arguments.integrators or INTEGRATORS,
                timesteps=arguments.timesteps or (_QUICK if arguments.quick else ()),
                repeats=1 if arguments.quick else arguments.repeats,
                report=report,
            )
            for each in problems
        ]


def _list_problems(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab.catalogue import PROBLEMS

    table = Table('problem', 'what moves', 'stands for', title='Problems (every scene is one too)')
    rows = []
    for name, make in PROBLEMS.items():
        each = make()
        rows.append({'name': name, 'title': each.title, 'stands_for': each.stands_for})
        table.add_row(name, escape(each.title), escape(each.stands_for))
    show(arguments.json, table, rows)
    return 0


def _fronts(found: list[dict[str, Any]], files: list[Path]) -> Any:
    """Return the Pareto fronts as a table."""
    from rich.console import Group
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab.pareto import judged

    table = Table(
        'problem', 'rung', 'integrator', 'timestep', 'µs per simulated s', 'error',
        title='Pareto fronts',
    )  # fmt: skip
    for result in found:
        front = [point for point in result['points'] if point['pareto']]
        for point in sorted(front, key=lambda p: float(p['wall_us_per_s'])):
            table.add_row(
                result['problem'], escape(point['rung']), point['integrator'],
                f'{point["timestep_s"] * 1e3:g} ms', f'{point["wall_us_per_s"]:.4g}',
                f'{judged(point, result["judged_by"]):.3g} {result["judged_by"]}',
            )  # fmt: skip
    return Group(table, escape('\n'.join(map(str, files))))
