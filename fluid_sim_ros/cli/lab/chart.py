# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim chart``: speed against accuracy of problems and scenes."""

import argparse
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.lab.tables import fronts_table
from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.reality.chart_against import add_against, chart_flight
from fluid_sim_ros.cli.shared import Show, add_command, made_folder
from fluid_sim_ros.errors import ConfigError, FluidSimError, printable
from fluid_sim_ros.output.progress import progress_of_parts

if TYPE_CHECKING:
    from fluid_sim_ros.lab.problems.problem import Problem
    from fluid_sim_ros.output.progress import Report

#: A quick chart: so many timesteps, the largest of them [s], and bursts of steps.
_QUICK_COUNT, _QUICK_LARGEST, _QUICK_ROUNDS = 4, 0.02, 10
#: Exit code where some of the problems failed.
FAILED = 2
#: Errors of one problem that do not end the others.
_CAUGHT = (
    FluidSimError, RuntimeError, ArithmeticError, LookupError, ValueError, TypeError,
    AttributeError,
)  # fmt: skip


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
    problem = chart.add_argument(
        'problem', metavar='PROBLEM', nargs='*',
        help='problems, scenes (name or file); all: every problem; none: list them',
    )  # fmt: skip
    completion.completed_by(problem, completion.problems)
    chart.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/chart'))
    integrators = chart.add_argument(
        '--integrators', nargs='+', metavar='NAME', help='default: all five'
    )
    completion.completed_by(integrators, completion.words(*completion.INTEGRATORS))
    chart.add_argument('--timesteps', nargs='+', type=float, metavar='S', help='[s]')
    chart.add_argument(
        '--metric', default='pose', help='pose, position, attitude, velocity or regime'
    )
    chart.add_argument(
        '--rounds',
        type=above(0, int),
        default=60,
        help='timed bursts of steps per curve (default 60)',
    )
    chart.add_argument('--quick', action='store_true', help='four timesteps, ten bursts')
    chart.add_argument(
        '--from', dest='saved', nargs='+', type=Path, metavar='JSON',
        help='draw results of an earlier chart again, without running',
    )  # fmt: skip
    chart.add_argument(
        '--time-again', action='store_true',
        help='with --from: measure the times anew, on this machine, and keep the errors; name '
        'the scene file, too, where it is yours',
    )  # fmt: skip
    add_against(chart)


def _chart(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.drawing.chart import draw
    from fluid_sim_ros.lab.drawing.chart_page import write_chart_page

    if arguments.against is not None:
        return chart_flight(arguments, show)
    if arguments.time_again and not arguments.saved:
        raise ConfigError('--time-again: needs --from JSON, the charts to time')
    if not (arguments.saved or arguments.problem):
        return _list_problems(arguments, show)
    found: list[dict[str, Any]] = []
    failed: dict[str, str] = {}
    files: list[Path] = []
    with made_folder(arguments.out) as folder, progress_of_parts() as report:
        for name, make in _charts(arguments, report):
            try:
                result = make()
                fronts_table([result], [], [])  # a saved one may lack what is shown
                stem = folder / result['problem']
                # written at once: a later failure does not lose it
                write_chart_page([*found, result], folder / 'chart.html')
                files += [
                    results.save(result, stem.with_suffix('.json')),
                    results.write_csv(result, stem.with_suffix('.csv')),
                    draw(result, stem.with_suffix('.png')),
                ]
                found.append(result)
            except _CAUGHT as error:
                failed[name] = _reason(error)
                if arguments.saved and not isinstance(error, FluidSimError):
                    failed[name] = f'{printable(name)}: is no whole chart ({failed[name]})'
        if found:
            files.append(write_chart_page(found, folder / 'chart.html'))
    lines = [f'{name} failed: {reason}' for name, reason in failed.items()]
    if not found:
        raise ConfigError('; '.join(failed.values()))
    show(
        arguments.json, fronts_table(found, files, lines),
        {'charts': found, 'failed': failed, 'files': [str(file) for file in files]},
    )  # fmt: skip
    for line in lines:
        sys.stderr.write(f'fluid_sim: {line}\n')
    return FAILED if failed else 0


def _reason(error: Exception) -> str:
    if isinstance(error, FluidSimError):
        return str(error)
    return printable(f'{type(error).__name__}: {" ".join(str(error).split())}')


def _charts(
    arguments: argparse.Namespace, report: 'Report'
) -> list[tuple[str, Callable[[], dict[str, Any]]]]:
    """Return what is charted, by name, each as a function that measures it."""
    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.charts.measure import measure, time_again
    from fluid_sim_ros.lab.problems.catalogue import PROBLEMS, is_scene, problem
    from fluid_sim_ros.lab.problems.problem import INTEGRATORS

    files = {Path(name).stem: name for name in arguments.problem or ()}
    rounds = _QUICK_ROUNDS if arguments.quick else arguments.rounds

    def measured(name: str) -> dict[str, Any]:
        case = problem(name)
        steps = arguments.timesteps or (quick_timesteps(case) if arguments.quick else ())
        return measure(
            case, integrators=arguments.integrators or INTEGRATORS, timesteps=steps,
            metric_name=arguments.metric, rounds=rounds, report=report,
        )  # fmt: skip

    def saved(path: Path) -> dict[str, Any]:
        result = results.load(path, 'points')
        if not arguments.time_again:
            return result
        name = result['problem']
        if not (name in PROBLEMS or is_scene(files.get(name, name))):
            raise ConfigError(
                f"{path}: its problem '{name}' is a scene file of yours; name that file, too: "
                f'fluid_sim chart {name}.yaml --from {path} --time-again'
            )
        case = problem(files.get(name, name))
        return time_again(result, case, rounds=rounds, report=report)

    if arguments.saved:
        return [(str(path), partial(saved, path)) for path in arguments.saved]
    names = list(PROBLEMS) if arguments.problem == ['all'] else arguments.problem
    return [(name, partial(measured, name)) for name in names]


def quick_timesteps(case: 'Problem') -> tuple[float, ...]:
    """
    Return the timesteps of a quick chart.

    Parameters
    ----------
    case
        The problem; a gait or an event may allow small timesteps only.

    Returns
    -------
    tuple
        The largest of the problem's own ones, from 20 ms down [s].

    """
    small = [step for step in case.timesteps if step <= _QUICK_LARGEST]
    return tuple(small[:_QUICK_COUNT]) or case.timesteps[-_QUICK_COUNT:]


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
